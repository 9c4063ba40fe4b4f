# Sourced by cases. blow FILE [PEAK [SECOND [CLIP]]]: a half sine of 200 us on 2 kg from 1 ms on, every 10 us: force, velocity, acceleration and displacement.
blow() {
  awk -v peak="${2:-100}" -v second="${3:-0}" -v clip="${4:-1e9}" 'BEGIN {
    pi = atan2(0, -1); dt = 1e-5
    print "time_s,force_N,velocity_m_per_s,acceleration_m_per_s2,displacement_m"
    for (k = 0; k < 1000; ++k) {
      f = k >= 100 && k <= 120 ? peak * sin(pi * (k - 100) / 20) : k >= 500 && k <= 520 ? second * sin(pi * (k - 500) / 20) : 0
      if (f > clip) f = clip
      x += dt * v + dt * dt * (2 * last + f) / 12; v += dt * (f + last) / 4
      printf "%.12g,%.17g,%.17g,%.17g,%.17g\n", (k - 100) * dt, f, v, f / 2, x
      last = f
    } }' > "$1"
}
