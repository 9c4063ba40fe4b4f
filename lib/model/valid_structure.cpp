#include "lib/model/valid_structure.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

bool is_finite(const Sparse& a) {
  for (Eigen::Index j = 0; j < a.outerSize(); ++j)
    for (Sparse::InnerIterator it(a, j); it; ++it)
      if (!std::isfinite(it.value())) return false;
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

}  // namespace

void require_valid_structure(const Structure& body) { require_structure(body); }

void require_valid_structure(const DenseStructure& body) { require_structure(body); }

}  // namespace impulse
