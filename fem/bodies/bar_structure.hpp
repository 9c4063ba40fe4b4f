#pragma once

#include "fem/elements/mass_matrix.hpp"
#include "lib/material/profile.hpp"
#include "lib/model/structure.hpp"

#include <cstddef>
#include <vector>

namespace impulse {

/// Elements of a bar: equal lengths within a segment.
struct BarMesh {
  std::vector<std::size_t> elements;  ///< of each segment, from end A; at least 1 each
  MassMatrix mass = MassMatrix::lumped;
};

/// `total_elements` shared out so that the longest travel time h/c of an element is as short as it can be.
/// @throws std::invalid_argument if there are fewer elements than segments, or for an invalid bar.
/// Verified by: tests/fem/bar_structure.test.cpp
[[nodiscard]] BarMesh bar_mesh_by_count(const Bar& bar, std::size_t total_elements,
                                        MassMatrix mass = MassMatrix::lumped);

/// The finest mesh on which central differences with `step_s` are stable with lumped mass: as many elements per segment
/// as have 2/ω ≥ step (bar_element_highest_frequency; for a cylinder that is h/c ≥ step, n = ⌊τ/step⌋, with a
/// relative 1e-12 forgiven so that step = τ/n gives n elements). Waves see Courant numbers as near to 1 as the
/// segments' travel times τ allow; dispersion vanishes where τ/step is a whole number.
/// @throws std::invalid_argument naming the segment and the longest step that works if one element is already too
/// short, or if the step is not positive; and for an invalid bar.
/// Verified by: tests/fem/bar_structure.test.cpp
[[nodiscard]] BarMesh bar_mesh_by_step(const Bar& bar, double step_s, MassMatrix mass = MassMatrix::lumped);

/// Matrices of an elastic bar: one axial displacement per node, positive from end A to end B, nodes in that order. K is
/// tridiagonal; M diagonal or tridiagonal.
/// Contact i is the face bar.faces[i]; its functional points into the body: +u at end A, -u at end B. Wave admittance:
/// diag(1/Z) of the faces' sections. The far end of a bar with one face is free, or fixed (its node eliminated), or
/// infinite: a dashpot Z of the section there, which absorbs every wave of a continuing uniform rod; at Courant number
/// 1 to rounding. A cone does not continue as a cone.
/// @throws std::invalid_argument for an invalid bar, a mesh with another number of segments or an empty segment.
/// Verified by: tests/fem/bar_structure.test.cpp
[[nodiscard]] Structure bar_structure(const Bar& bar, const BarMesh& mesh);

}  // namespace impulse
