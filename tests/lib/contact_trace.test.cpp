#include "lib/law/contact_trace.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("contact_trace: periods of contact begin and end at the zeros of the indentation") {
  ContactTrace trace;
  trace.indentation_m = {0, 2, 1, -1, -1, 3, -1, -2, 1};
  for (double x : trace.indentation_m) {
    trace.force_N.push_back(x > 0 ? 10 * x : 0);
    trace.in_contact.push_back(x > 0);
  }
  trace.running_impulse_Ns = {0, 10, 25, 28, 28, 35, 47, 47, 50};
  const auto periods = contact_intervals(trace, {1, 9});
  REQUIRE(periods.size() == 3);
  CHECK(periods[0].start_s == 0);
  CHECK(periods[0].end_s == 2.5);
  CHECK(periods[0].peak_force_N == 20);
  CHECK(periods[0].peak_time_s == 1);
  CHECK(periods[0].impulse_Ns == 28);
  CHECK(periods[1].start_s == 4.25);
  CHECK(periods[1].end_s == 5.75);
  CHECK(periods[1].impulse_Ns == 19);
  CHECK(periods[2].open_ended);
  CHECK(periods[2].end_s == 8);
}

TEST_CASE("contact_trace: a rigid contact ends with the first of three samples without force, not of two") {
  const auto bridged = [](std::vector<bool> in_contact) {
    bridge_wave_fronts(in_contact);
    return in_contact;
  };
  CHECK(bridged({0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0}) == std::vector<bool>{0, 0, 1, 1, 1, 1, 1, 1, 1, 0, 0});
  CHECK(bridged({1, 0, 0, 0, 1, 0, 1}) == std::vector<bool>{1, 0, 0, 0, 1, 1, 1});
  CHECK(bridged({0, 0}) == std::vector<bool>{0, 0});
  CHECK(bridged({}).empty());
}

TEST_CASE("contact_trace: a rigid contact counts from its first to its last sample in contact") {
  ContactTrace trace;
  trace.indentation_m = {-2, -1, 0, 0, 0, -1};
  trace.in_contact = {false, false, true, true, true, false};
  trace.force_N = {0, 0, 5, 5, 5, 0};
  trace.running_impulse_Ns = {0, 0, 5, 10, 15, 15};
  const auto periods = contact_intervals(trace, {1, 6});
  REQUIRE(periods.size() == 1);
  CHECK(periods[0].start_s == 2);
  CHECK(periods[0].end_s == 4);
}

TEST_CASE(
    "contact_trace: the summary adds the impulses of all contacts of body 1, and knows restitution from both masses") {
  ContactTrace first;
  first.indentation_m = {0, 1, 1, -1};
  first.in_contact = {false, true, true, false};
  first.force_N = {0, 5, 9, 0};
  first.running_impulse_Ns = {0, 2, 6, 7};
  ContactTrace second = first;
  second.force_N = {0, 3, 4, 0};
  second.running_impulse_Ns = {0, 1, 2, 3};
  ContactsScene scene{.speed_1_m_per_s = 4,
                      .speed_2_m_per_s = -1,
                      .mass_1_kg = 2,
                      .mass_2_kg = 5,
                      .contacts_of_body_1 = 2,
                      .energy_error = 0.5};
  const ContactsSummary both = contacts_summary({first, second}, {1, 4}, scene);
  CHECK(both.impact.impulse_Ns == 10);
  CHECK(both.impact.peak_force_N == 9);
  CHECK(both.impact.peak_time_s == 2);
  CHECK(both.impact.contact_duration_s == 2.5);
  CHECK(both.impact.energy_error == 0.5);
  CHECK(both.contact_count == 2);
  CHECK(both.impact.rebound_speed_m_per_s == 4 - 10.0 / 2);
  CHECK(*both.restitution == about(10 * (0.5 + 0.2) / 5 - 1));
  // In a row of bodies only the first contact is body 1's.
  scene.contacts_of_body_1 = 1;
  scene.mass_2_kg = std::nullopt;
  const ContactsSummary row = contacts_summary({first, second}, {1, 4}, scene);
  CHECK(row.impact.impulse_Ns == 7);
  CHECK_FALSE(row.restitution.has_value());
}

TEST_CASE("contact_trace: energy of a centre of mass: speed and impulses, less what a preload is balanced by") {
  const UniformGrid grid{0.5, 3};
  ContactTrace one, two;
  one.running_impulse_Ns = {0, 3, 5};
  two.running_impulse_Ns = {0, 1, 1};
  const std::vector<ContactTrace> traces{one, two};
  // p = 2·3 - (0, 4, 6) and p = 4·1 + (0, 3, 5) - 2 t.
  CHECK(translational_energy({1, 2, 3, -1, 0}, grid, traces).translational_J == std::vector<double>{9, 1, 0});
  const BodyEnergy last = translational_energy({3, 4, 1, +1, 2}, grid, std::span(traces).first(1));
  CHECK(last.body == 3);
  CHECK(last.translational_J == std::vector<double>{2, 4.5, 49.0 / 8});
  CHECK_THROWS_WITH_AS((void)translational_energy({1, 0, 3, -1, 0}, grid, traces), "mass 0 kg is not positive",
                       std::invalid_argument);
}
