#include "impulse/exact/beam_modes.hpp"

#include "impulse/exact/beam_statics.hpp"
#include "tests/support/about.hpp"
#include "tests/support/beams.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace impulse;
using std::numbers::pi;

namespace {

/// Participations at points spread over the beam, times √m: the mode shapes, ∫φ² = 1.
Eigen::MatrixXd shapes(BeamSupports supports, std::size_t count, const std::vector<double>& at) {
  const Beam beam = beams::timoshenko(supports, at);
  return exact_beam_modes(beam, {.count = count}).participation * std::sqrt(beam.mass_kg());
}

}  // namespace

TEST_CASE("beam_modes: frequencies of the tables (Blevins), to their digits") {
  // β of the first five modes; the free beam's follow its two rigid-body modes.
  const auto check = [](BeamSupports supports, std::initializer_list<double> beta) {
    const Beam beam = beams::timoshenko(supports, {0.4});
    const Eigen::Index rigid = supports == BeamSupports::free ? 2 : 0;
    const ModalModel model = exact_beam_modes(beam, {.count = beta.size() + static_cast<std::size_t>(rigid)});
    for (Eigen::Index n = 0; n < rigid; ++n) CHECK(model.angular_frequency(n) == 0);
    Eigen::Index n = rigid;
    for (const double b : beta)
      CHECK(std::sqrt(model.angular_frequency(n++) / beam.slenderness_frequency()) == about(b).epsilon(1e-8));
  };
  check(BeamSupports::simple, {pi, 2 * pi, 3 * pi, 4 * pi, 5 * pi});
  for (const BeamSupports supports : {BeamSupports::clamped, BeamSupports::free})
    check(supports, {4.73004074, 7.85320462, 10.9956079, 14.1371655, 17.2787597});
  check(BeamSupports::cantilever, {1.87510407, 4.69409113, 7.85475744, 10.99554073, 14.13716839});
}

TEST_CASE("beam_modes: the period of Timoshenko's beam is 1 ms") {
  const ModalModel model = exact_beam_modes(beams::timoshenko(), {.count = 1});
  CHECK(2 * pi / model.angular_frequency(0) == about(1e-3).epsilon(2e-3));  // published to one digit
}

