#include "tools/support/contacts_request.hpp"

#include "lib/cli/progress.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_table.hpp"
#include "lib/law/impact_csv.hpp"
#include "tools/support/two_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <span>

namespace impulse {
namespace {

/// Column velocity_m_per_s on the grid of the responses.
std::vector<double> free_velocity(const std::optional<std::string>& path, const UniformGrid& grid) {
  if (!path) return {};
  const CsvTable table = read_csv(*path);
  if (!same_grid(uniform_time(table), grid))
    throw InputError(
        table.file(), 0, 0,
        fmt::format("has another grid than the responses ({} samples of {:.6g} s)", grid.size, grid.step_s));
  return table.column("velocity_m_per_s");
}

}  // namespace

void ContactsRequest::declare(Command& command) {
  law_.declare(command);
  command.quantity("--gap", gaps_m_, "m", Sign::non_negative,
                   "gap at t = 0 (default: 0); one for all contacts or one each");
  command.quantity("--preload", preload_N_, "N", Sign::non_negative,
                   "constant force that pressed the bodies together before t = 0");
  command.quantity("--speed-2", speed_2_m_per_s_, "m/s", Sign::any,
                   "of body 2, in the direction of --speed (default: 0)");
  command.text("--free-velocity-1", free_velocity_1_, "FILE",
               "velocity_m_per_s of body 1's face were there no contact, beyond --speed");
  command.text("--free-velocity-2", free_velocity_2_, "FILE",
               "velocity_m_per_s of the last body's face were there no contact");
  command.flag("--recontact", recontact_, "let bodies that parted touch again");
  command.choice<HistoryMethod>(
      "--history", history_,
      {{"auto", HistoryMethod::automatic},
       {"convolution", HistoryMethod::convolution},
       {"modes", HistoryMethod::modes}},
      "how a march remembers forces on bodies given by modes: convolution with their sampled response, O(N log^2 N), "
      "or "
      "advancing the modes, O(N modes), the cheaper and taken by auto; sampled responses are always convolved");
  command.output_file("--contacts", contacts_, "write a row for every period of contact to FILE");
}

bool ContactsRequest::asked(const Command& command) const {
  for (const char* flag : {"--law", "--gap", "--preload", "--speed-2", "--free-velocity-1", "--free-velocity-2",
                           "--recontact", "--contacts"})
    if (command.given(flag)) return true;
  return false;
}

ContactsProblem ContactsRequest::problem(const StruckBodies& bodies, double speed_m_per_s) const {
  const std::size_t contacts = bodies.joint_count();
  ContactsProblem problem;
  problem.speed_m_per_s.assign(bodies.count(), 0.0);
  problem.speed_m_per_s[0] = speed_m_per_s;
  problem.speed_m_per_s[1] = speed_2_m_per_s_.value_or(0);
  problem.laws = law_.laws(contacts);
  problem.gaps_m = gaps_m_;
  if (gaps_m_.size() <= 1) problem.gaps_m.assign(contacts, gaps_m_.empty() ? 0.0 : gaps_m_.front());
  problem.preload_N = preload_N_.value_or(0);
  problem.free_velocity_first_m_per_s = free_velocity(free_velocity_1_, bodies.grid());
  problem.free_velocity_last_m_per_s = free_velocity(free_velocity_2_, bodies.grid());
  problem.recontact = recontact_ ? Recontact::yes : Recontact::no;
  problem.history = history_;
  if (history_ == HistoryMethod::modes && !bodies.any_modal())
    throw UsageError("--history", "asks for modes, but no file holds any; leave it out");
  return problem;
}

// A body that something else moves too has a momentum that its contacts alone do not tell.
std::vector<BodyEnergy> ContactsRequest::energies(const StruckBodies& bodies, double speed_m_per_s,
                                                  const std::vector<ContactTrace>& traces) const {
  const std::span<const ContactTrace> all(traces);
  const bool two_bodies = bodies.count() == 2;
  const double preload = preload_N_.value_or(0);
  std::vector<BodyEnergy> energies;
  if (bodies.mass_1_kg() && !free_velocity_1_)
    energies.push_back(translational_energy({1, *bodies.mass_1_kg(), speed_m_per_s, -1, preload}, bodies.grid(),
                                            two_bodies ? all : all.first(1)));
  const double speed_2 = two_bodies ? speed_2_m_per_s_.value_or(0) : 0;
  if (bodies.mass_2_kg() && !free_velocity_2_)
    energies.push_back(translational_energy({bodies.count(), *bodies.mass_2_kg(), speed_2, +1, preload}, bodies.grid(),
                                            two_bodies ? all : all.last(1)));
  return energies;
}

void ContactsRequest::run(const StruckBodies& bodies, double speed_m_per_s, bool summary,
                          const std::string& output) const {
  require_apart("--contacts", contacts_, output);
  ContactsProblem asked = problem(bodies, speed_m_per_s);
  const ContactsSolution solution = [&] {
    Progress progress("ir-impact");
    asked.progress = std::ref(progress);
    return solve_contacts(bodies.contact_bodies(), bodies.grid(), asked);
  }();
  const UniformGrid& grid = bodies.grid();
  if (bodies.any_modal() && stderr_is_terminal())
    fmt::print(stderr, "ir-impact: forces on bodies given by modes remembered by {} (--history)\n",
               solution.history == HistoryMethod::modes ? "their modes" : "convolution");
  if (solution.in_contact_at_end)
    fmt::print(stderr,
               "ir-impact: the responses end during contact, after {:g} s; compute them with a longer --duration\n",
               grid.duration_s());
  if (contacts_) write_intervals(*contacts_, grid, solution.traces);
  if (!summary) {
    write_traces(output, grid, solution.traces, energies(bodies, speed_m_per_s, solution.traces));
    return;
  }
  const bool two_bodies = bodies.count() == 2;
  const ContactsScene scene{.speed_1_m_per_s = speed_m_per_s,
                            .speed_2_m_per_s = speed_2_m_per_s_.value_or(0),
                            .mass_1_kg = bodies.mass_1_kg(),
                            .mass_2_kg = two_bodies ? bodies.mass_2_kg() : std::nullopt,
                            .contacts_of_body_1 = two_bodies ? solution.traces.size() : 1,
                            .energy_error = solution.energy_error};
  write_summary(output, contacts_summary(solution.traces, grid, scene));
}

}  // namespace impulse
