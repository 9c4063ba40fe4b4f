#include "lib/plot/scans.hpp"

namespace impulse {

std::vector<std::vector<ScanPoint>> scan_lines(const std::vector<ScanPoint>& points) {
  std::vector<std::vector<ScanPoint>> lines;
  for (const ScanPoint& point : points) {
    bool turns_back = lines.empty();
    if (!turns_back && lines.back().size() >= 2) {
      const ScanPoint& last = lines.back().back();
      const ScanPoint& before = lines.back()[lines.back().size() - 2];
      turns_back = (point.x - last.x) * (last.x - before.x) + (point.y - last.y) * (last.y - before.y) < 0;
    }
    if (turns_back) lines.emplace_back();
    lines.back().push_back(point);
  }
  return lines;
}

}  // namespace impulse
