#include "fem/explicit/explicit_contacts.hpp"

#include "fem/explicit/row_march.hpp"

#include <algorithm>
#include <array>

namespace impulse {
namespace {

/// Marches, and sees when rigid contacts let go and when everything is over.
class Run {
 public:
  Run(const std::vector<ExplicitBody>& flights, const ExplicitContacts& asked)
      : flights_(flights),
        asked_(asked),
        grid_(grid_over(asked.duration_s, asked.step_s)),
        row_(flights, asked, grid_) {}

  ExplicitContactsResult result() {
    row_.begin();
    for (std::size_t n = 1; n < grid_.size; ++n) n = step(n);
    const bool in_contact = row_.contacts.any_closed();
    if (in_contact) contact_end_s_ = grid_.duration_s();
    if (!finished_) energy_error_ = row_.energy_error(grid_.size - 1);
    ExplicitContactsResult result{
        grid_, row_.record().traces(grid_.size), {}, in_contact, contact_end_s_, energy_error_, row_.trial_count()};
    for (std::size_t i = 0; i < row_.contacts.count(); ++i)
      if (!row_.contacts.laws[i]) bridge_wave_fronts(result.traces[i].in_contact);
    for (std::size_t b = 0; b < flights_.size(); ++b)
      result.balances.push_back(balance(row_.bodies()[b], flights_[b], b));
    return result;
  }

 private:
  /// The step to sample n; returns the sample reached, which is an earlier one where a rigid contact ends.
  std::size_t step(std::size_t n) {
    if (release_end_ != n) releases_.clear();
    if (row_.contacts.any_sticks()) row_.keep(kept_[n % kept_.size()]);
    row_.advance(n, releases_);
    for (const Release& release : releases_)
      contact_end_s_ = std::max(contact_end_s_, grid_.time_s(n - 1) + release.part * grid_.step_s);
    const std::size_t end = n + 1 - std::min(patience(), n);
    const std::vector<Release> found = found_releases(n, end);
    if (!found.empty()) return release(end, found);
    settle(n);
    return n;
  }

  /// Samples without compression after which a rigid contact lets go; one that may touch again need not wait to see
  /// whether a wave front brings the force back.
  [[nodiscard]] std::size_t patience() const { return goes_on() ? 1 : samples_that_end_a_rigid_contact; }

  [[nodiscard]] bool goes_on() const { return asked_.after_contact == AfterContact::touch_again; }

  /// Contacts whose force, seen at sample n, is zero since sample `end`.
  std::vector<Release> found_releases(std::size_t n, std::size_t end) {
    std::vector<Release> found;
    for (std::size_t i = 0; i < row_.contacts.count(); ++i) {
      RigidContact& contact = row_.contacts.rigid[i];
      const std::vector<double>& force = row_.record().now[i].force_N;
      if (!contact.sticks() || contact.met_at == n) continue;
      contact.run_without_compression = force[n] <= 0 ? contact.run_without_compression + 1 : 0;
      if (contact.run_without_compression < patience()) continue;
      // What faces exchange that have just met is theirs whole: less would leave them closing, to meet again at once.
      const double zero = contact.met_just_before(end) ? grid_.time_s(end) : contact_end_s(force, grid_, end);
      found.push_back({i, (zero - grid_.time_s(end - 1)) / grid_.step_s});
    }
    return found;
  }

  /// Back to the last sample in compression of these contacts, and from there with a force that reaches zero.
  std::size_t release(std::size_t end, const std::vector<Release>& found) {
    if (release_end_ != end) releases_.clear();
    release_end_ = end;
    releases_.insert(releases_.end(), found.begin(), found.end());
    row_.return_to(kept_[end % kept_.size()], end);
    return step(end);
  }

  /// Laws that opened, and what to do when all contacts have ended.
  void settle(std::size_t n) {
    for (std::size_t i = 0; i < row_.contacts.count(); ++i) {
      const ContactTrace& trace = row_.record().now[i];
      std::optional<LawContact>& law = row_.contacts.laws[i];
      if (!law || !trace.in_contact[n - 1] || trace.in_contact[n]) continue;
      const double before = trace.indentation_m[n - 1] - (trace.indentation_m[n] - law->depth_m());
      const double part = before / (before - law->depth_m());
      contact_end_s_ = std::max(contact_end_s_, grid_.time_s(n - 1) + grid_.step_s * part);
      if (!goes_on()) law->open_for_good();
    }
    if (finished_ || !row_.contacts.all_over()) return;
    finished_ = true;
    energy_error_ = row_.energy_error(n);
    if (asked_.after_contact == AfterContact::stop) grid_.size = std::min(grid_.size, n + 3);
  }

  const std::vector<ExplicitBody>& flights_;
  const ExplicitContacts& asked_;
  UniformGrid grid_;
  RowMarch row_;
  std::array<RowState, samples_that_end_a_rigid_contact> kept_;
  std::vector<Release> releases_;  // in the step to release_end_
  std::size_t release_end_ = 0;
  bool finished_ = false;
  double contact_end_s_ = 0;
  double energy_error_ = 0;
};

}  // namespace

ExplicitContactsResult explicit_contacts(const std::vector<ExplicitBody>& bodies, const ExplicitContacts& contacts) {
  require_valid(bodies, contacts.step_s);
  return Run(bodies, contacts).result();
}

}  // namespace impulse
