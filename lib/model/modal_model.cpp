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

bool is_finite(const Eigen::MatrixXd& a) { return a.allFinite(); }

double asymmetry(const Sparse& a) { return (a - Sparse(a.transpose())).norm(); }

/// By blocks, or a large matrix is read across its columns.
double asymmetry(const Eigen::MatrixXd& a) {
  constexpr Eigen::Index side = 64;
  double sum = 0;
  for (Eigen::Index j = 0; j < a.cols(); j += side)
    for (Eigen::Index i = j; i < a.rows(); i += side) {
      const Eigen::Index r = std::min(side, a.rows() - i), c = std::min(side, a.cols() - j);
      sum += (a.block(i, j, r, c) - a.block(j, i, c, r).transpose()).squaredNorm();
    }
  return std::sqrt(2 * sum);
}

template <class Matrix>
void require_symmetric(const Matrix& a, const char* name) {
  require(is_finite(a), "the {} matrix has an element that is not finite", name);
  const double norm = a.norm(), difference = asymmetry(a);
  require(difference <= 1e-10 * norm, "the {} matrix is not symmetric (by {} of its norm); store both triangles", name,
          difference / norm);
}

template <class Matrix>
void require_structure(const BasicStructure<Matrix>& body) {
  const Matrix& k = body.stiffness;
  const Matrix& m = body.mass;
  const Eigen::Index n = k.rows(), p = body.contacts.cols();
  require(n > 0 && k.cols() == n && m.rows() == n && m.cols() == n,
          "stiffness {} x {} and mass {} x {} are not square of the same size", k.rows(), k.cols(), m.rows(), m.cols());
  require(body.contacts.rows() == n, "contacts have {} rows for {} degrees of freedom", body.contacts.rows(), n);
  require(body.contacts.allFinite(), "a contact has an element that is not finite");
  require(body.outputs.size() == 0 || (body.outputs.rows() == n && body.outputs.allFinite()),
          "outputs {} x {} do not fit {} degrees of freedom, or are not finite", body.outputs.rows(),
          body.outputs.cols(), n);
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

Eigenpairs lowest_eigenpairs(const Sparse& k, const Sparse& m, const ModalOptions& options, double limit) {
  const std::size_t count = sufficient_count(k, m, options, limit);
  const Route route = options.route;
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

Eigenpairs lowest_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, const ModalOptions& options,
                             double limit) {
  require(options.route == Route::automatic || options.route == Route::dense,
          "a dense structure takes the dense route only");
  const double scale = elastic_eigenvalue_scale(k, m);
  const std::size_t count = std::min(static_cast<std::size_t>(k.rows()), options.mode_count);
  // Rigid-body modes are above a limit of 0 by rounding.
  return lowest_dense_eigenpairs(k, m, scale > 0 ? scale : 1, count, std::max(limit, 0.1 * scale));
}

/// Sets the rigid-body modes' eigenvalues to 0 and their vectors right; returns how many there are.
template <class Matrix>
Eigen::Index settle_rigid_modes(const Matrix& k, const Matrix& m, Eigenpairs& pairs) {
  Eigen::Index count = 0;
  while (count < pairs.values.size() && is_rigid(k, pairs.vectors.col(count))) ++count;
  const double scale = count == 0                    ? 0
                       : count < pairs.values.size() ? pairs.values(count)
                                                     : elastic_eigenvalue_scale(k, m);
  pairs.values.head(count).setZero();
  const Eigen::MatrixXd rigid = purified_rigid_modes(k, m, pairs.vectors.leftCols(count), scale);
  pairs.vectors.leftCols(count) = rigid;
  if (count > 0) {
    Eigen::Ref<Eigen::MatrixXd> elastic = pairs.vectors.rightCols(pairs.values.size() - count);
    const Eigen::MatrixXd momentum = m * rigid;
    elastic -= rigid * (momentum.transpose() * elastic).eval();
  }
  require(count == pairs.values.size() || pairs.values(count) > 0,
          "the stiffness matrix is not positive semidefinite (it has the eigenvalue {} rad²/s²)",
          count == pairs.values.size() ? 0 : pairs.values(count));
  return count;
}

/// What Cᵀ K⁺ C - Σ φφᵀ/ω² loses to cancellation, relative: the accuracy of the lowest eigenvalues.
constexpr double residual_rounding = 1e-10;

/// A residual flexibility more negative than this is no rounding of a body that double precision can describe.
constexpr double residual_failure = 1e-4;

/// Whether the modes hold all rigid-body ones, without which there is no static answer of the others.
void require_all_rigid_modes(const Sparse& k, const Sparse& m, Eigen::Index rigid_count, double scale) {
  const auto all = scale > 0 ? static_cast<Eigen::Index>(eigenvalue_count_below(k, m, 0.01 * scale)) : k.rows();
  require(all == rigid_count,
          "{} of {} rigid-body modes are asked for, but the residual flexibility needs them all; ask for more modes",
          rigid_count, all);
}

void require_all_rigid_modes(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, Eigen::Index rigid_count,
                             double scale) {
  const double shift = scale > 0 ? scale : 1;
  const auto more = static_cast<std::size_t>(std::min(rigid_count + 1, k.rows()));
  const Eigen::VectorXd values = lowest_dense_eigenpairs(k, m, shift, more).values;
  require(scale == 0 || values(rigid_count) > 0.01 * scale,
          "only {} of the rigid-body modes are asked for, but the residual flexibility needs them all; ask for more "
          "modes",
          rigid_count);
}

/// R changes how contact begins, so rounding must not pass for it.
void settle_residual(const Eigen::MatrixXd& whole, Eigen::MatrixXd& residual) {
  residual = (residual + residual.transpose()).eval() / 2;
  for (Eigen::Index i = 0; i < residual.rows(); ++i) {
    if (whole(i, i) > 0 && residual(i, i) < -residual_failure * whole(i, i))
      throw ConvergenceError(
          fmt::format("the modes are more flexible than the body at contact {} (by {} of its static flexibility)",
                      i + 1, -residual(i, i) / whole(i, i)),
          residual_failure, -residual(i, i) / whole(i, i), 0);
    if (residual(i, i) <= residual_rounding * whole(i, i)) {
      residual.row(i).setZero();
      residual.col(i).setZero();
    }
  }
}

template <class Matrix>
void attach_residual(const BasicStructure<Matrix>& body, const Eigenpairs& pairs, Eigen::Index rigid_count,
                     ModalModel& model) {
  const Matrix& k = body.stiffness;
  const Matrix& m = body.mass;
  const Eigen::Index elastic_count = pairs.values.size() - rigid_count;
  if (pairs.values.size() == k.rows()) return;  // nothing is left out
  const double scale = elastic_count > 0 ? pairs.values(rigid_count) : elastic_eigenvalue_scale(k, m);
  if (elastic_count == 0) require_all_rigid_modes(k, m, rigid_count, scale);
  const Eigen::MatrixXd displacements =
      static_displacements(k, m, pairs.vectors.leftCols(rigid_count), body.contacts, scale);
  const Eigen::MatrixXd whole = body.contacts.transpose() * displacements;
  const Eigen::MatrixXd scaled =
      pairs.values.tail(elastic_count).cwiseInverse().asDiagonal() * model.participation.bottomRows(elastic_count);
  model.residual_flexibility = whole - model.participation.bottomRows(elastic_count).transpose() * scaled;
  settle_residual(whole, model.residual_flexibility);
  if (body.outputs.cols() > 0)
    model.residual_outputs = body.outputs.transpose() * displacements -
                             model.output_participation.bottomRows(elastic_count).transpose() * scaled;
}

template <class Matrix>
ModalModel modal_model_of(const BasicStructure<Matrix>& body, const ModalOptions& options) {
  require_structure(body);
  require_options(options);
  const Matrix& k = body.stiffness;
  const Matrix& m = body.mass;
  const double highest = 2 * std::numbers::pi * options.highest_frequency_Hz;
  const double limit = highest * highest;

  Eigenpairs pairs = lowest_eigenpairs(k, m, options, limit);
  const Eigen::Index rigid_count = settle_rigid_modes(k, m, pairs);
  const Eigen::Index kept = (pairs.values.array() <= limit).count();
  pairs.values.conservativeResize(kept);
  pairs.vectors.conservativeResize(Eigen::NoChange, kept);

  const Eigen::Index p = body.contacts.cols(), q = body.outputs.cols();
  ModalModel model;
  model.angular_frequency = pairs.values.cwiseSqrt();
  model.damping_ratio = Eigen::VectorXd::Zero(kept);
  model.participation = pairs.vectors.transpose() * body.contacts;
  model.residual_flexibility = Eigen::MatrixXd::Zero(p, p);
  if (q > 0) {
    model.output_participation = pairs.vectors.transpose() * body.outputs;
    model.residual_outputs = Eigen::MatrixXd::Zero(q, p);
  }
  if (options.residual == ModalOptions::Residual::attached) {
    attach_residual(body, pairs, rigid_count, model);
    if (body.residual_flexibility.size() > 0) model.residual_flexibility += body.residual_flexibility;
  }
  if (options.shapes == ModalOptions::Shapes::kept) model.shapes = pairs.vectors;
  model.wave_admittance = body.wave_admittance.size() == 0 ? Eigen::MatrixXd::Zero(p, p) : body.wave_admittance;
  require_valid(model);
  return model;
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
  require(body.output_participation.size() == 0 ||
              (body.output_participation.rows() == modes && body.residual_outputs.cols() == contacts &&
               body.residual_outputs.rows() == body.output_participation.cols()),
          "output participations {} x {} and their residuals {} x {} do not fit {} modes and {} contacts",
          body.output_participation.rows(), body.output_participation.cols(), body.residual_outputs.rows(),
          body.residual_outputs.cols(), modes, contacts);
  for (Eigen::Index i = 0; i < modes; ++i) {
    const double omega = body.angular_frequency(i), zeta = body.damping_ratio(i);
    require(omega >= 0, "mode {} has the negative angular frequency {} rad/s", i + 1, omega);
    require(i == 0 || omega >= body.angular_frequency(i - 1),
            "mode {} ({} rad/s) is below the one before it; sort the modes", i + 1, omega);
    require(zeta >= 0 && zeta < 1, "mode {} has the damping ratio {}, outside [0, 1)", i + 1, zeta);
  }
}

ModalModel modal_model(const Structure& body, const ModalOptions& options) { return modal_model_of(body, options); }

ModalModel modal_model(const DenseStructure& body, const ModalOptions& options) {
  return modal_model_of(body, options);
}

}  // namespace impulse
