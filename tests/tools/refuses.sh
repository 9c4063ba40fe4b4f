# Sourced by cases. refuses COMMAND...: runs what should fail; prints exit code and message, and tells of a file or output left behind.
refuses() {
  "$@" > "$TMP/.out" 2> "$TMP/.err"
  echo "$? $(cat "$TMP/.err")"
  [ -s "$TMP/.out" ] && echo "  wrote to stdout: $(head -n1 "$TMP/.out")"
  local left
  left=$(find "$TMP" -name '*.tmp')
  [ -z "$left" ] || echo "  left behind: $left"
}
