#pragma once

#include <cstddef>

namespace impulse {

/// Elements that one call of the kernel treats side by side, one in each lane of a vector.
inline constexpr std::size_t shell_lanes = 8;
inline constexpr std::size_t shell_gauss_points = 16;  ///< 4 × 4; point 4j + i has t1 = gauss_point[i]
inline constexpr std::size_t shell_coefficients =
    48;  ///< index 16c + 4b + a: component c, Hermite function a(t1) b(t2)

/// Numbers that the kernel reads at a Gauss point: a1 (3), a2 (3), n (3), Γ¹ and Γ² of κ11, κ22, 2κ12 (3 each), and the
/// lower triangle of C row by row (21).
inline constexpr std::size_t shell_point_numbers = 36;

/// Energy and nodal forces of eight elements,
///
///   E = Σ_points ½ eᵀCe,   e = (ε11, ε22, 2ε12, κ11, κ22, 2κ12),   force = ∂E/∂coefficients
///   ε_αβ = ½ (a_α·u_,β + a_β·u_,α + u_,α·u_,β),   κ_αβ = -(u_,αβ - Γ^λ_αβ u_,λ)·n
///
/// by products of the one-dimensional Hermite functions. All arrays are aligned to 64 bytes; the index of the lane runs
/// fastest: geometry [point][number][lane], coefficients and forces [coefficient][lane]. Returns ΣE over the lanes; a
/// lane that is all zero adds nothing.
/// Cost: about 5,100 multiplications with addition per element. Verified by: tests/fem/shell_kernel.test.cpp
using ShellKernel = double (*)(const double* geometry, const double* coefficients, double* forces);

double shell_kernel_baseline(const double* geometry, const double* coefficients, double* forces);
double shell_kernel_avx2(const double* geometry, const double* coefficients, double* forces);
double shell_kernel_avx512(const double* geometry, const double* coefficients, double* forces);

/// The fastest kernel that this machine's processor can run.
[[nodiscard]] ShellKernel fastest_shell_kernel();

}  // namespace impulse
