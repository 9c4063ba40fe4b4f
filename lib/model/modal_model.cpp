#include "lib/model/modal_model.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/model/rigid_modes.hpp"
#include "lib/model/structure_eigenpairs.hpp"
#include "lib/model/valid_structure.hpp"
#include "lib/numerics/eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impulse {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

void require_options(const ModalOptions& options) {
  require(options.mode_count > 0, "no modes are asked for; ask for at least one");
  require(options.highest_frequency_Hz >= 0, "the highest frequency of the modes, {} Hz, is negative or not a number",
          options.highest_frequency_Hz);
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
  require_valid_structure(body);
  require_options(options);
  const Matrix& k = body.stiffness;
  const Matrix& m = body.mass;
  const double highest = 2 * std::numbers::pi * options.highest_frequency_Hz;
  const double limit = highest * highest;

  Eigenpairs pairs = structure_eigenpairs(k, m, options, limit);
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
