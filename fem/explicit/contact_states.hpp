#pragma once

#include "fem/explicit/law_contact.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

/// A contact without a law between two steps.
struct RigidContact {
  enum class State { open, sticking, over };
  /// What the record shows where the faces met: the first force of the continuous bodies, or that of the next sample.
  enum class FirstForce { known, as_next };

  State state = State::open;
  double force_N = 0;                                ///< that acts from the last sample on
  double peak_N = 0;                                 ///< of the record so far
  double forgiven_m = 0;                             ///< approach that counts as none
  std::optional<std::size_t> met_at = std::nullopt;  ///< sample at which the faces met
  FirstForce first_force = FirstForce::known;        ///< of that sample
  std::size_t run_without_compression = 0;           ///< samples

  [[nodiscard]] bool sticks() const { return state == State::sticking; }
  [[nodiscard]] bool met_just_before(std::size_t sample) const { return met_at && *met_at + 1 == sample; }
};

/// The contacts of a row between two steps: each has its law, or is rigid.
struct ContactStates {
  std::vector<RigidContact> rigid;  ///< those of contacts with a law stay open
  std::vector<std::optional<LawContact>> laws;

  [[nodiscard]] std::size_t count() const { return laws.size(); }
  [[nodiscard]] bool is_closed(std::size_t i) const { return laws[i] ? laws[i]->in_contact() : rigid[i].sticks(); }
  [[nodiscard]] bool is_over(std::size_t i) const {
    return laws[i] ? laws[i]->over() : rigid[i].state == RigidContact::State::over;
  }
  [[nodiscard]] std::vector<std::size_t> sticking() const;
  [[nodiscard]] bool any_closed() const;
  [[nodiscard]] bool any_sticks() const;
  [[nodiscard]] bool all_over() const;
};

}  // namespace impulse
