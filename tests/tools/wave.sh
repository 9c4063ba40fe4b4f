# Sourced by cases. wave FILE [WIDTH]: a smooth compressive pulse of 1000 microstrain about 300 us, every 1 us, 1.2 ms long; width in us.
wave() {
  awk -v width="${2:-25}" 'BEGIN { print "time_s,strain"; for (k = 0; k < 1200; ++k) { x = (k - 300) / width; printf "%.12g,%.17g\n", k * 1e-6, -1e-3 * exp(-x * x) } }' > "$1"
}
