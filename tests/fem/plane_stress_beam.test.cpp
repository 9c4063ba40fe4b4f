#include "fem/bodies/plane_stress_beam.hpp"

#include "fem/explicit/central_difference.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/numerics/roots.hpp"
#include "tests/support/about.hpp"
#include "tests/support/beams.hpp"

#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace impulse;
using std::numbers::pi;

namespace {

BeamModel plane_stress(double patch_m, Quadrilateral kind = Quadrilateral::incompatible) {
  return {BeamElement::plane_stress, kind, patch_m};
}

/// NAFEMS FV5: 10 m long, 2 m square.
Beam deep_beam() {
  Beam beam = beams::timoshenko();
  beam.length_m = 10;
  beam.width_m = beam.height_m = 2;
  beam.material = parse_material("200GPa:8000kg/m3:0.3");
  return beam;
}

/// Frequencies of the modes that bend: those that the middle or the quarter point takes part in.
std::vector<double> bending_frequencies_Hz(const Beam& whole, const BeamModel& model, std::size_t along,
                                           std::size_t count) {
  Beam beam = whole;
  beam.contacts_at = {0.5, 0.25, 1.0 / 3};
  const ModalModel modes = modal_model(
      beam_structure(beam, model, beam_mesh_by_count(beam, model, along, MassMatrix::consistent)), {.mode_count = 12});
  std::vector<double> found;
  for (Eigen::Index i = 0; i < modes.mode_count() && found.size() < count; ++i)
    if (modes.participation.row(i).cwiseAbs().maxCoeff() > 0.3 / std::sqrt(beam.mass_kg()))
      found.push_back(modes.angular_frequency(i) / (2 * pi));
  return found;
}

double static_flexibility(const Structure& body) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factorised(body.stiffness);
  const Eigen::VectorXd answer = factorised.solve(Eigen::VectorXd(body.contacts.col(0)));
  return body.contacts.col(0).dot(answer);
}

}  // namespace

/// v = 0 and no axial stress at the ends is met by the flexural Lamb wave of wave number k = nπ/L (plane stress):
///   tanh(½bh)/tanh(½ah) = 4abk²/(b² + k²)²,  a² = k² - ω²/c_P², b² = k² - ω²/c_S²
double strip_frequency_Hz(const Beam& beam, int n, double guess_Hz) {
  const double e = beam.material.youngs_modulus_Pa, rho = beam.material.density_kg_per_m3;
  const double nu = *beam.material.poissons_ratio, h = beam.height_m, k = n * pi / beam.length_m;
  const auto mismatch = [&](double f) {
    const double w2 = std::pow(2 * pi * f, 2);
    const double a = std::sqrt(k * k - w2 * rho * (1 - nu * nu) / e),
                 b = std::sqrt(k * k - w2 * rho * 2 * (1 + nu) / e);
    return std::tanh(a * h / 2) * std::pow(b * b + k * k, 2) - 4 * a * b * k * k * std::tanh(b * h / 2);
  };
  return bracketed_root(mismatch, 0.97 * guess_Hz, 1.03 * guess_Hz);
}

TEST_CASE("plane_stress_beam: NAFEMS FV5, bending of a deep simply supported beam, with order 2 to the exact strip") {
  const double nafems[] = {42.649, 148.31, 284.55};
  std::vector<std::vector<double>> f;
  for (const std::size_t along : {20u, 40u, 80u, 120u})
    f.push_back(bending_frequencies_Hz(deep_beam(), plane_stress(0.5), along, 3));
  for (std::size_t n = 0; n < 3; ++n) {
    CAPTURE(n);
    const double exact = strip_frequency_Hz(deep_beam(), static_cast<int>(n) + 1, nafems[n]);
    const auto error = [&](std::size_t level) { return f[level][n] / exact - 1; };
    CHECK(std::log2(error(0) / error(1)) == about(2).epsilon(0.05));
    CHECK(std::log2(error(1) / error(2)) == about(2).epsilon(0.05));
    CHECK(std::log(error(2) / error(3)) / std::log(1.5) == about(2).epsilon(0.05));
    // Extrapolated by its order it is the strip's; which lies within 0.2 % of NAFEMS' value (a series for a thick
    // beam).
    const double extrapolated = f[3][n] + (f[3][n] - f[2][n]) / (1.5 * 1.5 - 1);
    CHECK(extrapolated == about(exact).epsilon(5e-5));
    CHECK(extrapolated == about(nafems[n]).epsilon(2e-3));
  }
}

