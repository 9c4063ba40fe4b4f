#pragma once

#include "fem/bodies/bar_structure.hpp"
#include "lib/model/modal_model.hpp"

namespace impulse {

/// What `--fe-frequencies` chooses.
enum class FeFrequencies { plain, corrected };

/// Modes of a lumped mesh with the mesh's own dispersion taken out of the frequencies:
///
///   ω ← (2/δ) asin(ωδ/2),   δ = h/c the travel time of an element
///
/// On a mesh of equal travel times the lumped equations are d'Alembert's lattice, whose waves obey sin(kh/2) = ωδ/2
/// exactly (in a cone for ψ = D·u), so the corrected frequencies are those of the continuous bar but for its ends and
/// joints. Modes above `highest_frequency_Hz` after correction are left out. Participations are unchanged.
/// @throws std::invalid_argument for a consistent mass matrix or elements whose travel times differ by more than 5 %.
/// Verified by: tests/fem/dispersion_correction.test.cpp
[[nodiscard]] ModalModel dispersion_corrected(ModalModel modes, const Bar& bar, const BarMesh& mesh,
                                              double highest_frequency_Hz);

}  // namespace impulse
