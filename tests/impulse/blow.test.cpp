#include "impulse/measured/blow.hpp"

#include "tests/support/records.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace impulse;

namespace {

Blow clean(std::size_t begin = 100, std::size_t length = 40) {
  Blow blow{"a.csv", records::half_sine(2000, begin, length, 500), std::vector<double>(2000)};
  for (std::size_t n = begin; n < 2000; ++n)
    blow.response[n] = std::sin(0.07 * static_cast<double>(n - begin)) * std::exp(-1e-3 * static_cast<double>(n));
  return blow;
}

}  // namespace

TEST_CASE("blow: the pulse is found with room on both sides, with noise too") {
  const BlowWindow window = examined_blow(clean(), 1e-5, {});
  CHECK(window.fault == BlowFault::none);
  CHECK(window.begin <= 100);
  CHECK(window.begin >= 70);
  CHECK(window.force_end >= 141);
  CHECK(window.force_end <= 170);
  std::mt19937_64 engine(2);
  for (int repeat = 0; repeat < 50; ++repeat) {
    Blow noisy = clean();
    records::add_noise(noisy.force_N, 50, engine);  // 20 dB below the peak
    records::add_noise(noisy.response, 0.05, engine);
    const BlowWindow found = examined_blow(noisy, 1e-5, {});
    CHECK(found.fault == BlowFault::none);
    CHECK(found.begin <= 101);
    CHECK(found.force_end >= 140);
    CHECK(found.force_end - found.begin < 100);
  }
}

TEST_CASE("blow: faults") {
  Blow twice = clean();
  for (std::size_t n = 0; n < 30; ++n) twice.force_N[400 + n] = 80;
  CHECK(examined_blow(twice, 1e-5, {}).fault == BlowFault::second_hit);
  CHECK(examined_blow(twice, 1e-5, {.second_hit = 0.2}).fault == BlowFault::none);

  Blow clipped_force = clean();
  for (double& value : clipped_force.force_N) value = std::min(value, 450.0);
  CHECK(examined_blow(clipped_force, 1e-5, {}).fault == BlowFault::clipped_force);
  Blow clipped_response = clean();
  for (double& value : clipped_response.response) value = std::max(value, -0.8);
  CHECK(examined_blow(clipped_response, 1e-5, {}).fault == BlowFault::clipped_response);

  Blow coasting = clean();
  for (std::size_t n = 0; n < 2000; ++n) coasting.response[n] = n < 140 ? 0.01 * static_cast<double>(n) : 1.4;
  CHECK(examined_blow(coasting, 1e-5, {}).fault == BlowFault::none);

  Blow silent = clean();
  std::ranges::fill(silent.force_N, 0.0);
  CHECK(examined_blow(silent, 1e-5, {}).fault == BlowFault::no_pulse);
  std::mt19937_64 engine(2);
  records::add_noise(silent.force_N, 1, engine);
  CHECK(examined_blow(silent, 1e-5, {}).fault == BlowFault::no_pulse);
  for (BlowFault fault :
       {BlowFault::no_pulse, BlowFault::clipped_force, BlowFault::clipped_response, BlowFault::second_hit})
    CHECK(description(fault).starts_with("it"));
}

TEST_CASE("blow: a window that is given counts from the trigger; beyond it the force is zero") {
  const Blow blow = clean();
  const BlowWindow window = examined_blow(blow, 1e-5, {.force_window_s = 3e-4});
  CHECK(window.force_end == 100 + 31);
  const Blow cut = windowed(blow, window, 1500);
  CHECK(cut.force_N.size() == 1500);
  CHECK(cut.force_N[100 - window.begin + 20] == 500);
  CHECK(cut.force_N[window.force_end - window.begin] == 0);
  CHECK(cut.response[0] == blow.response[window.begin]);
  CHECK_THROWS_WITH_AS((void)windowed(blow, window, 2000), doctest::Contains("are asked of 2000"),
                       std::invalid_argument);
}

TEST_CASE("blow: offset and drift") {
  std::vector<double> offset(100, 3.0);
  offset[99] = 7;
  remove_offset(offset, 50);
  CHECK(offset[0] == 0);
  CHECK(offset[99] == 4);
  CHECK_THROWS_WITH_AS(remove_offset(offset, 0), doctest::Contains("cannot be taken"), std::invalid_argument);
  std::vector<double> velocity(1000);
  for (std::size_t n = 0; n < 1000; ++n) velocity[n] = 0.25 + 1e-3 * static_cast<double>(n);
  velocity[0] = 0.25;
  remove_drift(velocity, 0.25);
  for (double value : velocity) CHECK(std::abs(value - 0.25) < 1e-12);
  std::vector<double> few(9);
  CHECK_THROWS_WITH_AS(remove_drift(few, 0), doctest::Contains("too short"), std::invalid_argument);
}

TEST_CASE("blow: refusals") {
  CHECK_THROWS_WITH_AS((void)examined_blow(clean(), 1e-5, {.trigger = 1}), doctest::Contains("not a fraction"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)examined_blow({"b.csv", {1, 2}, {1}}, 1, {}), doctest::Contains("b.csv: 2 samples"),
                       std::invalid_argument);
}
