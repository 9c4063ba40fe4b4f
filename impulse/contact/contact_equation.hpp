#pragma once

#include "impulse/response/response.hpp"
#include "lib/law/impact_history.hpp"

namespace impulse {

/// How the contact equation is discretised and solved.
enum class ContactMethod {
  product,      ///< product integration, marching
  trapezoidal,  ///< trapezoidal rule on G (the thesis'), marching
  fourier,  ///< product weights, divided on the circle |z| = e^(-9/N) by FFT (Odéen and Lundberg on a shifted contour)
  series    ///< product weights, division of power series
};

struct Impact {
  double speed_m_per_s = 0;  ///< of body 1 towards body 2, which is at rest
};

/// Force between two bodies whose faces stick from t = 0 until the force stops being positive: V = (G₁ + G₂)*F.
///
/// With U = U₁ + U₂ (displacement under a unit step force) and so on, and
///
///   w_0 = U_1/Δt,   w_k = (U_{k+1} - 2U_k + U_{k-1})/Δt   (U_0 := 0),
///
/// the kernel integrated exactly, Dirac pulses wherever they fall included:
///
/// * H(0+) > 0, no residual flexibility (rods; the force jumps): F is the mean F̄_k over each step, the faces'
/// displacements agree at the
///   samples, Σ_{j≤n} w_{n-j} F̄_j = V. No work is lost between samples, and the impulse stays right across jumps that
///   fall between samples (docs/decisions/0001-force-per-step.md). On the samples F_n = (F̄_{n-1} + F̄_n)/2, F_0 =
///   V/H(0+).
/// * otherwise (the force is continuous): F is linear within each step and the faces' velocities agree at the samples,
///   Σ_{j=1..n} w_{n-j} F_j = V - a_n F_0, a_n = H_n - (U_n - U_{n-1})/Δt; F_0 = 0 with a residual flexibility (U(0+) >
///   0), else F_0 = F_1.
/// * `trapezoidal`: the latter with w_0 = Δt G_0/2, w_k = Δt G_k, a_n = Δt G_n/2, F_0 = V/H(0+) where that is known.
///
/// Order 2 in Δt away from jumps of F; a jump between samples spoils the two or three samples next to it.
/// `fourier` solves the same equations to max(e^-27, ε e^9) of the peak on kernels that do not ring, and says so when
/// it can't.
/// @throws std::invalid_argument if grids differ, V ≤ 0, or the response is not resolved by its step (names one that
/// is); ConvergenceError if a solver's residual exceeds its bound (series 1e-9 V after the stable fallback, fourier
/// 1e-6 V). Cost: product, trapezoidal O(N log² N) up to the end of contact, the others O(N log N). References:
/// [OdeenLundberg1991]. Verified by: tests/impulse/contact_equation.test.cpp
[[nodiscard]] ImpactHistory solve_contact(const Response& body_1, const Response& body_2, const Impact& impact,
                                          ContactMethod method);

}  // namespace impulse
