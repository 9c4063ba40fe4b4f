#!/bin/bash
# check_symbols.sh NAME PROGRAM...: no program defines a dynamic symbol with NAME in it, which a shared library would take for its own.
name=$1
shift
wrong=0
for program in "$@"; do
  symbols=$(nm --dynamic --defined-only --demangle "$program") || exit 1
  if grep -m 3 "$name" <<<"$symbols" >&2; then
    echo "$program: lends the symbols above to the libraries that it loads" >&2
    wrong=1
  fi
done
exit $wrong
