#pragma once

#include "fem/elements/mass_matrix.hpp"
#include "fem/elements/plane_stress.hpp"
#include "lib/material/beam.hpp"
#include "lib/model/structure.hpp"

#include <cstddef>

namespace impulse {

enum class BeamElement {
  hermite,       ///< bending elements, Euler-Bernoulli: no shear, no rotary inertia, no thickness
  plane_stress,  ///< quadrilaterals: shear, rotary inertia and the thickness are in it
};

/// What a beam is made of.
struct BeamModel {
  BeamElement element = BeamElement::hermite;
  Quadrilateral quadrilateral = Quadrilateral::bilinear;  ///< of plane stress
  double patch_length_m = 0;  ///< of plane stress: each contact is a uniform pressure over this length of the top
                              ///< face, centred, across the whole width; its displacement is the mean over the patch
};

/// How it is divided.
struct BeamMesh {
  std::size_t along = 0;    ///< elements along the length, ≥ 2
  std::size_t through = 1;  ///< through the height; 1 for Hermite elements
  MassMatrix mass = MassMatrix::consistent;
};

/// `along` elements along the length; plane stress gets as many through the height as make them most nearly square, an
/// even number. @throws std::invalid_argument as beam_structure.
[[nodiscard]] BeamMesh beam_mesh_by_count(const Beam& beam, const BeamModel& model, std::size_t along, MassMatrix mass);

/// The finest mesh with lumped mass on which central differences with `step_s` are stable: h² ≥ ½√48 Δt √(EI/(ρA)) for
/// Hermite elements, 2/ω of the single element (plane_stress_highest_frequency) for plane stress.
/// @throws std::invalid_argument if the step is not positive, or naming the longest that works if two elements are
/// already too short. Verified by: tests/fem/beam_structure.test.cpp
[[nodiscard]] BeamMesh beam_mesh_by_step(const Beam& beam, const BeamModel& model, double step_s);

/// Matrices of a beam; contacts are downward deflections at beam.contacts_at, between nodes by shape functions.
///
/// Hermite elements, consistent mass: two degrees of freedom a node, frequencies of order 4 from above. Lumped mass:
/// masses at the nodes and none against rotation; the rotations follow statically and are condensed out, which leaves
/// the deflections of a cubic spline. Frequencies of order 4, of a simply supported beam from below (ω² short by
/// (βh/L)⁴/720); a longest step 7 times that of the consistent mass; between nodes no more flexible than the spline. A
/// free end's masses are 3/8, 7/6, 23/24 of an element's, by which the beam also turns as it should. See
/// docs/decisions/0009-beam-elements.md. Wave admittance: 0.
///
/// Plane stress: u and v of each node, y upwards. `simple` holds v on both end sections and u at the middle of the
/// beam; `clamped` and `cantilever` hold u and v on the end sections. Wave admittance: that of the patch,
/// 1/(ρ c A), c = √(E/(ρ(1-ν²))), A = patch length × width.
/// @throws std::invalid_argument for an invalid beam; fewer than 2 elements or more than 2000 along; for plane stress
/// without a patch inside the beam's length, without Poisson's ratio, or with simple supports and an odd number of
/// elements either way. Verified by: tests/fem/beam_structure.test.cpp, tests/fem/plane_stress_beam.test.cpp
[[nodiscard]] Structure beam_structure(const Beam& beam, const BeamModel& model, const BeamMesh& mesh);

}  // namespace impulse
