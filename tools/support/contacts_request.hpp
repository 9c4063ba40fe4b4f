#pragma once

#include "impulse/contact/contacts_problem.hpp"
#include "lib/cli/command.hpp"
#include "lib/cli/law_options.hpp"
#include "lib/law/impact_csv.hpp"
#include "tools/support/struck_bodies.hpp"

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

  /// Solves and writes: the history or (`summary`) one row to `output`, the periods of contact to --contacts. Says on
  /// stderr if the record ends during contact; on a terminal also how the forces were remembered, and the progress of
  /// long work.
  void run(const StruckBodies& bodies, double speed_m_per_s, bool summary, const std::string& output) const;

  /// What is asked; reads the files of --law and --free-velocity.
  [[nodiscard]] ContactsProblem problem(const StruckBodies& bodies, double speed_m_per_s) const;

 private:
  [[nodiscard]] std::vector<BodyEnergy> energies(const StruckBodies& bodies, double speed_m_per_s,
                                                 const std::vector<ContactTrace>& traces) const;

  LawOptions law_;
  std::vector<double> gaps_m_;
  std::optional<double> preload_N_;
  std::optional<double> speed_2_m_per_s_;
  std::optional<std::string> free_velocity_1_;
  std::optional<std::string> free_velocity_2_;
  std::optional<std::string> contacts_;
  bool recontact_ = false;
  HistoryMethod history_ = HistoryMethod::automatic;
};

}  // namespace impulse
