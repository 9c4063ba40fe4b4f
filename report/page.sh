# Parts of a page, each printing HTML. Sourced by report/make and report/study.

format() { awk -f report/format.awk -f /dev/fd/3 "$@" 3<<<"$awk_program"; }

escape() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }

# html_table ALIGNMENT [CLASS]: tab-separated lines, the first the heads; one letter per column, l or r. Wide tables scroll by themselves.
html_table() {
  echo "<div class=\"scroll\"><table${2:+ class=\"$2\"}>"
  awk -F'\t' -v alignment="$1" '
    {
      tag = NR == 1 ? "th" : "td"
      if (NR == 1) printf "<thead>"; else if (NR == 2) printf "<tbody>"
      printf "<tr>"
      for (i = 1; i <= NF; ++i) printf "<%s%s>%s</%s>", tag, substr(alignment, i, 1) == "r" ? " class=\"r\"" : "", $i, tag
      print "</tr>" (NR == 1 ? "</thead>" : "")
    }
    END { print "</tbody></table></div>" }'
}

# html_picture FILE.svg TEXT: inline. The parts of gnuplot that a page has no use for go: prologue, unused symbols, names that would repeat.
html_picture() {
  echo "<div class=\"scroll\"><figure class=\"picture\">"
  awk -v text="$2" '
    /<\?xml/ { next }
    /<defs>/ { inside = 1 }
    inside { if (/<\/defs>/) inside = 0; next }
    /xmlns:xlink/ { print ">"; skip = 1; next }
    skip && /^>/ { skip = 0; next }
    /<title>Gnuplot</ { print "<title>" text "</title>"; next }
    /<desc>/ { next }
    { gsub(/ id="[^"]*"/, ""); sub(/<svg/, "<svg role=\"img\""); gsub(/^[ \t]+/, ""); print }' "$1"
  echo "</figure></div>"
}

# page_begin TITLE: up to where the first heading belongs.
page_begin() {
  cat <<EOF
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8" />
<meta name="viewport" content="width=device-width, initial-scale=1" />
<meta name="color-scheme" content="light dark" />
<title>$1</title>
<style>
$(cat report/style.css)
</style>
</head>
<body>
<main>
EOF
}

page_end() { printf '</main>\n</body>\n</html>\n'; }
