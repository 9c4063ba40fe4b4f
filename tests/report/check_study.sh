#!/usr/bin/env bash
# Writes pages of studies made for the purpose with report/study and looks at what is on them.
# usage: check_study.sh SOURCE_DIR BIN_DIR
set -euo pipefail
export PATH=$2:$PATH
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
failures=0
fail() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }

# study NAME TEXT: a study whose README is the text.
study() {
  mkdir -p "$out/$1"
  printf '%s\n' "$2" >"$out/$1/README.md"
}

study good '# Ball & rod

A *first* word.

```sh
printf "time_s,force_N\n0,0\n1,2.123456789\n" | tee force.csv
ir-plot force.csv -o force.svg
```

![The force](force.svg)

```sh
test -s force.csv
basename "$here"
```'
"$1/report/study" "$out/good" "$out/pages"
page=$out/pages/good.html
grep -q '<title>Ball &amp; rod</title>' "$page" || fail "no title"
grep -q '<em>first</em>' "$page" || fail "no prose"
grep -q '<td class="r">2.1235</td>' "$page" || fail "no table"
(($(grep -c '<svg' "$page") == 1)) || fail "no picture"
grep -q '<pre>good</pre>' "$page" || fail "the second block did not see the study's folder"
if grep -q '<!--' "$page"; then fail "a mark left standing"; fi
[[ -s $out/pages/good/force.csv && -s $out/pages/good/commands/02.sh ]] || fail "files or commands not kept"

study broken '# Broken

```sh
printf "a,b\n1,2\n"
false
echo "not reached" >&2
```'
if "$1/report/study" "$out/broken" "$out/pages" 2>"$out/broken.txt"; then fail "a block that fails passes"; fi
grep -q 'block 01 of .*broken/README.md failed' "$out/broken.txt" || fail "the failing block is not named"
if grep -q '^not reached' "$out/broken.txt"; then fail "a block goes on after a failure"; fi
[[ ! -e $out/pages/broken.html ]] || fail "a page of a study that failed"

study bare '# Bare

```sh
true
```

![Nothing](nothing.svg)'
if "$1/report/study" "$out/bare" "$out/pages" 2>"$out/bare.txt"; then fail "a picture that nothing wrote passes"; fi
grep -q 'nothing.svg, which no block has written' "$out/bare.txt" || fail "the missing picture is not named"

study empty '# Empty'
if "$1/report/study" "$out/empty" "$out/pages" 2>"$out/empty.txt"; then fail "a study without blocks passes"; fi
exit $((failures > 0))
