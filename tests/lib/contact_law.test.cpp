#include "lib/law/contact_law.hpp"
#include "tests/support/about.hpp"
#include "tests/support/laws.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

using namespace impulse;
using namespace impulse::laws;

namespace {

constexpr double k32 = 1.413e9;
constexpr double beta = 0.094;
constexpr double critical = 1.667e-4;
constexpr double largest = 5e-4;  // beyond the critical indentation

struct NamedLaw {
  const char* name;
  ContactLaw law;
};

std::vector<NamedLaw> elastic_laws() {
  return {{"linear", ContactLaw::linear(2e6)},
          {"hertz", ContactLaw::hertz(k32)},
          {"elastic table", ContactLaw::table({lossy.indentation_m, lossy.loading_force_N, {}})}};
}
std::vector<NamedLaw> lossy_laws() {
  return {{"tan-sun", ContactLaw::tan_sun(k32, beta, critical)},
          {"tan-sun, never permanent", ContactLaw::tan_sun(k32, beta, 1.0)},
          {"tan-sun, always permanent", ContactLaw::tan_sun(k32, 0.5, 0)},
          {"table", ContactLaw::table(lossy)}};
}
std::vector<NamedLaw> all_laws() {
  std::vector<NamedLaw> laws = elastic_laws();
  for (const NamedLaw& law : lossy_laws()) laws.push_back(law);
  return laws;
}

/// ∫F dα from a to b > a at one history, by three-point Gauss rules in s, α = a + (b - a)s², which makes α^1.5 smooth
/// at 0; a and b are ends of smooth pieces or lie within one.
double smooth_work(const ContactLaw& law, const LawHistory& history, double a, double b) {
  constexpr int panel_count = 60;
  const double offset = std::sqrt(0.6);
  double sum = 0;
  for (int panel = 0; panel < panel_count; ++panel)
    for (const auto& [node, weight] :
         {std::array{-offset, 5.0 / 9}, std::array{0.0, 8.0 / 9}, std::array{offset, 5.0 / 9}}) {
      const double s = (panel + 0.5 * (1 + node)) / panel_count;
      sum += weight / (2 * panel_count) * law.force(a + (b - a) * s * s, history) * 2 * s * (b - a);
    }
  return sum;
}

/// α0, αm and the points of the table, also of its scaled unloading curve.
std::vector<double> kinks_of(const ContactLaw& law, const LawHistory& history) {
  std::vector<double> kinks{law.gap_closes_at(history), history.largest_indentation_m};
  for (const double point : lossy.indentation_m) {
    kinks.push_back(point);
    kinks.push_back(point * (history.largest_indentation_m / lossy.indentation_m.back()));
  }
  return kinks;
}

/// ∫F dα of one step, piece by smooth piece.
double step_work(const ContactLaw& law, const LawHistory& history, double from, double to) {
  const double low = std::min(from, to), high = std::max(from, to);
  std::vector<double> cuts = kinks_of(law, history);
  cuts.insert(cuts.end(), {low, high});
  std::sort(cuts.begin(), cuts.end());
  double work = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if (cuts[i] >= low && cuts[i + 1] <= high && cuts[i + 1] > cuts[i])
      work += smooth_work(law, history, cuts[i], cuts[i + 1]);
  return to > from ? work : -work;
}

template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("contact law: elastic laws follow their loading curve whatever went before") {
  const ContactLaw linear = ContactLaw::linear(2e6);
  const ContactLaw hertz = ContactLaw::hertz(k32);
  for (const std::vector<double>& path :
       std::vector<std::vector<double>>{{}, {4e-4}, {4e-4, 1e-4}, {4e-4, -1e-4, 2e-4}}) {
    CHECK(linear.force(2e-4, after(linear, path)) == rounded(400));
    CHECK(linear.tangent(2e-4, after(linear, path)) == 2e6);
    CHECK(linear.stored_energy(2e-4, after(linear, path)) == rounded(0.04));
    CHECK(hertz.force(1e-4, after(hertz, path)) == rounded(1413));
    CHECK(hertz.tangent(1e-4, after(hertz, path)) == rounded(1.5 * 1.413e7));
    CHECK(hertz.stored_energy(1e-4, after(hertz, path)) == rounded(0.4 * 1413e-4));
  }
  CHECK(linear.tangent(0, {}) == 2e6);
  CHECK(hertz.tangent(0, {}) == 0);
}

TEST_CASE("contact law: Tan-Sun has its four branches") {
  const ContactLaw law = ContactLaw::tan_sun(k32, beta, critical);
  const double permanent = beta * (largest - critical);
  const double length = largest - permanent;
  const double peak = k32 * std::pow(largest, 1.5);
  const double at = permanent + 0.4 * length;
  CHECK(law.force(3e-4, {}) == rounded(k32 * std::pow(3e-4, 1.5)));

  const LawHistory loaded = after(law, {1e-4, largest});
  CHECK(loaded.largest_indentation_m == largest);
  CHECK(loaded.largest_force_N == rounded(peak));
  CHECK(law.permanent_indentation(loaded) == rounded(permanent));
  CHECK(law.force(at, loaded) == rounded(peak * std::pow(0.4, 2.5)));
  CHECK(law.stored_energy(at, loaded) == rounded(peak * length * std::pow(0.4, 3.5) / 3.5));

  const LawHistory reloading = law.advanced(loaded, permanent);
  CHECK(law.force(at, reloading) == rounded(peak * std::pow(0.4, 1.5)));
  CHECK(law.stored_energy(at, reloading) == rounded(peak * length * std::pow(0.4, 2.5) / 2.5));
  CHECK(law.force(6e-4, reloading) == rounded(k32 * std::pow(6e-4, 1.5)));
  CHECK(law.force(permanent, loaded) == 0);
  CHECK(law.tangent(permanent * 0.999, loaded) == 0);

  SUBCASE("below the critical indentation nothing is permanent, but the exponent of unloading is 2.5") {
    const LawHistory small = after(law, {critical});
    CHECK(law.permanent_indentation(small) == 0);
    CHECK(law.force(0.5 * critical, small) == rounded(k32 * std::pow(critical, 1.5) * std::pow(0.5, 2.5)));
  }
}

TEST_CASE("contact law: partial cycles retrace the path they are on") {
  const ContactLaw law = ContactLaw::tan_sun(k32, beta, critical);
  const LawHistory loaded = after(law, {largest});
  const double permanent = law.gap_closes_at(loaded);

  const LawHistory partly_unloaded = after(law, {largest, 2e-4, 3e-4});
  CHECK(partly_unloaded == loaded);

  const LawHistory opened = after(law, {largest, permanent});
  CHECK(after(law, {largest, permanent, 4e-4, 2e-4}) == opened);
  CHECK(law.force(3e-4, opened) > 1.2 * law.force(3e-4, loaded));

  // Past the largest indentation, however it was reached, the contact is one that was loaded to it.
  LawHistory again = after(law, {largest, -1e-3, largest});
  CHECK(again.path == LawHistory::Path::unloading);
  CHECK(again.dissipated_J > loaded.dissipated_J);
  again.dissipated_J = loaded.dissipated_J;
  CHECK(again == loaded);

  // What never closed has nothing to remember.
  CHECK(after(law, {-1e-3, 0}) == LawHistory{});
}

TEST_CASE("contact law: the force is continuous, the tangent its derivative, on every branch") {
  for (const auto& [name, law] : all_laws()) {
    CAPTURE(name);
    for (const std::vector<double>& path :
         std::vector<std::vector<double>>{{}, {largest}, {largest, -1e-4}, {1e-4}, {1e-4, -1e-4}}) {
      const LawHistory history = after(law, path);
      CAPTURE(path.size());
      const double step = 1e-9;
      const double stiffest = law.tangent(5.9e-4, history) + law.tangent(largest * (1 - 1e-12), history);
      // Steps that straddle no kink: the points of the table, scaled or not, α0 and αm are multiples of 1e-7 m/6 or
      // far.
      for (double at = -0.53e-4; at < 5.9e-4; at += 1.0713e-5) {
        CAPTURE(at);
        const std::vector<double> kinks = kinks_of(law, history);
        REQUIRE(std::all_of(kinks.begin(), kinks.end(), [&](double kink) { return std::abs(at - kink) > 2 * step; }));
        const double difference = (law.force(at + step, history) - law.force(at - step, history)) / (2 * step);
        CHECK(law.tangent(at, history) == doctest::Approx(difference).epsilon(1e-6).scale(stiffest));
        CHECK(law.tangent(at, history) >= 0);
        const double power =
            (law.stored_energy(at + step, history) - law.stored_energy(at - step, history)) / (2 * step);
        if (at < history.largest_indentation_m)
          CHECK(law.force(at, history) == doctest::Approx(power).epsilon(1e-6).scale(history.largest_force_N + 1e-30));
      }
      for (const double kink : {law.gap_closes_at(history), history.largest_indentation_m}) {
        CAPTURE(kink);
        const double width = 1e-13;
        const double jump = law.force(kink + width, history) - law.force(kink - width, history);
        CHECK(std::abs(jump) <= 4 * width * stiffest);
        CHECK(law.force(kink, history) - law.force(kink - width, history) >= 0);
        CHECK(law.force(kink + width, history) - law.force(kink, history) >= 0);
      }
      CHECK(law.force(history.largest_indentation_m, history) == history.largest_force_N);
      CHECK(law.stored_energy(law.gap_closes_at(history), history) == 0);
    }
  }
}

TEST_CASE("contact law: tangents at kinks are right derivatives") {
  const ContactLaw tan_sun = ContactLaw::tan_sun(k32, beta, critical);
  const LawHistory loaded = after(tan_sun, {largest});
  CHECK(tan_sun.tangent(largest, loaded) == rounded(1.5 * k32 * std::sqrt(largest)));
  CHECK(tan_sun.tangent(std::nextafter(largest, 0), loaded) ==
        about(2.5 * loaded.largest_force_N / (largest - tan_sun.gap_closes_at(loaded))).epsilon(1e-12));
  const ContactLaw table = ContactLaw::table(lossy);
  CHECK(table.tangent(0, {}) == rounded(1e6));
  CHECK(table.tangent(1e-4, {}) == rounded(1.5e6));
  CHECK(table.tangent(6e-4, {}) == rounded(3.5e6));
  CHECK(table.tangent(-1e-9, {}) == 0);
}

TEST_CASE("contact law: along any path the work is what is stored and dissipated") {
  std::mt19937 random(20240607);
  for (const auto& [name, law] : all_laws()) {
    CAPTURE(name);
    for (int path = 0; path < 12; ++path) {
      CAPTURE(path);
      // Growing amplitudes: late paths reach new largest indentations often, and open often.
      const double reach = 5.9e-4 * (path + 1) / 12;
      std::uniform_real_distribution<double> place(-0.3 * reach, reach);
      LawHistory history;
      double at = 0, work = 0, dissipated = 0;
      const double scale = law.force(reach, {}) * reach;
      for (int step = 0; step < 60; ++step) {
        const double next = step % 7 == 3 ? history.largest_indentation_m : place(random);
        work += step_work(law, history, at, next);
        history = law.advanced(history, next);
        at = next;
        const double balance = law.stored_energy(at, history) + history.dissipated_J;
        CHECK(std::abs(work - balance) <= 1e-10 * scale);
        CHECK(law.stored_energy(at, history) >= 0);
        if (std::string(name) != "table") CHECK(history.dissipated_J >= dissipated - 1e-15 * scale);
        CHECK(history.dissipated_J >= 0);
        CHECK(law.advanced(history, at) == history);
        dissipated = history.dissipated_J;
      }
    }
  }
}

TEST_CASE("contact law: a peak passed in many steps or in one dissipates the same") {
  for (const auto& [name, law] : all_laws()) {
    CAPTURE(name);
    std::vector<double> steps;
    for (int i = 0; i <= 1000; ++i) steps.push_back(largest * i / 1000);
    const double once = after(law, {largest}).dissipated_J;
    CHECK(std::abs(after(law, steps).dissipated_J - once) <= 1e-13 * largest * law.force(largest, {}));
  }
}

TEST_CASE("contact law: elastic laws dissipate nothing at all") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2e-4, 5.9e-4);
  for (const auto& [name, law] : elastic_laws()) {
    CAPTURE(name);
    LawHistory history;
    for (int step = 0; step < 200; ++step) history = law.advanced(history, place(random));
    CHECK(history.dissipated_J == 0);
    CHECK(law.permanent_indentation(history) == 0);
  }
}

