#include "fem/bodies/modal_structure.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

Eigen::SparseMatrix<double> diagonal(const Eigen::VectorXd& values) {
  Eigen::SparseMatrix<double> matrix(values.size(), values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) matrix.insert(i, i) = values[i];
  matrix.makeCompressed();
  return matrix;
}

}  // namespace

Structure modal_structure(const ModalModel& body, double step_s) {
  require_valid(body);
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
  const Eigen::VectorXd& omega = body.angular_frequency;
  const Eigen::Index kept = std::upper_bound(omega.begin(), omega.end(), 1 / step_s) - omega.begin();
  const Eigen::Index left_out = omega.size() - kept, contacts = body.contact_count();
  require(kept > 0, "no mode is slow enough for the step {:.4g} us (the first has {:.4g} Hz); use --step {:.3g}us",
          step_s * 1e6, omega.size() > 0 ? omega[0] / (2 * M_PI) : 0, omega.size() > 0 ? 0.999e6 / omega[0] : 0);

  Structure structure;
  structure.stiffness = diagonal(omega.head(kept).cwiseAbs2());
  structure.mass = diagonal(Eigen::VectorXd::Ones(kept));
  if (body.damping_ratio.head(kept).maxCoeff() > 0)
    structure.dashpots = 2 * body.damping_ratio.head(kept).cwiseProduct(omega.head(kept));
  structure.contacts = body.participation.topRows(kept);
  structure.outputs = Eigen::MatrixXd::Zero(kept, 0);
  structure.residual_flexibility = body.residual_flexibility;
  if (structure.residual_flexibility.size() == 0)
    structure.residual_flexibility = Eigen::MatrixXd::Zero(contacts, contacts);
  const Eigen::MatrixXd scaled =
      omega.tail(left_out).cwiseInverse().asDiagonal() * body.participation.bottomRows(left_out);
  structure.residual_flexibility += scaled.transpose() * scaled;
  structure.wave_admittance = Eigen::MatrixXd::Zero(contacts, contacts);
  if (structure.residual_flexibility.isZero(0) && body.wave_admittance.size() > 0)
    structure.wave_admittance = body.wave_admittance;
  if (omega[0] == 0 && (kept == 1 || omega[1] > 0) && structure.contacts(0, 0) != 0)
    structure.translation = Eigen::VectorXd::Unit(kept, 0) / structure.contacts(0, 0);
  return structure;
}

}  // namespace impulse
