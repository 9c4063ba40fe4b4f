#!/bin/bash
# run_case.sh CASE_DIR BIN_DIR SOURCE_DIR: runs one case of a tool and compares what it does with what the folder says.
#   cmd         bash snippet; BIN_DIR is first in PATH, the working directory is SOURCE_DIR, TMP a fresh directory
#   exit        expected exit code (0 if absent)
#   stderr      every line must occur in stderr (must be empty if absent)
#   stdout      exact output; or
#   stdout.csv  expected CSV: header and texts exact, numbers within `tolerance` (0 if absent) times the column's largest
#   stdout_has  every line must occur in stdout
case_dir=$(realpath "$1")
bin_dir=$(realpath "$2")
cd "$3" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

every_line_occurs() { # EXPECTED ACTUAL NAME
  while IFS= read -r line || [ -n "$line" ]; do
    grep -qF -- "$line" "$2" || fail "$3 lacks: $line"
  done < "$1"
}

mkdir "$work/tmp"
PATH="$bin_dir:$PATH" TMP="$work/tmp" LC_ALL=${LC_ALL:-C.UTF-8} \
  bash "$case_dir/cmd" > "$work/stdout" 2> "$work/stderr" < /dev/null
code=$?

expected_code=0
[ -f "$case_dir/exit" ] && expected_code=$(tr -d '[:space:]' < "$case_dir/exit")
[ "$code" = "$expected_code" ] || fail "exit code $code instead of $expected_code"

if [ -f "$case_dir/stderr" ]; then
  every_line_occurs "$case_dir/stderr" "$work/stderr" stderr
elif [ -s "$work/stderr" ]; then
  fail "stderr is not empty"
fi

if [ -f "$case_dir/stdout" ]; then
  diff "$case_dir/stdout" "$work/stdout" >&2 || fail "stdout differs (< expected, > actual)"
fi
[ -f "$case_dir/stdout_has" ] && every_line_occurs "$case_dir/stdout_has" "$work/stdout" stdout

if [ -f "$case_dir/stdout.csv" ]; then
  tolerance=0
  [ -f "$case_dir/tolerance" ] && tolerance=$(tr -d '[:space:]' < "$case_dir/tolerance")
  awk -F, -v tolerance="$tolerance" '
    function number(text) { return text ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
    function magnitude(x) { return x < 0 ? -x : x }
    function wrong(message) { print message; bad = 1 }
    BEGIN { if (!number(tolerance)) wrong("tolerance \"" tolerance "\" is not a number") }
    FNR == NR { expected[FNR] = $0; expected_rows = FNR
                for (i = 1; i <= NF; ++i) if (number($i) && magnitude($i + 0) > largest[i]) largest[i] = magnitude($i + 0)
                next }
    { actual[FNR] = $0; actual_rows = FNR }
    END {
      if (expected_rows < 1) wrong("the expected CSV is empty")
      if (actual_rows + 0 != expected_rows) wrong(actual_rows + 0 " lines instead of " expected_rows)
      if (actual[1] != expected[1]) wrong("header \"" actual[1] "\" instead of \"" expected[1] "\"")
      for (row = 2; row <= expected_rows && row <= actual_rows; ++row) {
        fields = split(expected[row], e); found = split(actual[row], a)
        if (found != fields) { wrong("line " row ": " found " fields instead of " fields); continue }
        for (i = 1; i <= fields; ++i) {
          if (!number(e[i])) { if (a[i] "" != e[i] "") wrong("line " row ", field " i ": " a[i] " instead of " e[i]) }
          else if (!number(a[i])) wrong("line " row ", field " i ": " a[i] " is not a number")
          else if (!(magnitude(a[i] - e[i]) <= tolerance * largest[i]))
            wrong("line " row ", field " i ": " a[i] " instead of " e[i] " (tolerance " tolerance " of " largest[i] + 0 ")")
        }
      }
      exit bad
    }' "$case_dir/stdout.csv" "$work/stdout" >&2 || fail "stdout differs from stdout.csv"
fi

if [ "$failures" -gt 0 ]; then
  echo "--- stderr"; head -c 4000 "$work/stderr"
  echo "--- stdout"; head -c 4000 "$work/stdout"
  exit 1
fi >&2