TEST_CASE("plane_stress_beam: plain elements bend too stiffly, incompatible ones do not") {
  const Beam beam = beams::timoshenko();
  const double exact = pi * pi * beam.slenderness_frequency() / (2 * pi);
  const double plain = bending_frequencies_Hz(beam, plane_stress(0.01, Quadrilateral::bilinear), 26, 1).front();
  const double bent = bending_frequencies_Hz(beam, plane_stress(0.01), 26, 1).front();
  CHECK(plain / exact > 1.05);
  // Shear and rotary inertia lower the first frequency by ½(π h/L)²(1 + 2(1+ν)/κ)/12 = 0.7 %.
  CHECK(bent / exact == about(0.993).epsilon(0.003));
}

TEST_CASE("plane_stress_beam: the patch presses with its whole force, wherever it lies on the mesh") {
  for (const double at : {0.5, 0.37, 0.1}) {
    Beam beam = beams::timoshenko(BeamSupports::free, {at});
    for (const double patch : {0.0005, 0.006, 0.02}) {
      const Structure body = beam_structure(beam, plane_stress(patch), {25, 3, MassMatrix::lumped});
      CHECK(body.contacts.sum() == about(-1).epsilon(1e-13));
      // Its moment about ξ = 0: nodes of the top face are every fourth node from the third.
      double moment = 0;
      for (Eigen::Index i = 0; i <= 25; ++i)
        moment -= body.contacts(2 * (4 * i + 3) + 1, 0) * static_cast<double>(i) / 25;
      CHECK(moment == about(at).epsilon(1e-12));
      CHECK(body.wave_admittance(0, 0) == about(1 / (std::sqrt(215.75e9 * 7960 / 0.91) * patch * 0.01)).epsilon(1e-12));
    }
  }
}

TEST_CASE("plane_stress_beam: a slender beam under a wide patch yields like Euler-Bernoulli's") {
  for (const BeamSupports supports : {BeamSupports::simple, BeamSupports::clamped, BeamSupports::cantilever}) {
    Beam beam = beams::timoshenko(supports, {0.5});
    beam.height_m = beam.length_m / 100;
    const double exact = beam.flexibility_m_per_N() * (supports == BeamSupports::simple    ? 1.0 / 48
                                                       : supports == BeamSupports::clamped ? 1.0 / 192
                                                                                           : 1.0 / 24);
    // Shear adds 2.6·1.2·4·(h/L)²·(1 to 4) < 0.5 %, clamped ends that cannot swell take 0.3 %.
    CHECK(static_flexibility(beam_structure(beam, plane_stress(beam.height_m), {200, 2, MassMatrix::lumped})) ==
          about(exact).epsilon(6e-3));
  }
}

TEST_CASE("plane_stress_beam: a mesh by step is stable at that step") {
  for (const Quadrilateral kind : {Quadrilateral::bilinear, Quadrilateral::incompatible})
    for (const double step_us : {0.2, 0.7}) {
      const Beam beam = beams::timoshenko(BeamSupports::free);
      const BeamModel model = plane_stress(0.005, kind);
      const BeamMesh mesh = beam_mesh_by_step(beam, model, step_us * 1e-6);
      CHECK(mesh.along % 2 == 0);
      CHECK(mesh.through % 2 == 0);
      CHECK(stability_limit_s(beam_structure(beam, model, mesh)) >= step_us * 1e-6);
    }
}

TEST_CASE("plane_stress_beam: refuses patches and meshes that cannot be") {
  const Beam beam = beams::timoshenko();
  const auto refuses = [](const Beam& body, double patch, const BeamMesh& mesh, const char* message) {
    CHECK_THROWS_WITH_AS((void)beam_structure(body, plane_stress(patch), mesh), doctest::Contains(message),
                         std::invalid_argument);
  };
  refuses(beam, 0, {26, 2}, "plane stress needs a patch to press on");
  refuses(beams::timoshenko(BeamSupports::simple, {0.01}), 0.01, {26, 2}, "reaches beyond the beam's end");
  refuses(beam, 0.16, {26, 2}, "reaches beyond the beam's end");
  refuses(beam, 0.01, {25, 2}, "25 x 2 elements have no node in the middle");
  refuses(beam, 0.01, {26, 3}, "26 x 3 elements have no node in the middle");
  Beam without = beam;
  without.material.poissons_ratio.reset();
  refuses(without, 0.01, {26, 2}, "plane stress needs Poisson's ratio");
}
