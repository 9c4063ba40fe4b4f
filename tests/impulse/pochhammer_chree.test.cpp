#include "impulse/exact/pochhammer_chree.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

using namespace impulse;
using std::numbers::pi;
using Complex = std::complex<long double>;

namespace {

/// J_n(z) by its power series, n = 0, 1, 2.
Complex bessel(int n, Complex z) {
  Complex term = std::pow(z / 2.0L, n) / (n == 2 ? 2.0L : 1.0L);
  Complex sum = term;
  for (int m = 1; m < 120; ++m) {
    term *= -z * z / 4.0L / static_cast<long double>(m * (m + n));
    sum += term;
  }
  return sum;
}

/// |det| of the surface tractions of the potentials φ = A J0(pr) e^(ikz), ψ_θ = B J1(qr) e^(ikz) over the size of its
/// products, from u = ∇φ + ∇×ψ and Hooke's law, radius 1, E = ρ = 1: zero where the surface is free. Written without
/// the frequency equation.
double free_surface_residual(double ka, double ratio, double nu) {
  const long double k = ka, omega = ka * ratio, mu = 0.5 / (1 + nu);
  const long double lambda = nu / ((1 + nu) * (1 - 2 * nu));
  const Complex p = std::sqrt(Complex(omega * omega / (lambda + 2 * mu) - k * k));
  const Complex q = std::sqrt(Complex(omega * omega / mu - k * k));
  const Complex i(0, 1);
  // J0'(x) = -J1, J1' = J0 - J1/x.
  const Complex j0p = bessel(0, p), j1p = bessel(1, p), j0q = bessel(0, q), j1q = bessel(1, q);
  const Complex phi_rr = -p * p * (j0p - j1p / p);
  const Complex srr_a = -lambda * (p * p + k * k) * j0p + 2 * mu * phi_rr;
  const Complex srz_a = 2 * mu * i * k * (-p * j1p);
  // u_r = -ik B J1(qr), u_z = B q J0(qr): divergence free.
  const Complex srr_b = 2 * mu * (-i * k) * q * (j0q - j1q / q);
  const Complex srz_b = mu * (k * k * j1q - q * q * j1q);
  return static_cast<double>(std::abs(srr_a * srz_b - srr_b * srz_a) /
                             (std::abs(srr_a * srz_b) + std::abs(srr_b * srz_a)));
}

}  // namespace

TEST_CASE("pochhammer_chree: Bancroft's phase velocities to 1e-5") {
  constexpr std::array diameter_over_length{.1, .2, .3, .4, .5, .6, .8, 1.0, 1.4, 2.0};
  struct Row {
    double nu;
    std::array<double, 10> ratio;
  };
  const std::array rows{Row{.25, {.99843, .99333, .98337, .96559, .93479, .88681, .77332, .69344, .62048, .58932}},
                        Row{.29, {.99789, .99113, .97826, .95645, .92175, .87299, .76558, .68927, .61763, .58607}},
                        Row{.30, {.99774, .99054, .97691, .95410, .91854, .86964, .76357, .68814, .61687, .58524}}};
  for (const Row& row : rows)
    for (std::size_t n = 0; n < diameter_over_length.size(); ++n)
      CHECK(std::abs(pochhammer_chree_speed_ratio(pi * diameter_over_length[n], row.nu) - row.ratio[n]) < 1e-5);
  CHECK(std::abs(rayleigh_speed_ratio(.3) - .57516) < 1e-5);
}

TEST_CASE("pochhammer_chree: the surface is free, by displacement potentials and Hooke's law") {
  for (double nu : {0.05, 0.2, 0.3, 0.4, 0.49})
    for (double ka : {0.05, 0.3, 1.0, 2.0, 3.0, 4.0, 6.0, 9.0}) {
      CAPTURE(nu);
      CAPTURE(ka);
      const double ratio = pochhammer_chree_speed_ratio(ka, nu);
      // The two products cancel to the root's rounding, 1e-13, times the equation's slope over its size.
      CHECK(free_surface_residual(ka, ratio, nu) < 1e-11);
      CHECK(free_surface_residual(ka, ratio * 1.001, nu) > 1e-8);
    }
}

TEST_CASE("pochhammer_chree: limits of long and short waves, and no lateral motion") {
  for (double nu : {0.0, 0.1, 0.3, 0.5}) {
    CAPTURE(nu);
    CHECK(pochhammer_chree_speed_ratio(0, nu) == 1);
    // Rayleigh: 1 - ν²κ²/4 + O(κ⁴), and the same on both sides of where the series takes over.
    CHECK(std::abs(pochhammer_chree_speed_ratio(0.02, nu) - (1 - nu * nu * 1e-4)) < 1e-7);
    CHECK(std::abs(pochhammer_chree_speed_ratio(0.9999e-3, nu) - pochhammer_chree_speed_ratio(1.0001e-3, nu)) < 1e-9);
    CHECK(std::abs(pochhammer_chree_speed_ratio(1e3, nu) - rayleigh_speed_ratio(nu)) < 1e-3);
    double before = 1;
    for (double ka = 0.05; ka < 60; ka *= 1.05) {
      const double ratio = pochhammer_chree_speed_ratio(ka, nu);
      // Past ka = 4 the curve may dip below the speed of Rayleigh waves and rise to it again: by 1 % at ν = ½, from 3 %
      // below at ν = 0.
      CHECK(ratio <= (ka < 4 ? before + 1e-12 : 1.01 * before));
      CHECK(ratio > 0.95 * rayleigh_speed_ratio(nu));
      before = ratio;
    }
  }
  for (double ka : {0.01, 0.5, 1.5}) CHECK(std::abs(pochhammer_chree_speed_ratio(ka, 0) - 1) < 1e-12);
  // ν = ½: s³ - 8s² + 24s - 16 = 0 has the root 0.9126; c_R/c_T = 0.95531.
  CHECK(rayleigh_speed_ratio(0.5) * std::sqrt(3.0) == about(0.955313).epsilon(1e-6));
}

TEST_CASE("pochhammer_chree: the table is the exact curve to 2e-10") {
  const BarDispersion table(0.29, 20);
  for (double ka = 0.0013; ka < 20; ka *= 1.037) {
    const double ratio = pochhammer_chree_speed_ratio(ka, 0.29);
    CAPTURE(ka);
    CHECK(std::abs(table.speed_ratio(ka * ratio) - ratio) < 2e-10);
  }
  CHECK(std::abs(table.speed_ratio(0) - 1) < 1e-15);
  CHECK_NOTHROW((void)table.speed_ratio(20));
}

TEST_CASE("pochhammer_chree: refusals") {
  CHECK_THROWS_WITH_AS((void)pochhammer_chree_speed_ratio(1, 0.6), doctest::Contains("Poisson's ratio 0.6"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)pochhammer_chree_speed_ratio(-1, 0.3), doctest::Contains("negative"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)rayleigh_speed_ratio(-0.1), doctest::Contains("outside [0, 0.5]"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(BarDispersion(0.3, 0), doctest::Contains("not positive"), std::invalid_argument);
  const BarDispersion table(0.3, 1);
  CHECK_THROWS_WITH_AS((void)table.speed_ratio(-0.1), doctest::Contains("negative"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)table.speed_ratio(9), doctest::Contains("outside"), std::invalid_argument);
}
