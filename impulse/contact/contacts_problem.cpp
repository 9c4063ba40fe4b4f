#include "impulse/contact/contacts_problem.hpp"

#include "impulse/contact/step_means.hpp"
#include "impulse/response/modal_response.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace impulse {
namespace {

std::vector<double> running_sum(const std::vector<double>& steps, double step_s) {
  std::vector<double> sum(steps.size() + 1);
  for (std::size_t n = 0; n < steps.size(); ++n) sum[n + 1] = sum[n] + step_s * steps[n];
  return sum;
}

void require_consistent(const std::vector<ContactBody>& bodies, const UniformGrid& grid, const ContactsProblem& given,
                        std::size_t contacts) {
  for (const ContactBody& body : bodies) {
    const auto* response = std::get_if<ResponseReference>(&body);
    if (response == nullptr) continue;
    require_valid(response->get());
    const UniformGrid& own = response->get().grid;
    require(same_grid(own, grid),
            "the responses have different grids ({} samples of {:.6g} s and {} samples of {:.6g} s); compute all "
            "with the same --step and --duration",
            grid.size, grid.step_s, own.size, own.step_s);
  }
  require(given.speed_m_per_s.size() == bodies.size(), "{} speeds for {} bodies", given.speed_m_per_s.size(),
          bodies.size());
  require(given.laws.size() == contacts, "{} contact laws for {} contacts; give one for all or one each (--law)",
          given.laws.size(), contacts);
  require(given.gaps_m.size() == contacts, "{} gaps for {} contacts; give one for all or one each (--gap)",
          given.gaps_m.size(), contacts);
  for (const auto* free : {&given.free_velocity_first_m_per_s, &given.free_velocity_last_m_per_s})
    require(free->empty() || free->size() == grid.size, "a free velocity of {} samples for responses of {}",
            free->size(), grid.size);
}

class Problem {
 public:
  Problem(const std::vector<ContactBody>& bodies, const UniformGrid& grid, const ContactsProblem& given)
      : bodies_(bodies), grid_(grid), given_(given), joints_(joints_of(bodies)) {
    require_consistent(bodies, grid, given, joints_.size());
  }

  [[nodiscard]] ContactsSolution solve() const {
    const std::vector<MarchedContact> contacts = marched_contacts();
    BodiesHistory history(bodies_, joints_, grid_, given_.progress);
    const std::vector<MarchedHistory> histories = march_contacts(grid_, contacts, history, given_.recontact);
    const ForcesBeyondPreload beyond{beyond_preload(histories, &MarchedHistory::mean_force_N),
                                     beyond_preload(histories, &MarchedHistory::force_N)};
    ContactsSolution solution;
    double mismatch = 0;
    double scale = 0;
    for (std::size_t c = 0; c < joints_.size(); ++c) {
      solution.traces.push_back(trace(c, histories[c], beyond, history));
      solution.in_contact_at_end = solution.in_contact_at_end || histories[c].in_contact.back();
      double work = 0;
      for (std::size_t n = 0; n + 1 < grid_.size; ++n) {
        work += histories[c].mean_force_N[n] * (histories[c].approach_m[n + 1] - histories[c].approach_m[n]);
        scale += std::abs(histories[c].mean_force_N[n] * contacts[c].approach_m_per_s[n]) * grid_.step_s;
      }
      mismatch += work - taken_up(histories[c], grid_.size - 1) + taken_up(histories[c], 0);
    }
    solution.energy_error = scale > 0 ? std::abs(mismatch) / scale : 0;
    return solution;
  }

 private:
  static double taken_up(const MarchedHistory& history, std::size_t n) {
    return history.stored_J[n] + history.residual_J[n] + history.dissipated_J[n];
  }

  /// Residual flexibility of the bodies that both contacts share.
  [[nodiscard]] double series_flexibility(const Joint& here, const Joint& there) const {
    double sum = 0;
    for (const ContactSide& a : {here.first, here.second})
      for (const ContactSide& b : {there.first, there.second})
        if (a.body == b.body) sum += residual_flexibility(bodies_[a.body], a.contact, b.contact);
    return sum;
  }

  [[nodiscard]] std::vector<double> free_velocity(std::size_t body) const {
    std::vector<double> mean(grid_.size - 1, given_.speed_m_per_s[body]);
    for (const auto& [own, free] : {std::pair{std::size_t{0}, &given_.free_velocity_first_m_per_s},
                                    {bodies_.size() - 1, &given_.free_velocity_last_m_per_s}})
      if (body == own && !free->empty())
        for (std::size_t n = 0; n < mean.size(); ++n) mean[n] += 0.5 * ((*free)[n] + (*free)[n + 1]);
    return mean;
  }

