#pragma once

#include "impulse/response/response.hpp"
#include "lib/law/impact_history.hpp"

namespace impulse {

/// How the contact equation is discretised and solved.
enum class ContactMethod {
  product,      ///< product trapezoidal rule, marching; order 2
  trapezoidal,  ///< trapezoidal rule on G (the thesis'), marching; order 2 on smooth kernels
  fourier,      ///< product weights, divided on the circle |z| = e^(-9/N) by FFT (Odéen and Lundberg on a shifted contour)
  series        ///< product weights, division of power series
};

struct Impact {
  double speed_m_per_s = 0;  ///< of body 1 towards body 2, which is at rest
};

/// Force between two bodies whose faces stick from t = 0 until the force stops being positive: V = (G₁ + G₂)*F.
///
/// F is linear within each step, F_n = F(t_n). Σ_{j=1..n} w_{n-j} F_j = V - a_n F_0 with
///
///   product:      w_0 = U_1/Δt, w_k = (U_{k+1} - 2U_k + U_{k-1})/Δt  (U_0 := 0),   a_n = H_n - (U_n - U_{n-1})/Δt
///   trapezoidal:  w_0 = Δt G_0/2, w_k = Δt G_k,                                    a_n = Δt G_n/2
///
/// U = U₁ + U₂ (displacement under a unit step force) and so on. The product rule integrates the kernel exactly, Dirac pulses
/// wherever they fall included. Start: F_0 = V/H(0+); 0 with a residual flexibility (U(0+) > 0); F_1 if H(0+) = 0.
/// `fourier` solves the product equations to max(e^-27, ε e^9) of the peak on kernels that do not ring, and says so when it can't.
/// Order 2 in Δt where F is smooth; a jump of F between samples costs 0.4·jump there, which is the interpolation's, not the method's.
/// @throws std::invalid_argument if grids differ, V ≤ 0, or the response is not resolved by its step (names one that is);
/// ConvergenceError if a solver's residual exceeds its bound (series 1e-9 V after the stable fallback, fourier 1e-6 V).
/// Cost: product, trapezoidal O(N log² N) up to the end of contact, the others O(N log N).
/// References: [OdeenLundberg1991]. Verified by: tests/impulse/contact_equation.test.cpp
[[nodiscard]] ImpactHistory solve_contact(const Response& body_1, const Response& body_2, const Impact& impact,
                                          ContactMethod method);

}  // namespace impulse
