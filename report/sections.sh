# The sections of the page on the four bar impacts, one function each. Sourced by report/make.

# html_commands FILE CASE
html_commands() {
  echo "<details><summary>The commands for ${2^^}</summary>"
  echo "<p>Kept as <code>$1</code>; runs in the project’s folder with the tools in <code>PATH</code>.</p>"
  echo "<pre>$(escape <"$1")</pre></details>"
}

section_title() {
  cat <<'EOF'
<h1>Four impacts on a Hopkinson bar</h1>
<p class="lead">Four projectiles of nylon and aluminium strike the end of a long steel rod. The force between them is predicted by the impulse response
method, from exact travelling waves and from modes, and by explicit finite elements, which share no code with it.</p>
EOF
}

# section_summary SUMMARY.csv CASE...
section_summary() {
  local awk_program summary=$1
  shift
  echo '<nav>'
  for case; do echo "<a href=\"#$case\">${case^^}</a>"; done
  echo '<a href="#table-4-1">Table 4.1</a> <a href="#studies">Studies</a> <a href="#resolution">Modes and step</a> <a href="#reading">How to read this</a></nav>'
  echo '<h2>Summary</h2>'
  awk_program='
    BEGIN { print "case\tprojectile\tface\tspeed<br />m/s\tfirst force<br />N\tpeak<br />N\tpeak at<br />µs\tcontact ends<br />µs\timpulse<br />N s" }
    NR == 1 { name_columns(); next }
    { print "<a href=\"#" tolower(value("case")) "\">" value("case") "</a>\t" value("projectile") "\t" value("face") "\t" number(value("speed_m_per_s"), 2) "\t" \
        number(value("first_force_N"), 1) "\t" number(value("peak_force_N"), 1) "\t" number(1e6 * value("peak_time_s"), 1) "\t" \
        number(1e6 * value("contact_duration_s"), 1) "\t" number(value("impulse_Ns"), 4) }'
  format -F, "$summary" | html_table lllrrrrrr
  echo '<p class="note">Travelling waves at 0.1 µs. A peak that lasts counts from its beginning. Each case begins when the faces touch.</p>'
}

