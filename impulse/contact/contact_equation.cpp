#include "impulse/contact/contact_equation.hpp"

#include "impulse/contact/step_means.hpp"
#include "impulse/contact/toeplitz_solvers.hpp"
#include "lib/contract/require.hpp"
#include "lib/transform/real_fft.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace impulse {
namespace {

/// Weights of one body or of the sum of both: w_k acts on F_{n-k}, start[n] on F_0.
struct Weights {
  std::vector<double> w;
  std::vector<double> start;
};

Weights product_weights(const PairResponse& body, double step_s) {
  const std::vector<double>& u = body.step_displacement_m_per_N;
  const std::vector<double>& h = body.step_velocity_m_per_Ns;
  const std::size_t last = u.size() - 1;
  Weights weights{std::vector<double>(last), std::vector<double>(u.size())};
  // U(0-) = 0 stands in for U_0, so that a residual flexibility's jump belongs to the first step.
  weights.w[0] = u[1] / step_s;
  if (last > 1) weights.w[1] = (u[2] - 2 * u[1]) / step_s;
  for (std::size_t k = 2; k < last; ++k) weights.w[k] = (u[k + 1] - 2 * u[k] + u[k - 1]) / step_s;
  weights.start[0] = h[0];
  weights.start[1] = h[1] - u[1] / step_s;
  for (std::size_t n = 2; n <= last; ++n) weights.start[n] = h[n] - (u[n] - u[n - 1]) / step_s;
  return weights;
}

Weights trapezoidal_weights(const PairResponse& body, double step_s) {
  const std::vector<double>& g = body.impulse_response_per_kg;
  Weights weights{std::vector<double>(g.size() - 1), std::vector<double>(g.size())};
  for (std::size_t k = 0; k + 1 < g.size(); ++k) weights.w[k] = step_s * g[k];
  weights.w[0] /= 2;
  for (std::size_t n = 0; n < g.size(); ++n) weights.start[n] = step_s * g[n] / 2;
  return weights;
}

/// ½Δt²G_0/U_1 measures how much of the response lies above the Nyquist frequency 1/(2Δt): it is 1 for a kernel smooth
/// within the step, 1.29 for a rod's exact modes (up to 1.4 for chains) up to the Nyquist frequency (Dirichlet's
/// kernel), 1.57 ν for modes up to ν times it, and 0 where a jump of H stands without the Dirac pulse that makes it.
void require_resolved_by_trapezoid(const Response& response, int number) {
  const PairResponse& pair = response.pair(0, 0);
  const double dt = response.grid.step_s;
  const double g0 = pair.impulse_response_per_kg[0];
  const double u1 = pair.step_displacement_m_per_N[1];
  const double ratio = 0.5 * dt * dt * g0 / u1;
  require(ratio > 0.7,
          "body {}: the trapezoidal rule needs the impulse response itself, but H jumps (or U does) where G has no "
          "Dirac pulse (½Δt²G/U = {:.2g} "
          "at the first step, not 1 to 1.4); use --method product, or a modal response with modes up to the Nyquist "
          "frequency",
          number, ratio);
  const double h0 = pair.step_velocity_m_per_Ns[0];
  require(ratio<1.45,
                "body {}: step {:.4g} s aliases the modes of the response above its Nyquist frequency (½Δt²G/U = "
                "{:.2g} at the first step, not 1 to "
                "1.4); use --method product, or a step of {:.3g} s",
                number, dt, ratio, h0> 0
              ? 2 * h0 / g0
              : dt * 1.2 / ratio);
}

PairResponse sum(const PairResponse& a, const PairResponse& b) {
  PairResponse total = a;
  for (std::size_t k = 0; k < total.step_velocity_m_per_Ns.size(); ++k) {
    total.impulse_response_per_kg[k] += b.impulse_response_per_kg[k];
    total.step_velocity_m_per_Ns[k] += b.step_velocity_m_per_Ns[k];
    total.step_displacement_m_per_N[k] += b.step_displacement_m_per_N[k];
  }
  return total;
}

std::vector<double> solve_toeplitz(const std::vector<double>& w, const std::vector<double>& rhs, double speed,
                                   ContactMethod method) {
  switch (method) {
    case ContactMethod::series:
      return series_toeplitz(w, rhs, 1e-9 * speed);
    case ContactMethod::fourier:
      return contour_toeplitz(w, rhs, 1e-6 * speed);
    case ContactMethod::product:
    case ContactMethod::trapezoidal:
      break;
  }
  // Four, so that three samples are past the end also where a sample is the mean of two steps.
  return marched_toeplitz(w, rhs, [](std::span<const double> f) {
    return f.size() >= 4 && std::ranges::all_of(f.last(4), [](double value) { return value <= 0; });
  });
}

/// A force with the velocities that it gives the two faces (into each body).
struct Solution {
  std::vector<double> force;
  double contact_end_s = 0;
  std::optional<double> impulse_Ns;
  std::vector<double> velocity_1;
  std::vector<double> velocity_2;
};

/// (G*F)(t_n) for a force linear within each step.
std::vector<double> linear_velocity(const Weights& weights, const std::vector<double>& force) {
  const std::vector<double> later = convolution(weights.w, std::span(force).subspan(1), force.size() - 1);
  std::vector<double> v(force.size());
  v[0] = weights.start[0] * force[0];
  for (std::size_t n = 1; n < v.size(); ++n) v[n] = weights.start[n] * force[0] + later[n - 1];
  return v;
}

/// The first sample given, the last extrapolated.
std::vector<double> extrapolated_samples(const std::vector<double>& means, double first) {
  return on_samples(means, first, 1.5 * means[means.size() - 1] - 0.5 * means[means.size() - 2]);
}

/// Ends contact where the force does; returns the first sample out of contact.
std::size_t release(Solution& solution, const UniformGrid& grid) {
  const std::size_t end = contact_end_index(solution.force);
  solution.contact_end_s = contact_end_s(solution.force, grid, end);
  std::fill(solution.force.begin() + static_cast<std::ptrdiff_t>(end), solution.force.end(), 0.0);
  return end;
}

/// The force as unknown samples.
Solution linear_solution(const Weights& body_1, const Weights& body_2, const UniformGrid& grid,
                         std::optional<double> start, double speed, ContactMethod method) {
  Weights both = body_1;
  for (std::size_t k = 0; k < both.w.size(); ++k) both.w[k] += body_2.w[k];
  for (std::size_t n = 0; n < both.start.size(); ++n) both.start[n] += body_2.start[n];
  const double f0 = start.value_or(speed / (both.w[0] + both.start[1]));
  std::vector<double> rhs(both.w.size());
  for (std::size_t n = 0; n < rhs.size(); ++n) rhs[n] = speed - f0 * both.start[n + 1];
  Solution solution;
  solution.force = {f0};
  const std::vector<double> later = solve_toeplitz(both.w, rhs, speed, method);
  solution.force.insert(solution.force.end(), later.begin(), later.end());
  release(solution, grid);
  solution.velocity_1 = linear_velocity(body_1, solution.force);
  solution.velocity_2 = linear_velocity(body_2, solution.force);
  return solution;
}

/// The force as unknown means over the steps.
Solution step_solution(const Weights& body_1, const Weights& body_2, const UniformGrid& grid, double f0, double speed,
                       ContactMethod method) {
  std::vector<double> w = body_1.w;
  for (std::size_t k = 0; k < w.size(); ++k) w[k] += body_2.w[k];
  std::vector<double> means = solve_toeplitz(w, std::vector<double>(w.size(), speed), speed, method);
  Solution solution;
  solution.force = extrapolated_samples(means, f0);
  const std::size_t end = release(solution, grid);
  // A jump to tension inside the last step leaves that step what was compression in it, at most.
  if (end > 0 && end <= means.size()) means[end - 1] = std::max(means[end - 1], 0.0);
  std::fill(means.begin() + static_cast<std::ptrdiff_t>(std::min(end, means.size())), means.end(), 0.0);
  solution.impulse_Ns = grid.step_s * std::accumulate(means.begin(), means.end(), 0.0);
  solution.velocity_1 = extrapolated_samples(convolution(body_1.w, means, means.size()), f0 * body_1.start[0]);
  solution.velocity_2 = extrapolated_samples(convolution(body_2.w, means, means.size()), f0 * body_2.start[0]);
  return solution;
}

/// |∫F(v₁ - v₂)dt|/(V∫F dt): what the rigid interface loses between samples, where v₁ = v₂ is not asked for. By
/// steps, ½(F_n + F_{n+1}) times the interface's displacement over the step, V Δt - Δ(H*F). H*F of a piecewise linear F
/// needs P = ∫U: P by the trapezoidal rule with end correction, -Δt²/12 ΔH.
double energy_error(const PairResponse& total, const UniformGrid& grid, const std::vector<double>& force,
                    std::size_t end, double speed) {
  const std::vector<double>& u = total.step_displacement_m_per_N;
  const std::vector<double>& h = total.step_velocity_m_per_Ns;
  const double dt = grid.step_s;
  std::vector<double> slab(end);  // ∫U over step k
  for (std::size_t k = 0; k < end; ++k) slab[k] = 0.5 * dt * (u[k] + u[k + 1]) - dt * dt / 12 * (h[k + 1] - h[k]);
  std::vector<double> slope(end);
  for (std::size_t k = 0; k < end; ++k) slope[k] = (force[k + 1] - force[k]) / dt;
  const std::vector<double> ramps = convolution(slab, slope, end);
  double work = 0;
  double received = 0;
  double before = u[0] * force[0];
  for (std::size_t n = 1; n <= end; ++n) {
    const double now = u[n] * force[0] + ramps[n - 1];
    const double mean_force = 0.5 * (force[n - 1] + force[n]);
    work += mean_force * (speed * dt - (now - before));
    received += mean_force * speed * dt;
    before = now;
  }
  return received > 0 ? std::abs(work) / received : 0;
}

void require_compatible(const Response& body_1, const Response& body_2, const Impact& impact) {
  require_valid(body_1);
  require_valid(body_2);
  require(body_1.contact_count == 1 && body_2.contact_count == 1,
          "the bodies have {} and {} contacts; this equation has one each", body_1.contact_count, body_2.contact_count);
  require(same_grid(body_1.grid, body_2.grid),
          "the responses have different grids ({} samples of {:.6g} s and {} samples of {:.6g} s); compute both with "
          "the same --step and "
          "--duration",
          body_1.grid.size, body_1.grid.step_s, body_2.grid.size, body_2.grid.step_s);
  require(body_1.grid.size >= 4, "the responses have {} samples; at least 4 are needed", body_1.grid.size);
  require(std::isfinite(impact.speed_m_per_s) && impact.speed_m_per_s > 0, "speed {} m/s is not positive (--speed)",
          impact.speed_m_per_s);
}

void require_something_elastic(const PairResponse& total) {
  const std::vector<double>& u = total.step_displacement_m_per_N;
  bool rigid = true;
  for (std::size_t k = 0; k < u.size() && rigid; ++k) {
    const double of_mass = u[1] * static_cast<double>(k) * static_cast<double>(k);
    rigid = std::abs(u[k] - of_mass) <= 1e-9 * of_mass;
  }
  require(!rigid,
          "both bodies are rigid masses over the whole record (U = t²/2m), so that the force has no limit; one of them "
          "has to be elastic");
}

}  // namespace

