#!/bin/bash
# The runner itself: every kind of difference must fail a case.
runner=$(realpath "$(dirname "$0")/run_case.sh")
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
mkdir bin
bad=0

new_case() { rm -rf case; mkdir case; printf '%s\n' "$1" > case/cmd; }
passes() { bash "$runner" case bin . > log 2>&1 || { echo "should pass: $1"; cat log; bad=1; }; }
fails() { bash "$runner" case bin . > log 2>&1 && { echo "should fail: $1"; bad=1; }; }

new_case 'true'; passes "nothing said"
new_case 'exit 2'; fails "exit code"
echo 2 > case/exit; passes "expected exit code"
new_case 'echo oops >&2'; fails "unexpected stderr"
echo oop > case/stderr; passes "stderr substring"
echo other >> case/stderr; fails "missing stderr line"
new_case 'echo hello'; echo hello > case/stdout; passes "stdout"
echo hell > case/stdout; fails "stdout differs"
new_case 'echo hello; echo $TMP >/dev/null; touch $TMP/x'; echo ell > case/stdout_has; passes "stdout_has"
echo elk > case/stdout_has; fails "stdout_has"

csv() { # NAME EXPECTED_RESULT ACTUAL...
  local name=$1 result=$2; shift 2
  new_case "printf '%s\n' $*"
  printf 'file,x\na,1\nb,100\nc,\n' > case/stdout.csv
  echo 1e-3 > case/tolerance
  "$result" "csv $name"
}
csv equal passes file,x a,1 b,100 c,
csv within passes file,x a,1.09 b,99.95 c,
csv beyond fails file,x a,1.2 b,100 c,
csv NaN fails file,x a,nan b,100 c,
csv infinity fails file,x a,1 b,inf c,
csv "empty field" fails file,x a, b,100 c,
csv "number for empty" fails file,x a,1 b,100 c,5
csv header fails file,y a,1 b,100 c,
csv text fails file,x z,1 b,100 c,
csv "missing row" fails file,x a,1 b,100
csv "extra row" fails file,x a,1 b,100 c, d,4
csv "extra field" fails file,x a,1,1 b,100 c,
csv nothing fails
rm case/tolerance; new_case "printf 'file,x\na,1\n'"; printf 'file,x\na,1.0\n' > case/stdout.csv; passes "exact by default"
printf 'file,x\na,1.0000001\n' > case/stdout.csv; fails "exact by default"
printf 'file,x\na,1\n' > case/stdout.csv; echo x > case/tolerance; fails "tolerance is no number"
exit $bad
