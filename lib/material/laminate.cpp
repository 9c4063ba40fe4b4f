#include "lib/material/laminate.hpp"

#include "lib/contract/require.hpp"
#include "lib/material/layup.hpp"

#include <cmath>
#include <numbers>

namespace impulse {
namespace {

/// Cosine and sine of an angle in degrees, exact at multiples of 90°, so that a cross-ply has no spurious coupling.
Eigen::Vector2d direction(double angle_deg) {
  const double turns = std::remainder(angle_deg, 360.0);
  const double quarter = std::round(turns / 90);
  const double rest = (turns - 90 * quarter) * std::numbers::pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch ((static_cast<int>(quarter) + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

Eigen::Matrix3d plane_stress_stiffness(const Ply& ply) {
  const double nu12 = ply.poissons_ratio_12, nu21 = nu12 * ply.modulus_2_Pa / ply.modulus_1_Pa;
  const double scale = 1 / (1 - nu12 * nu21);
  Eigen::Matrix3d q = Eigen::Matrix3d::Zero();
  q(0, 0) = scale * ply.modulus_1_Pa;
  q(1, 1) = scale * ply.modulus_2_Pa;
  q(0, 1) = q(1, 0) = scale * nu12 * ply.modulus_2_Pa;
  q(2, 2) = ply.shear_modulus_12_Pa;
  return q;
}

void clear_below(double magnitude, Eigen::Matrix3d& matrix) {
  matrix = (matrix.array().abs() <= magnitude).select(0.0, matrix);
}

EngineeringConstants constants_of(const Eigen::Matrix3d& compliance) {
  return {1 / compliance(0, 0),
          1 / compliance(1, 1),
          1 / compliance(2, 2),
          -compliance(0, 1) / compliance(0, 0),
          -compliance(0, 1) / compliance(1, 1),
          compliance(0, 2) / compliance(0, 0),
          compliance(1, 2) / compliance(1, 1)};
}

}  // namespace

Laminate laminate(const std::vector<Layer>& layers) {
  require(!layers.empty(), "a laminate without layers has no stiffness");
  Laminate result;
  for (const Layer& layer : layers) {
    require_valid(layer.ply);
    require(std::isfinite(layer.thickness_m) && layer.thickness_m > 0,
            "a layer of thickness {} m is not positive and finite", layer.thickness_m);
    require(std::isfinite(layer.angle_deg), "a layer has the angle {}", layer.angle_deg);
    result.thickness_m += layer.thickness_m;
  }
  double bottom = -result.thickness_m / 2;
  for (const Layer& layer : layers) {
    const double t = layer.thickness_m, middle = bottom + t / 2, second = t * (middle * middle + t * t / 12);
    bottom += t;
    const Eigen::Vector2d d = direction(layer.angle_deg);
    const double c = d(0), s = d(1);
    Eigen::Matrix3d strain;  // of the ply axes from those of x, y
    strain << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
    const Eigen::Matrix3d q = strain.transpose() * plane_stress_stiffness(layer.ply) * strain;
    result.extension += q * t;
    result.coupling += q * (t * middle);
    result.bending += q * second;
    Eigen::Matrix2d turn;  // γ23, γ13 from γyz, γxz
    turn << c, -s, s, c;
    const Eigen::Vector2d g(layer.ply.shear_modulus_23_Pa, layer.ply.shear_modulus_13_Pa);
    result.transverse_shear += turn.transpose() * g.asDiagonal() * turn * t;
    result.mass_kg_per_m2 += layer.ply.density_kg_per_m3 * t;
    result.mass_moment_kg_per_m += layer.ply.density_kg_per_m3 * t * middle;
    result.rotary_inertia_kg += layer.ply.density_kg_per_m3 * second;
  }
  // A symmetric layup sums to exactly no coupling, so that callers can tell.
  const double h = result.thickness_m, rounding = 1e-14 * static_cast<double>(layers.size());
  clear_below(rounding * h * result.extension.norm(), result.coupling);
  clear_below(rounding * result.extension.norm(), result.extension);
  clear_below(rounding * result.bending.norm(), result.bending);
  if (std::abs(result.mass_moment_kg_per_m) <= rounding * h * result.mass_kg_per_m2) result.mass_moment_kg_per_m = 0;
  return result;
}

std::vector<Layer> layers_of(const std::string& layup, const Ply& ply, double total_thickness_m) {
  const std::vector<double> angles = parse_layup(layup);
  std::vector<Layer> layers;
  layers.reserve(angles.size());
  for (const double angle : angles)
    layers.push_back({ply, angle, total_thickness_m / static_cast<double>(angles.size())});
  return layers;
}

LaminateConstants engineering_constants(const Laminate& laminate) {
  const double h = laminate.thickness_m;
  // Scaled to one unit, or the blocks differ by h² in size and the inverse loses as much.
  Eigen::Matrix<double, 6, 6> stiffness;
  stiffness << laminate.extension / h, laminate.coupling / (h * h / 2), laminate.coupling / (h * h / 2),
      laminate.bending / (h * h * h / 12) / 3;
  const Eigen::Matrix<double, 6, 6> compliance = stiffness.inverse();
  return {constants_of(compliance.topLeftCorner<3, 3>()), constants_of(compliance.bottomRightCorner<3, 3>() / 3)};
}

}  // namespace impulse