TEST_CASE("beam_modes: shapes are orthonormal") {
  // The midpoint sum on 4000 points is exact for circular parts to (β/4000)²/24 < 1e-5.
  std::vector<double> at;
  for (int i = 0; i < 4000; ++i) at.push_back((i + 0.5) / 4000);
  for (const BeamSupports supports : beams::all_supports) {
    const Eigen::MatrixXd phi = shapes(supports, 12, at);
    const Eigen::MatrixXd gram = phi * phi.transpose() / 4000;
    CHECK((gram - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff() < 1e-4);
  }
}

TEST_CASE("beam_modes: shapes meet the supports and, by differences, φ'''' = β⁴φ") {
  for (const BeamSupports supports : beams::all_supports) {
    CAPTURE(static_cast<int>(supports));
    for (const std::size_t n : {3u, 4u, 7u}) {
      const double h = 1e-3;
      for (const double x : {0.02, 0.31, 0.5, 0.98}) {
        const Eigen::RowVectorXd phi = shapes(supports, n, {x - 2 * h, x - h, x, x + h, x + 2 * h}).bottomRows(1);
        const Beam beam = beams::timoshenko(supports);
        const double fourth = exact_beam_modes(beam, {.count = n}).angular_frequency(static_cast<Eigen::Index>(n) - 1) /
                              beam.slenderness_frequency();  // β²
        const double difference = phi(0) - 4 * phi(1) + 6 * phi(2) - 4 * phi(3) + phi(4);
        // Truncation β²h²/6 of β⁴φ, below 1e-4 for β < 25; rounding 16ε/h⁴ = 3.6e-3, against β⁴ ≥ 1e3.
        CHECK(std::abs(difference / std::pow(h, 4) - fourth * fourth * phi(2)) <
              1e-4 * fourth * fourth * std::numbers::sqrt2 + 0.02);
      }
    }
    // A held end: φ and, if clamped, φ' vanish; near ξ = 0 the shape then is of order ξ, ξ².
    const double near = 1e-6;
    if (supports == BeamSupports::free) continue;
    const Eigen::MatrixXd phi = shapes(supports, 5, {near});
    CHECK(phi.cwiseAbs().maxCoeff() < (supports == BeamSupports::simple ? 50 * near : 1e-9));
  }
}

TEST_CASE("beam_modes: end values of free and clamped shapes, 2 however high the mode") {
  const Eigen::MatrixXd free = shapes(BeamSupports::free, 5000, {0, 1});
  for (const Eigen::Index n : {2, 3, 50, 51, 1000, 4999}) {
    CHECK(std::abs(free(n, 0)) == about(2).epsilon(1e-10));
    CHECK(free(n, 1) == about(2).epsilon(1e-10));
  }
  const Eigen::MatrixXd tip = shapes(BeamSupports::cantilever, 5000, {1});
  for (const Eigen::Index n : {0, 1, 10, 11, 1000, 4999}) CHECK(std::abs(tip(n, 0)) == about(2).epsilon(1e-9));
  // Far from the ends only the circular part is left, of amplitude √2.
  for (const BeamSupports supports : beams::all_supports) {
    const Eigen::MatrixXd inside = shapes(supports, 5000, {0.3, 0.5, 0.7});
    CHECK(inside.bottomRows(4000).cwiseAbs().maxCoeff() < std::numbers::sqrt2 * (1 + 1e-9));
    CHECK(inside.bottomRows(4000).cwiseAbs().maxCoeff() > 1.41);
  }
}

TEST_CASE("beam_modes: the modes of ever more of the beam add up to its static influence function") {
  const std::vector<double> at{0.07, 0.3, 0.5, 0.85};
  for (const BeamSupports supports : beams::all_supports) {
    CAPTURE(static_cast<int>(supports));
    const Beam beam = beams::timoshenko(supports, at);
    const Eigen::MatrixXd whole = beam_static_flexibility(beam);
    CHECK((whole - whole.transpose()).cwiseAbs().maxCoeff() < 1e-15 * whole.maxCoeff() * 100);
    // The rest after N modes is at most Σ 4/β⁴ ≈ 4/(3π⁴N³) of the flexibility L³/EI: 1e-12 at 2400.
    const ModalModel model = exact_beam_modes(beam, {.count = 2400});
    const Eigen::Index rigid = supports == BeamSupports::free ? 2 : 0;
    const Eigen::MatrixXd compliant = model.angular_frequency.tail(2400 - rigid).cwiseInverse().asDiagonal() *
                                      model.participation.bottomRows(2400 - rigid);
    CHECK((whole - compliant.transpose() * compliant).cwiseAbs().maxCoeff() < 3e-12 * beam.flexibility_m_per_N());
    // The residual of a few modes is what the others add.
    const ModalModel few = exact_beam_modes(beam, {.count = 9});
    const Eigen::MatrixXd others = compliant.bottomRows(2400 - 9).transpose() * compliant.bottomRows(2400 - 9);
    CHECK((few.residual_flexibility - others).cwiseAbs().maxCoeff() < 3e-12 * beam.flexibility_m_per_N());
    CHECK(few.residual_flexibility(2, 2) > 0);
  }
}

TEST_CASE("beam_modes: static deflections of the handbook, and a residual that is rounding is none") {
  const auto at_middle = [](BeamSupports supports, double at) {
    const Beam beam = beams::timoshenko(supports, {at});
    return beam_static_flexibility(beam)(0, 0) / beam.flexibility_m_per_N();
  };
  CHECK(at_middle(BeamSupports::simple, 0.5) == about(1.0 / 48));
  CHECK(at_middle(BeamSupports::simple, 0.25) == about(0.25 * 0.25 * 0.75 * 0.75 / 3));
  CHECK(at_middle(BeamSupports::clamped, 0.5) == about(1.0 / 192));
  CHECK(at_middle(BeamSupports::cantilever, 1) == about(1.0 / 3));
  // Elastic part of a free beam loaded in the middle, against inertia 1 a unit length: Σ 4.73.. modes; 1/β⁴φ² of the
  // first symmetric one is 0.00295, the rest adds little.
  CHECK(at_middle(BeamSupports::free, 0.5) == about(0.0030).epsilon(0.05));
  CHECK(exact_beam_modes(beams::timoshenko(), {.count = 100000}).residual_flexibility(0, 0) == 0);
}

TEST_CASE("beam_modes: a free beam moves with its mass and turns about its middle") {
  const Beam beam = beams::timoshenko(BeamSupports::free, {0, 0.5, 1});
  const ModalModel model = exact_beam_modes(beam, {.count = 2});
  for (Eigen::Index i = 0; i < 3; ++i)
    CHECK(model.participation(0, i) == about(1 / std::sqrt(beam.mass_kg())).epsilon(1e-15));
  // (x - L/2)/√(mL²/12)
  CHECK(model.participation(1, 0) == about(-std::sqrt(3 / beam.mass_kg())).epsilon(1e-15));
  CHECK(model.participation(1, 1) == 0);
}

TEST_CASE("beam_modes: the range ends at the highest frequency, and needs an end") {
  const Beam beam = beams::timoshenko();
  const double first = exact_beam_modes(beam, {.count = 1}).angular_frequency(0) / (2 * pi);
  CHECK(exact_beam_modes(beam, {.highest_frequency_Hz = 100.5 * first}).mode_count() == 10);
  CHECK(exact_beam_modes(beam, {.highest_frequency_Hz = 0.5 * first}).mode_count() == 0);
  CHECK(exact_beam_modes(beam, {.highest_frequency_Hz = 0.5 * first}).residual_flexibility(0, 0) ==
        about(beam.flexibility_m_per_N() / 48));
  const auto refuses = [](const Beam& body, const ModeRange& range, const char* message) {
    CHECK_THROWS_WITH_AS((void)exact_beam_modes(body, range), doctest::Contains(message), std::invalid_argument);
  };
  refuses(beam, {}, "infinitely many modes");
  refuses(beam, {.count = 10'000'000}, "1e+07 modes are more than can be had");
  refuses(beam, {.highest_frequency_Hz = 1e18}, "modes are more than can be had");
  refuses(beams::timoshenko(BeamSupports::free), {.count = 1}, "two rigid-body modes");
  refuses(beams::timoshenko(BeamSupports::simple, {0}), {.count = 1}, "is a support");
}
