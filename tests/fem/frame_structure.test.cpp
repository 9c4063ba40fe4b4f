#include "fem/bodies/frame_structure.hpp"

#include "lib/model/modal_model.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace impulse;
using std::numbers::pi;

namespace {

/// NAFEMS FV2: eight arms of 5 m from a common joint, pinned outside; section 0.125 m square.
Frame cross(std::size_t elements) {
  const double side = 0.125, e = 200e9, rho = 8000;
  Frame frame{{{0, 0, JointSupport::none}}, {}};
  for (std::size_t arm = 1; arm <= 8; ++arm) {
    const double angle = pi / 4 * static_cast<double>(arm);
    frame.joints.push_back({5 * std::cos(angle), 5 * std::sin(angle), JointSupport::pinned});
    frame.members.push_back({0, arm, e * side * side, e * std::pow(side, 4) / 12, rho * side * side, elements});
  }
  return frame;
}

Eigen::VectorXd frequencies_Hz(const Frame& frame, std::size_t count) {
  return modal_model(frame_structure(frame), {.mode_count = count}).angular_frequency / (2 * pi);
}

}  // namespace

TEST_CASE("frame_structure: NAFEMS FV2, pin-ended double cross") {
  const Eigen::VectorXd f = frequencies_Hz(cross(12), 16);
  // Euler-Bernoulli with 12 elements an arm, computed independently, to the digits given; NAFEMS within 0.6 %.
  const double converged[] = {11.336, 17.681, 17.681, 17.710, 17.710, 17.710, 17.710, 17.710,
                              45.347, 57.079, 57.079, 57.395, 57.395, 57.395, 57.395, 57.395};
  const double nafems[] = {11.336, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709, 17.709,
                           45.345, 57.390, 57.390, 57.390, 57.390, 57.390, 57.390, 57.390};
  for (Eigen::Index i = 0; i < 16; ++i) {
    CAPTURE(i);
    CHECK(f(i) == about(converged[i]).epsilon(0.0006 / converged[i]));
    CHECK(f(i) == about(nafems[i]).epsilon(0.006));
  }
}

TEST_CASE("frame_structure: frequencies do not know how the frame is turned, nor which way a member runs") {
  Frame frame{{{0, 0, JointSupport::clamped}, {3, 0, JointSupport::none}, {3, 2, JointSupport::pinned}}, {}};
  frame.members = {{0, 1, 1e6, 2e4, 3, 6}, {1, 2, 1e6, 2e4, 3, 4}};
  const Eigen::VectorXd f = frequencies_Hz(frame, 6);
  for (FrameJoint& joint : frame.joints) {
    const double x = joint.x_m;
    joint.x_m = 0.6 * x - 0.8 * joint.y_m + 1;
    joint.y_m = 0.8 * x + 0.6 * joint.y_m;
  }
  std::swap(frame.members[1].from, frame.members[1].to);
  CHECK((frequencies_Hz(frame, 6) - f).cwiseAbs().maxCoeff() < 1e-9 * f(5));
}

TEST_CASE("frame_structure: one straight member is a beam and a bar") {
  const double ea = 1e6, ei = 20, mu = 3, length = 2;
  const Frame beam{{{0, 0, JointSupport::pinned}, {0, length, JointSupport::pinned}}, {{0, 1, ea, ei, mu, 40}}};
  const Eigen::VectorXd f = frequencies_Hz(beam, 3);
  for (int n = 1; n <= 3; ++n)  // order 4: (nπ/40)⁴/1440 < 3e-6
    CHECK(f(n - 1) == about(n * n * pi / 2 / (length * length) * std::sqrt(ei / mu)).epsilon(3e-6));
}

TEST_CASE("frame_structure: refuses what is no frame") {
  const auto refuses = [](auto change, const char* message) {
    Frame frame = cross(1);
    change(frame);
    CHECK_THROWS_WITH_AS((void)frame_structure(frame), doctest::Contains(message), std::invalid_argument);
  };
  refuses([](Frame& f) { f.members.clear(); }, "needs at least one member");
  refuses([](Frame& f) { f.members[1].to = 9; }, "member 2 goes from joint 0 to 9, but there are 9 joints");
  refuses([](Frame& f) { f.members[2].to = 0; }, "member 3 has no length");
  refuses([](Frame& f) { f.members[0].elements = 0; }, "member 1 has no element");
  refuses([](Frame& f) { f.members[0].mass_kg_per_m = 0; }, "are not all positive");
}
