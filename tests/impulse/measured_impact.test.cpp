#include "impulse/contact/contacts_problem.hpp"
#include "impulse/measured/response_estimate.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/wave_response.hpp"
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
