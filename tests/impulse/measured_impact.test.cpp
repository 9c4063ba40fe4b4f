#include "impulse/contact/contacts_problem.hpp"
#include "impulse/measured/response_estimate.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/numerics/student_t.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/struck_structures.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace impulse;

namespace {

Response cut(Response response, std::size_t size) {
  PairResponse& pair = response.pairs.front();
  response.grid.size = size;
  for (auto* values : {&pair.impulse_response_per_kg, &pair.step_velocity_m_per_Ns, &pair.step_displacement_m_per_N})
    values->resize(size);
  return response;
}

/// Force of a sphere of 200 g at 1 m/s by Hertz' law.
std::vector<double> sphere_force(const Response& body) {
  ContactsProblem problem;
  problem.speed_m_per_s = {1, 0};
  problem.laws = {ContactLaw::hertz(3e8)};
  problem.gaps_m = {0};
  return solve_contacts(std::vector<Response>{mass_response(0.2, body.grid), body}, problem).traces[0].force_N;
}

double relative_l2(const std::vector<double>& x, const std::vector<double>& y) {
  double error = 0, size = 0;
  for (std::size_t n = 0; n < y.size(); ++n) {
    error += (x[n] - y[n]) * (x[n] - y[n]);
    size += y[n] * y[n];
  }
  return std::sqrt(error / size);
}

/// Share of the samples from `first` on at which |estimate - truth| is within the band.
double share_within(const std::vector<double>& estimate, const std::vector<double>& truth,
                    const std::vector<double>& uncertainty, double quantile, std::size_t first) {
  std::size_t within = 0;
  for (std::size_t n = first; n < estimate.size(); ++n)
    within += std::abs(estimate[n] - truth[n]) <= quantile * uncertainty[n] ? 1 : 0;
  return static_cast<double>(within) / static_cast<double>(estimate.size() - first);
}

}  // namespace

TEST_CASE("measured_impact: the force of a sphere, predicted from five blows, at 40 and at 20 dB") {
  const structures::HammerTest hammer;
  const UniformGrid grid{hammer.step_s, hammer.size + 1};
  const std::array bodies{modal_response(structures::beam(), grid), modal_response(structures::plate(), grid),
                          wave_response(bars::steel_rod(0.5, FarEnd::free), grid)};
  for (const double noise_dB : {40.0, 20.0})
    for (std::size_t body = 0; body < bodies.size(); ++body)
      for (unsigned seed : {1u, 2u, 3u}) {
        CAPTURE(noise_dB);
        CAPTURE(body);
        CAPTURE(seed);
        structures::HammerTest noisy = hammer;
        noisy.noise_dB = noise_dB;
        const ResponseEstimate estimate =
            estimated_response(structures::blows(bodies[body].pairs[0], noisy, seed), hammer.step_s, {});
        const Response& found = estimate.measured.response;
        CHECK(relative_l2(sphere_force(found), sphere_force(cut(bodies[body], found.grid.size))) <
              (noise_dB == 40 ? 0.01 : 0.05));
      }
}

TEST_SUITE("slow") {
  TEST_CASE("measured_impact: the 95 % band of H holds the truth at 93 to 97 % of the samples of 4000 repetitions") {
    structures::HammerTest hammer;
    hammer.size = 500;
    const Response body = modal_response(structures::beam(), {hammer.step_s, hammer.size + 1});
    const double quantile = student_t_quantile(0.975, 4);
    double h = 0, g = 0;
    const int repetitions = 4000;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      const ResponseEstimate estimate =
          estimated_response(structures::blows(body.pairs[0], hammer, 1000 + static_cast<unsigned>(repetition)),
                             hammer.step_s, {.regularisation = {Regularisation::Rule::value, 1e-5}});
      REQUIRE(estimate.measured.degrees_of_freedom == 4);
      const PairResponse uncertainty = estimate.measured.standard_uncertainty();
      const PairResponse& found = estimate.measured.response.pairs[0];
      h += share_within(found.step_velocity_m_per_Ns, body.pairs[0].step_velocity_m_per_Ns,
                        uncertainty.step_velocity_m_per_Ns, quantile, 1) /
           repetitions;
      g += share_within(found.impulse_response_per_kg, body.pairs[0].impulse_response_per_kg,
                        uncertainty.impulse_response_per_kg, quantile, 1) /
           repetitions;
    }

    CHECK(h > 0.93);
    CHECK(h < 0.97);
    CHECK(g > 0.93);
    CHECK(g < 0.97);
  }
}
