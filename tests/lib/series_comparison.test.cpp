#include "lib/series/series_comparison.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace impulse;

namespace {

UniformSeries sampled(double step, std::size_t size, const std::function<double(double)>& f) {
  UniformSeries series{{step, size}, {}};
  for (std::size_t k = 0; k < size; ++k) series.values.push_back(f(series.grid.time_s(k)));
  return series;
}

doctest::Approx rounded(double value) { return doctest::Approx(value).epsilon(1e-12).scale(1); }

}  // namespace

TEST_CASE("series_difference of a series with itself is exactly zero") {
  const UniformSeries x = sampled(0.1, 101, [](double t) { return std::sin(t) + 2; });
  const SeriesDifference d = series_difference(x, x, {10, {}, 0});
  CHECK(d.relative_l2 == 0);
  CHECK(d.peak_difference == 0);
  CHECK(d.impulse_difference == 0);
}

TEST_CASE("series_difference of a scaled series is the scale in all three") {
  const UniformSeries x = sampled(0.1, 101, [](double t) { return std::sin(t) + 2; });
  const UniformSeries y = sampled(0.1, 101, [](double t) { return 1.25 * (std::sin(t) + 2); });
  const SeriesDifference d = series_difference(x, y, {7.33, {}, 0});
  CHECK(d.relative_l2 == rounded(0.25));
  CHECK(d.peak_difference == rounded(0.25));
  CHECK(*d.impulse_difference == rounded(0.25));
}

TEST_CASE("series_difference integrates lines exactly") {
  const UniformSeries x = sampled(0.25, 5, [](double t) { return t; });
  const UniformSeries shifted = sampled(1.0, 2, [](double t) { return t + 1; });
  // ∫1 / ∫t² over [0, 1] = 3; peaks 1 and 2; impulses 1/2 and 3/2.
  const SeriesDifference d = series_difference(x, shifted, {1, {}, 0});
  CHECK(d.relative_l2 == rounded(std::sqrt(3)));
  CHECK(d.peak_difference == rounded(1));
  CHECK(*d.impulse_difference == rounded(2));
}

TEST_CASE("series_difference does not depend on how finely a piecewise linear series is sampled") {
  const auto triangle = [](double t) { return t < 1 ? t : 2 - t; };
  const auto skew = [](double t) { return t < 0.5 ? 2.4 * t : 1.2 - 0.8 * (t - 0.5); };
  const SeriesDifference coarse = series_difference(sampled(1, 3, triangle), sampled(0.5, 5, skew), {2, {}, 0});
  for (const double step : {0.5, 0.25, 0.1}) {
    const auto size = static_cast<std::size_t>(std::round(2 / step)) + 1;
    const SeriesDifference fine = series_difference(sampled(step, size, triangle), sampled(0.5, 5, skew), {2, {}, 0});
    CHECK(fine.relative_l2 == rounded(coarse.relative_l2));
    CHECK(fine.peak_difference == rounded(coarse.peak_difference));
    CHECK(*fine.impulse_difference == rounded(*coarse.impulse_difference));
  }
  CHECK(coarse.peak_difference == rounded(0.2));
}

TEST_CASE("series_difference counts the missing part of a short series as zero") {
  const UniformSeries ones = sampled(0.5, 5, [](double) { return 1; });
  const UniformSeries half = sampled(0.5, 3, [](double) { return 1; });
  const SeriesDifference d = series_difference(ones, half, {2, {}, 0});
  CHECK(d.relative_l2 == rounded(std::sqrt(0.5)));
  CHECK(d.peak_difference == 0);
  CHECK(*d.impulse_difference == rounded(-0.5));
  const UniformSeries long_one = sampled(0.5, 9, [](double) { return 1; });
  CHECK(series_difference(ones, long_one, {2, {}, 0}).relative_l2 == 0);
}

TEST_CASE("series_difference looks no further than the window") {
  const UniformSeries x = sampled(0.5, 5, [](double) { return 1; });
  const UniformSeries y = sampled(0.5, 5, [](double t) { return t < 1.25 ? 1 : 100; });
  CHECK(series_difference(x, y, {1, {}, 0}).relative_l2 == 0);
  // A window that ends inside an interval cuts it: y rises from 1 to 100 between 1 and 1.5.
  CHECK(series_difference(x, y, {1.25, {}, 0}).peak_difference == rounded(49.5));
}