  [[nodiscard]] std::vector<MarchedContact> marched_contacts() const {
    std::vector<MarchedContact> contacts;
    for (std::size_t c = 0; c < joints_.size(); ++c) {
      MarchedContact contact;
      contact.law = given_.laws[c];
      for (const Joint& other : joints_)
        contact.residual_flexibility_across_m_per_N.push_back(series_flexibility(joints_[c], other));
      contact.residual_flexibility_m_per_N = contact.residual_flexibility_across_m_per_N[c];
      contact.gap_m = given_.gaps_m[c];
      contact.preload_N = given_.preload_N;
      contact.approach_m_per_s = free_velocity(joints_[c].first.body);
      const std::vector<double> receding = free_velocity(joints_[c].second.body);
      for (std::size_t n = 0; n < receding.size(); ++n) contact.approach_m_per_s[n] -= receding[n];
      contacts.push_back(std::move(contact));
    }
    return contacts;
  }

  /// A column of forces of every contact, less the preload.
  [[nodiscard]] std::vector<std::vector<double>> beyond_preload(const std::vector<MarchedHistory>& histories,
                                                                std::vector<double> MarchedHistory::*column) const {
    std::vector<std::vector<double>> forces;
    for (const MarchedHistory& history : histories) {
      forces.push_back(history.*column);
      for (double& force : forces.back()) force -= given_.preload_N;
    }
    return forces;
  }

  struct ForcesBeyondPreload {
    std::vector<std::vector<double>> means;
    std::vector<std::vector<double>> samples;
  };

  [[nodiscard]] ContactTrace trace(std::size_t c, const MarchedHistory& own, const ForcesBeyondPreload& forces,
                                   const BodiesHistory& history) const {
    ContactTrace trace;
    trace.force_N = own.force_N;
    trace.running_impulse_Ns = running_sum(own.mean_force_N, grid_.step_s);
    trace.indentation_m = own.indentation_m;
    trace.stored_J = own.stored_J;
    trace.dissipated_J = own.dissipated_J;
    trace.in_contact = own.in_contact;
    fill_side(joints_[c].first, -1, history.velocity_into(joints_[c].first, forces.means, forces.samples),
              own.mean_force_N, {trace.velocity_1_m_per_s, trace.displacement_1_m, trace.work_1_J});
    fill_side(joints_[c].second, +1, history.velocity_into(joints_[c].second, forces.means, forces.samples),
              own.mean_force_N, {trace.velocity_2_m_per_s, trace.displacement_2_m, trace.work_2_J});
    return trace;
  }

  struct FaceColumns {
    std::vector<double>& velocity;
    std::vector<double>& displacement;
    std::vector<double>& work;
  };

  /// Motion of one face, along the row (direction -1: into the body is against it), and the work that the contact's
  /// force did on it.
  void fill_side(const ContactSide& side, double direction, const std::vector<double>& into,
                 const std::vector<double>& own_force, const FaceColumns& out) const {
    std::vector<double> mean = free_velocity(side.body);
    std::vector<double> power(mean.size());
    for (std::size_t n = 0; n < mean.size(); ++n) {
      mean[n] += direction * into[n];
      power[n] = direction * own_force[n] * mean[n];
    }
    out.velocity = on_samples(mean, mean.front(), mean.back());
    out.displacement = running_sum(mean, grid_.step_s);
    out.work = running_sum(power, grid_.step_s);
  }

  const std::vector<ContactBody>& bodies_;
  const UniformGrid& grid_;
  const ContactsProblem& given_;
  std::vector<Joint> joints_;
};

}  // namespace

ContactsSolution solve_contacts(const std::vector<ContactBody>& bodies, const UniformGrid& grid,
                                const ContactsProblem& problem) {
  const bool modal = std::ranges::any_of(
      bodies, [](const ContactBody& body) { return !std::holds_alternative<ResponseReference>(body); });
  require(modal || problem.history != HistoryMethod::modes,
          "no body is given by modes, so that the history can't be theirs");
  const HistoryMethod method =
      modal && problem.history != HistoryMethod::convolution ? HistoryMethod::modes : HistoryMethod::convolution;
  std::vector<ContactBody> seen = bodies;
  std::deque<Response> sampled;  // a deque: its elements stay where they are
  if (method == HistoryMethod::convolution)
    for (ContactBody& body : seen)
      if (const auto* modes = std::get_if<ModesReference>(&body))
        body = sampled.emplace_back(modal_response(*modes, grid));
  ContactsSolution solution = Problem(seen, grid, problem).solve();
  solution.history = method;
  return solution;
}

ContactsSolution solve_contacts(const std::vector<Response>& bodies, const ContactsProblem& problem) {
  require(!bodies.empty(), "an impact needs two bodies, not 0");
  return solve_contacts(std::vector<ContactBody>(bodies.begin(), bodies.end()), bodies[0].grid, problem);
}

}  // namespace impulse
