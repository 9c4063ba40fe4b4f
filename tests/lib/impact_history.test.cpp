#include "lib/law/impact_history.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

namespace impulse {
namespace {

ImpactHistory released(std::vector<double> force, double step_s) {
  ImpactHistory history;
  history.grid = {step_s, force.size()};
  const std::size_t end = contact_end_index(force);
  history.contact_end_s = contact_end_s(force, history.grid, end);
  history.separated = end < force.size();
  for (std::size_t k = end; k < force.size(); ++k) force[k] = 0;
  history.force_N = std::move(force);
  return history;
}

TEST_CASE("contact ends at the first of three successive samples without compression") {
  CHECK(contact_end_index({1, 2, 1, -1, -2, -3, 4}) == 3);
  CHECK(contact_end_index({1, -1, -1, 2, 0, 0, 0}) == 4);
  CHECK(contact_end_index({0, 1, 2, 0, -1, -1}) == 3);
}

TEST_CASE("one or two samples spoilt by a wave front, or a record that stops too early, do not end contact") {
  CHECK(contact_end_index({1, 2, -9, -9, 2, 1}) == 6);
  CHECK(contact_end_index({1, 2, -9, -9}) == 4);
  CHECK(contact_end_index({}) == 0);
}

TEST_CASE("the end of contact is the linear zero before the first released sample") {
  const UniformGrid grid{0.5, 6};
  const std::vector<double> force{1, 3, 1, -3, -1, -1};
  CHECK(contact_end_s(force, grid, 3) == about(1.0 + 0.5 / 4));
  CHECK(contact_end_s(force, grid, 6) == about(2.5));
  CHECK(contact_end_s(force, grid, 0) == 0);
  CHECK(contact_end_s({1, 3, 1, 0, 0, 0}, grid, 3) == about(1.5));
}

TEST_CASE("the impulse is that of the piecewise linear force up to the linear zero") {
  // 0.5 (1+3)/2 + 0.5 (3+1)/2 + the triangle 1·0.125/2
  CHECK(impulse_Ns(released({1, 3, 1, -3, -1, -1}, 0.5)) == about(2.0625).epsilon(1e-15));
  CHECK(impulse_Ns(released({1, 3, 1, 0, 0, 0}, 0.5)) == about(2.25).epsilon(1e-15));
}

TEST_CASE("the impulse of a record that ends in contact is the whole trapezoidal sum, spoilt samples included") {
  CHECK(impulse_Ns(released({2, 2, 2}, 0.25)) == about(1.0).epsilon(1e-15));
  CHECK(impulse_Ns(released({2, -2, 2}, 0.25)) == doctest::Approx(0.0));
}

TEST_CASE("a summary names the peak, its time, and the rebound of a body of known mass") {
  ImpactHistory history = released({1, 3, 1, -3, -1, -1}, 0.5);
  history.energy_error = 0.125;
  const ImpactSummary line = summary(history, 2.0, 0.5);
  CHECK(line.peak_force_N == 3);
  CHECK(line.peak_time_s == 0.5);
  CHECK(line.contact_duration_s == about(1.125));
  CHECK(line.impulse_Ns == about(2.0625));
  CHECK(line.rebound_speed_m_per_s.value() == about(2.0 - 2.0625 / 0.5));
  CHECK(line.energy_error == 0.125);
  CHECK_FALSE(summary(history, 2.0, std::nullopt).rebound_speed_m_per_s.has_value());
}

TEST_CASE("an impact history that cannot be summarised is refused") {
  CHECK_THROWS_WITH_AS((void)summary({}, 1, std::nullopt), "an impact history without samples has no summary",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)contact_end_s({1, 2}, {0.5, 3}, 1), "2 force samples on a grid of 3",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)contact_end_s({1, 2}, {0.5, 2}, 3), "contact ends at sample 3 of a record of 2",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)summary(released({2, 2}, 0.5), 1, -1.0), "mass -1 kg of body 1 is not positive",
                       std::invalid_argument);
}

}  // namespace
}  // namespace impulse
