#pragma once

#include "lib/plot/picture.hpp"

#include <cstddef>
#include <optional>

namespace impulse {

/// The curve by at most 4 × `stretch_count` of its points: in each of as many stretches of equal numbers of points the
/// first, the lowest, the highest and the last, so that no peak is lost. With a range of x only what is seen of the
/// curve counts: the points in it and one on either side. A curve of fewer points comes back as it is,
/// and so does one with pen lifts, points, or an x that turns back.
/// Verified by: tests/lib/thinning.test.cpp
[[nodiscard]] Curve thinned(const Curve& curve, std::size_t stretch_count, const std::optional<AxisRange>& seen = {});

}  // namespace impulse