# case_table CASE FOLDER: one line per history, the exact values first where they are known.
case_table() {
  local awk_program folder=$2 run exact=data/experiments/$1/exact.csv
  {
    printf 'method\tstep<br />µs\tpeak<br />N\tcontact<br />µs\timpulse<br />N s\tL2<br />%%\tenergy error<br />%%\n'
    if [[ -e $exact ]]; then
      awk_program='NR == 1 { name_columns(); next }
        { print "exact\t\t" number(value("peak_force_N"), 1) "\t" number(1e6 * value("contact_duration_s"), 2) "\t" number(value("impulse_Ns"), 5) "\t\t" }'
      format -F, "$exact"
    fi
    for run in $(case_runs "$1"); do
      awk_program='
        FNR == 1 { delete column; name_columns(); next }
        FILENAME ~ /comparison/ { file = value("file"); sub(/^.*\//, "", file); if (file == run ".csv") l2 = 100 * value("relative_l2"); next }
        { print run_method(run) "\t" run_step(run) "\t" number(value("peak_force_N"), 1) "\t" number(1e6 * value("contact_duration_s"), 2) "\t" \
            number(value("impulse_Ns"), 5) "\t" (l2 == "" ? "reference" : number(l2, 2)) "\t" number(100 * value("energy_error"), 3) }'
      format -F, -v run="$run" "$folder/comparison.csv" "$folder/$run-summary.csv"
    done
  } | html_table lrrrrrr runs
}

# exact_table CASE FOLDER: known values and those of the finest waves.
exact_table() {
  local awk_program data=data/experiments/$1 reference
  read -r reference _ <<<"$(case_runs "$1")"
  awk_program='
    function line(name, unit, known, ours, decimals) {
      print name " " unit "\t" number(known, decimals) "\t" number(ours, decimals) "\t" sprintf("%.0e", known > ours ? (known - ours) / known : (ours - known) / known)
    }
    FNR == 1 { ++file; delete column; name_columns(); next }
    file == 1 { first = value("first_force_N"); peak = value("peak_force_N"); from = 1e6 * value("peak_from_s"); until = 1e6 * value("peak_until_s")
                end = 1e6 * value("contact_duration_s"); impulse = value("impulse_Ns"); next }
    file == 2 && FNR == 2 { our_first = value("force_N") }
    file == 3 {
      print "\texact\ttravelling waves, 0.1 µs\tapart by"
      line("first force", "N", first, our_first, 6)
      line("peak", "N", peak, value("peak_force_N"), 4)
      ours = 1e6 * value("peak_time_s")
      print "peak at µs\t" (from == until ? number(from, 3) : number(from, 3) " to " number(until, 3)) "\t" number(1e6 * value("peak_time_s"), 3) "\t" \
        (ours < from ? number(from - ours, 1) " µs" : ours > until ? number(ours - until, 1) " µs" : "within")
      line("contact ends", "µs", end, 1e6 * value("contact_duration_s"), 3)
      line("impulse", "N s", impulse, value("impulse_Ns"), 9)
    }'
  format -F, "$data/exact.csv" "$2/$reference.csv" "$2/$reference-summary.csv" | html_table lrrr
}

# section_case CASE FOLDER
section_case() {
  local case=$1 folder=$2 data=data/experiments/$1
  echo "<h2 id=\"$case\">$(sed -n '1s/^# //p' "$data/README.md")</h2>"
  echo "<p>$(awk '/^#/ { next } NF { print; next } NR > 2 { exit }' "$data/README.md" | escape)</p>"
  html_picture "$folder/force.svg" "${case^^}: force histories by three methods"
  case_table "$case" "$folder"
  echo "<p>$(awk '/^## What to look for/ { inside = 1; next } /^## / { inside = 0 } inside' "$data/README.md" | escape)</p>"
  html_picture "$folder/zoom.svg" "${case^^}: the largest jump of the force"
  echo '<p class="note">The largest jump after the first instant, 60 µs on either side.</p>'
  if [[ -e $data/exact.csv ]]; then
    echo '<h3>Beside the exact values</h3>'
    exact_table "$case" "$folder"
  fi
  html_commands "$folder/commands.sh" "$case"
}

# section_table_4_1 FILE.csv
section_table_4_1() {
  local awk_program
  cat <<'EOF'
<h2 id="table-4-1">Table 4.1</h2>
<p>CPU times of both methods at the published steps, from the bodies to the force, beside those published for a workstation of the early 1990s (minutes:seconds).
The shortest of five runs counts. The ratio says how much shorter: mostly a newer machine, partly better numerics.</p>
EOF
  awk_program='
    BEGIN { print "case\tmethod\tstep<br />µs\tpublished<br />min:s\there<br />ms\tratio\tL2<br />%" }
    NR == 1 { name_columns(); next }
    { method = value("method"); sub(/-/, " ", method)
      print toupper(value("case")) "\t" method "\t" 1e6 * value("step_s") "\t" minutes(value("published_cpu_s")) "\t" number(1e3 * value("cpu_s"), 2) "\t" \
        number(1000 * int(value("ratio") / 1000 + 0.5), 0) "\t" number(100 * value("relative_l2"), 2) }'
  format -F, "$1" | html_table llrrrrr
}

# section_studies STUDY...: what each is about, its README's title, and where its page is.
section_studies() {
  local study
  echo '<h2 id="studies">Studies</h2>'
  echo '<p>Other bodies, other questions: each page with the commands that made it.</p>'
  echo '<ul>'
  for study; do echo "<li><a href=\"$(basename "$study").html\">$(sed -n '1s/^# //p' "$study/README.md" | escape)</a></li>"; done
  echo '</ul>'
}

# section_resolution FOLDER CASE...: a column per case and step.
section_resolution() {
  local awk_program folder=$1 case step kind cell file
  shift
  cat <<EOF
<h2 id="resolution">How many modes, what step</h2>
<p>The trapezoidal rule on modal responses, as the published calculations used it, with modes of five origins. L2 against travelling waves at 0.1 µs, in %.</p>
EOF
  {
    printf 'modes of both bodies'
    for case; do for step in "${resolution_steps_us[@]}"; do printf '\t%s<br />%s µs' "${case^^}" "$step"; done; done
    echo
    for kind in "${resolution_kinds[@]}"; do
      printf '%s' "$(resolution_label "$kind")"
      for case; do
        for step in "${resolution_steps_us[@]}"; do
          file=$folder/$case/$kind-${step}us.csv
          if [[ -e $file ]]; then
            awk_program='NR == 1 { name_columns(); next } value("file") == file { printf "\t%s", number(100 * value("relative_l2"), 2) }'
            format -F, -v file="$file" "$folder/$case/comparison.csv"
          else
            printf '\trefused'
          fi
        done
      done
      echo
    done
  } | html_table lrrrr modes
  cat <<'EOF'
<p>A sampled impulse response holds frequencies up to the Nyquist frequency, 1/(2 step). Exact modes up to there and not one further make the rule follow
waves without dispersion; what is left of L2 is the price of jumps between samples. Plain finite-element modes have frequencies that are too low near the top
of the mesh: the force rings, and a finer step helps slowly. Corrected by the mesh’s own dispersion they are as good as exact ones. A finer mesh with modes
up to the Nyquist frequency lies between. All modes of a finer mesh go beyond it and fold back into the record (aliasing); <code>ir-impact</code> refuses such
a response rather than give a force that is too small. The correction is refused too where a section cannot be cut into elements of about equal travel time
(CCA’s aluminium at 10 µs). Hence the default of <code>ir-bar</code> and <code>ir-cone</code>: exact modes up to the Nyquist frequency.</p>
EOF
  for case; do html_commands "$folder/$case/commands.sh" "$case"; done
}

resolution_label() {
  case $1 in
    exact) echo 'exact, up to Nyquist' ;;
    fe) echo 'elements of one step’s travel time' ;;
    fe-corrected) echo 'the same, frequencies corrected' ;;
    fe-finer) echo "$refinement times the elements, up to Nyquist" ;;
    fe-finer-all) echo "$refinement times the elements, all modes" ;;
  esac
}

