#include "lib/model/modal_model.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/model/rigid_modes.hpp"
#include "lib/numerics/eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impulse {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Route = ModalOptions::Route;

bool is_finite(const Sparse& a) {
  for (Eigen::Index j = 0; j < a.outerSize(); ++j)
    for (Sparse::InnerIterator it(a, j); it; ++it)
      if (!std::isfinite(it.value())) return false;
  return true;
}

/// No element further than `width` from the diagonal.
bool is_banded(const Sparse& a, Eigen::Index width) {
  for (Eigen::Index j = 0; j < a.outerSize(); ++j)
    for (Sparse::InnerIterator it(a, j); it; ++it)
      if (it.value() != 0 && std::abs(it.row() - it.col()) > width) return false;
  return true;
}

void require_symmetric(const Sparse& a, const char* name) {
  require(is_finite(a), "the {} matrix has an element that is not finite", name);
  const Sparse difference = a - Sparse(a.transpose());
  require(difference.norm() <= 1e-10 * a.norm(),
          "the {} matrix is not symmetric (by {} of its norm); store both triangles", name,
          difference.norm() / a.norm());
}

void require_structure(const Structure& body) {
  const Sparse& k = body.stiffness;
  const Sparse& m = body.mass;
  const Eigen::Index n = k.rows(), p = body.contacts.cols();
  require(n > 0 && k.cols() == n && m.rows() == n && m.cols() == n,
          "stiffness {} x {} and mass {} x {} are not square of the same size", k.rows(), k.cols(), m.rows(), m.cols());
  require(body.contacts.rows() == n, "contacts have {} rows for {} degrees of freedom", body.contacts.rows(), n);
  require(body.contacts.allFinite(), "a contact has an element that is not finite");
  require(body.wave_admittance.size() == 0 || (body.wave_admittance.rows() == p && body.wave_admittance.cols() == p),
          "wave admittance {} x {} for {} contacts", body.wave_admittance.rows(), body.wave_admittance.cols(), p);
  require(body.dashpots.size() == 0 || body.dashpots.isZero(0),
          "a body with dashpots has no undamped modes; integrate it in time, or leave the dashpots out");
  require_symmetric(k, "stiffness");
  require_symmetric(m, "mass");
  const Eigen::VectorXd mass = m.diagonal();
  Eigen::Index i = 0;
  const double least = mass.minCoeff(&i);
  require(least > 0,
          "the mass matrix is not positive definite (degree of freedom {} has {}); give every degree of freedom mass",
          i, least);
}

void require_options(const ModalOptions& options) {
  require(options.mode_count > 0, "no modes are asked for; ask for at least one");
  require(options.highest_frequency_Hz >= 0, "the highest frequency of the modes, {} Hz, is negative or not a number",
          options.highest_frequency_Hz);
}

/// With T = D^-1/2 K D^-1/2, M = D diagonal:  T z = λ z,  u = D^-1/2 z.
Eigenpairs tridiagonal_route(const Sparse& k, const Sparse& m, std::size_t count) {
  const Eigen::Index n = k.rows();
  const Eigen::VectorXd mass = m.diagonal();
  const Eigen::VectorXd stiffness = k.diagonal();
  Eigen::VectorXd off_diagonal(n - 1);
  for (Eigen::Index i = 0; i + 1 < n; ++i) off_diagonal(i) = k.coeff(i + 1, i) / std::sqrt(mass(i) * mass(i + 1));
  Eigenpairs pairs = tridiagonal_eigenpairs(stiffness.cwiseQuotient(mass), off_diagonal, count);
  pairs.vectors = mass.cwiseSqrt().cwiseInverse().asDiagonal() * pairs.vectors;
  return pairs;
}

/// Up to here all modes of a dense matrix take no more time (a few ms) than finding out how to do without. Not more,
/// because ARPACK about the lowest modes is the more accurate for them (see eigenpairs.hpp): for a free beam of 290
/// elements the first elastic frequency comes to 1e-9 instead of 1e-6.
constexpr Eigen::Index small_size = 200;

