#include "impulse/measured/force_band.hpp"

#include "impulse/response/mass_response.hpp"
#include "lib/contract/errors.hpp"
#include "lib/numerics/student_t.hpp"
#include "tests/support/about.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

using namespace impulse;

namespace {

MeasuredResponse measured(std::size_t degrees) {
  const UniformGrid grid{1e-3, 5};
  MeasuredResponse result{mass_response(2, grid), {}, degrees};
  for (double part : {0.03, -0.04}) {
    PairResponse deviation = mass_response(2, grid).pairs[0];
    for (auto* values :
         {&deviation.impulse_response_per_kg, &deviation.step_velocity_m_per_Ns, &deviation.step_displacement_m_per_N})
      for (double& value : *values) value *= part;
    result.deviations.push_back(std::move(deviation));
  }
  return result;
}

/// The drawn G_3 as the outcome, so that its quantiles are known.
ForceOutcome outcome(const MeasuredResponse& body, std::mt19937_64& engine) {
  const Response drawn = drawn_response(body, engine);
  const double g = drawn.pairs[0].impulse_response_per_kg[3];
  CHECK(drawn.pairs[0].step_displacement_m_per_N[4] == about(g * 8e-6));
  return {{g, 2 * g}, g, 1 - g, g * g};
}

}  // namespace

TEST_CASE("force_band: quantiles of draws are those of Student's t about the estimate") {
  for (std::size_t degrees : {std::size_t{0}, std::size_t{1}, std::size_t{4}}) {
    CAPTURE(degrees);
    const MeasuredResponse body = measured(degrees);
    const ForceBand band =
        force_band({.draws = 40000, .seed = 5}, [&](std::mt19937_64& engine) { return outcome(body, engine); });
    // Standard uncertainty 0.05 of 0.5; the quantile of 40000 draws is known to 1.5 % (one degree: 4 %).
    const double half = student_t_quantile(0.975, degrees == 0 ? 1e9 : static_cast<double>(degrees)) * 0.025;
    const double tolerance = degrees == 1 ? 0.12 : 0.04;
    CHECK(band.peak_force_N.median == about(0.5).epsilon(0.003));
    CHECK((band.peak_force_N.upper - 0.5) / half == about(1).epsilon(tolerance));
    CHECK((0.5 - band.peak_force_N.lower) / half == about(1).epsilon(tolerance));
    CHECK(band.force_N.size() == 2);
    CHECK(band.force_N[1].upper == about(2 * band.peak_force_N.upper));
    CHECK(band.contact_duration_s.upper == about(1 - band.peak_force_N.lower));
  }
}

TEST_CASE("force_band: a seed gives the same band, another one another; a confidence is the band's") {
  const MeasuredResponse body = measured(4);
  const auto draw = [&](std::size_t seed, double confidence) {
    return force_band({.draws = 400, .seed = seed, .confidence = confidence},
                      [&](std::mt19937_64& engine) { return outcome(body, engine); })
        .peak_force_N;
  };
  CHECK(draw(1, 0.95).upper == draw(1, 0.95).upper);
  CHECK(draw(1, 0.95).upper != draw(2, 0.95).upper);
  CHECK(draw(1, 0.5).upper < draw(1, 0.95).upper);
}

TEST_CASE("force_band: one, two and three threads draw the same band, every quantity of it") {
  const MeasuredResponse body = measured(4);
  const auto on = [&](std::size_t threads) {
    return force_band({.draws = 101, .seed = 9, .threads = threads},
                      [&](std::mt19937_64& engine) { return outcome(body, engine); });
  };
  const auto numbers = [](const ForceBand& band) {
    std::vector<double> all;
    const auto add = [&](const Quantiles& q) { all.insert(all.end(), {q.lower, q.median, q.upper}); };
    for (const Quantiles& q : band.force_N) add(q);
    for (const Quantiles& q : {band.peak_force_N, band.contact_duration_s, band.impulse_Ns}) add(q);
    return all;
  };
  const std::vector<double> one = numbers(on(1));
  CHECK(one.size() == 15);
  CHECK(numbers(on(2)) == one);
  CHECK(numbers(on(3)) == one);
}

TEST_CASE("force_band: draws that end in contact are counted") {
  std::atomic<int> count = 0;
  const ForceBand band = force_band({.draws = 41}, [&](std::mt19937_64&) {
    return ForceOutcome{{1, 2}, 2, 1, 1, ++count <= 7};
  });
  CHECK(band.in_contact_at_end == 7);
}

TEST_CASE("force_band: an exception of either thread reaches the caller") {
  for (int wanted : {0, 1}) {
    std::atomic<int> count = 0;
    CHECK_THROWS_WITH_AS((void)force_band({.draws = 40},
                                          [&](std::mt19937_64&) -> ForceOutcome {
                                            if (count++ == wanted) throw std::runtime_error("lost");
                                            return {{0}, 0, 0, 0};
                                          }),
                         "lost", std::runtime_error);
  }
}

TEST_CASE("force_band: uncertainty is read from files: deviations, standard uncertainties, none") {
  const test::TemporaryDirectory folder;
  const std::string head = "time_s,impulse_response_per_kg,step_velocity_m_per_Ns,step_displacement_m_per_N";
  const auto read = [&](const std::string& text) {
    const CsvTable table = read_csv(folder.write("r.csv", text));
    return measured_response_from(table, mass_response(1, {1, 2}));
  };
  CHECK(read(head + "\n0,1,0,0\n1,1,1,1\n").deviations.empty());
  const MeasuredResponse one =
      read(head +
           ",impulse_response_std_per_kg,step_velocity_std_m_per_Ns,"
           "step_displacement_std_m_per_N,degrees_of_freedom\n0,1,0,0,.1,.2,.3,4\n1,1,1,1,.1,.2,.3,4\n");
  CHECK(one.deviations.size() == 1);
  CHECK(one.deviations[0].step_displacement_m_per_N[1] == 0.3);
  CHECK(one.degrees_of_freedom == 4);
  CHECK_THROWS_WITH_AS((void)read(head + ",step_displacement_deviation_1_m_per_N\n0,1,0,0,1\n1,1,1,1,1\n"),
                       doctest::Contains("no column 'impulse_response_deviation_1_per_kg'"), InputError);
}

TEST_CASE("force_band: refusals") {
  const auto nothing = [](std::mt19937_64&) { return ForceOutcome{}; };
  CHECK_THROWS_WITH_AS((void)force_band({.draws = 39}, nothing), doctest::Contains("39 draws"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)force_band({.draws = 40, .confidence = 1}, nothing), doctest::Contains("confidence 1"),
                       std::invalid_argument);
}