TEST_CASE("series_difference leaves out what touches the samples next to a jump") {
  const UniformSeries step = sampled(1, 11, [](double t) { return t < 4.5 ? 1 : 2; });
  UniformSeries spoiled = step;
  spoiled.values[4] = 50;
  spoiled.values[5] = -50;
  const ComparisonWindow one{10, {4.5}, 1};
  CHECK(series_difference(step, spoiled, one).relative_l2 == 0);
  CHECK(series_difference(step, spoiled, one).peak_difference == 0);
  CHECK(series_difference(step, spoiled, one).impulse_difference == 0);
  CHECK(series_difference(step, spoiled, {10, {}, 1}).relative_l2 > 1);
  CHECK(series_difference(step, spoiled, {10, {4.5}, 0}).relative_l2 > 1);
  CHECK(series_difference(step, spoiled, {10, {3.5}, 1}).relative_l2 > 1);
  CHECK(series_difference(step, spoiled, {10, {3.5}, 2}).relative_l2 == 0);
  // Sample 6 is wrong by one: its two intervals count in full unless left out, and so do their lengths.
  UniformSeries late = step;
  late.values[6] = 3;
  const SeriesDifference d = series_difference(step, late, one);
  CHECK(d.relative_l2 == rounded(std::sqrt((1.0 / 3) / (3 + 4 * 4))));
  CHECK(*d.impulse_difference == rounded(0.5 / (3 + 8)));
  CHECK(d.peak_difference == rounded(0.5));
}

TEST_CASE("series_difference leaves out a sample that lies on the jump") {
  const UniformSeries x = sampled(0.1, 11, [](double) { return 1; });
  UniformSeries y = x;
  y.values[2] = y.values[3] = y.values[4] = 9;
  CHECK(series_difference(x, y, {1, {0.3}, 1}).relative_l2 == 0);
  y.values[1] = 9;  // the interval from sample 0 to 1 is kept
  CHECK(series_difference(x, y, {1, {0.3}, 1}).relative_l2 > 0);
}

TEST_CASE("series_difference: jumps outside the record leave nothing out") {
  const UniformSeries x = sampled(0.1, 11, [](double t) { return 1 + t; });
  const UniformSeries y = sampled(0.1, 11, [](double t) { return 1.5 * (1 + t); });
  CHECK(series_difference(x, y, {1, {-5, 7}, 2}).relative_l2 == rounded(0.5));
}

TEST_CASE("series_difference: half-sine against its interpolant is of order 2") {
  const auto pulse = [](double t) { return std::sin(std::numbers::pi * t); };
  const UniformSeries fine = sampled(1.0 / 4096, 4097, pulse);
  double previous = 0;
  for (const std::size_t n : {8, 16, 32, 64, 128}) {
    const double error =
        series_difference(fine, sampled(1.0 / static_cast<double>(n), n + 1, pulse), {1, {}, 0}).relative_l2;
    if (previous > 0) CHECK(std::log2(previous / error) == about(2).epsilon(0.02));
    previous = error;
  }
}

TEST_CASE("series_difference refuses what has no answer") {
  const UniformSeries x = sampled(0.5, 5, [](double) { return 1; });
  const UniformSeries zero = sampled(0.5, 5, [](double) { return 0; });
  CHECK_THROWS_WITH_AS((void)series_difference(zero, x, {2, {}, 0}), "the reference is zero where it is compared",
                       std::invalid_argument);
  CHECK_THROWS_WITH((void)series_difference(x, x, {3, {}, 0}),
                    "the window ends at 3 s, outside (0, 2] s of the reference");
  CHECK_THROWS_WITH((void)series_difference(x, x, {0, {}, 0}),
                    "the window ends at 0 s, outside (0, 2] s of the reference");
  CHECK_THROWS_WITH((void)series_difference(x, x, {2, {1}, 9}),
                    "no interval is left to compare; leave out fewer samples than 9");
  CHECK_THROWS_AS((void)series_difference(x, {{0.5, 5}, {1}}, {2, {}, 0}), std::invalid_argument);
  const UniformSeries odd = sampled(0.5, 5, [](double t) { return t - 1; });
  CHECK_FALSE(series_difference(odd, odd, {2, {}, 0}).impulse_difference.has_value());
}

TEST_CASE("first_contact_end_s skips a gap before the contact") {
  CHECK(first_contact_end_s({{1, 8}, {1, 2, 1, -1, 0, 0, 0, 0}}) == 2.5);
  CHECK(first_contact_end_s({{1, 9}, {0, 0, 0, 0, 2, 1, -1, 0, 0}}) == 5.5);
  CHECK(first_contact_end_s({{0.5, 3}, {1, 2, 1}}) == 1);
  CHECK_THROWS_WITH_AS((void)first_contact_end_s({{1, 3}, {0, -1, 0}}),
                       "the force is nowhere positive (there is no contact)", std::invalid_argument);
}
