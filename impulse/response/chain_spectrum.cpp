#include "impulse/response/chain_spectrum.hpp"

#include "impulse/response/truncated_series.hpp"

namespace impulse {
namespace {

using Complex = std::complex<double>;

/// From the far end backwards: the reflectance ρ = l/r at the left of each piece, through the impedance -N/v at each
/// joint; then forwards: v_right/v_left = spread·e^(-sτ)(1 + ρ_right)/(1 + ρ_left).
template <class T>
EndMobility<T> mobility(const WaveLine& line, Complex s, const T& inverse_s) {
  const T one = T(1.0);
  T reflectance = far_reflection(line.pieces.back(), line.far_end, inverse_s);
  T ratio = one;
  for (std::size_t i = line.pieces.size(); i-- > 0;) {
    const WavePiece& piece = line.pieces[i];
    const Complex delay = std::exp(-s * piece.travel_time_s);
    const T at_right = one + reflectance;
    reflectance = (delay * delay) * reflectance;
    const T at_left = one + reflectance;
    ratio = ratio * ((Complex(piece.spread) * delay) * at_right / at_left);
    const T forward = one + Complex(piece.taper_left) * inverse_s;
    const T backward = one - Complex(piece.taper_left) * inverse_s;
    const T impedance = Complex(piece.impedance_left) * ((forward - backward * reflectance) / at_left);
    if (i == 0) {
      const T struck = one / impedance;
      return {struck, struck * ratio};
    }
    const WavePiece& before = line.pieces[i - 1];
    const Complex z = before.impedance_right;
    const Complex kappa = before.taper_right;
    reflectance = (z * (one + kappa * inverse_s) - impedance) / (impedance + z * (one - kappa * inverse_s));
  }
  return {};
}

}  // namespace

EndMobility<Complex> line_mobility(const WaveLine& line, Complex s) { return mobility<Complex>(line, s, 1.0 / s); }

EndMobility<Complex> line_pulse_mobility(const WaveLine& line, Complex s, double mu_per_s) {
  using Series = TruncatedSeries<Complex>;
  const EndMobility<Series> series = mobility<Series>(line, s, inverse_s_series<Complex>(mu_per_s));
  const Complex q = 1.0 / (s + mu_per_s);
  EndMobility<Complex> value{0, 0};
  for (std::size_t k = Series::size; k-- > 0;) {
    value.struck = value.struck * q + series.struck.a[k];
    value.far = value.far * q + series.far.a[k];
  }
  return value;
}

}  // namespace impulse