Route chosen_route(const Sparse& k, const Sparse& m, std::size_t count) {
  const auto n = static_cast<std::size_t>(k.rows());
  if (is_banded(m, 0) && is_banded(k, 1)) return Route::tridiagonal;
  // Measured on a square membrane: at n = 900 dense 0.12 s, ARPACK 0.55 s for 400 modes; at n = 3600 7.9 s against
  // 1.6 s. They meet near a fifth of the modes.
  return k.rows() <= small_size || 5 * count >= n ? Route::dense : Route::arpack;
}

/// How many of the lowest modes to compute so that none up to the options' limits is missing; a few more do no harm.
std::size_t sufficient_count(const Sparse& k, const Sparse& m, const ModalOptions& options, double limit) {
  const auto n = static_cast<std::size_t>(k.rows());
  const std::size_t count = std::min(n, options.mode_count);
  if (std::isinf(limit) || k.rows() <= small_size) return count;
  // Above the rigid-body modes, whose computed eigenvalues are not quite 0, even if the limit is 0.
  const double above = std::max(limit * (1 + 1e-6), 0.1 * elastic_eigenvalue_scale(k, m));
  return std::min(count, eigenvalue_count_below(k, m, above) + 1);
}

Eigenpairs lowest_eigenpairs(const Sparse& k, const Sparse& m, std::size_t count, Route route) {
  switch (route == Route::automatic ? chosen_route(k, m, count) : route) {
    case Route::tridiagonal:
      require(is_banded(m, 0) && is_banded(k, 1),
              "the tridiagonal route takes a diagonal mass and a tridiagonal stiffness matrix; use the dense or the "
              "arpack route");
      return tridiagonal_route(k, m, count);
    case Route::arpack: {
      // The shift of the size of the lowest elastic eigenvalue: the rigid-body modes do not then drown it (see
      // shift_invert_eigenpairs), and K + scale·M is well conditioned.
      const double scale = elastic_eigenvalue_scale(k, m);
      return shift_invert_eigenpairs(k, m, count, scale > 0 ? -scale : -1);
    }
    default:
      return dense_eigenpairs(Eigen::MatrixXd(k), Eigen::MatrixXd(m), count);
  }
}

/// Sets the rigid-body modes' eigenvalues to 0 and their vectors right; returns how many there are.
Eigen::Index settle_rigid_modes(const Sparse& k, const Sparse& m, Eigenpairs& pairs) {
  Eigen::Index count = 0;
  while (count < pairs.values.size() && is_rigid(k, pairs.vectors.col(count))) ++count;
  const double scale = count == 0                    ? 0
                       : count < pairs.values.size() ? pairs.values(count)
                                                     : elastic_eigenvalue_scale(k, m);
  pairs.values.head(count).setZero();
  const Eigen::MatrixXd rigid = purified_rigid_modes(k, m, pairs.vectors.leftCols(count), scale);
  pairs.vectors.leftCols(count) = rigid;
  Eigen::Ref<Eigen::MatrixXd> elastic = pairs.vectors.rightCols(pairs.values.size() - count);
  elastic -= (rigid * (rigid.transpose() * (m * elastic))).eval();
  require(count == pairs.values.size() || pairs.values(count) > 0,
          "the stiffness matrix is not positive semidefinite (it has the eigenvalue {} rad²/s²)",
          count == pairs.values.size() ? 0 : pairs.values(count));
  return count;
}

/// What Cᵀ K⁺ C - Σ φφᵀ/ω² loses to cancellation, relative: the accuracy of the lowest eigenvalues.
constexpr double residual_rounding = 1e-10;

/// A residual flexibility more negative than this is no rounding of a body that double precision can describe.
constexpr double residual_failure = 1e-4;

