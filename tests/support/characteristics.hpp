#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// An oracle for cylindrical rods in a row that strike, part and meet again: velocity waves shifted by one cell a step,
/// which is exact where travel times, flights and gaps are whole numbers of steps. Rod ends are contacts with the next
/// rod, or with a wall.
namespace impulse::characteristics {

struct Rod {
  double impedance;
  std::size_t cells;
  double speed;  ///< at t = 0
};

struct Result {
  std::vector<std::vector<double>> force;  ///< per contact, constant over each step
  std::vector<double> energy;              ///< kinetic and strain, at each step
};

/// contacts: gaps between neighbours, before the first rod (wall) and behind the last; a wall is left out with gap < 0.
inline Result simulate(const std::vector<Rod>& rods, std::vector<double> gaps, double step_s, std::size_t steps) {
  const std::size_t n = rods.size();
  std::vector<std::vector<double>> right(n), left(n);
  for (std::size_t i = 0; i < n; ++i) {
    right[i].assign(rods[i].cells, rods[i].speed / 2);
    left[i].assign(rods[i].cells, rods[i].speed / 2);
  }
  const std::vector<bool> wall_less = [&] {
    std::vector<bool> absent;
    for (double gap : gaps) absent.push_back(gap < 0);
    return absent;
  }();
  Result result{std::vector<std::vector<double>>(n + 1, std::vector<double>(steps, 0.0)), {}};
  for (std::size_t k = 0; k < steps; ++k) {
    double energy = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < rods[i].cells; ++c)
        energy += rods[i].impedance * step_s * (right[i][c] * right[i][c] + left[i][c] * left[i][c]);
    result.energy.push_back(energy);
    for (std::size_t contact = 0; contact <= n; ++contact) {
      // Incoming waves on both sides; a wall has infinite impedance and brings none.
      const double from_left = contact > 0 ? right[contact - 1].back() : 0;
      const double from_right = contact < n ? left[contact].front() : 0;
      const double yield =
          (contact > 0 ? 1 / rods[contact - 1].impedance : 0) + (contact < n ? 1 / rods[contact].impedance : 0);
      double force = 0;
      if (!wall_less[contact] && gaps[contact] <= 1e-12) force = std::max(0.0, 2 * (from_left - from_right) / yield);
      result.force[contact][k] = force;
      const double closing = 2 * (from_left - from_right) - force * yield;
      if (!wall_less[contact]) gaps[contact] = std::max(0.0, gaps[contact] - step_s * closing);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double in_left = left[i].front();
      const double in_right = right[i].back();
      std::rotate(right[i].begin(), right[i].end() - 1, right[i].end());
      std::rotate(left[i].begin(), left[i].begin() + 1, left[i].end());
      right[i].front() = in_left + result.force[i][k] / rods[i].impedance;
      left[i].back() = in_right - result.force[i + 1][k] / rods[i].impedance;
    }
  }
  return result;
}

}  // namespace impulse::characteristics
