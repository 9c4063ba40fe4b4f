#include "impulse/bodies/tensor_form.hpp"

#include "lib/numerics/dense_algebra.hpp"
#include "lib/numerics/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace impulse {
namespace {

/// Orders of the ξ- and η-derivative of each column of T.
constexpr std::array<int, derivative_count> xi_order{0, 1, 0, 2, 1, 0};
constexpr std::array<int, derivative_count> eta_order{0, 0, 1, 0, 1, 2};

/// Products bᵢ⁽ᵃ⁾ bₖ⁽ᶜ⁾ of two bases at the quadrature points: points × (i + k·n).
class ProductTables {
 public:
  explicit ProductTables(Eigen::VectorXd points) : points_(std::move(points)) {}

  const Eigen::MatrixXd& operator()(const RitzBasis& f, int a, const RitzBasis& g, int c) {
    const auto [entry, is_new] = tables_.try_emplace({&f, a, &g, c});
    if (is_new) {
      const Eigen::MatrixXd left = f.at(points_, a), right = g.at(points_, c);
      entry->second.resize(points_.size(), left.cols() * right.cols());
      for (Eigen::Index k = 0; k < right.cols(); ++k)
        for (Eigen::Index i = 0; i < left.cols(); ++i)
          entry->second.col(i + k * left.cols()) = left.col(i).cwiseProduct(right.col(k));
    }
    return entry->second;
  }

 private:
  Eigen::VectorXd points_;
  std::map<std::tuple<const RitzBasis*, int, const RitzBasis*, int>, Eigen::MatrixXd> tables_;
};

/// One pair of fields of the form.
class FormPair {
 public:
  FormPair(const FormField& f, const FormField& g, const Eigen::MatrixXd& weight)
      : f_(f), g_(g), weight_(f.operators.transpose() * weight * g.operators) {}

  [[nodiscard]] bool is_zero() const { return weight_.isZero(0); }

