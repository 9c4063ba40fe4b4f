#!/bin/bash
# check_slow_names.sh SUITE TEST_PROGRAM...: no case of the suite has a comma in its name. doctest's discovery takes a comma for the
# end of a name and then gives the case no label, so that a slow one would run in every ./check.
suite=$1
shift
wrong=0
for program in "$@"; do
  cases=$("$program" --test-suite="$suite" --list-test-cases) || exit 1
  if grep ',' <<< "$cases" >&2; then
    echo "$program: the names above lose their label \"$suite\" by a comma" >&2
    wrong=1
  fi
done
exit $wrong
