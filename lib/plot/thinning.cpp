#include "lib/plot/thinning.hpp"

#include <algorithm>
#include <array>

namespace impulse {

Curve thinned(const Curve& curve, std::size_t stretch_count, const std::optional<AxisRange>& seen) {
  if (curve.x.size() <= 4 * stretch_count || curve.mark != Mark::line || !curve.pen_lifts.empty() ||
      !std::is_sorted(curve.x.begin(), curve.x.end()))
    return curve;
  std::size_t origin = 0, count = curve.x.size();
  if (seen) {
    const auto [from, to] = std::minmax(seen->from, seen->to);
    const auto first = std::lower_bound(curve.x.begin(), curve.x.end(), from);
    const auto last = std::upper_bound(first, curve.x.end(), to);
    origin = static_cast<std::size_t>(first - curve.x.begin()) - (first == curve.x.begin() ? 0 : 1);
    count = static_cast<std::size_t>(last - curve.x.begin()) + (last == curve.x.end() ? 0 : 1) - origin;
  }
  stretch_count = std::min(stretch_count, count);
  Curve result{curve.label, {}, {}, curve.mark, {}};
  for (std::size_t stretch = 0; stretch < stretch_count; ++stretch) {
    const std::size_t begin = origin + count * stretch / stretch_count;
    const std::size_t end = origin + count * (stretch + 1) / stretch_count;
    const auto at = [&](std::size_t index) { return curve.y.begin() + static_cast<std::ptrdiff_t>(index); };
    const auto [lowest, highest] = std::minmax_element(at(begin), at(end));
    std::array<std::size_t, 4> kept{begin, static_cast<std::size_t>(lowest - curve.y.begin()),
                                    static_cast<std::size_t>(highest - curve.y.begin()), end - 1};
    std::sort(kept.begin(), kept.end());
    const auto unique_end = std::unique(kept.begin(), kept.end());
    for (auto index = kept.begin(); index != unique_end; ++index) {
      result.x.push_back(curve.x[*index]);
      result.y.push_back(curve.y[*index]);
    }
  }
  return result;
}

}  // namespace impulse
