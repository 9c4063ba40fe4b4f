# Pulses of one column of a CSV with time_s: stretches longer than `shortest` seconds in which |x| exceeds a quarter of the column's largest |x|; each from
# where it first to where it last exceeds half of its own largest. Variables: column (name), record, shortest.
function magnitude(x) { return x < 0 ? -x : x }
function crossing(k, level,   a, b) { a = magnitude(x[k - 1]); b = magnitude(x[k]); return t[k - 1] + (level - a) / (b - a) * (t[k] - t[k - 1]) }
BEGIN { FS = "," }
NR == 1 { for (i = 1; i <= NF; ++i) if ($i == column) wanted = i; next }
{ t[NR - 1] = $1; x[NR - 1] = $wanted; n = NR - 1; if (magnitude($wanted) > largest) largest = magnitude($wanted) }
END {
  for (k = 2; k <= n; ++k) {
    above = magnitude(x[k]) >= largest / 4
    if (above && !inside) { inside = 1; begin = k }
    if (!above && inside) {
      inside = 0
      if (t[k] - t[begin] < shortest) continue
      own = 0; first = 0
      for (i = begin; i < k; ++i) if (magnitude(x[i]) > magnitude(own)) own = x[i]
      for (i = begin; i <= k; ++i) {
        if (!first && magnitude(x[i]) >= magnitude(own) / 2) { first = 1; up = crossing(i, magnitude(own) / 2) }
        if (first && magnitude(x[i]) < magnitude(own) / 2 && magnitude(x[i - 1]) >= magnitude(own) / 2) down = crossing(i, magnitude(own) / 2)
      }
      printf "%s,%s,%d,%.2f,%.2f,%.5g\n", record, column, ++number, up * 1e6, (down - up) * 1e6, own
    }
  }
}
