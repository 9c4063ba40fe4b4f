#pragma once

#include "lib/material/profile.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

/// An oracle for waves in chains that shares no line with the library: d'Alembert's lattice. Every segment is cut into
/// cells crossed in one time step (its travel time must be a whole number of them); then central differences for ψ =
/// D·u carry waves without dispersion, exactly in cylinders, to order 2 at the ends and joints of cones.
namespace impulse::lattice {

/// Velocity of face A under a unit step force on it, at steps 0, 1, 2, ... Far end free.
inline std::vector<double> step_velocity(const Profile& profile, double step_s, std::size_t size) {
  std::vector<double> mass{0.0};
  std::vector<double> spring;
  for (const Segment& s : profile) {
    const double c = std::sqrt(s.material.youngs_modulus_Pa / s.material.density_kg_per_m3);
    const auto cells = static_cast<std::size_t>(std::lround(s.length_m / c / step_s));
    const double h = s.length_m / static_cast<double>(cells);
    for (std::size_t i = 0; i < cells; ++i) {
      const double x0 = static_cast<double>(i) / static_cast<double>(cells);
      const double x1 = static_cast<double>(i + 1) / static_cast<double>(cells);
      const double d0 = s.diameter_a_m + (s.diameter_b_m - s.diameter_a_m) * x0;
      const double d1 = s.diameter_a_m + (s.diameter_b_m - s.diameter_a_m) * x1;
      const double rho = s.material.density_kg_per_m3 * M_PI / 4 * h;
      mass.back() += rho * d0 * (2 * d0 + d1) / 6;
      mass.push_back(rho * d1 * (2 * d1 + d0) / 6);
      spring.push_back(s.material.youngs_modulus_Pa * M_PI / 4 * d0 * d1 / h);
    }
  }
  const std::size_t n = mass.size();
  std::vector<double> u(n, 0.0), v(n, 0.0), a(n, 0.0), velocity(size);
  const auto accelerate = [&] {
    for (std::size_t j = 0; j < n; ++j) {
      double force = j == 0 ? 1.0 : spring[j - 1] * (u[j - 1] - u[j]);
      if (j + 1 < n) force += spring[j] * (u[j + 1] - u[j]);
      a[j] = force / mass[j];
    }
  };
  accelerate();
  for (std::size_t k = 1; k < size; ++k) {
    for (std::size_t j = 0; j < n; ++j) {
      u[j] += step_s * v[j] + 0.5 * step_s * step_s * a[j];
      v[j] += 0.5 * step_s * a[j];
    }
    accelerate();
    for (std::size_t j = 0; j < n; ++j) v[j] += 0.5 * step_s * a[j];
    velocity[k] = v[0];
  }
  return velocity;
}

}  // namespace impulse::lattice
