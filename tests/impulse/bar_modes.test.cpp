#include "impulse/exact/bar_modes.hpp"

#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <numbers>

using namespace impulse;
using std::numbers::pi;

TEST_CASE("bar_modes: a cylinder's frequencies and participations in closed form") {
  for (FarEnd far_end : {FarEnd::free, FarEnd::fixed}) {
    const Bar bar = bars::steel_rod(0.5, far_end);
    const double tau = travel_time_s(bar.profile);
    const double m = mass_kg(bar.profile);
    const ModalModel model = exact_bar_modes(bar, {.count = 200});
    REQUIRE(model.mode_count() == 200);
    for (Eigen::Index n = 0; n < 200; ++n) {
      const double expected =
          far_end == FarEnd::free ? pi * static_cast<double>(n) / tau : pi * (static_cast<double>(n) + 0.5) / tau;
      CHECK(model.angular_frequency(n) == about(expected).epsilon(1e-12));
      CHECK(std::pow(model.participation(n, 0), 2) == about((expected == 0 ? 1 : 2) / m).epsilon(1e-12));
    }
    CHECK(model.wave_admittance(0, 0) == about(1 / face_impedance_kg_per_s(bar.profile, Face::a)));
  }
}

TEST_CASE("bar_modes: a free cone obeys tan kL = kL·... of its two ends") {
  // ψ = sin(kx + δ), free ends: tan(k x + δ) = k x at both, so atan(k x2) - atan(k x1) = k(x2 - x1) mod π.
  const Bar bar = bars::cone();
  const double c = bar.profile[0].material.rod_wave_speed_m_per_s();
  const double x1 = 0.4 * 30.0 / 45.0;
  const double x2 = x1 + 0.4;
  const ModalModel model = exact_bar_modes(bar, {.count = 60});
  for (Eigen::Index n = 1; n < 60; ++n) {
    const double k = model.angular_frequency(n) / c;
    const double turns = (k * (x2 - x1) - std::atan(k * x2) + std::atan(k * x1)) / pi;
    CHECK(std::abs(turns - static_cast<double>(n)) < 1e-11 * static_cast<double>(n));
  }
}

TEST_CASE("bar_modes: participations of a composite chain add up to its static flexibility") {
  for (Face face : {Face::a, Face::b}) {
    Bar bar{{parse_segment("125mm,32mm,nylon-6"), parse_segment("80mm,20mm,35mm,aluminium"),
             parse_segment("60mm,15mm,steel")},
            {face},
            FarEnd::fixed};
    double flexibility = 0;
    for (const Segment& s : bar.profile)
      flexibility += s.length_m / (s.material.youngs_modulus_Pa * pi / 4 * s.diameter_a_m * s.diameter_b_m);
    const auto sum = [&](std::size_t count) {
      const ModalModel model = exact_bar_modes(bar, {.count = count});
      return (model.participation.col(0).array() / model.angular_frequency.array()).square().sum();
    };
    // The rest of the series falls as 1/count: extrapolate it away.
    const double extrapolated = 2 * sum(4000) - sum(2000);
    CHECK(extrapolated == about(flexibility).epsilon(1e-6));
  }
}

TEST_CASE("bar_modes: no mode is missed between very unlike segments") {
  const Bar bar{{parse_segment("1m,100mm,steel"), parse_segment("2mm,1mm,nylon-6"), parse_segment("1m,100mm,steel")},
                {Face::a, Face::b},
                FarEnd::free};
  const ModalModel model = exact_bar_modes(bar, {.count = 21});
  // Two heavy rods on a thread: each rod's own modes in nearly equal pairs.
  const double alone = pi / travel_time_s({bar.profile[0]});
  for (Eigen::Index n = 2; n + 1 < 21; n += 2) {
    const double expected = alone * static_cast<double>(n) / 2;
    CHECK(model.angular_frequency(n) == about(expected).epsilon(1e-3));
    CHECK(model.angular_frequency(n + 1) == about(expected).epsilon(1e-3));
  }
  // A free bar seen from both ends: into the body at B is against the axis.
  CHECK(model.participation(0, 0) == -model.participation(0, 1));
}

TEST_CASE("bar_modes: the range ends at the highest frequency") {
  const Bar bar = bars::steel_rod(0.5);
  const double nyquist = 10.25 / (2 * travel_time_s(bar.profile));
  CHECK(exact_bar_modes(bar, {.highest_frequency_Hz = nyquist}).mode_count() == 11);
}

TEST_CASE("bar_modes: refuses an infinite bar and an endless range") {
  CHECK_THROWS_WITH_AS(static_cast<void>(exact_bar_modes(bars::steel_rod(1, FarEnd::infinite), {.count = 3})),
                       doctest::Contains("infinite bar has no modes"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(exact_bar_modes(bars::steel_rod(1), {})),
                       doctest::Contains("infinitely many modes"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(exact_bar_modes(bars::steel_rod(1), {.highest_frequency_Hz = 1e15})),
                       doctest::Contains("3.89e+11 modes"), std::invalid_argument);
}
