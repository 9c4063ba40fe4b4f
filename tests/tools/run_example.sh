#!/bin/bash
# run_example.sh TOOL BIN_DIR SOURCE_DIR: runs the example at the end of the tool's --help in a folder that holds the project's data and nothing else.
tool=$1
PATH="$(realpath "$2"):$PATH"
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
"$tool" --help > "$work/help" || exit 1
sed '1,/^Example:$/d' "$work/help" > "$work/example"
[ -s "$work/example" ] || { echo "$tool --help has no example" >&2; exit 1; }
mkdir "$work/empty" && ln -s "$(realpath "$3")/data" "$work/empty/data"
cd "$work/empty" && bash -e -o pipefail "$work/example" > "$work/stdout" || { cat "$work/example" >&2; exit 1; }
