#include "impulse/bodies/point_flexibility.hpp"

#include "lib/contract/require.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/numerics/dense_algebra.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

enum class Body { held, free };

/// cᵀ K⁺ c of each point.
Eigen::VectorXd static_flexibility(const RitzPlate& plate, const std::vector<Eigen::Vector2d>& points, Body body) {
  DenseStructure structure = plate.structure();
  structure.contacts.resize(plate.unknown_count(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    structure.contacts.col(static_cast<Eigen::Index>(i)) = plate.deflection(points[i]);
  if (body == Body::held)
    if (const auto factor = DenseCholesky::of(structure.stiffness))
      return structure.contacts.cwiseProduct(factor->solve(structure.contacts)).colwise().sum();
  const std::size_t rigid_and_one = 7;
  const ModalModel modes =
      modal_model(structure, {.mode_count = rigid_and_one, .residual = ModalOptions::Residual::attached});
  Eigen::VectorXd sum = modes.residual_flexibility.diagonal();
  for (Eigen::Index i = 0; i < modes.mode_count(); ++i)
    if (modes.angular_frequency(i) > 0)
      sum += (modes.participation.row(i) / modes.angular_frequency(i)).array().square().matrix().transpose();
  return sum;
}

}  // namespace

Eigen::VectorXd missing_point_flexibility(const RitzPlate& plate, const std::vector<Eigen::Vector2d>& points) {
  require(plate.plate().theory == Plate::Theory::thin, "a point force on a shear-deformable plate has no limit");
  const std::size_t fine = plate.term_count(), steps = std::max<std::size_t>(1, fine / 8);
  if (fine < 8) return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points.size()));
  const RitzPlate coarse(plate.plate(), fine - 2 * steps);
  const ModalModel lowest = modal_model(coarse.structure(), {.mode_count = 1});
  const Body body = lowest.angular_frequency(0) == 0 ? Body::free : Body::held;
  const Eigen::VectorXd of_coarse = static_flexibility(coarse, points, body),
                        of_fine = static_flexibility(plate, points, body);
  const double n = std::pow(static_cast<double>(fine) - 2, 2),
               m = std::pow(static_cast<double>(coarse.term_count()) - 2, 2);
  // A larger space is never stiffer: what is negative is rounding.
  return ((of_fine - of_coarse) * (m / (n - m))).cwiseMax(0);
}

}  // namespace impulse