  /// Coefficient of the product of reference derivatives α of f and β of g, at points (η × ξ).
  void set_coefficients(const std::vector<DerivativeMatrix>& derivatives, const Eigen::MatrixXd& area) {
    for (auto& row : coefficients_)
      for (Eigen::MatrixXd& c : row) c.setZero(area.rows(), area.cols());
    for (Eigen::Index p = 0; p < area.cols(); ++p)
      for (Eigen::Index s = 0; s < area.rows(); ++s) {
        const DerivativeMatrix& t = derivatives[static_cast<std::size_t>(p * area.rows() + s)];
        const DerivativeMatrix w = area(s, p) * (t.transpose() * weight_ * t);
        for (std::size_t a = 0; a < derivative_count; ++a)
          for (std::size_t b = 0; b < derivative_count; ++b)
            coefficients_[a][b](s, p) = w(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
  }

  void add_to(ProductTables& tables, Eigen::Ref<Eigen::MatrixXd> block) {
    const Eigen::Index nf = f_.basis->size(), ng = g_.basis->size();
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(nf * ng, nf * ng);  // (j, l) × (i, k)
    for (int b = 0; b <= 2; ++b)
      for (int d = 0; d <= 2; ++d) {
        const Eigen::MatrixXd along_xi = integrated_along_xi(tables, b, d);
        if (along_xi.size() > 0) add_transposed_product(tables(*f_.basis, b, *g_.basis, d), along_xi, sums);
      }
    for (Eigen::Index k = 0; k < ng; ++k)
      for (Eigen::Index i = 0; i < nf; ++i)
        block.block(i * nf, k * ng, nf, ng) += Eigen::Map<const Eigen::MatrixXd>(sums.col(i + k * nf).data(), nf, ng);
  }

 private:
  /// η points × (i, k), of the terms with η-derivatives of order b of f and d of g; empty if there are none.
  Eigen::MatrixXd integrated_along_xi(ProductTables& tables, int b, int d) {
    Eigen::MatrixXd result;
    for (std::size_t alpha = 0; alpha < derivative_count; ++alpha)
      for (std::size_t beta = 0; beta < derivative_count; ++beta) {
        const Eigen::MatrixXd& coefficient = coefficients_[alpha][beta];
        if (eta_order[alpha] != b || eta_order[beta] != d || coefficient.isZero(0)) continue;
        const Eigen::MatrixXd& table = tables(*f_.basis, xi_order[alpha], *g_.basis, xi_order[beta]);
        if (result.size() == 0) result = Eigen::MatrixXd::Zero(coefficient.rows(), table.cols());
        add_transposed_product(coefficient.transpose(), table, result);
      }
    return result;
  }

  const FormField& f_;
  const FormField& g_;
  DerivativeMatrix weight_;
  std::array<std::array<Eigen::MatrixXd, derivative_count>, derivative_count> coefficients_;
};

}  // namespace

DerivativeMatrix physical_derivatives(const PlateShape& shape, const Eigen::Vector2d& reference) {
  const Eigen::Matrix2d j = shape.jacobian(reference), inverse = j.inverse();
  const double x1 = j(0, 0), y1 = j(0, 1), x2 = j(1, 0), y2 = j(1, 1);
  Eigen::Matrix3d second;  // (f_ξξ, f_ξη, f_ηη) from (f_xx, f_xy, f_yy), beside the twist's share
  second << x1 * x1, 2 * x1 * y1, y1 * y1,  //
      x1 * x2, x1 * y2 + x2 * y1, y1 * y2,  //
      x2 * x2, 2 * x2 * y2, y2 * y2;
  const Eigen::Matrix3d second_inverse = second.inverse();
  DerivativeMatrix t = DerivativeMatrix::Zero();
  t(0, 0) = 1;
  t.block<2, 2>(1, 1) = inverse;
  t.block<3, 3>(3, 3) = second_inverse;
  t.block<3, 2>(3, 1) = -second_inverse.col(1) * (shape.twist().transpose() * inverse);
  return t;
}

Eigen::VectorXd field_functional(const RitzBasis& basis, const PlateShape& shape, const Eigen::Vector2d& reference,
                                 const DerivativeRow& row) {
  const Eigen::Index n = basis.size();
  if (row.isZero(0)) return Eigen::VectorXd::Zero(n * n);
  const DerivativeRow derivatives = row * physical_derivatives(shape, reference);
  std::array<Eigen::VectorXd, 3> along_xi, along_eta;
  for (int order = 0; order <= 2; ++order) {
    const auto o = static_cast<std::size_t>(order);
    along_xi[o] = basis.at(Eigen::VectorXd::Constant(1, reference.x()), order).transpose();
    along_eta[o] = basis.at(Eigen::VectorXd::Constant(1, reference.y()), order).transpose();
  }
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(n, n);  // (j, i)
  for (std::size_t a = 0; a < derivative_count; ++a) {
    const double factor = derivatives(static_cast<Eigen::Index>(a));
    if (factor != 0)
      values += factor * along_eta[static_cast<std::size_t>(eta_order[a])] *
                along_xi[static_cast<std::size_t>(xi_order[a])].transpose();
  }
  return values.reshaped();
}

std::size_t quadrature_points(const PlateShape& shape, std::size_t terms) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      const double j = std::abs(shape.jacobian({a, b}).determinant());
      least = std::min(least, j);
      most = std::max(most, j);
    }
  if (most - least <= 1e-12 * most) return terms;
  const double z = (most + least) / (most - least), rate = 2 * std::log(z + std::sqrt(z * z - 1));
  constexpr double digits = 37;  // -ln ε
  constexpr double most_extra = 200;
  return terms + 2 + static_cast<std::size_t>(std::min(most_extra, std::ceil(digits / rate)));
}

Eigen::MatrixXd tensor_form(const std::vector<FormField>& fields, const Eigen::MatrixXd& weight,
                            const PlateShape& shape, std::size_t points) {
  const QuadratureRule rule = gauss_legendre(points);
  const Eigen::Index q = rule.points.size();
  std::vector<DerivativeMatrix> derivatives;
  derivatives.reserve(points * points);
  Eigen::MatrixXd area(q, q);
  for (Eigen::Index p = 0; p < q; ++p)
    for (Eigen::Index s = 0; s < q; ++s) {
      const Eigen::Vector2d at(rule.points(p), rule.points(s));
      derivatives.push_back(physical_derivatives(shape, at));
      area(s, p) = std::abs(shape.jacobian(at).determinant()) * rule.weights(p) * rule.weights(s);
    }

  std::vector<Eigen::Index> begin{0};
  for (const FormField& field : fields) begin.push_back(begin.back() + field.basis->size() * field.basis->size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(begin.back(), begin.back());
  ProductTables tables(rule.points);
  for (std::size_t f = 0; f < fields.size(); ++f)
    for (std::size_t g = 0; g <= f; ++g) {
      FormPair pair(fields[f], fields[g], weight);
      if (pair.is_zero()) continue;
      pair.set_coefficients(derivatives, area);
      pair.add_to(tables, result.block(begin[f], begin[g], begin[f + 1] - begin[f], begin[g + 1] - begin[g]));
    }
  // The diagonal blocks are symmetric to rounding only.
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  return result;
}

}  // namespace impulse
