#include "impulse/measured/band_filter.hpp"
#include "impulse/measured/response_estimate.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/numerics/student_t.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/struck_structures.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace impulse;

namespace {

/// Mean of what was added, with its standard error.
class Mean {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  [[nodiscard]] double value() const { return sum_ / count_; }
  [[nodiscard]] double standard_error() const {
    return std::sqrt((squares_ / count_ - value() * value()) / (count_ - 1));
  }

 private:
  double count_ = 0, sum_ = 0, squares_ = 0;
};

/// Share of the samples from `first` on at which an error is within `factor` standard uncertainties of its deviations.
double share_within(double factor, const std::vector<double>& error, const std::vector<std::vector<double>>& deviations,
                    std::size_t first) {
  std::size_t within = 0;
  for (std::size_t n = first; n < error.size(); ++n) {
    double variance = 0;
    for (const std::vector<double>& deviation : deviations) variance += deviation[n] * deviation[n];
    within += std::abs(error[n]) <= factor * std::sqrt(variance) ? 1 : 0;
  }
  return static_cast<double>(within) / static_cast<double>(error.size() - first);
}

/// H, G and U as a kernel estimated without error would give them (for a rod's steps, means over the step).
PairResponse estimand(const PairResponse& body, double step_s) {
  std::vector<double> impulse(body.step_displacement_m_per_N.size() - 1);
  impulse[0] = 1;
  const std::vector<double> kernel = records::velocity(body, step_s, impulse);
  return response_of_kernel(kernel, {step_s, kernel.size()});
}

struct Shares {
  Mean samples;  ///< within Student's band
  Mean tests;    ///< of which 95 % of the samples are within the band for one test (curve_band_factor)
};

/// Over repetitions of a hammer test.
struct Coverage {
  Shares g, h, u;
  Shares h_in_band;  ///< H, its error and its deviations through the same low-pass filter
};

Coverage coverage(const PairResponse& body, const PairResponse& truth, const structures::HammerTest& hammer,
                  unsigned repetitions, const EstimateOptions& options) {
  using Part = std::vector<double> PairResponse::*;
  // Flat to fs/30, nothing above fs/12, where a half sine of ten steps still has a quarter of its largest power.
  const BandFilter filter(0.05);
  Coverage coverage;
  for (unsigned repetition = 0; repetition < repetitions; ++repetition) {
    const MeasuredResponse found =
        estimated_response(structures::blows(body, hammer, 1000 + repetition), hammer.step_s, options).measured;
    REQUIRE(found.degrees_of_freedom == 4);
    const auto add = [&](Part part, const BandFilter* through, Shares& shares) {
      std::vector<double> error = found.response.pairs[0].*part;
      for (std::size_t n = 0; n < error.size(); ++n) error[n] -= (truth.*part)[n];
      std::vector<std::vector<double>> deviations;
      for (const PairResponse& deviation : found.deviations)
        deviations.push_back(through ? through->filtered(deviation.*part) : deviation.*part);
      if (through) error = through->filtered(error);
      const std::size_t first = through ? 0 : 1;
      shares.samples.add(share_within(student_t_quantile(0.975, 4), error, deviations, first));
      shares.tests.add(share_within(curve_band_factor(0.95, 0.05, 4), error, deviations, first) >= 0.95 ? 1 : 0);
    };
    add(&PairResponse::impulse_response_per_kg, nullptr, coverage.g);
    add(&PairResponse::step_velocity_m_per_Ns, nullptr, coverage.h);
    add(&PairResponse::step_displacement_m_per_N, nullptr, coverage.u);
    add(&PairResponse::step_velocity_m_per_Ns, &filter, coverage.h_in_band);
  }
  return coverage;
}

void check_share(const Shares& share) {
  CHECK(share.samples.standard_error() < 0.007);
  CHECK(share.samples.value() > 0.93);
  CHECK(share.samples.value() < 0.97);
  CHECK(share.tests.value() >= 0.95);
}

PairResponse short_modal(const ModalModel& model, const structures::HammerTest& hammer) {
  return modal_response(model, {hammer.step_s, hammer.size + 1}).pairs[0];
}

PairResponse short_rod(const structures::HammerTest& hammer) {
  return wave_response(bars::steel_rod(0.5, FarEnd::free), {hammer.step_s, hammer.size + 1}).pairs[0];
}

structures::HammerTest short_test(double noise_dB) {
  structures::HammerTest hammer;
  hammer.size = 500;
  hammer.noise_dB = noise_dB;
  return hammer;
}

}  // namespace

