#pragma once

#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <limits>

namespace impulse {

/// A body as its modes, uᵀMu = 1, seen from its p contacts.
struct ModalModel {
  Eigen::VectorXd angular_frequency;     ///< ω, m modes, ascending [rad/s]; rigid-body modes have exactly 0
  Eigen::VectorXd damping_ratio;         ///< ζ, m, in [0, 1)
  Eigen::MatrixXd participation;         ///< φ = cᵀu, m × p [kg^-1/2]
  Eigen::MatrixXd residual_flexibility;  ///< R, p × p [m/N]: the static answer of the modes left out
  Eigen::MatrixXd wave_admittance;       ///< p × p, H(0+) of the continuous body [m/(N s)]; zero where it has none
  Eigen::MatrixXd shapes = {};           ///< u, n × m [kg^-1/2], if they were asked for; else empty

  Eigen::MatrixXd output_participation = {};  ///< oᵀu, m × q, of the structure's outputs [unit of the output·kg^-1/2]
  Eigen::MatrixXd residual_outputs = {};      ///< q × p, static answer of the modes left out there, per N at a contact

  [[nodiscard]] Eigen::Index mode_count() const { return angular_frequency.size(); }
  [[nodiscard]] Eigen::Index contact_count() const { return participation.cols(); }
};

/// @throws std::invalid_argument if sizes disagree, ω < 0 or unsorted, ζ outside [0, 1), or a value is not finite.
void require_valid(const ModalModel& body);

struct ModalOptions {
  std::size_t mode_count =
      std::numeric_limits<std::size_t>::max();  ///< at most this many (≥ 1), rigid-body modes included
  double highest_frequency_Hz = std::numeric_limits<double>::infinity();  ///< ≥ 0; and none above this
  enum class Route { automatic, tridiagonal, dense, arpack } route = Route::automatic;
  enum class Residual { none, attached } residual = Residual::none;
  enum class Shapes { left_out, kept } shapes = Shapes::left_out;  ///< n × m of them take memory
};

/// Lowest modes K u = ω² M u of a structure without dashpots, none missed, and their participations:
///
///   φᵢ = cᵀuᵢ,   R = Cᵀ K⁺ C - Σ_elastic φᵢφᵢᵀ/ωᵢ²   (K⁺: elastic flexibility, inertia relief for a free body)
///
/// and the same of the outputs o, oᵀuᵢ and Oᵀ K⁺ C - Σ_elastic. What the structure has of a residual flexibility comes
/// on top.
/// The sign of a mode is arbitrary; damping ratios are 0. With a highest frequency the modes up to it are counted
/// beforehand (inertia of K - ω²M); there may be none. R is 0 if Residual::none, if no mode is left out, and in the
/// rows and columns of contacts where it is below 1e-10 of the static flexibility, which is rounding. Its accuracy is
/// that of the frequencies, relative to the static flexibility. Routes: tridiagonal (LAPACK stevr; K tridiagonal and M
/// diagonal, then always), dense (LAPACK sygvd; n ≤ 200 or a fifth of the modes and more), ARPACK shift-invert (else)
/// about a negative shift of the size of the lowest elastic eigenvalue, so that a free body's singular K can be
/// factorised. Rigid-body modes (is_rigid in rigid_modes.hpp: those whose strain energy is rounding) come out with ω =
/// 0 exactly and without elastic parts.
/// @throws std::invalid_argument for dashpots, unequal sizes, K or M unsymmetric or not (semi)definite, a route that
/// does not fit, or R asked for with fewer modes than the rigid-body ones; ConvergenceError if ARPACK misses modes or
/// the static flexibility is lost to rounding.
/// Verified by: tests/lib/modal_model.test.cpp
[[nodiscard]] ModalModel modal_model(const Structure& body, const ModalOptions& options = {});

/// The same of dense matrices, by LAPACK (lowest_dense_eigenpairs about a shift as above); the only route there is.
/// Cost: a factorisation to find the shift, the eigenpairs, a factorisation for the residual flexibility.
[[nodiscard]] ModalModel modal_model(const DenseStructure& body, const ModalOptions& options = {});

}  // namespace impulse
