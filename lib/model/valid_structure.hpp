#pragma once

#include "lib/model/structure.hpp"

namespace impulse {

/// Whether a body has undamped modes: sizes that fit, finite values, symmetric K and M, positive masses, no dashpots.
/// Cost: one pass through the matrices. @throws std::invalid_argument with a way out.
/// Verified by: tests/lib/modal_model.test.cpp
void require_valid_structure(const Structure& body);
void require_valid_structure(const DenseStructure& body);

}  // namespace impulse
