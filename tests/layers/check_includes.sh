#!/usr/bin/env bash
# The arrows between the layers, read from the includes: lib <- impulse, lib <- fem, none between impulse and fem, nobody sees tools.
# usage: check_includes.sh SOURCE_DIR
set -u
cd "$1" || exit 2
failed=0
forbid() {  # forbid FOLDER PATTERN
  local hits
  hits=$(grep -rnE "^#include \"($2)/" "$1" --include='*.cpp' --include='*.hpp')
  if [[ -n "$hits" ]]; then
    printf '%s must not include %s:\n%s\n' "$1" "$2" "$hits"
    failed=1
  fi
}
forbid lib 'impulse|fem|tools|tests'
forbid impulse 'fem|tools|tests'
forbid fem 'impulse|tools|tests'
forbid tools 'tests'
exit $failed
