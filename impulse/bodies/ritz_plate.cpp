#include "impulse/bodies/ritz_plate.hpp"

#include "impulse/bodies/ritz_supports.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "lib/numerics/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace impulse {

RitzPlate::RitzPlate(const Plate& plate, std::size_t terms)
    : plate_(plate),
      values_(terms, RitzBasis::Ends::values),
      slopes_(std::max<std::size_t>(terms, 4), RitzBasis::Ends::slopes) {
  require_valid(plate);
  require(plate.theory == Plate::Theory::shear || terms >= 4, "{} terms a side make no thin plate; use at least 4",
          terms);
  coefficients_ = series_supports(plate, values_.size()).unheld;
  require(unknown_count() > 0, "the edges hold every term of {} a side; use more", terms);
}

std::vector<FormField> RitzPlate::on_series(const std::vector<FieldOperator>& fields) const {
  const bool thin = plate_.theory == Plate::Theory::thin;
  std::vector<FormField> result;
  for (const FieldOperator& f : fields)
    result.push_back({thin && f.field == PlateField::w ? &slopes_ : &values_, f.operators});
  return result;
}

Eigen::VectorXd RitzPlate::unheld_work(const std::vector<PlateLoad>& loads) const {
  const std::vector<FieldOperator> strains = strain_operators(plate_), motions = motion_operators(plate_);
  const std::vector<FormField> fields = on_series(strains);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(coefficients_.rows());
  for (const PlateLoad& load : loads) {
    Eigen::Index begin = 0;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const RitzBasis& basis = *fields[f].basis;
      const Eigen::Index size = basis.size() * basis.size();
      const DerivativeRow row =
          load.resultants.transpose() * strains[f].operators + load.forces.transpose() * motions[f].operators;
      result.segment(begin, size) += field_functional(basis, plate_.shape, load.reference, row);
      begin += size;
    }
  }
  return result;
}

Eigen::MatrixXd RitzPlate::unheld_stiffness() const {
  Eigen::MatrixXd stiffness = tensor_form(on_series(strain_operators(plate_)), stiffness_weight(plate_), plate_.shape,
                                          quadrature_points(plate_.shape, term_count()));
  add_springs(stiffness);
  return stiffness;
}

Eigen::MatrixXd RitzPlate::unheld_mass() const {
  return tensor_form(on_series(motion_operators(plate_)), mass_weight(plate_), plate_.shape,
                     quadrature_points(plate_.shape, term_count()) + 1);
}

void RitzPlate::add_springs(Eigen::MatrixXd& stiffness) const {
  const QuadratureRule rule = gauss_legendre(term_count());
  for (std::size_t e = 0; e < 4; ++e) {
    const std::array<double, 5> springs = spring_stiffness(plate_.springs[e]);
    const Eigen::Matrix<double, 5, 5> motions = edge_motions(plate_.shape, e);
    const double half_length = plate_.shape.edge(e).norm() / 2;
    for (std::size_t k = 0; k < springs.size(); ++k) {
      if (springs[k] == 0) continue;
      Eigen::MatrixXd samples(rule.points.size(), stiffness.rows());
      for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
        PlateLoad load = no_load(plate_, along_edge(e, rule.points(q)));
        load.forces = motions.row(static_cast<Eigen::Index>(k)) * std::sqrt(springs[k] * rule.weights(q) * half_length);
        samples.row(q) = unheld_work({load});
      }
      add_transposed_product(samples, samples, stiffness);
    }
  }
}

Eigen::MatrixXd RitzPlate::of_unknowns(const Eigen::MatrixXd& form) const {
  return coefficients_.transpose() * (form * coefficients_);
}

DenseStructure RitzPlate::structure() const {
  DenseStructure body;
  body.stiffness = of_unknowns(unheld_stiffness());
  body.mass = of_unknowns(unheld_mass());
  body.contacts.resize(unknown_count(), 0);
  return body;
}

Eigen::VectorXd RitzPlate::deflection(const Eigen::Vector2d& reference) const {
  return coefficients_.transpose() * unheld_work({motion_load(plate_, reference, motion_w)});
}

Eigen::VectorXd RitzPlate::mean_deflection(const Eigen::Vector2d& reference, double radius_m) const {
  require(std::isfinite(radius_m) && radius_m > 0, "the radius {} m of a patch is not positive and finite", radius_m);
  const Eigen::Vector2d centre = plate_.shape.position(reference);
  const double room = plate_.shape.distance_to_boundary(centre);
  require(radius_m <= room,
          "a patch of radius {:.4g} m about x = {:.4g} m, y = {:.4g} m leaves the plate (an edge is {:.4g} m away)",
          radius_m, centre.x(), centre.y(), room);
  // A polynomial of degree 2(n - 1) in x and y is integrated exactly by n points along the radius, of weight r, and 2n
  // round the disc; the inverse of a bilinear map is so smooth over a disc inside that the same rule will do.
  const QuadratureRule rule = gauss_legendre(static_cast<std::size_t>(values_.size()));
  const Eigen::Index turns = 2 * values_.size();
  std::vector<PlateLoad> pressure;
  for (Eigen::Index p = 0; p < rule.points.size(); ++p) {
    const double r = (1 + rule.points(p)) / 2;
    for (Eigen::Index t = 0; t < turns; ++t) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(t) / static_cast<double>(turns);
      const Eigen::Vector2d at = centre + radius_m * r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      PlateLoad load = motion_load(plate_, plate_.shape.reference(at), motion_w);
      load.forces *= rule.weights(p) * r / static_cast<double>(turns);
      pressure.push_back(load);
    }
  }
  return coefficients_.transpose() * unheld_work(pressure);
}

Eigen::MatrixXd RitzPlate::strains(const Eigen::Vector2d& reference, double z_m) const {
  require(std::abs(z_m) <= plate_.laminate.thickness_m / 2 * (1 + 1e-9), "z = {} m is outside the plate", z_m);
  Eigen::MatrixXd result(unknown_count(), 3);
  for (Eigen::Index i = 0; i < 3; ++i)
    result.col(i) = coefficients_.transpose() * unheld_work({strain_load(plate_, reference, i, z_m)});
  return result;
}

}  // namespace impulse
