#include "fem/bodies/axisymmetric_solid.hpp"
#include "impulse/exact/bar_modes.hpp"
#include "impulse/exact/pochhammer_chree.hpp"
#include "lib/model/modal_model.hpp"
#include "tests/support/about.hpp"
#include "tests/support/section_mesh.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace impulse {
namespace {

constexpr double pi = std::numbers::pi;

/// Phase velocity over √(E/ρ) of the wave of length 2ℓ on a cylinder of diameter d with sliding ends ℓ apart: its first
/// mode is that wave exactly.
double phase_velocity_ratio(double d_per_wavelength, double poissons_ratio) {
  const double diameter = 1, length = diameter / (2 * d_per_wavelength);
  const int rows = std::max(12, static_cast<int>(std::ceil(8 * length)));
  const AxisymmetricSolid solid{.mesh = rectangle_mesh(0, diameter / 2, length, 8, rows),
                                .materials = {isotropic_elasticity({"unit", 1, 1, poissons_ratio})},
                                .contacts = {},
                                .end_a = EndSupport::sliding,
                                .end_b = EndSupport::sliding};
  SolidStructure body = axisymmetric_structure(solid);
  // Modes that do not vary along the axis (breathing) do not take part in u_z = sin(πz/ℓ); of those that do, the lowest
  // is the first longitudinal one.
  Eigen::VectorXd wave = Eigen::VectorXd::Zero(body.structure.mass.rows());
  for (Eigen::Index node = 0; node < solid.mesh.node_count(); ++node)
    if (body.freedoms(node, 1) >= 0) wave(body.freedoms(node, 1)) = std::sin(pi * solid.mesh.nodes(node, 1) / length);
  body.structure.contacts = body.structure.mass * wave;
  body.structure.wave_admittance.resize(0, 0);
  const ModalModel modes = modal_model(body.structure, {.mode_count = 6});
  const double all = std::sqrt(wave.dot(body.structure.mass * wave));
  for (Eigen::Index i = 0; i < modes.mode_count(); ++i)
    if (std::abs(modes.participation(i, 0)) > 0.1 * all) return modes.angular_frequency(i) * length / pi;
  return 0;
}

TEST_CASE("waves on a cylinder travel at Bancroft's velocities, within 0.1 %, and at the exact ones within 0.01 %") {
  // Bancroft, Phys. Rev. 59 (1941) 588, first longitudinal mode, Poisson's ratio 0.3; digits as tabulated in the
  // reference solutions of dbrizard/dielwa-elba (roundReferenceSolutions.py).
  const std::vector<std::pair<double, double>> bancroft{{0.1, 0.99774}, {0.2, 0.99054}, {0.3, 0.97691}, {0.4, 0.95410},
                                                        {0.5, 0.91854}, {0.6, 0.86964}, {0.8, 0.76357}, {1.0, 0.68814}};
  for (const auto& [d_per_wavelength, ratio] : bancroft) {
    CAPTURE(d_per_wavelength);
    const double ours = phase_velocity_ratio(d_per_wavelength, 0.3);
    CHECK(ours == about(ratio).epsilon(1e-3));
    CHECK(ours == about(pochhammer_chree_speed_ratio(pi * d_per_wavelength, 0.3)).epsilon(1e-4));
  }
}

TEST_CASE("a slender cone's first ten frequencies approach those of rod theory as (d/L)²") {
  // Lateral inertia: rod theory errs by about (ν k r)²/4. Free ends; a mapped mesh, one cell across.
  const auto errors = [](double slenderness) {  // of the mean diameter over the length
    const double length = 1, ra = 0.5 * slenderness * 0.6, rb = 0.5 * slenderness * 1.4;
    const int rows = 200;
    const Material material{"unit", 1, 1, 0.3};
    const TriangleMesh mesh = mapped_mesh(1, rows, [=](double i, double j) {
      const double z = length * j / rows;
      return Eigen::RowVector2d(i * (ra + (rb - ra) * z / length), z);
    });
    const AxisymmetricSolid solid{.mesh = mesh, .materials = {isotropic_elasticity(material)}, .contacts = {}};
    const ModalModel modes = modal_model(axisymmetric_structure(solid).structure, {.mode_count = 11});
    const Bar bar{{{length, 2 * ra, 2 * rb, material}}, {Face::a}, FarEnd::free};
    const ModalModel exact = exact_bar_modes(bar, {.count = 11});
    return Eigen::VectorXd(
        (exact.angular_frequency - modes.angular_frequency).tail(10).cwiseQuotient(exact.angular_frequency.tail(10)));
  };
  std::vector<Eigen::VectorXd> error;
  for (const double slenderness : {0.04, 0.02, 0.01, 0.005}) error.push_back(errors(slenderness));
  for (std::size_t i = 0; i + 1 < error.size(); ++i)
    for (Eigen::Index mode = 0; mode < 10; ++mode) {
      CAPTURE(mode);
      CHECK(std::log2(error[i](mode) / error[i + 1](mode)) == about(2).epsilon(0.05));
    }
}

}  // namespace
}  // namespace impulse
