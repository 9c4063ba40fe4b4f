#pragma once

#include "lib/model/structure.hpp"
#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace impulse {

/// What the integration of one load tells at a sample: its number on the grid and the displacement of the whole body.
using StepObserver = std::function<void(std::size_t load, std::size_t sample, const Eigen::VectorXd& displacement)>;

struct StepResponseOptions {
  std::size_t substeps = 1;  ///< ≥ 1: steps of the integration within one of the grid
  StepObserver observer;     ///< may be empty
};

/// Displacements U_ij(t) [m/N] of a body at rest under a unit step force along contact j, at contact i and, below the
/// contacts, at output i - p: (p + q) × p series, row by row. By direct integration (Newmark) of the whole structure,
/// with the step δ = grid step/substeps. The load rises over 2δ about t = 0, symmetrically (¼, ¾ of it are there at
/// ∓½δ): a load that jumped would leave stiff modes ringing at (-1)ⁿ for ever, this one leaves them at rest, and is of
/// order 2 too. U(0) = 0.
/// Cost: a factorisation, then size·substeps solutions per contact.
/// @throws std::invalid_argument as Newmark, and for no contact or no substep.
/// Verified by: tests/fem/step_response.test.cpp
[[nodiscard]] std::vector<std::vector<double>> step_displacements(const Structure& body, const UniformGrid& grid,
                                                                  const StepResponseOptions& options = {});

}  // namespace impulse
