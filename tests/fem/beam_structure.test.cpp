#include "fem/bodies/beam_structure.hpp"

#include "fem/explicit/central_difference.hpp"
#include "lib/model/modal_model.hpp"
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

const MassMatrix masses[] = {MassMatrix::lumped, MassMatrix::consistent};

Structure hermite(const Beam& beam, std::size_t elements, MassMatrix mass) {
  return beam_structure(beam, {}, {elements, 1, mass});
}

/// β of elastic mode n, to all digits, for the supports of beams::all_supports.
double exact_wave_number(BeamSupports supports, int n) {
  const double like_ends[] = {4.730040744862704, 7.853204624095838, 10.995607838001671, 14.137165491257464};
  const double cantilever[] = {1.875104068711961, 4.694091132974175, 7.854757438237613, 10.995540734875467};
  if (supports == BeamSupports::simple) return n * pi;
  return supports == BeamSupports::cantilever ? cantilever[n - 1] : like_ends[n - 1];
}

double relative_frequency_error(const Beam& beam, std::size_t elements, MassMatrix mass, int n) {
  const Eigen::Index rigid = beam.supports == BeamSupports::free ? 2 : 0;
  const ModalModel model =
      modal_model(hermite(beam, elements, mass), {.mode_count = static_cast<std::size_t>(n + rigid)});
  const double beta = exact_wave_number(beam.supports, n);
  return model.angular_frequency(n - 1 + rigid) / (beta * beta * beam.slenderness_frequency()) - 1;
}

}  // namespace

TEST_CASE("beam_structure: Hermite elements find frequencies with order 4, whatever the ends and the mass") {
  const std::size_t meshes[] = {24, 32, 48, 64};
  for (const BeamSupports supports : beams::all_supports)
    for (const MassMatrix mass : masses) {
      CAPTURE(static_cast<int>(supports));
      CAPTURE(static_cast<int>(mass));
      const Beam beam = beams::timoshenko(supports, {0.4});
      const bool free_end = supports == BeamSupports::cantilever || supports == BeamSupports::free;
      if (mass == MassMatrix::lumped && free_end) {
        // There terms of higher order, of the other sign, are as large on such meshes.
        for (const int mode : {2, 3})
          CHECK(std::abs(relative_frequency_error(beam, 16, mass, mode)) >
                256 * std::abs(relative_frequency_error(beam, 64, mass, mode)));
        continue;
      }
      // Where the leading term alone is left but rounding (1e-9, of the largest eigenvalue) not yet felt.
      const int mode = mass == MassMatrix::lumped && supports == BeamSupports::clamped ? 1 : 3;
      std::vector<double> errors;
      for (const std::size_t elements : meshes) errors.push_back(relative_frequency_error(beam, elements, mass, mode));
      for (const double error : errors) CHECK((error > 0) == (mass == MassMatrix::consistent));
      for (std::size_t i = 1; i < 4; ++i) {
        const double finer = static_cast<double>(meshes[i]) / static_cast<double>(meshes[i - 1]);
        CHECK(std::log(errors[i - 1] / errors[i]) / std::log(finer) == about(4).epsilon(0.025));
      }
    }
}

TEST_CASE("beam_structure: of a simply supported beam ω² errs by (βh/L)⁴/720, one way and the other") {
  const Beam beam = beams::timoshenko();
  for (const MassMatrix mass : masses) {
    const double theta = 3 * pi / 30;
    const double expected = (mass == MassMatrix::consistent ? 1 : -1) * std::pow(theta, 4) / 1440;
    CHECK(relative_frequency_error(beam, 30, mass, 3) == about(expected).epsilon(0.03));  // the next term is θ²/4
  }
}