ImpactHistory solve_contact(const Response& body_1, const Response& body_2, const Impact& impact,
                            ContactMethod method) {
  require_compatible(body_1, body_2, impact);
  if (method == ContactMethod::trapezoidal) {
    require_resolved_by_trapezoid(body_1, 1);
    require_resolved_by_trapezoid(body_2, 2);
  }
  const PairResponse total = sum(body_1.pair(0, 0), body_2.pair(0, 0));
  const UniformGrid& grid = body_1.grid;
  const double speed = impact.speed_m_per_s;
  const double u1 = total.step_displacement_m_per_N[1];
  require(u1 > 0,
          "the bodies' displacement one step after a unit step force is {} m/N: a body that yields backwards is not a "
          "passive response",
          u1);
  require_something_elastic(total);
  const bool trapezoidal = method == ContactMethod::trapezoidal;
  const auto weights_of = [&](const Response& body) {
    return trapezoidal ? trapezoidal_weights(body.pair(0, 0), grid.step_s)
                       : product_weights(body.pair(0, 0), grid.step_s);
  };
  const double r = total.step_displacement_m_per_N[0];
  const double h0 = total.step_velocity_m_per_Ns[0];
  const Weights weights_1 = weights_of(body_1);
  const Weights weights_2 = weights_of(body_2);
  Solution solution;
  if (r == 0 && h0 > 0 && !trapezoidal)
    solution = step_solution(weights_1, weights_2, grid, speed / h0, speed, method);
  else
    solution = linear_solution(weights_1, weights_2, grid,
                               r > 0    ? std::optional(0.0)
                               : h0 > 0 ? std::optional(speed / h0)
                                        : std::nullopt,
                               speed, method);
  ImpactHistory history;
  history.grid = grid;
  history.force_N = std::move(solution.force);
  history.acted_impulse_Ns = solution.impulse_Ns;
  history.velocity_1_m_per_s = std::move(solution.velocity_1);
  history.velocity_2_m_per_s = std::move(solution.velocity_2);
  for (double& v : history.velocity_1_m_per_s) v = speed - v;
  const std::size_t end = contact_end_index(history.force_N);
  history.separated = end < grid.size;
  history.contact_end_s = solution.contact_end_s;
  history.energy_error = energy_error(total, grid, history.force_N, std::min(end, grid.size - 1), speed);
  return history;
}

}  // namespace impulse
