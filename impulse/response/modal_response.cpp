#include "impulse/response/modal_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace impulse {
namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t restart_interval = 1024;  // a multiple of lanes

/// Coefficients of one elastic mode: G += p·c - g_sine·s, H += h_sine·s, U += u·(1 - c - u_sine·s),
/// where c + i s = e^((-s + iω_d)t).
struct Oscillator {
  double decay;
  double frequency;
  double p;
  double sine_ratio;  ///< decay/ω_d
  double h_sine;      ///< p/ω_d
  double u;           ///< p/ω²
};

struct Columns {
  double* g;
  double* h;
  double* u;
};

// Eight neighbouring samples per vector: each lane rotates by eight steps at once, so that no sum runs across lanes.
[[gnu::target_clones("avx2,default")]] void add_oscillator(const Oscillator& mode, double step_s, std::size_t begin,
                                                           std::size_t end, Columns out) {
  std::array<double, lanes> c;
  std::array<double, lanes> s;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double t = step_s * static_cast<double>(begin + lane);
    const double envelope = std::exp(-mode.decay * t);
    c[lane] = envelope * std::cos(mode.frequency * t);
    s[lane] = envelope * std::sin(mode.frequency * t);
  }
  const double stride = step_s * static_cast<double>(lanes);
  const double shrink = std::exp(-mode.decay * stride);
  const double turn_c = shrink * std::cos(mode.frequency * stride);
  const double turn_s = shrink * std::sin(mode.frequency * stride);
  const double g_sine = mode.p * mode.sine_ratio;
  const double u_sine = mode.u * mode.sine_ratio;
  std::size_t k = begin;
  for (; k + lanes <= end; k += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      out.g[k + lane] += mode.p * c[lane] - g_sine * s[lane];
      out.h[k + lane] += mode.h_sine * s[lane];
      out.u[k + lane] += mode.u - mode.u * c[lane] - u_sine * s[lane];
      const double rotated = c[lane] * turn_c - s[lane] * turn_s;
      s[lane] = c[lane] * turn_s + s[lane] * turn_c;
      c[lane] = rotated;
    }
  }
  for (std::size_t lane = 0; k < end; ++k, ++lane) {
    out.g[k] += mode.p * c[lane] - g_sine * s[lane];
    out.h[k] += mode.h_sine * s[lane];
    out.u[k] += mode.u - mode.u * c[lane] - u_sine * s[lane];
  }
}

void add_rigid_mode(double p, const UniformGrid& grid, Columns out) {
  for (std::size_t k = 0; k < grid.size; ++k) {
    const double t = grid.time_s(k);
    out.g[k] += p;
    out.h[k] += p * t;
    out.u[k] += 0.5 * p * t * t;
  }
}

PairResponse pair_response(const ModalModel& body, Eigen::Index i, Eigen::Index j, const UniformGrid& grid) {
  PairResponse pair{std::vector<double>(grid.size, 0.0), std::vector<double>(grid.size, 0.0),
                    std::vector<double>(grid.size, body.residual_flexibility(i, j))};
  const Columns out{pair.impulse_response_per_kg.data(), pair.step_velocity_m_per_Ns.data(),
                    pair.step_displacement_m_per_N.data()};
  for (Eigen::Index mode = 0; mode < body.mode_count(); ++mode)
    if (body.angular_frequency(mode) == 0)
      add_rigid_mode(body.participation(mode, i) * body.participation(mode, j), grid, out);
  for (std::size_t begin = 0; begin < grid.size; begin += restart_interval) {
    const std::size_t end = std::min(begin + restart_interval, grid.size);
    for (Eigen::Index mode = 0; mode < body.mode_count(); ++mode) {
      const double omega = body.angular_frequency(mode);
      const double p = body.participation(mode, i) * body.participation(mode, j);
      if (omega == 0 || p == 0) continue;
      const double zeta = body.damping_ratio(mode);
      const double damped = omega * std::sqrt(1 - zeta * zeta);
      add_oscillator({zeta * omega, damped, p, zeta * omega / damped, p / damped, p / (omega * omega)}, grid.step_s,
                     begin, end, out);
    }
  }
  out.h[0] = body.wave_admittance(i, j);
  out.u[0] = body.residual_flexibility(i, j);
  return pair;
}

}  // namespace

Response modal_response(const ModalModel& body, const UniformGrid& grid) {
  require_valid(body);
  const Eigen::Index contacts = body.contact_count();
  Response response{grid, static_cast<std::size_t>(contacts), {}};
  for (Eigen::Index i = 0; i < contacts; ++i)
    for (Eigen::Index j = 0; j < contacts; ++j)
      // Reciprocity: the lower triangle is the upper one.
      response.pairs.push_back(i > j ? response.pairs[static_cast<std::size_t>(j * contacts + i)]
                                     : pair_response(body, i, j, grid));
  return response;
}

}  // namespace impulse
