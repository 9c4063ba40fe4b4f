# How many modes and what step: one impact with modes of several origins. Sourced by report/make.

resolution_cases=(tca cca)
resolution_steps_us=(10 1)
refinement=2  # of the finer mesh

# Travel times end to end, from which the number of elements follows.
declare -A projectile_travel_us=([tca]=256.348 [cca]=209.671)
target_travel_us=1195.1745

# The kinds of modes, by the names of their files: exact ones; finite elements whose travel time is the step, plain and corrected; a finer mesh up to
# the Nyquist frequency, and with all it has.
resolution_kinds=(exact fe fe-corrected fe-finer fe-finer-all)

# element_count TRAVEL_US STEP_US
element_count() { awk -v travel="$1" -v step="$2" 'BEGIN { printf "%.0f", travel / step }'; }

# modes_options KIND ELEMENTS
modes_options() {
  local finer=$((refinement * $2))
  case $1 in
    exact) ;;
    fe) echo " --modes-from fe --elements $2" ;;
    fe-corrected) echo " --modes-from fe --elements $2 --fe-frequencies corrected" ;;
    fe-finer) echo " --modes-from fe --elements $finer" ;;
    fe-finer-all) echo " --modes-from fe --elements $finer --modes $((finer + 1))" ;;
  esac
}

# resolution_commands CASE FOLDER REFERENCE: a force file for each step and kind, or none and the reason where a tool refuses.
resolution_commands() {
  local case=$1 folder=$2 reference=$3 step kind stem tool body_options rod_options
  tool=ir-$(toml_value "data/experiments/$case/projectile.toml" body)
  cat <<EOF
#!/usr/bin/env bash
# Case ${case^^} with modes of several origins. In the project's folder, with the tools in PATH: bash commands.sh [FOLDER]
set -euo pipefail
in=data/experiments/$case
out=\${1:-$folder}
mkdir -p "\$out"

# Modes above the Nyquist frequency, or elements too unlike for one correction, are refused; anything else is an error.
refused() { grep -Eq 'aliases|too unlike' "\$1" || { cat "\$1" >&2; exit 1; }; }
EOF
  for step in "${resolution_steps_us[@]}"; do
    for kind in "${resolution_kinds[@]}"; do
      stem=$kind-${step}us
      body_options=$(modes_options "$kind" "$(element_count "${projectile_travel_us[$case]}" "$step")")
      rod_options=$(modes_options "$kind" "$(element_count "$target_travel_us" "$step")")
      cat <<EOF

{ $tool --config "\$in/projectile.toml" --method modal --step ${step}us --duration 1.2ms$body_options -o "\$out/$stem-projectile.csv" &&
  ir-bar --config "\$in/target.toml" --method modal --step ${step}us --duration 1.2ms$rod_options -o "\$out/$stem-target.csv" &&
  ir-impact --config "\$in/impact.toml" --method trapezoidal "\$out/$stem-projectile.csv" "\$out/$stem-target.csv" -o "\$out/$stem.csv"
} 2> "\$out/$stem.txt" || refused "\$out/$stem.txt"
EOF
    done
  done
  printf '\n# Differences from the reference of every force that there is\nir-compare %s "$out"/*us.csv -o "$out/comparison.csv"\n' "$reference"
}
