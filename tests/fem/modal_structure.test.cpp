#include "fem/bodies/modal_structure.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "fem/explicit/explicit_contact.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace impulse {
namespace {

TEST_CASE("modal_structure: with all its modes a body moves as its elements do") {
  // A change of coordinates commutes with central differences.
  const Bar cone = bars::cone(), rod = bars::steel_rod(1.0);
  const Structure projectile = bar_structure(cone, bar_mesh_by_count(cone, 30));
  const Structure target = bar_structure(rod, bar_mesh_by_count(rod, 30));
  const double step = 0.4 * travel_time_s(rod.profile) / 30;
  const Structure modal_projectile = modal_structure(modal_model(projectile), step);
  const Structure modal_target = modal_structure(modal_model(target), step);
  REQUIRE(modal_target.mass.rows() == 31);
  REQUIRE(modal_target.residual_flexibility.isZero(0));
  for (const ContactLaw& law : {ContactLaw::hertz(1e9), ContactLaw::rigid()}) {
    const ExplicitContact contact{.speed_m_per_s = 1.3, .step_s = step, .duration_s = 4e-4, .law = law};
    const ExplicitContactResult nodes = explicit_contact(projectile, target, contact);
    const ExplicitContactResult modes = explicit_contact(modal_projectile, modal_target, contact);
    const double peak = *std::ranges::max_element(nodes.trace.force_N);
    for (std::size_t n = 0; n < nodes.grid.size; ++n)
      REQUIRE(std::abs(modes.trace.force_N[n] - nodes.trace.force_N[n]) <= 1e-8 * peak);
    CHECK(modes.projectile.momentum_Ns == about(nodes.projectile.momentum_Ns).epsilon(1e-9));
    CHECK(modes.target.kinetic_energy_J == about(nodes.target.kinetic_energy_J).epsilon(1e-7));
  }
}

TEST_CASE("modal_structure: modes too fast for the step go to the residual flexibility, which the law has in series") {
  // A supported rod under a soft blow: the first modes and what the others give way statically.
  const Bar rod = bars::steel_rod(0.5, FarEnd::fixed);
  const ModalModel model = modal_model(bar_structure(rod, bar_mesh_by_count(rod, 100)));
  const Structure few = modal_structure(model, 1 / (1.5 * model.angular_frequency[3]));
  CHECK(few.mass.rows() == 5);
  const double compliance = [&] {
    double sum = few.residual_flexibility(0, 0);
    for (Eigen::Index i = 0; i < few.mass.rows(); ++i)
      sum += std::pow(few.contacts(i, 0), 2) / few.stiffness.coeff(i, i);
    return sum;
  }();
  const Material steel = parse_material("steel");
  CHECK(compliance == about(0.5 / (steel.youngs_modulus_Pa * M_PI / 4 * 1e-4)).epsilon(1e-9));

  const double k = 2e6, mass = 2;  // a blow of about 3 ms, against 0.4 ms of the rod's first period
  const ExplicitContact contact{.speed_m_per_s = 1, .step_s = 0.3e-6, .duration_s = 4e-3, .law = ContactLaw::linear(k)};
  const ExplicitContactResult all =
      explicit_contact(mass_structure(mass), modal_structure(model, contact.step_s), contact);
  const ExplicitContactResult cut = explicit_contact(mass_structure(mass), few, contact);
  Structure without = few;
  without.residual_flexibility.setZero();
  const ExplicitContactResult dropped = explicit_contact(mass_structure(mass), without, contact);
  const double reference = all.trace.running_impulse_Ns.back();
  const auto worst = [&](const ExplicitContactResult& other) {
    double largest = 0;
    for (std::size_t n = 0; n < all.grid.size; ++n)
      largest = std::max(largest, std::abs(other.trace.force_N[n] - all.trace.force_N[n]));
    return largest / *std::ranges::max_element(all.trace.force_N);
  };
  CHECK(worst(cut) <= 1e-4);
  CHECK(worst(dropped) >= 10 * worst(cut));
  CHECK(cut.trace.running_impulse_Ns.back() == about(reference).epsilon(1e-4));
  CHECK(cut.energy_error <= 1e-6);
}

TEST_CASE("modal_structure: a rigid contact is the spring of the residual flexibility") {
  const Bar rod = bars::steel_rod(0.5, FarEnd::fixed);
  const ModalModel model = modal_model(bar_structure(rod, bar_mesh_by_count(rod, 100)));
  const Structure few = modal_structure(model, 1e-5);
  Structure bare = few;
  bare.residual_flexibility.setZero();
  ExplicitContact contact{.speed_m_per_s = 1, .step_s = 2e-6, .duration_s = 1e-3};
  const ContactTrace rigid = explicit_contact(mass_structure(0.1), few, contact).trace;
  contact.law = ContactLaw::linear(1 / few.residual_flexibility(0, 0));
  const ContactTrace spring = explicit_contact(mass_structure(0.1), bare, contact).trace;
  CHECK(rigid.force_N == spring.force_N);
}

TEST_CASE("modal_structure: modes are damped by their ratios") {
  ModalModel one;
  one.angular_frequency = Eigen::VectorXd::Constant(1, 1000);
  one.damping_ratio = Eigen::VectorXd::Constant(1, 0.1);
  one.participation = Eigen::MatrixXd::Constant(1, 1, 2);
  one.residual_flexibility = Eigen::MatrixXd::Zero(1, 1);
  one.wave_admittance = Eigen::MatrixXd::Zero(1, 1);
  const Structure body = modal_structure(one, 1e-4);
  CHECK(body.dashpots[0] == about(200));
  CHECK(body.stiffness.coeff(0, 0) == about(1e6));
  CHECK_THROWS_WITH_AS((void)modal_structure(one, 2e-3),
                       "no mode is slow enough for the step 2000 us (the first has 159.2 Hz); use --step 999us",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)modal_structure(one, 0), "step 0 s is not positive", std::invalid_argument);
}

}  // namespace
}  // namespace impulse
