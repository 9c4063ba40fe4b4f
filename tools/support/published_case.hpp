#pragma once

#include "lib/material/profile.hpp"

#include <string>
#include <vector>

namespace impulse {

/// One run of the published table: a method with its step and CPU time.
struct PublishedRun {
  std::string method;  ///< impulse-response or finite-elements
  double step_s = 0;
  double cpu_s = 0;
};

/// A case folder: projectile.toml, target.toml, impact.toml (speed) and published.csv.
struct PublishedCase {
  std::string id;
  Bar projectile;
  Bar target;
  double speed_m_per_s = 0;
  std::vector<PublishedRun> runs;
};

/// @throws InputError for a missing or wrong file. Verified by: tests/tools/table-4-1/
[[nodiscard]] PublishedCase read_published_case(const std::string& folder, const std::string& id);

}  // namespace impulse
