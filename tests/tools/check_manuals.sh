#!/bin/bash
# check_manuals.sh BIN_DIR SHARE_DIR: every tool has a manual page that is well-formed and holds its options, and is completed by bash.
bin=$(realpath "$1")
share=$(realpath "$2")
PATH=$bin:$PATH
failures=0
fail() { echo "FAILED: $*" >&2; failures=$((failures + 1)); }

source "$share/bash-completion/completions/impulse" || exit 1
# completed WORDS...: what bash would offer for the last word.
completed() {
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _impulse_tool "$1"
  echo "${COMPREPLY[*]}"
}

count=0
for tool in "$bin"/ir-* "$bin"/fe-* "$bin"/table-*; do
  name=$(basename "$tool")
  page=$share/man/man1/$name.1
  [[ -s $page ]] || { fail "$name has no manual page"; continue; }
  count=$((count + 1))
  complaints=$(groff -man -Tutf8 -ww "$page" 2>&1 >/dev/null | grep -v "cannot adjust line")
  [[ -z $complaints ]] || fail "$page: $complaints"
  text=$(groff -man -Tascii "$page" 2>/dev/null | sed 's/.\x08//g; s/\x1b\[[0-9;]*m//g')
  grep -q '^OPTIONS' <<<"$text" || fail "$name: no options in the manual"
  grep -q 'Example:' <<<"$text" || fail "$name: no example in the manual"
  if grep -q '1970\|20[0-9][0-9]  *'"${name^^}" <<<"$text"; then fail "$name: a date in the manual"; fi
  offered=" $(completed "$name" --) "
  for flag in $("$tool" --help | awk '$1 ~ /^-/ { n = split($1, names, ","); print names[n] }'); do
    [[ $offered == *" $flag "* ]] || fail "$name: $flag is not completed"
    grep -qF -- "$flag" <<<"$text" || fail "$name: $flag is not in the manual"
  done
done
((count > 5)) || fail "only $count tools"
[[ $(completed ir-bar --as "") == "response modes" ]] || fail "values of --as: $(completed ir-bar --as "")"
[[ $(completed ir-bar --as m) == modes ]] || fail "values of --as that begin with m"
[[ -z $(completed ir-impact --config f) ]] || fail "a file is not left to bash"
exit $((failures > 0))
