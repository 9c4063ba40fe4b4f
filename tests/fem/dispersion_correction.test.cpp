#include "fem/bodies/dispersion_correction.hpp"

#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace impulse {
namespace {

constexpr double everything = std::numeric_limits<double>::infinity();

ModalModel corrected(const Bar& bar, const BarMesh& mesh, double highest_frequency_Hz = everything) {
  return dispersion_corrected(modal_model(bar_structure(bar, mesh)), bar, mesh, highest_frequency_Hz);
}

TEST_CASE("every corrected frequency of a free uniform rod is exact, nπ/τ, up to the last mode of the mesh") {
  const Bar rod = bars::steel_rod(0.5);
  const std::size_t n = 40;
  const ModalModel modes = corrected(rod, bar_mesh_by_count(rod, n));
  REQUIRE(modes.mode_count() == 41);
  const double fundamental = std::numbers::pi / travel_time_s(rod.profile);
  // asin has a vertical tangent at the last mode: rounding of ω by ε moves it by √ε.
  for (Eigen::Index i = 0; i < 41; ++i)
    CHECK(std::abs(modes.angular_frequency[i] / fundamental - static_cast<double>(i)) <= (i < 39 ? 1e-9 : 1e-5));
}

TEST_CASE("a cone's corrected frequencies err by its ends alone: order 4, and far less than plain ones") {
  const Bar cone = bars::cone();
  const std::size_t mode = 6;
  const auto frequency = [&](std::size_t n, bool correct) {
    const BarMesh mesh = bar_mesh_by_count(cone, n);
    const ModalModel plain = modal_model(bar_structure(cone, mesh));
    return (correct ? dispersion_corrected(plain, cone, mesh, everything) : plain).angular_frequency[mode];
  };
  const double exact = frequency(1500, true);
  std::vector<double> errors;
  for (const std::size_t n : {30u, 60u, 120u, 240u}) errors.push_back(std::abs(frequency(n, true) / exact - 1));
  for (std::size_t i = 1; i < errors.size(); ++i) CHECK(std::abs(std::log2(errors[i - 1] / errors[i]) - 4) <= 0.1);
  CHECK(errors.front() < 0.01 * std::abs(frequency(30, false) / exact - 1));
}

TEST_CASE("modes above the highest frequency are left out after correction") {
  const Bar rod = bars::steel_rod(0.5);
  const double fundamental_Hz = 0.5 / travel_time_s(rod.profile);
  const ModalModel modes = corrected(rod, bar_mesh_by_count(rod, 40), 20.5 * fundamental_Hz);
  CHECK(modes.mode_count() == 21);
  CHECK(modes.participation.rows() == 21);
  CHECK(modes.damping_ratio.size() == 21);
}

TEST_CASE("meshes without one dispersion are refused") {
  const Bar bar = bars::composite();
  CHECK_THROWS_WITH_AS((void)corrected(bar, bar_mesh_by_count(bar, 6)), doctest::Contains("too unlike"),
                       std::invalid_argument);
  const Bar rod = bars::steel_rod(0.5);
  CHECK_THROWS_WITH_AS((void)corrected(rod, bar_mesh_by_count(rod, 6, MassMatrix::consistent)),
                       "the dispersion correction is that of the lumped mass matrix", std::invalid_argument);
}

}  // namespace
}  // namespace impulse
