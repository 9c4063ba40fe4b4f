# One impact of data/experiments/<case>: the commands that compute it, and the facts about it that the page shows. Sourced by report/make.

# toml_value FILE KEY: a string of a flat TOML file.
toml_value() { sed -n "s/^$2 *= *\"\(.*\)\" *$/\1/p" "$1"; }

# published_step CASE METHOD: the step of published.csv as the tools take it, 10us.
published_step() { awk -F, -v method="$2" '$1 == method { printf "%gus", 1e6 * $2 }' "data/experiments/$1/published.csv"; }

# Every history of a case by the stem of its file, in the order of its table; the reference is first.
case_runs() {
  local modal fe
  modal=$(published_step "$1" impulse-response)
  fe=$(published_step "$1" finite-elements)
  echo "waves-0.1us waves-1us modal-$modal modal-1us fe-$fe fe-0.25us"
}

# response_commands STEM METHOD STEP [ir-impact options]: two responses, the force, its summary.
response_commands() {
  local stem=$1 method=$2 step=$3
  shift 3
  cat <<EOF
$projectile_tool --config "\$in/projectile.toml" --method $method --step $step --duration 1.2ms -o "\$out/$stem-projectile.csv"
ir-bar --config "\$in/target.toml" --method $method --step $step --duration 1.2ms -o "\$out/$stem-target.csv"
ir-impact --config "\$in/impact.toml"${*:+ $*} "\$out/$stem-projectile.csv" "\$out/$stem-target.csv" -o "\$out/$stem.csv"
ir-impact --config "\$in/impact.toml"${*:+ $*} "\$out/$stem-projectile.csv" "\$out/$stem-target.csv" --summary -o "\$out/$stem-summary.csv"
EOF
}

# element_commands STEM STEP [fe-impact options]
element_commands() {
  local stem=$1 step=$2
  shift 2
  local bodies="--projectile \"\$in/projectile.toml\" --target \"\$in/target.toml\" --config \"\$in/impact.toml\""
  cat <<EOF
fe-impact $bodies --step $step${*:+ $*} --duration 1.2ms -o "\$out/$stem.csv"
fe-impact $bodies --step $step${*:+ $*} --duration 1.2ms --summary -o "\$out/$stem-summary.csv"
EOF
}

# case_commands CASE FOLDER: the script that computes everything about the case into the folder.
case_commands() {
  local case=$1 folder=$2 projectile_tool runs
  projectile_tool=ir-$(toml_value "data/experiments/$case/projectile.toml" body)
  read -ra runs <<<"$(case_runs "$case")"
  local published_modal=${runs[2]} published_fe=${runs[4]}
  local reference=${runs[0]} others=("${runs[@]:1}")
  cat <<EOF
#!/usr/bin/env bash
# Case ${case^^} by three methods. In the project's folder, with the tools in PATH: bash commands.sh [FOLDER]
set -euo pipefail
in=data/experiments/$case
out=\${1:-$folder}
mkdir -p "\$out/zoom"

# Travelling waves (exact), the finest step as the reference
$(response_commands "$reference" wave 0.1us)
$(response_commands "${runs[1]}" wave 1us)

# Modes up to the Nyquist frequency and the trapezoidal rule, at the published step and finer
$(response_commands "$published_modal" modal "${published_modal#modal-}" --method trapezoidal)
$(response_commands "${runs[3]}" modal 1us --method trapezoidal)

# Explicit finite elements, four steps of the projectile within one of the target, and one to one at a finer step
$(element_commands "$published_fe" "${published_fe#fe-}" --subcycles 4)
$(element_commands "${runs[5]}" 0.25us)

# Differences from the reference
ir-compare "\$out/$reference.csv"$(printf ' "$out/%s.csv"' "${others[@]}") -o "\$out/comparison.csv"

# Pictures: the whole impact, and 60 us on either side of the largest jump after the first instant
ir-plot$(printf ' "$out/%s.csv"' "${runs[1]}" "$published_modal" "$published_fe") -o "\$out/force.svg"
jump=\$(awk -F, 'NR > 3 { d = \$2 - last; if (d < 0) d = -d; if (d > most) { most = d; t = \$1 } } NR > 2 { last = \$2 } END { print t }' "\$out/$reference.csv")
for run in $reference $published_modal $published_fe ${runs[3]}; do
  awk -F, -v t="\$jump" 'NR == 1 || (\$1 > t - 60e-6 && \$1 < t + 60e-6)' "\$out/\$run.csv" > "\$out/zoom/\$run.csv"
done
ir-plot$(printf ' "$out/zoom/%s.csv"' "$reference" "$published_modal" "$published_fe" "${runs[3]}") -o "\$out/zoom.svg"
EOF
}

# csv_value FILE COLUMN: the first row's.
csv_value() {
  awk -F, -v column="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == column) c = i } NR == 2 { print $c; exit }' "$1"
}

# case_summary CASE FOLDER: one CSV row of what the finest waves say, in the columns of summary_header. A peak that is a plateau
# counts from its first sample, whichever of them rounding has made the highest.
summary_header=case,projectile,face,speed_m_per_s,first_force_N,peak_force_N,peak_time_s,contact_duration_s,impulse_Ns
case_summary() {
  local data=data/experiments/$1 reference
  read -r reference _ <<<"$(case_runs "$1")"
  local history=$2/$reference.csv summary=$2/$reference-summary.csv speed peak
  speed=$(toml_value "$data/impact.toml" speed)
  peak=$(csv_value "$summary" peak_force_N)
  printf '%s,%s,%s,%s,%s,%s,%s,%s,%s\n' "${1^^}" "$(sed -n '1s/^# \([^:,.]*\).*/\1/p' "$data/projectile.toml")" \
    "$(toml_value "$data/projectile.toml" face)" "${speed%m/s}" "$(csv_value "$history" force_N)" "$peak" \
    "$(awk -F, -v peak="$peak" 'NR > 1 && $2 >= peak * (1 - 1e-9) { print $1; exit }' "$history")" \
    "$(csv_value "$summary" contact_duration_s)" "$(csv_value "$summary" impulse_Ns)"
}
