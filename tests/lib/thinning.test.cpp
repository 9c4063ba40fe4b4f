#include "lib/plot/thinning.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace impulse;

namespace {

Curve wave(std::size_t count) {
  Curve curve;
  for (std::size_t i = 0; i < count; ++i) {
    curve.x.push_back(static_cast<double>(i));
    curve.y.push_back(std::sin(0.001 * static_cast<double>(i)));
  }
  return curve;
}

}  // namespace

TEST_CASE("thinned keeps ends and every spike, in order, within its number of points") {
  Curve curve = wave(100000);
  curve.y[12345] = 7;
  curve.y[54321] = -9;
  const Curve thin = thinned(curve, 500);
  CHECK(thin.x.size() <= 2000);
  CHECK(thin.x.size() >= 1000);
  CHECK(std::is_sorted(thin.x.begin(), thin.x.end()));
  CHECK(thin.x.front() == 0);
  CHECK(thin.x.back() == 99999);
  CHECK(*std::max_element(thin.y.begin(), thin.y.end()) == 7);
  CHECK(*std::min_element(thin.y.begin(), thin.y.end()) == -9);
  for (std::size_t i = 0; i < thin.x.size(); ++i) CHECK(thin.y[i] == curve.y[static_cast<std::size_t>(thin.x[i])]);
}

TEST_CASE(
    "thinned of a range keeps every point of a short one, and peaks of a long one, with a neighbour on either side") {
  Curve curve = wave(100000);
  curve.y[54321] = -9;
  const Curve close = thinned(curve, 500, AxisRange{1000.5, 1400});
  REQUIRE(close.x.size() == 402);
  for (std::size_t i = 0; i < close.x.size(); ++i) CHECK(close.x[i] == 1000 + static_cast<double>(i));
  const Curve wide = thinned(curve, 500, AxisRange{60000, 50000});
  CHECK(wide.x.size() <= 2000);
  CHECK(wide.x.front() == 49999);
  CHECK(wide.x.back() == 60001);
  CHECK(*std::min_element(wide.y.begin(), wide.y.end()) == -9);
  CHECK(thinned(curve, 500, AxisRange{-10, 5}).x.size() == 7);
  CHECK(thinned(curve, 500, AxisRange{2e5, 3e5}).x.size() == 1);
}

TEST_CASE("thinned leaves alone what is short, no line, interrupted, or turns back") {
  CHECK(thinned(wave(2000), 500).x.size() == 2000);
  CHECK(thinned(wave(2001), 500).x.size() < 2001);
  Curve points = wave(3000), interrupted = wave(3000), loop = wave(3000);
  points.mark = Mark::points;
  interrupted.pen_lifts = {5};
  loop.x[1] = 7;
  for (const Curve& curve : {points, interrupted, loop}) CHECK(thinned(curve, 500).x.size() == 3000);
}
