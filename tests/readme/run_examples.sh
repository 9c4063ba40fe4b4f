#!/usr/bin/env bash
# Types the console blocks of a Markdown file as they stand and compares what they print: text exactly, numbers to 1e-6 (small ones, such as
# an error that cancels, to 1e-9).
# usage: run_examples.sh FILE BIN_DIR SOURCE_DIR
set -u
file=$(realpath "$1")
export PATH=$2:$PATH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" && ln -s "$3/data" data || exit 2
expected=$scratch/expected.txt
actual=$scratch/actual.txt
: >"$expected"
: >"$actual"
commands=0
inside=0
while IFS= read -r line; do
  case $line in
    '```console') inside=1 ;;
    '```') inside=0 ;;
    '$ '*)
      ((inside)) || continue
      commands=$((commands + 1))
      printf '%s\n' "$line" >>"$expected"
      printf '%s\n' "$line" >>"$actual"
      bash -o pipefail -c "${line#\$ }" >>"$actual" 2>&1 </dev/null || { echo "failed: $line" >&2; cat "$actual" >&2; exit 1; }
      ;;
    *) ((inside)) && printf '%s\n' "$line" >>"$expected" ;;
  esac
done <"$file"
((commands > 0)) || { echo "no console block in $file" >&2; exit 1; }
awk '
  function is_number(x) { return x ~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/ }
  function apart(a, b,  d, m) { d = a - b; if (d < 0) d = -d; m = a < 0 ? -a : a; return d > 1e-6 * m + 1e-9 }
  NR == FNR { want[FNR] = $0; wanted = FNR; next }
  {
    n = split(want[FNR], a, /[ ,]/); m = split($0, b, /[ ,]/); bad = n != m || FNR > wanted
    for (i = 1; i <= n && !bad; ++i) bad = is_number(a[i]) && is_number(b[i]) ? apart(a[i] + 0, b[i] + 0) : a[i] != b[i]
    if (bad) { print "line " FNR "\n  documented: " want[FNR] "\n  printed:    " $0; failed = 1 }
    got = FNR
  }
  END { if (got != wanted) { print "documented " wanted " lines, printed " got; failed = 1 } exit failed }
' "$expected" "$actual"
