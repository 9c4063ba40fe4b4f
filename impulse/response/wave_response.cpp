#include "impulse/response/wave_response.hpp"

#include "impulse/response/chain_spectrum.hpp"
#include "impulse/response/pulse_train.hpp"
#include "impulse/response/wave_line.hpp"
#include "lib/contract/require.hpp"
#include "lib/transform/real_fft.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace impulse {

WaveLine wave_line(const Profile& profile, FarEnd far_end) {
  WaveLine line;
  line.far_end = far_end;
  for (const Segment& segment : profile) {
    const double speed = segment.material.rod_wave_speed_m_per_s();
    const double slope = (segment.diameter_b_m - segment.diameter_a_m) / segment.length_m;
    line.pieces.push_back({segment.travel_time_s(), segment.impedance_a_kg_per_s(), segment.impedance_b_kg_per_s(),
                           speed * slope / segment.diameter_a_m, speed * slope / segment.diameter_b_m,
                           segment.diameter_a_m / segment.diameter_b_m});
  }
  return line;
}

namespace {

constexpr std::size_t order = TruncatedSeries<double>::size - 1;

/// The pulses as the state of a chain of integrators, advanced exactly from sample to sample:
///
///   y_k' = -μ y_k + y_(k+1) + a_k δ  (k = 1 .. order),   H' = y_1 + a_0 δ,   U' = H
class TailState {
 public:
  using State = std::array<double, order + 2>;  ///< U, H, y_1 .. y_order

  TailState(double mu, double step_s) : mu_(mu) {
    for (std::size_t column = 0; column < propagator_.size(); ++column) {
      State unit{};
      unit[column] = 1;
      propagator_[column] = advanced(unit, step_s);
    }
  }

  void step() {
    State next{};
    for (std::size_t column = 0; column < next.size(); ++column)
      for (std::size_t row = 0; row <= column; ++row) next[row] += propagator_[column][row] * state_[column];
    state_ = next;
  }

  /// Adds a pulse that arrived `age_s` before the present sample, at most one step.
  void add(const TruncatedSeries<double>& velocity, double age_s) {
    State pulse{};
    std::ranges::copy(velocity.a, pulse.begin() + 1);
    const State now = mu_ == 0 ? State{pulse[1] * age_s, pulse[1]} : advanced(pulse, age_s);
    for (std::size_t k = 0; k < now.size(); ++k) state_[k] += now[k];
  }

  [[nodiscard]] const State& state() const { return state_; }

 private:
  [[nodiscard]] State derivative(const State& x) const {
    State rate{};
    rate[0] = x[1];
    rate[1] = x[2];
    for (std::size_t k = 2; k < x.size(); ++k) rate[k] = -mu_ * x[k] + (k + 1 < x.size() ? x[k + 1] : 0.0);
    return rate;
  }
  /// e^{Aτ}x by its Taylor series over pieces with μτ ≤ 1/2, where 20 terms reach rounding.
  [[nodiscard]] State advanced(State x, double tau) const {
    const auto pieces = static_cast<std::size_t>(std::ceil(2 * mu_ * tau)) + 1;
    const double h = tau / static_cast<double>(pieces);
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      State term = x;
      for (int n = 1; n <= 20; ++n) {
        term = derivative(term);
        for (std::size_t k = 0; k < x.size(); ++k) {
          term[k] *= h / n;
          x[k] += term[k];
        }
      }
    }
    return x;
  }

  double mu_;
  std::array<State, order + 2> propagator_{};
  State state_{};
};

void add_pulses(const std::vector<Pulse>& pulses, double mu, double sign, const UniformGrid& grid, PairResponse& pair) {
  TailState tail(mu, grid.step_s);
  std::size_t next = 0;
  for (std::size_t k = 0; k < grid.size; ++k) {
    if (k > 0) tail.step();
    const double now = grid.time_s(k);
    // A front on a sample, to rounding, has arrived there: samples are right limits.
    for (; next < pulses.size() && pulses[next].time_s <= now * (1 + 1e-13); ++next)
      tail.add(pulses[next].velocity, std::max(0.0, now - pulses[next].time_s));
    pair.step_displacement_m_per_N[k] += sign * tail.state()[0];
    pair.step_velocity_m_per_Ns[k] += sign * tail.state()[1];
    pair.impulse_response_per_kg[k] += sign * tail.state()[2];
  }
}

/// The transforms and spectra take some 60 bytes a value, 8 GB at most.
std::size_t affordable_size(std::size_t sample_count, std::size_t oversampling) {
  const double size = static_cast<double>(sample_count) * static_cast<double>(oversampling);
  require(
      size <= 0x1p27,
      "the cone is so sharp at one end that its waves need {} values per step ({:.2g} in all); use a blunter end, a "
      "shorter duration, or modes (--method modal)",
      oversampling, size);
  return fast_transform_size(sample_count * oversampling);
}

