#!/bin/sh
# manual.sh HELP2MAN TOOL OUTPUT: the tool's manual page, from its --help; without a date, so that the same tool gives the same page.
set -eu
mkdir -p "$(dirname "$3")"
summary=$("$2" --help | sed -n 2p)
"$1" --no-info --name "$summary" "$2" | sed 's/^\(\.TH [^ ]* "1"\) "[^"]*"/\1 ""/' >"$3.new"
mv "$3.new" "$3"
