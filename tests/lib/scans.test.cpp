#include "lib/plot/scans.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace impulse;

TEST_CASE("scan_lines finds the lines of straight, skew and graded grids") {
  for (const double skew : {0.0, 0.9, -0.9}) {
    std::vector<ScanPoint> points;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 7; ++i) points.push_back({0.1 * i * i + skew * j, 1.0 * j, 0});
    const auto lines = scan_lines(points);
    REQUIRE(lines.size() == 4);
    for (const auto& line : lines) CHECK(line.size() == 7);
  }
  CHECK(scan_lines({}).empty());
}

TEST_CASE("scan_lines follows an arc, whose way turns a little at each point") {
  std::vector<ScanPoint> points;
  for (int j = 1; j < 4; ++j)
    for (int i = 0; i <= 8; ++i) points.push_back({j * std::cos(0.2 * i), j * std::sin(0.2 * i), 0});
  CHECK(scan_lines(points).size() == 3);
}