section_reading() {
  cat <<'EOF'
<h2 id="reading">How to read this</h2>
<dl>
<dt>The three methods</dt>
<dd><em>Travelling waves</em>: each body’s response from waves that run and reflect, exact in one-dimensional theory. <em>Modes, trapezoidal</em>: the same response as a sum of
vibration modes, and the equation V = (G₁ + G₂) * F by the trapezoidal rule, as published. <em>Finite elements</em>: both bodies as chains of masses and springs, stepped through time
until the faces part. The first two give one force for any pair of bodies once their responses are known; the third starts afresh for each.</dd>
<dt>L2</dt>
<dd>Root of the mean squared difference from the reference over its contact, as a share of the root mean square of the reference force. 1 % of L2 in a force
of 2000 N rms is a difference of 20 N rms. It sees every wiggle; peak and impulse do not.</dd>
<dt>What a jump costs</dt>
<dd>Where a wave returns, the force jumps. Between two samples a drawn history is a straight line, so a jump J is smeared over one step Δt (two where the force is a mean per step) however good
the method: it adds about J²Δt/6 to the squared difference. L2 therefore falls like the root of the step, 10 times for a step 100 times finer. The impulse falls much
faster: what is missing before the jump is there after it. Judge a method by impulse and contact end as well as by L2.</dd>
<dt>Peak</dt>
<dd>Of the samples. Next to a jump the true peak lies between two of them.</dd>
<dt>Contact</dt>
<dd>From the first touch to the time at which the force stops being positive for three samples on end. In all four cases the rod’s far end is silent until 2390 µs.</dd>
<dt>Energy error</dt>
<dd>Work that the force seems to do on the contact itself, as a share of speed × impulse. It should be zero; at jumps it is as large as the sampling makes it.</dd>
</dl>
EOF
}
