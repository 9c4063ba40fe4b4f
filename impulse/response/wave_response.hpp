#pragma once

#include "impulse/response/response.hpp"
#include "lib/material/profile.hpp"

namespace impulse {

/// Exact response of a bar of cylinders and cones by travelling waves (one-dimensional theory), at its faces.
///
/// Wave fronts are followed one by one (pulse_train.hpp), each with its tail as a series in q = 1/(s + μ); what the
/// series leaves out, of order q⁷ and thus six times differentiable, is added by inverting the exact Laplace transform
/// on the contour Re s = σ with one FFT. A chain of cylinders has no tails, so there G, H and U are the fronts alone.
/// Fronts need not fall on the grid: U is the exact double integral at every sample.
/// Error of U: about 1e-12 of its largest value; with many incommensurate segments see pulse_train.hpp.
/// Cost: fronts × 49 flops + (cones only) one transform of about 4·size and as many evaluations of the chain.
/// @throws std::invalid_argument for an invalid bar.
/// Verified by: tests/impulse/wave_response.test.cpp
[[nodiscard]] Response wave_response(const Bar& bar, const UniformGrid& grid);

}  // namespace impulse
