#include "fem/shell/shell_kernel.hpp"

#include "fem/shell/shell_geometry.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>

namespace impulse {
namespace {

constexpr std::size_t geometry_size = shell_gauss_points * shell_point_numbers * shell_lanes;
constexpr std::size_t vector_size = shell_coefficients * shell_lanes;

struct Batch {
  alignas(64) std::array<double, geometry_size> geometry;
  alignas(64) std::array<double, vector_size> coefficients, forces;
};

Batch random_batch() {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Batch batch;
  for (double& value : batch.geometry) value = uniform(generator);
  for (double& value : batch.coefficients) value = uniform(generator);
  return batch;
}

/// ½ eᵀCe of one lane by the definitions, with whole matrices.
double plain_energy(const Batch& batch, std::size_t lane) {
  double energy = 0;
  Coefficients q;
  for (Eigen::Index c = 0; c < 3; ++c)
    for (Eigen::Index k = 0; k < 16; ++k)
      q(k, c) = batch.coefficients[static_cast<std::size_t>(16 * c + k) * shell_lanes + lane];
  for (std::size_t p = 0; p < shell_gauss_points; ++p) {
    const auto number = [&](std::size_t k) {
      return batch.geometry[(p * shell_point_numbers + k) * shell_lanes + lane];
    };
    ShellPoint point;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      point.a1(i) = number(k);
      point.a2(i) = number(3 + k);
      point.n(i) = number(6 + k);
      point.gamma(i, 0) = number(9 + k);
      point.gamma(i, 1) = number(12 + k);
    }
    Matrix6d c;
    for (std::size_t i = 0, k = 15; i < 6; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k)
        c(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = number(k);
    const Matrix6d whole = c.selfadjointView<Eigen::Lower>();
    const Eigen::Matrix<double, 6, 1> e =
        shell_strain(point, shell_functions(gauss_point[p % 4], gauss_point[p / 4]), q);
    energy += e.dot(whole * e) / 2;
  }
  return energy;
}

TEST_CASE("every kernel that this machine can run gives the energy of the definitions") {
  Batch batch = random_batch();
  double expected = 0;
  for (std::size_t lane = 0; lane < shell_lanes; ++lane) expected += plain_energy(batch, lane);
  for (const ShellKernel kernel : {ShellKernel{shell_kernel_baseline}, fastest_shell_kernel()})
    CHECK(kernel(batch.geometry.data(), batch.coefficients.data(), batch.forces.data()) ==
          about(expected).epsilon(1e-12));
}

TEST_CASE("kernels agree in every force to rounding, and a force is the energy's derivative in its own lane") {
  Batch batch = random_batch();
  (void)shell_kernel_baseline(batch.geometry.data(), batch.coefficients.data(), batch.forces.data());
  const auto plain = batch.forces;
  (void)fastest_shell_kernel()(batch.geometry.data(), batch.coefficients.data(), batch.forces.data());
  for (std::size_t k = 0; k < vector_size; ++k) CHECK(std::abs(batch.forces[k] - plain[k]) <= 1e-11 * 1e3);
  const std::size_t index = 20 * shell_lanes + 5;
  const auto energy = [&](double step) {
    Batch moved = batch;
    moved.coefficients[index] += step;
    return plain_energy(moved, 5);
  };
  const double slope = (8 * (energy(1e-3) - energy(-1e-3)) - energy(2e-3) + energy(-2e-3)) / 12e-3;
  CHECK(plain[index] == about(slope).epsilon(1e-9));
}

}  // namespace
}  // namespace impulse
