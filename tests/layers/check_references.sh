#!/bin/bash
# check_references.sh SOURCE_DIR: every [Key1999] that is cited is an entry of REFERENCES.bib, whose entries are closed and named once.
cd "$1" || exit 1
wrong=0
complain() { echo "REFERENCES.bib: $*" >&2; wrong=1; }
open=$(awk '/^@/ && depth != 0 { print NR } { depth += gsub(/{/, "{") - gsub(/}/, "}") } END { if (depth) print "its end" }' REFERENCES.bib)
[[ -z $open ]] || complain "an entry is open before line" $open
twice=$(sed -n 's/^@[a-z]*{\([^,]*\),.*/\1/p' REFERENCES.bib | sort | uniq -d)
[[ -z $twice ]] || complain "twice:" $twice
while IFS=: read -r file key; do
  key=${key#[}
  grep -q "{${key%]}," REFERENCES.bib || complain "no entry $key, which $file cites"
done < <(grep -roE --include='*.[hc]pp' --include='*.md' '\[[A-Z][A-Za-z]+(19|20)[0-9]{2}\]' lib impulse fem tools docs data README.md)
exit $wrong