TEST_CASE("beam_structure: static deflection at nodes and between them") {
  const auto deflection = [](const Structure& body) {
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factorised(body.stiffness);
    const Eigen::VectorXd answer = factorised.solve(Eigen::VectorXd(body.contacts.col(0)));
    return body.contacts.col(0).dot(answer);
  };
  for (const MassMatrix mass : masses) {
    // At a node exact, whatever the mesh; 1e-12: the condition of 8 elements.
    const Beam beam = beams::timoshenko(BeamSupports::simple, {0.25});
    const double exact = beam.flexibility_m_per_N() * std::pow(0.25 * 0.75, 2) / 3;
    CHECK(deflection(hermite(beam, 8, mass)) == about(exact).epsilon(1e-12));
    // In the middle of an element the interpolation misses a third of what the element, clamped, would give there
    // (h³/192EI), and the spline all that its rotations would; both fall with h³.
    for (const BeamSupports supports : {BeamSupports::simple, BeamSupports::clamped, BeamSupports::cantilever}) {
      const Beam between = beams::timoshenko(supports, {0.5});
      std::vector<double> errors;
      for (const std::size_t elements : {3u, 5u, 9u, 15u}) {
        const double at_node = deflection(hermite(between, 2 * elements, mass));
        errors.push_back(at_node - deflection(hermite(between, elements, mass)));
      }
      const double lengths[] = {3, 5, 9, 15};
      for (std::size_t i = 1; i < 4; ++i)
        CHECK(std::log(errors[i - 1] / errors[i]) / std::log(lengths[i] / lengths[i - 1]) == about(3).epsilon(0.03));
    }
  }
}

TEST_CASE("beam_structure: a free beam carries its mass and floats without strain; contacts translate with it") {
  for (const MassMatrix mass : masses) {
    const Beam beam = beams::timoshenko(BeamSupports::free, {0.0, 0.37, 0.5, 1.0});
    const ModalModel model = modal_model(hermite(beam, 21, mass), {.mode_count = 2});
    CHECK(model.angular_frequency.isZero(0));
    // Both rigid modes together, whatever their mixture: 1/m + 12 (ξ-½)²/m.
    for (Eigen::Index i = 0; i < 4; ++i) {
      const double s = beam.contacts_at[static_cast<std::size_t>(i)] - 0.5;
      CHECK(model.participation.col(i).squaredNorm() * beam.mass_kg() == about(1 + 12 * s * s).epsilon(1e-9));
    }
  }
}

TEST_CASE("beam_structure: a mesh by step is stable at that step, and no coarser than it needs to be") {
  for (const BeamSupports supports : beams::all_supports)
    for (const double step_us : {0.05, 0.3, 2.0}) {
      CAPTURE(static_cast<int>(supports));
      CAPTURE(step_us);
      const Beam beam = beams::timoshenko(supports, {0.4});
      const BeamMesh mesh = beam_mesh_by_step(beam, {}, step_us * 1e-6);
      CHECK(mesh.mass == MassMatrix::lumped);
      CHECK(stability_limit_s(beam_structure(beam, {}, mesh)) >= step_us * 1e-6 * (1 - 1e-9));
      CHECK(stability_limit_s(hermite(beam, mesh.along + 4, MassMatrix::lumped)) < step_us * 1e-6);
    }
}

TEST_CASE("beam_structure: the lumped mass is diagonal and takes 7 times longer steps than the consistent one") {
  const Beam beam = beams::timoshenko();
  const Structure lumped = hermite(beam, 40, MassMatrix::lumped),
                  consistent = hermite(beam, 40, MassMatrix::consistent);
  CHECK(lumped.mass.nonZeros() == lumped.mass.rows());
  CHECK(lumped.mass.rows() == 39);
  CHECK(consistent.mass.rows() == 80);
  CHECK(lumped.mass.sum() == about(beam.mass_kg() * 39 / 40));  // a quarter element at each support is held
  CHECK(stability_limit_s(lumped) / stability_limit_s(consistent) == about(std::sqrt(2520 / 48.0)).epsilon(0.02));
}

TEST_CASE("beam_structure: refuses meshes and beams that cannot be") {
  const Beam beam = beams::timoshenko();
  const auto refuses = [](auto call, const char* message) {
    CHECK_THROWS_WITH_AS((void)call(), doctest::Contains(message), std::invalid_argument);
  };
  refuses([&] { return beam_mesh_by_count(beam, {}, 1, MassMatrix::consistent); },
          "1 element along the beam is too few");
  refuses([&] { return hermite(beam, 2001, MassMatrix::consistent); },
          "2001 elements along the beam lose its low modes");
  refuses([&] { return hermite(beams::timoshenko(BeamSupports::clamped, {1}), 4, MassMatrix::lumped); },
          "is a support");
  refuses([&] { return beam_mesh_by_step(beam, {}, 0); }, "step 0 s is not positive");
  refuses([&] { return beam_mesh_by_step(beam, {}, 1e-3); }, "is too long for a beam of two elements");
  refuses([&] { return beam_mesh_by_step(beam, {}, 1e-12); }, "stable for more than 2000 elements");
}
