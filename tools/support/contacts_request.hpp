#pragma once

#include "impulse/contact/contacts_problem.hpp"
#include "lib/cli/command.hpp"
#include "lib/cli/law_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// The options of `ir-impact` that go past a rigid interface up to its first separation: laws, gaps, preload, other
/// motion, re-contact, chains and several points.
class ContactsRequest {
 public:
  void declare(Command& command);

  /// Whether any of them was given, so that the contacts have to be marched.
  [[nodiscard]] bool asked(const Command& command) const;

  /// Solves and writes: the history or (`summary`) one row to `output`, the periods of contact to --contacts. Masses,
  /// where they are known, are those of the first and last body. Says on stderr if the record ends during contact.
  void run(const std::vector<Response>& bodies, double speed_m_per_s, std::optional<double> first_mass_kg,
           std::optional<double> last_mass_kg, bool summary, const std::string& output) const;

 private:
  [[nodiscard]] ContactsProblem problem(const std::vector<Response>& bodies, double speed_m_per_s) const;

  LawOptions law_;
  std::vector<double> gaps_m_;
  std::optional<double> preload_N_;
  std::optional<double> speed_2_m_per_s_;
  std::optional<std::string> free_velocity_1_;
  std::optional<std::string> free_velocity_2_;
  std::optional<std::string> contacts_;
  bool recontact_ = false;
};

}  // namespace impulse