Eigen::MatrixXd attached_residual(const Structure& body, const Eigenpairs& pairs, const Eigen::MatrixXd& participation,
                                  Eigen::Index rigid_count) {
  const Sparse& k = body.stiffness;
  const Sparse& m = body.mass;
  const Eigen::Index p = participation.cols(), elastic_count = pairs.values.size() - rigid_count;
  if (pairs.values.size() == k.rows()) return Eigen::MatrixXd::Zero(p, p);  // nothing is left out
  const double scale = elastic_eigenvalue_scale(k, m);
  if (elastic_count == 0) {
    const auto all = scale > 0 ? static_cast<Eigen::Index>(eigenvalue_count_below(k, m, 0.01 * scale)) : k.rows();
    require(all == rigid_count,
            "{} of {} rigid-body modes are asked for, but the residual flexibility needs them all; ask for more modes",
            rigid_count, all);
  }
  const Eigen::MatrixXd whole = static_flexibility(k, m, pairs.vectors.leftCols(rigid_count), body.contacts, scale);
  const Eigen::MatrixXd elastic = participation.bottomRows(elastic_count);
  Eigen::MatrixXd residual =
      whole - elastic.transpose() * pairs.values.tail(elastic_count).cwiseInverse().asDiagonal() * elastic;
  residual = (residual + residual.transpose()).eval() / 2;
  for (Eigen::Index i = 0; i < p; ++i) {
    if (whole(i, i) > 0 && residual(i, i) < -residual_failure * whole(i, i))
      throw ConvergenceError(
          fmt::format("the modes are more flexible than the body at contact {} (by {} of its static flexibility)",
                      i + 1, -residual(i, i) / whole(i, i)),
          residual_failure, -residual(i, i) / whole(i, i), 0);
    // R > 0 changes how contact begins, so rounding must not pass for it.
    if (residual(i, i) <= residual_rounding * whole(i, i)) {
      residual.row(i).setZero();
      residual.col(i).setZero();
    }
  }
  return residual;
}

}  // namespace

void require_valid(const ModalModel& body) {
  const Eigen::Index modes = body.mode_count(), contacts = body.contact_count();
  require(body.damping_ratio.size() == modes && body.participation.rows() == modes,
          "{} angular frequencies, {} damping ratios and {} rows of participations do not make a modal model", modes,
          body.damping_ratio.size(), body.participation.rows());
  require(body.residual_flexibility.rows() == contacts && body.residual_flexibility.cols() == contacts,
          "residual flexibility {} x {} for {} contacts", body.residual_flexibility.rows(),
          body.residual_flexibility.cols(), contacts);
  require(body.wave_admittance.rows() == contacts && body.wave_admittance.cols() == contacts,
          "wave admittance {} x {} for {} contacts", body.wave_admittance.rows(), body.wave_admittance.cols(),
          contacts);
  require(body.angular_frequency.allFinite() && body.damping_ratio.allFinite() && body.participation.allFinite() &&
              body.residual_flexibility.allFinite() && body.wave_admittance.allFinite(),
          "a modal model has a value that is not finite");
  for (Eigen::Index i = 0; i < modes; ++i) {
    const double omega = body.angular_frequency(i), zeta = body.damping_ratio(i);
    require(omega >= 0, "mode {} has the negative angular frequency {} rad/s", i + 1, omega);
    require(i == 0 || omega >= body.angular_frequency(i - 1),
            "mode {} ({} rad/s) is below the one before it; sort the modes", i + 1, omega);
    require(zeta >= 0 && zeta < 1, "mode {} has the damping ratio {}, outside [0, 1)", i + 1, zeta);
  }
}

ModalModel modal_model(const Structure& body, const ModalOptions& options) {
  require_structure(body);
  require_options(options);
  const Sparse& k = body.stiffness;
  const Sparse& m = body.mass;
  const double highest = 2 * std::numbers::pi * options.highest_frequency_Hz;
  const double limit = highest * highest;

  Eigenpairs pairs = lowest_eigenpairs(k, m, sufficient_count(k, m, options, limit), options.route);
  const Eigen::Index rigid_count = settle_rigid_modes(k, m, pairs);
  const Eigen::Index kept = (pairs.values.array() <= limit).count();
  pairs.values.conservativeResize(kept);
  pairs.vectors.conservativeResize(Eigen::NoChange, kept);

  const Eigen::Index p = body.contacts.cols();
  ModalModel model;
  model.angular_frequency = pairs.values.cwiseSqrt();
  model.damping_ratio = Eigen::VectorXd::Zero(kept);
  model.participation = pairs.vectors.transpose() * body.contacts;
  model.residual_flexibility = options.residual == ModalOptions::Residual::attached
                                   ? attached_residual(body, pairs, model.participation, rigid_count)
                                   : Eigen::MatrixXd::Zero(p, p);
  if (options.shapes == ModalOptions::Shapes::kept) model.shapes = pairs.vectors;
  model.wave_admittance = body.wave_admittance.size() == 0 ? Eigen::MatrixXd::Zero(p, p) : body.wave_admittance;
  require_valid(model);
  return model;
}

}  // namespace impulse
