#include "impulse/bodies/missing_answer.hpp"

#include "impulse/bodies/ritz_supports.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "lib/numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace impulse {
namespace {

/// Beyond the degree of the series: s is smooth along the edges, and r ln r times smooth along a ray from the force.
constexpr std::size_t extra_points = 12;

Eigen::MatrixXd solved(const Eigen::MatrixXd& k, const Eigen::MatrixXd& right) {
  const auto factor = DenseCholesky::of(k);
  if (!factor) throw std::runtime_error("the plate's stiffness is not positive definite to rounding; use fewer terms");
  return factor->solve(right);
}

/// The lowest elastic ω² of a plate that has rigid motions [rad²/s²], roughly.
std::optional<double> lowest_beside_rigid(const Plate& plate) {
  const std::size_t rigid_and_one = 7;
  const ModalModel modes = modal_model(RitzPlate(plate, 6).structure(), {.mode_count = rigid_and_one});
  if (modes.angular_frequency(0) > 0) return std::nullopt;
  return std::pow(*std::ranges::find_if(modes.angular_frequency, [](double omega) { return omega > 0; }), 2);
}

/// y with K y = a where K leaves rigid motions, on which a does no work; theirs are those of M⁻¹b. With a shift K is
/// definite; rigid motions stay as the first solution has them, and what is wrong with the others is divided by 30 or
/// more each time.
Eigen::MatrixXd relieved_solution(const DenseStructure& body, double lowest, const Eigen::MatrixXd& a,
                                  const Eigen::MatrixXd& b) {
  const double shift = lowest / 30;
  const auto factor = DenseCholesky::of(body.stiffness + shift * body.mass);
  if (!factor) throw std::runtime_error("the plate's stiffness is lost to rounding; use fewer terms");
  Eigen::MatrixXd y = factor->solve(a + shift * b);
  for (int i = 0; i < 9; ++i) y = factor->solve(a + shift * (body.mass * y));
  return y;
}

}  // namespace

MissingAnswer::MissingAnswer(const RitzPlate& plate, const DenseStructure& body,
                             const std::vector<Eigen::Vector2d>& forces)
    : plate_(plate),
      strains_(strain_operators(plate.plate())),
      motions_(motion_operators(plate.plate())),
      singularity_(plate.plate().laminate),
      forces_(forces) {
  require(plate.plate().theory == Plate::Theory::thin, "a point force on a shear-deformable plate has no limit");
  const Eigen::SparseMatrix<double> unheld = plate.coefficients();
  const Eigen::MatrixXd h = held_series();
  Eigen::MatrixXd elastic = plate.unheld_stiffness() * h, inertial = Eigen::MatrixXd::Zero(h.rows(), h.cols());
  const std::optional<double> rigid = lowest_beside_rigid(plate.plate());
  if (rigid) inertial = plate.unheld_mass() * h;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    std::vector<PlateLoad> stress = loads(i), inertia = stress;
    for (PlateLoad& load : stress) load.forces.setZero();
    elastic.col(column) += plate.unheld_work(stress) + spring_work(i);
    if (!rigid) continue;
    for (PlateLoad& load : inertia) load.resultants.setZero();
    inertial.col(column) += plate.unheld_work(inertia);
  }
  const Eigen::MatrixXd a = unheld.transpose() * elastic, b = unheld.transpose() * inertial;
  series_ = h - unheld * (rigid ? relieved_solution(body, *rigid, a, b) : solved(body.stiffness, a));
}

double MissingAnswer::singular_work(const PlateLoad& load, std::size_t force) const {
  const PlateShape& shape = plate_.plate().shape;
  const Eigen::Vector2d offset = shape.position(load.reference) - shape.position(forces_[force]);
  if (offset.isZero(0)) return 0;  // of w itself, and a weight of 0 where s has a pole
  const Eigen::Matrix<double, 3, derivative_count> s = singularity_.at(offset);
  double work = 0;
  for (std::size_t f = 0; f < strains_.size(); ++f)
    work += (load.resultants.transpose() * strains_[f].operators + load.forces.transpose() * motions_[f].operators)
                .dot(s.row(static_cast<Eigen::Index>(strains_[f].field)));
  return work;
}

/// The coefficients that edges hold, so that along them s + h has what they hold at zero.
Eigen::MatrixXd MissingAnswer::held_series() const {
  const Plate& plate = plate_.plate();
  const Eigen::SparseMatrix<double> held = series_supports(plate, static_cast<Eigen::Index>(plate_.term_count())).held;
  const auto force_count = static_cast<Eigen::Index>(forces_.size());
  if (held.cols() == 0) return Eigen::MatrixXd::Zero(held.rows(), force_count);
  const QuadratureRule rule = gauss_legendre(plate_.term_count() + extra_points);
  std::vector<PlateLoad> conditions;
  for (std::size_t e = 0; e < 4; ++e) {
    const Eigen::Matrix<double, 5, 5> motions = edge_motions(plate.shape, e);
    const std::array<bool, 5> holds = held_motions(plate.edges[e]);
    const double length = plate.shape.edge(e).norm();
    // A thin edge that doesn't deflect doesn't turn along itself; displacements only where the plate has them.
    for (const Eigen::Index k : {0, 1, 2, 3}) {
      if (!holds[static_cast<std::size_t>(k)] || ((k == 1 || k == 2) && !moves_in_plane(plate))) continue;
      for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
        conditions.push_back(no_load(plate, along_edge(e, rule.points(q))));
        conditions.back().forces = motions.row(k) * (std::sqrt(rule.weights(q)) * (k == 3 ? length : 1));
      }
    }
  }
  Eigen::MatrixXd of_held(static_cast<Eigen::Index>(conditions.size()), held.cols());
  Eigen::MatrixXd of_singularity(of_held.rows(), force_count);
  for (std::size_t r = 0; r < conditions.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    of_held.row(row) = held.transpose() * plate_.unheld_work({conditions[r]});
    for (std::size_t i = 0; i < forces_.size(); ++i)
      of_singularity(row, static_cast<Eigen::Index>(i)) = singular_work(conditions[r], i);
  }
  return -(held * of_held.colPivHouseholderQr().solve(of_singularity));
}

