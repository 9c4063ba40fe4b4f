#pragma once

#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <limits>

namespace impulse {

/// A body as its modes, uᵀMu = 1, seen from its p contacts.
struct ModalModel {
  Eigen::VectorXd angular_frequency;    ///< ω, m modes, ascending [rad/s]; rigid-body modes have exactly 0
  Eigen::VectorXd damping_ratio;        ///< ζ, m, in [0, 1)
  Eigen::MatrixXd participation;        ///< φ = cᵀu, m × p [kg^-1/2]
  Eigen::MatrixXd residual_flexibility; ///< R, p × p [m/N]: the static answer of the modes left out
  Eigen::MatrixXd wave_admittance;      ///< p × p, H(0+) of the continuous body [m/(N s)]; zero where it has none

  [[nodiscard]] Eigen::Index mode_count() const { return angular_frequency.size(); }
  [[nodiscard]] Eigen::Index contact_count() const { return participation.cols(); }
};

/// @throws std::invalid_argument if sizes disagree, ω < 0 or unsorted, ζ outside [0, 1), or a value is not finite.
void require_valid(const ModalModel& body);

struct ModalOptions {
  std::size_t mode_count = std::numeric_limits<std::size_t>::max();  ///< at most this many, rigid-body modes included
  double highest_frequency_Hz = std::numeric_limits<double>::infinity();  ///< and none above this
  enum class Route { automatic, tridiagonal, dense, arpack } route = Route::automatic;
  enum class Residual { none, attached } residual = Residual::none;
};

/// Lowest modes K u = ω² M u of a structure without dashpots, and their participations:
///
///   φᵢ = cᵀuᵢ,   R = Cᵀ K⁺ C - Σ_elastic φᵢφᵢᵀ/ωᵢ²   (K⁺: elastic flexibility, inertia relief for a free body)
///
/// Routes: tridiagonal (LAPACK stevr; K tridiagonal and M diagonal), dense (LAPACK sygvd), ARPACK shift-invert about a
/// small negative shift, so that a free body's singular K can be factorised. Rigid-body modes (those whose strain
/// energy is rounding) come out with ω = 0 exactly.
/// @throws std::invalid_argument for dashpots or unequal sizes; ConvergenceError if ARPACK misses modes.
/// Verified by: tests/lib/modal_model.test.cpp
[[nodiscard]] ModalModel modal_model(const Structure& body, const ModalOptions& options = {});

}  // namespace impulse