TEST_CASE("contact law: a Tan-Sun cycle dissipates its closed form, a second one 4/35 of Fm (αm-α0)") {
  for (const double critical_m : {critical, 1.0}) {
    const ContactLaw law = ContactLaw::tan_sun(k32, beta, critical_m);
    const double permanent = largest > critical_m ? beta * (largest - critical_m) : 0;
    const double peak = k32 * std::pow(largest, 1.5);
    const double first = 0.4 * peak * largest - 2.0 / 7 * peak * (largest - permanent);
    const double second = 4.0 / 35 * peak * (largest - permanent);
    CHECK(after(law, {largest, 0}).dissipated_J == rounded(first));
    CHECK(after(law, {largest, 0, largest, 0}).dissipated_J == rounded(first + second));
    CHECK(after(law, {largest, 0, 0.99 * largest, 0}).dissipated_J == rounded(first));
    if (permanent == 0) CHECK(first == rounded(second));
  }
}

TEST_CASE("contact law: constants and indentations out of range are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, 0.0, nan, infinity}) {
    CHECK(refusal([&] { (void)ContactLaw::linear(bad); }) ==
          fmt::format("contact stiffness {} N/m is not a positive number", bad));
    CHECK(refusal([&] { (void)ContactLaw::hertz(bad); }) ==
          fmt::format("contact stiffness {} N/m^1.5 is not a positive number", bad));
    CHECK(refusal([&] { (void)ContactLaw::tan_sun(bad, 0.1, 0); }) ==
          fmt::format("contact stiffness {} N/m^1.5 is not a positive number", bad));
  }
  for (const double bad : {-0.1, 1.0, nan})
    CHECK(refusal([&] { (void)ContactLaw::tan_sun(1, bad, 0); }) ==
          fmt::format("beta {} of the permanent indentation is outside [0, 1)", bad));
  for (const double bad : {-1e-9, nan, infinity})
    CHECK(refusal([&] { (void)ContactLaw::tan_sun(1, 0.1, bad); }) ==
          fmt::format("critical indentation {} m is not a number from 0", bad));
  CHECK(refusal([] {
          (void)ContactLaw::table({{0, 1, 1}, {0, 1, 2}, {}});
        }) == "point 3 of the table: indentation 1 m does not increase (before: 1 m)");
  CHECK(refusal([] {
          (void)ContactLaw::table({{0, 1}, {0, 1}, {0}});
        }) == "point 1 of the table: 2 indentations with 2 loading and 1 unloading forces");
  CHECK(refusal([&] {
          (void)ContactLaw::table({{0, nan}, {0, 1}, {}});
        }) == "point 2 of the table: indentation nan m is not finite");

  for (const auto& [name, law] : all_laws()) {
    CAPTURE(name);
    for (const double bad : {nan, infinity, -infinity}) {
      const std::string message = fmt::format("indentation {} m is not finite", bad);
      CHECK(refusal([&, &one = law] { (void)one.force(bad, {}); }) == message);
      CHECK(refusal([&, &one = law] { (void)one.tangent(bad, {}); }) == message);
      CHECK(refusal([&, &one = law] { (void)one.stored_energy(bad, {}); }) == message);
      CHECK(refusal([&, &one = law] { (void)one.advanced({}, bad); }) == message);
    }
  }
  const ContactLaw table = ContactLaw::table(lossy);
  const std::string beyond = "indentation 0.0007 m exceeds the table's last 0.0006 m";
  CHECK(refusal([&] { (void)table.force(7e-4, {}); }) == beyond);
  CHECK(refusal([&] { (void)table.tangent(7e-4, {}); }) == beyond);
  CHECK(refusal([&] { (void)table.stored_energy(7e-4, {}); }) == beyond);
  CHECK(refusal([&] { (void)table.advanced({}, 7e-4); }) == beyond);
  CHECK(table.largest_possible_indentation_m() == 6e-4);
  CHECK(ContactLaw::hertz(1).largest_possible_indentation_m() == infinity);
}

TEST_CASE("contact law: a rigid contact has no indentation to answer for") {
  const ContactLaw rigid = ContactLaw::rigid();
  CHECK(rigid.is_rigid());
  CHECK_FALSE(ContactLaw::linear(1).is_rigid());
  CHECK(rigid.gap_closes_at({}) == 0);
  CHECK(rigid.stored_energy(0, {}) == 0);
  CHECK(rigid.advanced({}, 0) == LawHistory{});
  CHECK(refusal([&] { (void)rigid.force(0, {}); }).starts_with("a rigid contact has no force"));
  CHECK(refusal([&] { (void)rigid.tangent(0, {}); }).starts_with("a rigid contact has no tangent"));
}
