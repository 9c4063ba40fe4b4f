#pragma once

#include "impulse/measured/force_band.hpp"
#include "lib/cli/command.hpp"
#include "tools/support/struck_bodies.hpp"

#include <functional>
#include <optional>
#include <string>

namespace impulse {

/// The options of `ir-impact` that carry the uncertainty of measured responses to the force.
/// Verified by: tests/tools/ir-impact/
class DrawRequest {
 public:
  void declare(Command& command);

  [[nodiscard]] bool asked() const { return draws_.has_value(); }

  /// Draws the bodies, lets `outcome` find the force of each, and writes its best estimate with the band.
  /// Says on stderr in how many draws the responses end during contact.
  /// @throws UsageError unless a response has an uncertainty and there is one contact.
  void run(const StruckBodies& bodies, const std::function<ForceOutcome(const StruckBodies&)>& outcome, bool summary,
           const std::string& output) const;

  /// @throws UsageError for options that need --draws.
  void require_consistent(const Command& command) const;

 private:
  std::optional<std::size_t> draws_;
  BandOptions options_;
};

}  // namespace impulse
