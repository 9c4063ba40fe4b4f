#pragma once

#include "impulse/response/response.hpp"
#include "lib/model/modal_model.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

enum class RigidBody {
  held,   ///< no rigid-body mode
  free,   ///< one, its participation to be found
  known,  ///< one, of a given mass
};

struct IdentificationOptions {
  double highest_frequency_Hz = 0;        ///< of the modes sought; above it the response is filtered away
  std::size_t largest_order = 30;         ///< modes in the last line of the diagram, ≥ 2
  std::optional<std::size_t> modes = {};  ///< so many, the most significant ones; empty: all that are significant
  RigidBody rigid_body = RigidBody::held;
  double mass_kg = 0;  ///< of RigidBody::known
  enum class Residual { none, fitted } residual = Residual::none;
};

/// One pole of one line of the stabilisation diagram.
struct StabilisationPoint {
  std::size_t order = 0;  ///< modes that were allowed for
  double frequency_Hz = 0;
  double damping_ratio = 0;
  bool stable = false;  ///< within 0.5 % in frequency and 10 % in damping of one of the order before
};

struct Identification {
  ModalModel modes;
  std::vector<StabilisationPoint> diagram;
  double relative_residual = 0;  ///< ‖what is not explained‖/‖response‖, in the band
};

/// Modes of a body from its response at one contact, as sums of exponentials.
///
/// The second differences of U over Δt², which are G under a hat of two steps, are exactly Σ Re(C_m z_m^k) for modes, z
/// = e^(λΔt), λ = -ζω + iω√(1-ζ²). In the band (band_filter.hpp) the poles come from the signal subspace of their
/// Hankel matrix by its shift invariance (ESPRIT, a matrix-pencil method; docs/decisions/0016), for every order up to
/// the largest. Poles that stay from order to order are kept, and frequency, damping and φ² ≥ 0 of all together fitted
/// by least squares (Gauss-Newton) to the same data, with real modes: the phase of each is that of an impulse at t = 0.
/// Modes whose φ² is below seven standard deviations are dropped, the weakest first, and those that are less than 1e-3
/// of the response. The residual flexibility, if asked for, is the mean of U less the modes'; it needs a U without
/// drift. Cost: an eigenproblem of at most 400 rows, and fits of 3 unknowns a mode to at most some thousand samples.
/// @throws std::invalid_argument for several contacts, a record too short for the band, or a response without modes in
/// it. Reference: [RoyKailath1989]. Verified by: tests/impulse/mode_identification.test.cpp
[[nodiscard]] Identification identified_modes(const Response& response, const IdentificationOptions& options);

}  // namespace impulse
