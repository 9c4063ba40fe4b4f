#include "fem/explicit/explicit_contacts.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "fem/explicit/explicit_contact.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/chain.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace impulse {
namespace {

const double steel_speed = parse_material("steel").rod_wave_speed_m_per_s();

/// Two bodies that know nothing of each other, as one body with the contacts of both.
Structure side_by_side(const Structure& a, const Structure& b) {
  Structure both;
  both.stiffness = test::side_by_side(a.stiffness, b.stiffness);
  both.mass = test::side_by_side(a.mass, b.mass);
  const auto diagonal = [](const Eigen::MatrixXd& first, const Eigen::MatrixXd& second) {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(first.rows() + second.rows(), first.cols() + second.cols());
    whole.topLeftCorner(first.rows(), first.cols()) = first;
    whole.bottomRightCorner(second.rows(), second.cols()) = second;
    return whole;
  };
  both.contacts = diagonal(a.contacts, b.contacts);
  both.wave_admittance = diagonal(a.wave_admittance, b.wave_admittance);
  both.translation.resize(both.mass.rows());
  both.translation << *rigid_translation(a), *rigid_translation(b);
  return both;
}

/// A rigid mass that two contacts share.
Structure wide_mass(double mass_kg) {
  Structure body = mass_structure(mass_kg);
  body.contacts = Eigen::MatrixXd::Ones(1, 2);
  body.wave_admittance = Eigen::MatrixXd::Zero(2, 2);
  return body;
}

Structure rod_of(std::size_t elements, const std::vector<Face>& faces, double diameter_m = 0.01) {
  Bar bar = bars::steel_rod(0.5 / 40 * static_cast<double>(elements), FarEnd::free, diameter_m);
  bar.faces = faces;
  return bar_structure(bar, bar_mesh_by_count(bar, elements));
}

constexpr double element_m = 0.5 / 40;

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

TEST_CASE("explicit_contacts: in a row of equal rods the last one leaves with the speed of the first") {
  const double step = element_m / steel_speed;
  const std::vector<ExplicitBody> row{
      {rod_of(40, {Face::b}), 1}, {rod_of(40, {Face::a, Face::b})}, {rod_of(40, {Face::a})}};
  const double mass = mass_kg(bars::steel_rod(0.5).profile), force = mass * steel_speed / 0.5 / 2;
  for (const AfterContact after : {AfterContact::go_on, AfterContact::touch_again}) {
    const ExplicitContactsResult result = explicit_contacts(row, {.step_s = step,
                                                                  .duration_s = 200 * step,
                                                                  .laws = {ContactLaw::rigid(), ContactLaw::rigid()},
                                                                  .gaps_m = {0, 0},
                                                                  .after_contact = after});
    // V Z/2 for 2L/c, from 0 and from L/c: fronts fall on samples, where the force is the mean of both sides.
    for (std::size_t n = 0; n < result.grid.size; ++n) {
      if (n > 0 && n < 80) CHECK(result.traces[0].force_N[n] == about(force).epsilon(1e-9));
      if (n > 40 && n < 120) CHECK(result.traces[1].force_N[n] == about(force).epsilon(1e-9));
      if (n > 81) CHECK(result.traces[0].force_N[n] == 0);
      if (n < 39 || n > 121) CHECK(result.traces[1].force_N[n] == 0);
    }
    CHECK_FALSE(result.in_contact_at_end);
    CHECK(result.energy_error <= 0.02);
    const double total =
        result.balances[0].momentum_Ns + result.balances[1].momentum_Ns + result.balances[2].momentum_Ns;
    CHECK(total == about(mass).epsilon(1e-12));
    CHECK(result.balances[2].momentum_Ns == about(mass).epsilon(0.02));
    // The forces of both faces of the middle rod are its momentum.
    CHECK(std::abs(result.balances[1].momentum_Ns - (result.traces[0].running_impulse_Ns.back() -
                                                     result.traces[1].running_impulse_Ns.back())) <= 1e-13 * mass);
  }
}

ExplicitContactsResult uneven_row(const ContactLaw& first, const ContactLaw& second, std::size_t refined) {
  const double step = 0.5 * element_m / steel_speed / static_cast<double>(refined);
  const auto rod = [&](double elements, const std::vector<Face>& faces, double diameter_m) {
    Bar bar = bars::steel_rod(element_m * elements, FarEnd::free, diameter_m);
    bar.faces = faces;
    return bar_structure(bar, bar_mesh_by_count(bar, static_cast<std::size_t>(elements) * refined));
  };
  return explicit_contacts(
      {{rod(40, {Face::b}, 0.01), 1, 2}, {rod(10, {Face::a, Face::b}, 0.02), 0, 3}, {rod(60, {Face::a}, 0.01), 0, 1}},
      {.step_s = step,
       .duration_s = 1200 * step * static_cast<double>(refined),
       .laws = {first, second},
       .gaps_m = {3e-6, 5e-6},
       .after_contact = AfterContact::touch_again});
}

TEST_CASE("explicit_contacts: a row with laws, gaps and subcycles keeps momentum and, with laws, energy") {
  const double mass = mass_kg(bars::steel_rod(0.5).profile), arrived = 0.5 * mass;
  for (const ContactLaw& first : {ContactLaw::hertz(2e10), ContactLaw::rigid()})
    for (const ContactLaw& second : {ContactLaw::linear(2e8), ContactLaw::tan_sun(2e10, 0.1, 1e-7)}) {
      const ExplicitContactsResult result = uneven_row(first, second, 1);
      double momentum = 0;
      for (const BodyBalance& body : result.balances) momentum += body.momentum_Ns;
      CHECK(momentum == about(mass).epsilon(1e-12));
      CHECK(largest(result.traces[1].force_N) > 100);
      // Of a rigid contact below Courant number 1 each closing costs the energy of the face's node, of order 1.
      if (first.is_rigid())
        CHECK(uneven_row(first, second, 4).energy_error <= 0.4 * result.energy_error);
      else
        CHECK(result.energy_error <= 1e-3);
      const ContactTrace& trace = result.traces[1];
      for (std::size_t n = 0; n < trace.force_N.size(); ++n)
        REQUIRE(std::abs(trace.work_1_J[n] + trace.work_2_J[n] + trace.stored_J[n] + trace.dissipated_J[n]) <=
                1e-11 * arrived);
    }
}

TEST_CASE("explicit_contacts: two contacts of bodies side by side are the two by themselves") {
  const double step = 4e-6;
  const auto by_step = [step](const Bar& bar) { return bar_structure(bar, bar_mesh_by_step(bar, step)); };
  const Structure cone = by_step(bars::cone(Face::b)), rod = by_step(bars::long_rod()),
                  bar = by_step(bars::composite());
  for (const ContactLaw& law : {ContactLaw::rigid(), ContactLaw::hertz(2e9)})
    for (const AfterContact after : {AfterContact::go_on, AfterContact::touch_again}) {
      const ContactLaw other = ContactLaw::linear(1e8);
      const ExplicitContactsResult both =
          explicit_contacts({{side_by_side(cone, bar), 0.93, 1}, {side_by_side(rod, rod), 0, 1}},
                            {.step_s = step,
                             .duration_s = 1.2e-3,
                             .laws = {law, law.is_rigid() ? law : other},
                             .gaps_m = {0, 20e-6},
                             .after_contact = after});
      const ExplicitContact alone{
          .speed_m_per_s = 0.93, .step_s = step, .duration_s = 1.2e-3, .law = law, .after_contact = after};
      ExplicitContact second = alone;
      second.gap_m = 20e-6;
      if (!law.is_rigid()) second.law = other;
      const ContactTrace one = explicit_contact(cone, rod, alone).trace, two = explicit_contact(bar, rod, second).trace;
      const double peak = std::max(largest(one.force_N), largest(two.force_N));
      for (std::size_t n = 0; n < one.force_N.size(); ++n) {
        REQUIRE(std::abs(both.traces[0].force_N[n] - one.force_N[n]) <= 1e-9 * peak);
        REQUIRE(std::abs(both.traces[1].force_N[n] - two.force_N[n]) <= 1e-9 * peak);
        REQUIRE(std::abs(both.traces[1].indentation_m[n] - two.indentation_m[n]) <= 1e-12);
      }
      CHECK(contact_intervals(both.traces[0], both.grid).size() == contact_intervals(one, both.grid).size());
    }
}

TEST_CASE("explicit_contacts: a mass on two springs at once: half a sine of twice the stiffness, with order 2") {
  // The contacts share the mass within each step, so that their forces are iterated.
  const double m = 0.3, big = 0.5, k = 1e6, reduced = m * 2 * big / (m + 2 * big), omega = std::sqrt(2 * k / reduced);
  const double peak = 0.5 * std::sqrt(2 * k * reduced);
  std::vector<double> errors;
  for (const double per_contact : {20.3, 40.3, 80.3, 160.3}) {
    const double step = std::numbers::pi / omega / per_contact;
    const ExplicitContactsResult result =
        explicit_contacts({{wide_mass(m), 1}, {side_by_side(mass_structure(big), mass_structure(big)), 0}},
                          {.step_s = step,
                           .duration_s = 1.5 * std::numbers::pi / omega,
                           .laws = {ContactLaw::linear(k), ContactLaw::linear(k)},
                           .gaps_m = {0, 0}});
    double worst = 0;
    for (std::size_t n = 0; n < result.grid.size; ++n) {
      const double angle = omega * result.grid.time_s(n);
      for (const ContactTrace& trace : result.traces)
        worst = std::max(worst, std::abs(trace.force_N[n] - (angle < std::numbers::pi ? peak * std::sin(angle) : 0)));
    }
    errors.push_back(worst / peak);
    CHECK(result.energy_error <= 1e-6);
    CHECK(result.balances[0].momentum_Ns == about(m - 2 * reduced).epsilon(1e-12));
    CHECK(result.balances[1].momentum_Ns == about(2 * reduced).epsilon(1e-12));
  }
  CHECK(std::abs(std::log2(errors.front() / errors.back()) / 3 - 2) <= 0.1);
}

TEST_CASE("explicit_contacts: a mass strikes a second with a third behind it, on springs: two normal modes, order 2") {
  // Equal masses m, equal springs k: δ₁,₂ = V/2 [sin(ω₁t)/ω₁ ± sin(ω₂t)/ω₂], ω₁² = k/m, ω₂² = 3k/m.
  const double m = 0.3, k = 1e6, speed = 2, omega = std::sqrt(k / m), faster = std::sqrt(3.0) * omega;
  std::vector<double> errors;
  for (const double steps : {50.0, 100.0, 200.0, 400.0}) {
    const ExplicitContactsResult result = explicit_contacts(
        {{mass_structure(m), speed}, {mass_structure(m, {Face::a, Face::b}), 0}, {mass_structure(m), 0}},
        {.step_s = 2 / omega / steps,
         .duration_s = 2 / omega,
         .laws = {ContactLaw::linear(k), ContactLaw::linear(k)},
         .gaps_m = {0, 0}});
    double worst = 0;
    for (std::size_t n = 0; n < result.grid.size; ++n) {
      const double t = result.grid.time_s(n), slow = std::sin(omega * t) / omega, fast = std::sin(faster * t) / faster;
      worst = std::max(worst, std::abs(result.traces[0].force_N[n] - 0.5 * k * speed * (slow + fast)));
      worst = std::max(worst, std::abs(result.traces[1].force_N[n] - 0.5 * k * speed * (slow - fast)));
    }
    errors.push_back(worst * omega / (k * speed));
  }
  CHECK(std::abs(std::log2(errors.front() / errors.back()) / 3 - 2) <= 0.1);
  CHECK(errors.back() < 1e-4);
}

TEST_CASE("explicit_contacts: rigid contacts that share a mass stop it together, each with its share") {
  // The mass meets a rod at each contact: with the impedances Z₁, Z₂ it is slowed by e^(-(Z₁+Z₂)t/m).
  const double mass = 0.2, step = element_m / steel_speed;
  const Bar thin = bars::steel_rod(0.5, FarEnd::infinite), thick = bars::steel_rod(0.5, FarEnd::infinite, 0.02);
  const double z1 = face_impedance_kg_per_s(thin.profile, Face::a),
               z2 = face_impedance_kg_per_s(thick.profile, Face::a);
  std::vector<double> errors;
  for (const std::size_t n : {40u, 80u, 160u, 320u}) {
    const double fine = step * 40 / static_cast<double>(n);
    const ExplicitContactsResult result =
        explicit_contacts({{wide_mass(mass), 1},
                           {side_by_side(bar_structure(thin, bar_mesh_by_count(thin, n)),
                                         bar_structure(thick, bar_mesh_by_count(thick, n)))}},
                          {.step_s = fine,
                           .duration_s = 30 * step,
                           .laws = {ContactLaw::rigid(), ContactLaw::rigid()},
                           .gaps_m = {0, 0}});
    const double speed = std::exp(-(z1 + z2) * result.grid.duration_s() / mass);
    errors.push_back(std::abs(result.traces[0].force_N.back() / (z1 * speed) - 1));
    CHECK(result.traces[0].force_N[0] == about(z1).epsilon(1e-12));
    CHECK(result.traces[1].force_N[0] == about(z2).epsilon(1e-12));
    CHECK(result.traces[1].force_N.back() / result.traces[0].force_N.back() == about(z2 / z1).epsilon(1e-6));
  }
  CHECK(std::abs(std::log2(errors.front() / errors.back()) / 3 - 2) <= 0.1);
}

TEST_CASE("explicit_contacts: a consistent mass integrates too, and tends to the same impact") {
  const Bar cone = bars::cone(), rod = bars::long_rod();
  std::vector<double> apart;
  for (const std::size_t n : {40u, 80u, 160u, 320u}) {
    const double step = travel_time_s(cone.profile) / static_cast<double>(n) / 2;
    const auto impulse = [&](MassMatrix mass) {
      return explicit_contact(
                 bar_structure(cone, bar_mesh_by_count(cone, n, mass)),
                 bar_structure(rod, bar_mesh_by_count(rod, 2 * n, mass)),
                 {.speed_m_per_s = 1.16, .step_s = step, .duration_s = 5e-4, .law = ContactLaw::hertz(1e9)})
          .trace.running_impulse_Ns.back();
    };
    apart.push_back(std::abs(impulse(MassMatrix::consistent) / impulse(MassMatrix::lumped) - 1));
  }
  CHECK(apart.back() <= 1e-4);
  CHECK(std::log2(apart.front() / apart.back()) / 3 >= 1.5);
}

TEST_CASE("explicit_contacts: bodies and contacts that do not fit are refused") {
  const double step = element_m / steel_speed;
  const Structure end = rod_of(40, {Face::a}), inner = rod_of(40, {Face::a, Face::b});
  const ExplicitContacts good{
      .step_s = step, .duration_s = 50 * step, .laws = {ContactLaw::rigid(), ContactLaw::rigid()}, .gaps_m = {0, 0}};
  const auto refused = [](const std::vector<ExplicitBody>& bodies, const ExplicitContacts& contacts,
                          const char* message) {
    CHECK_THROWS_WITH_AS((void)explicit_contacts(bodies, contacts), message, std::invalid_argument);
  };
  refused({{end, 1}}, good, "1 body cannot collide; give two or more");
  refused({{end, 1}, {inner}}, good, "the projectile has 1 contacts, the target 2; they meet pair by pair");
  refused({{end, 1}, {end}, {end}}, good,
          "the 2nd body has 1 contacts; in a row of 3 bodies it takes two, entry and exit");
  refused({{inner, 1}, {inner}, {end}}, good, "the projectile has 2 contacts; in a row of 3 bodies it takes one");
  refused({{inner, 1}, {inner}}, good, "contact 2 of the projectile does not fly with it towards the other body");
  refused({{end}, {inner, 0}, {end}}, good, "no body flies towards the next one, so they never meet");
  refused({{end, 1}, {inner, 0, 0}, {end}}, good,
          "0 subcycles of the 2nd body (it takes at least one step); use 1 or more");
  refused({{end, 1}, {rod_of(40, {Face::a, Face::b}), 0, 1}, {rod_of(40, {Face::a}), 0, 0}}, good,
          "0 subcycles of the target (it takes at least one step); use 1 or more");
  ExplicitContacts contacts = good;
  contacts.laws.pop_back();
  refused({{end, 1}, {inner}, {end}}, contacts, "1 laws for 2 contacts");
  contacts = good;
  contacts.gaps_m = {0};
  refused({{end, 1}, {inner}, {end}}, contacts, "1 gaps for 2 contacts");
  contacts = good;
  contacts.matching = Matching::bisection;
  refused({{end, 1}, {inner}, {end}}, contacts, "bisection finds the force of one rigid contact; use direct matching");
  Structure odd = end;
  odd.residual_flexibility = Eigen::MatrixXd::Zero(2, 2);
  contacts = good;
  contacts.laws = {ContactLaw::rigid()};
  contacts.gaps_m = {0};
  refused({{odd, 1}, {end}}, contacts, "residual flexibility 2 x 2 of the projectile for 1 contacts");
  odd = end;
  odd.translation = Eigen::VectorXd::Ones(3);
  refused({{odd, 1}, {end}}, contacts, "a translation of 3 degrees of freedom for the projectile's 41");
  odd = end;
  odd.contacts.setZero();
  refused({{odd, 1}, {end}}, contacts, "contact 1 of the projectile does not move with anything");
}

}  // namespace
}  // namespace impulse
