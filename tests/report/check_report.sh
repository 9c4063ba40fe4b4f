#!/usr/bin/env bash
# Writes the page of report/make into a temporary folder and checks it; computes one case again by the commands that the page keeps.
# usage: check_report.sh SOURCE_DIR BIN_DIR
set -euo pipefail
export PATH=$2:$PATH
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
failures=0
fail() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }

"$1/report/make" "$out/report" >"$out/terminal.txt"
page=$out/report/index.html
[[ -s $page ]] || { echo "FAILED: no page" >&2; exit 1; }

for case in tca tcb cca ccb; do
  grep -q "id=\"$case\"" "$page" || fail "$case has no section"
  grep -q "^${case^^} " "$out/terminal.txt" || fail "$case is not on the terminal"
done
tail -n 1 "$out/terminal.txt" | grep -qx "$page" || fail "the last line is not the page's path"
(($(grep -c '<svg' "$page") == 8)) || fail "not two pictures for each case"

# Nothing that was not computed, and nothing that the page would have to fetch.
text=$(sed 's/<[^>]*>/ /g' "$page")
if grep -Eiwq -- '-?(nan|inf)' <<<"$text"; then fail "a number is not a number"; fi
if grep -o 'https\?://[^"]*' "$page" | grep -qvx 'http://www.w3.org/2000/svg'; then fail "an address"; fi
if grep -Eq '(src|xlink:href|@import|<script|<link)' "$page"; then fail "a reference to the outside"; fi
for target in $(grep -o 'href="[^#"][^"]*"' "$page" | sed 's/href="//; s/"//'); do
  [[ $target != */* && -s $out/report/$target ]] || fail "a link to $target, which is not there"
done

# Tags balance, and no id stands twice.
awk '
  { text = text $0 "\n" }
  END {
    while (match(text, /<[^>]*>/)) {
      tag = substr(text, RSTART + 1, RLENGTH - 2); text = substr(text, RSTART + RLENGTH)
      if (tag ~ /^!/ || tag ~ /\/$/) continue
      name = tag; sub(/^\//, "", name); sub(/[ \t\n].*/, "", name)
      if (tag !~ /^\//) { open[++depth] = name; continue }
      if (depth == 0 || open[depth] != name) { print "FAILED: </" name "> closes <" open[depth] ">"; exit 1 }
      --depth
    }
    if (depth) { print "FAILED: <" open[depth] "> stays open"; exit 1 }
  }' "$page" >&2 || fail "tags"
repeated=$(grep -o ' id="[^"]*"' "$page" | sort | uniq -d)
[[ -z $repeated ]] || fail "repeated$repeated"

# The commands that the page keeps are those that were run.
(cd "$1" && bash "$out/report/tca/commands.sh" "$out/again")
for file in "$out"/report/tca/*.csv "$out"/report/tca/*.svg "$out"/report/tca/zoom/*.csv; do
  name=${file#"$out/report/tca/"}
  # The comparison names its files, which now lie elsewhere.
  if ! diff -q <(sed "s|$out/report/tca/||" "$file") <(sed "s|$out/again/||" "$out/again/$name") >/dev/null; then fail "$name comes out differently"; fi
done
exit $((failures > 0))
