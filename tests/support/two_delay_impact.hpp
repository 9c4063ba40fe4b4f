#pragma once

#include "lib/material/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

/// Exact force between a chain of cylinders of two kinds (two travel times) and a rod whose echo does not return, as a
/// power series in the two delays: F(t) = Σ f_mn 1(t - 2mτ₁ - 2nτ₂). Shares nothing with the library but the material
/// constants.
namespace impulse::two_delays {

constexpr int rows = 24;
constexpr int columns = 24;

struct Series {
  std::array<std::array<double, columns>, rows> a{};
  explicit Series(double constant = 0) { a[0][0] = constant; }
  friend Series operator+(Series x, const Series& y) {
    for (int m = 0; m < rows; ++m)
      for (int n = 0; n < columns; ++n) x.a[m][n] += y.a[m][n];
    return x;
  }
  friend Series operator*(double scale, Series x) {
    for (auto& row : x.a)
      for (double& value : row) value *= scale;
    return x;
  }
  friend Series operator/(const Series& x, const Series& y) {
    Series q;
    for (int m = 0; m < rows; ++m)
      for (int n = 0; n < columns; ++n) {
        double rest = x.a[m][n];
        for (int i = 0; i <= m; ++i)
          for (int j = 0; j <= n; ++j)
            if (i + j > 0) rest -= y.a[i][j] * q.a[m - i][n - j];
        q.a[m][n] = rest / y.a[0][0];
      }
    return q;
  }
  [[nodiscard]] Series delayed(bool second) const {
    Series x;
    for (int m = 0; m < rows; ++m)
      for (int n = 0; n < columns; ++n) {
        if (second && n > 0) x.a[m][n] = a[m][n - 1];
        if (!second && m > 0) x.a[m][n] = a[m - 1][n];
      }
    return x;
  }
};

/// Times of the jumps and their heights, in order; the first is F(0+) at 0. `chain` from the struck face; kinds by
/// travel time.
inline std::vector<std::pair<double, double>> jumps(const Profile& chain, double rod_impedance, double speed,
                                                    double until) {
  const double tau_1 = chain.front().travel_time_s();
  double tau_2 = tau_1;
  for (const Segment& s : chain)
    if (std::abs(s.travel_time_s() - tau_1) > 1e-9 * tau_1) tau_2 = s.travel_time_s();
  Series rho(1.0);
  for (std::size_t i = chain.size(); i-- > 0;) {
    const bool second = std::abs(chain[i].travel_time_s() - tau_1) > 1e-9 * tau_1;
    rho = rho.delayed(second);
    if (i == 0) break;
    const double left = chain[i - 1].impedance_a_kg_per_s();
    const double here = chain[i].impedance_a_kg_per_s();
    const Series plus = Series(1.0) + rho, minus = Series(1.0) + (-1.0) * rho;
    rho = (left * plus + (-here) * minus) / (left * plus + here * minus);
  }
  const double z1 = chain.front().impedance_a_kg_per_s();
  const Series plus = Series(1.0) + rho, minus = Series(1.0) + (-1.0) * rho;
  const Series force = (speed * rod_impedance * z1 * minus) / (z1 * minus + rod_impedance * plus);
  std::vector<std::pair<double, double>> result;
  for (int m = 0; m < rows; ++m)
    for (int n = 0; n < columns; ++n) {
      const double t = 2 * m * tau_1 + 2 * n * tau_2;
      if (t <= until && std::abs(force.a[m][n]) > 1e-12 * force.a[0][0]) result.emplace_back(t, force.a[m][n]);
    }
  std::sort(result.begin(), result.end());
  return result;
}

inline double force_at(const std::vector<std::pair<double, double>>& jumps, double t) {
  double force = 0;
  for (const auto& [time, height] : jumps)
    if (time <= t) force += height;
  return force;
}

}  // namespace impulse::two_delays
