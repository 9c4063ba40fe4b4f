#!/bin/bash
# check_verified_by.sh SOURCE_DIR: every test that a header names as its verification is there.
cd "$1" || exit 1
missing=0
while IFS=: read -r header path; do
  path=${path%.}
  [[ -e $path ]] || { echo "$header: verified by $path, which is not there" >&2; missing=1; }
done < <(grep -ro --include=*.hpp 'tests/[A-Za-z0-9_./-]*' lib impulse fem tools)
exit $missing