/// What the truncated series leave out of G, H = G/s and U = G/s², by the trapezoidal rule on Re s = σ (an FFT): f(t) =
/// e^(σt)/π Re ∫ f̂ e^(iωt) dω. Period four times the record and σ = 9/duration: aliases enter by e^-27 and below,
/// rounding grows by e^9.
class RemainderTransform {
 public:
  RemainderTransform(const UniformGrid& grid, double mu)
      : grid_(grid),
        oversampling_(static_cast<std::size_t>(std::ceil(std::clamp(8 * mu * grid.step_s, 1.0, 1e15)))),
        fft_(affordable_size(4 * grid.size, oversampling_)),
        sigma_(9 / grid.duration_s()) {}

  [[nodiscard]] std::size_t size() const { return fft_.spectrum_size(); }
  [[nodiscard]] std::complex<double> s(std::size_t k) const {
    const double step = grid_.step_s / static_cast<double>(oversampling_);
    return {sigma_, 2 * M_PI * static_cast<double>(k) / (static_cast<double>(fft_.size()) * step)};
  }
  void add(ComplexBuffer spectrum, double sign, std::vector<double>& column) const {
    RealBuffer time(fft_.size());
    fft_.inverse(spectrum, time);
    const double scale = sign * static_cast<double>(oversampling_) / grid_.step_s;
    for (std::size_t k = 0; k < grid_.size; ++k)
      column[k] += scale * std::exp(sigma_ * grid_.time_s(k)) * time[k * oversampling_];
  }

 private:
  UniformGrid grid_;
  std::size_t oversampling_;
  RealFft fft_;
  double sigma_;
};

/// μ of the tails' series, 0 without cones. Scattering n times at rates κ makes coefficients (nκ/μ)^k/k! of q^k: with μ
/// = nκ they stay bounded on long records, and the remainder is smooth on the scale of 1/μ.
double tail_rate(const WaveLine& line, double duration_s) {
  double fastest = 0;
  double travel_time = 0;
  for (const WavePiece& piece : line.pieces) {
    fastest = std::max({fastest, std::abs(piece.taper_left), std::abs(piece.taper_right)});
    travel_time += piece.travel_time_s;
  }
  return fastest * (1 + 0.5 * static_cast<double>(line.pieces.size()) * duration_s / travel_time);
}

void add_remainder(const RemainderTransform& transform, const std::vector<std::complex<double>>& mobility, double sign,
                   PairResponse& pair) {
  std::vector<double>* columns[3] = {&pair.impulse_response_per_kg, &pair.step_velocity_m_per_Ns,
                                     &pair.step_displacement_m_per_N};
  ComplexBuffer spectrum(mobility.begin(), mobility.end());
  ComplexBuffer integrated(spectrum);
  for (std::vector<double>* column : columns) {
    const double start = column->front();
    transform.add(integrated, sign, *column);
    column->front() = start;  // the remainder starts from exactly 0, its transform only nearly so
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] /= transform.s(k);
    integrated = spectrum;
  }
}

/// Adds what a unit impulse on the struck end does there and, seen into the body, at the far end.
void add_struck(const WaveLine& line, const UniformGrid& grid, PairResponse& at_struck, PairResponse* at_far) {
  const double mu = tail_rate(line, grid.duration_s());
  // Before the pulses: it refuses what the pulses' tails would take hours for.
  std::optional<RemainderTransform> transform;
  if (mu > 0) transform.emplace(grid, mu);
  const PulseTrain train = pulse_train(line, grid.duration_s() + 0.5 * grid.step_s, grid.step_s, mu);
  add_pulses(train.at_struck_end, mu, 1.0, grid, at_struck);
  if (at_far != nullptr) add_pulses(train.at_far_end, mu, -1.0, grid, *at_far);
  if (!transform) return;
  std::vector<std::complex<double>> struck(transform->size());
  std::vector<std::complex<double>> far(transform->size());
  for (std::size_t k = 0; k < transform->size(); ++k) {
    const auto exact = line_mobility(line, transform->s(k));
    const auto followed = line_pulse_mobility(line, transform->s(k), mu);
    struck[k] = exact.struck - followed.struck;
    far[k] = exact.far - followed.far;
  }
  add_remainder(*transform, struck, 1.0, at_struck);
  if (at_far != nullptr) add_remainder(*transform, far, -1.0, *at_far);
}

}  // namespace

Response wave_response(const Bar& bar, const UniformGrid& grid) {
  require_valid(bar);
  Response response = zero_response(grid, bar.faces.size());
  for (std::size_t j = 0; j < bar.faces.size(); ++j) {
    const Profile oriented = bar.faces[j] == Face::a ? bar.profile : reversed(bar.profile);
    const WaveLine line = wave_line(oriented, bar.far_end);
    const bool both = bar.faces.size() == 2;
    add_struck(line, grid, response.pair(j, j), both && j == 0 ? &response.pair(1, 0) : nullptr);
  }
  if (bar.faces.size() == 2) response.pair(0, 1) = response.pair(1, 0);
  return response;
}

}  // namespace impulse