/// Stresses and momenta of s over the plate, by triangles between the force and the edges.
std::vector<PlateLoad> MissingAnswer::loads(std::size_t force) const {
  const Plate& plate = plate_.plate();
  const Eigen::MatrixXd stiffness = stiffness_weight(plate), mass = mass_weight(plate);
  const Eigen::Vector2d centre = plate.shape.position(forces_[force]);
  const QuadratureRule rule = gauss_legendre(plate_.term_count() + extra_points);
  const QuadratureRule ray = gauss_legendre(3 * plate_.term_count() / 2 + extra_points);
  std::vector<PlateLoad> result;
  for (std::size_t e = 0; e < 4; ++e) {
    const Eigen::Vector2d from = plate.shape.corners[e] - centre, along = plate.shape.edge(e);
    const double area = std::abs(from.x() * along.y() - from.y() * along.x()) / 2;
    for (Eigen::Index p = 0; p < ray.points.size() && area > 0; ++p)
      for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
        // r = ρ² takes the logarithm's sting out of r ln r dr.
        const double rho = (1 + ray.points(p)) / 2, r = rho * rho;
        const Eigen::Vector2d offset = r * (from + (1 + rule.points(q)) / 2 * along);
        const double weight = area * r * rho * ray.weights(p) * rule.weights(q);
        const Eigen::Matrix<double, 3, derivative_count> s = singularity_.at(offset);
        PlateLoad load = no_load(plate, plate.shape.reference(centre + offset));
        for (std::size_t f = 0; f < strains_.size(); ++f) {
          const auto of_field = s.row(static_cast<Eigen::Index>(strains_[f].field)).transpose();
          load.resultants += strains_[f].operators * of_field;
          load.forces += motions_[f].operators * of_field;
        }
        load.resultants = weight * (stiffness * load.resultants);
        load.forces = weight * (mass * load.forces);
        result.push_back(load);
      }
  }
  return result;
}

Eigen::VectorXd MissingAnswer::spring_work(std::size_t force) const {
  const Plate& plate = plate_.plate();
  const QuadratureRule rule = gauss_legendre(plate_.term_count() + extra_points);
  std::vector<PlateLoad> result;
  for (std::size_t e = 0; e < 4; ++e) {
    const Eigen::Matrix<double, 5, 5> motions = edge_motions(plate.shape, e);
    const std::array<double, 5> springs = spring_stiffness(plate.springs[e]);
    for (std::size_t k = 0; k < springs.size(); ++k)
      for (Eigen::Index q = 0; q < rule.points.size() && springs[k] > 0; ++q) {
        PlateLoad load = no_load(plate, along_edge(e, rule.points(q)));
        load.forces = motions.row(static_cast<Eigen::Index>(k));
        load.forces *= springs[k] * rule.weights(q) * plate.shape.edge(e).norm() / 2 * singular_work(load, force);
        result.push_back(load);
      }
  }
  return plate_.unheld_work(result);
}

Eigen::RowVectorXd MissingAnswer::missing(const PlateLoad& load) const {
  Eigen::RowVectorXd result = plate_.unheld_work({load}).transpose() * series_;
  for (std::size_t i = 0; i < forces_.size(); ++i) result(static_cast<Eigen::Index>(i)) += singular_work(load, i);
  return result;
}

Eigen::RowVectorXd MissingAnswer::deflection(const Eigen::Vector2d& reference) const {
  return missing(motion_load(plate_.plate(), reference, motion_w));
}

Eigen::MatrixXd MissingAnswer::strains(const Eigen::Vector2d& reference, double z_m) const {
  Eigen::MatrixXd result(3, series_.cols());
  for (Eigen::Index i = 0; i < 3; ++i) result.row(i) = missing(strain_load(plate_.plate(), reference, i, z_m));
  for (std::size_t i = 0; i < forces_.size(); ++i)
    if ((reference - forces_[i]).norm() < 1e-9) result.col(static_cast<Eigen::Index>(i)).setZero();
  return result;
}

Eigen::MatrixXd MissingAnswer::flexibility() const {
  Eigen::MatrixXd result(series_.cols(), series_.cols());
  for (std::size_t i = 0; i < forces_.size(); ++i) result.row(static_cast<Eigen::Index>(i)) = deflection(forces_[i]);
  return (result + result.transpose()) / 2;
}

}  // namespace impulse