TEST_CASE("response_coverage: in 95 of 100 tests, 95 % of the samples are within the band for one test") {
  for (const double noise_dB : {40.0, 20.0}) {
    CAPTURE(noise_dB);
    const structures::HammerTest hammer = short_test(noise_dB);
    constexpr unsigned tests = 25;
    for (const ModalModel& model : {structures::beam(), structures::plate()}) {
      const PairResponse body = short_modal(model, hammer);
      const Coverage shares = coverage(body, body, hammer, tests, {});
      for (const Shares* share : {&shares.g, &shares.h, &shares.u}) CHECK(share->tests.value() >= 0.95);
    }
    // A rod by what is in the hammer's band, and by the means over steps of its H; its G lies above that band.
    const PairResponse rod = short_rod(hammer);
    const Coverage shares = coverage(rod, estimand(rod, hammer.step_s), hammer, tests, {});
    for (const Shares* share : {&shares.h_in_band, &shares.h, &shares.u}) CHECK(share->tests.value() >= 0.95);
  }
}

// Within one record errors of H and U are slow, so that the share of samples in the band scatters from one test to the
// next (by 0.2 for U): its mean is what is 95 %, and a wider band that holds 95 % of a single test (curve_band_factor).
// Blows of unequal strength whose noise is a fraction of it leave 94.4 % of that (docs/decisions/0014), regularisation
// the 93.2 to 94.9 % here (docs/decisions/0015).
TEST_SUITE("slow") {
  TEST_CASE("response_coverage: beam and plate at 40 and 20 dB have 93 to 97 % of the samples within the 95 % band") {
    for (const double noise_dB : {40.0, 20.0})
      for (const ModalModel& model : {structures::beam(), structures::plate()}) {
        CAPTURE(noise_dB);
        CAPTURE(model.angular_frequency.size());
        const structures::HammerTest hammer = short_test(noise_dB);
        const PairResponse body = short_modal(model, hammer);
        const Coverage shares = coverage(body, body, hammer, 1500, {});
        check_share(shares.g);
        check_share(shares.h);
        check_share(shares.u);
      }
  }

  // A rod's G is pulses and its H steps: most of either lies above the hammer's band, where regularisation takes it
  // away and nothing in the spread of the blows tells (G: 0.86 and 0.57 of the samples within the band).
  TEST_CASE("response_coverage: a rod at 40 and 20 dB has 93 to 97 % of the samples of H in the excited band") {
    for (const double noise_dB : {40.0, 20.0}) {
      CAPTURE(noise_dB);
      const structures::HammerTest hammer = short_test(noise_dB);
      const PairResponse body = short_rod(hammer);
      const Coverage shares = coverage(body, estimand(body, hammer.step_s), hammer, 1500, {});
      check_share(shares.h_in_band);
      CHECK(shares.g.samples.value() < 0.93);
    }
  }

  TEST_CASE("response_coverage: 93 to 97 % of the samples of 4000 repetitions at a given regularisation") {
    const structures::HammerTest hammer = short_test(40);
    const PairResponse body = short_modal(structures::beam(), hammer);
    const Coverage shares = coverage(body, body, hammer, 4000, {.regularisation = {Regularisation::Rule::value, 1e-5}});
    check_share(shares.h);
    check_share(shares.g);
  }
}
