#include "fem/explicit/step_forces.hpp"

#include "lib/contract/errors.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

constexpr int most_rounds = 500;
/// A mean force is a difference of energies over a difference of indentations, which is down to 1e-4 of the indentation
/// (LawContact): of its digits rounding leaves eleven.
constexpr double rest = 2e-11;

/// Mobilities of contacts that stick (by `shape`) and with a law (held), column by column.
StepMobility mixed_mobility(const JoinedBodies& bodies, StepForce shape,
                            const std::vector<std::optional<LawContact>>& laws) {
  StepMobility mixed = bodies.mobility(shape);
  const StepMobility& held = bodies.mobility(StepForce::held);
  for (std::size_t j = 0; j < laws.size(); ++j) {
    if (!laws[j]) continue;
    const Eigen::Index column = static_cast<Eigen::Index>(j);
    mixed.velocity.col(column) = held.velocity.col(column);
    mixed.displacement.col(column) = held.displacement.col(column);
  }
  return mixed;
}

/// x of the contacts that stick, given what else makes them close.
class Sticking {
 public:
  Sticking(const Eigen::MatrixXd& velocity, const std::vector<std::size_t>& contacts)
      : contacts_(contacts.begin(), contacts.end()), factors_(velocity(contacts_, contacts_)) {}

  [[nodiscard]] Eigen::VectorXd forces(const Eigen::VectorXd& closing_speed) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(closing_speed.size());
    if (contacts_.size() == 1) all[contacts_[0]] = closing_speed[contacts_[0]] / factors_.matrixLU()(0, 0);
    if (contacts_.size() > 1) {
      const Eigen::VectorXd speeds = closing_speed(contacts_);
      const Eigen::VectorXd solved = factors_.solve(speeds);
      all(contacts_) = solved;
    }
    return all;
  }

 private:
  std::vector<Eigen::Index> contacts_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace

StepForces step_forces(const JoinedBodies& bodies, const TrialStep& trial, const std::vector<std::size_t>& sticking,
                       StepForce shape, const std::vector<std::optional<LawContact>>& laws) {
  const Eigen::Index p = trial.approach_m.size();
  const StepMobility mobility = mixed_mobility(bodies, shape, laws);
  const Sticking stick(mobility.velocity, sticking);
  StepForces answer{stick.forces(trial.closing_speed), Eigen::VectorXd::Zero(p),
                    std::vector<LawContact::Answer>(laws.size())};
  std::vector<std::size_t> pressing;
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (laws[i]) pressing.push_back(i);
  if (pressing.empty()) return answer;

  // What a unit mean force at j leaves of the approaches when the contacts that stick have given way to it.
  Eigen::MatrixXd compliance = mobility.displacement;
  Eigen::VectorXd free = trial.approach_m - mobility.displacement * answer.force_N;
  if (!sticking.empty())
    for (const std::size_t j : pressing)
      compliance.col(static_cast<Eigen::Index>(j)) -=
          mobility.displacement * stick.forces(mobility.velocity.col(static_cast<Eigen::Index>(j)));
  const Eigen::MatrixXd& residual = bodies.residual_flexibility();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(p);
  for (int round = 1;; ++round) {
    double moved = 0;
    for (const std::size_t i : pressing) {
      const Eigen::Index row = static_cast<Eigen::Index>(i);
      const double others = compliance.row(row).dot(mean) - compliance(row, row) * mean[row] +
                            residual.row(row).dot(answer.law_force_N) - residual(row, row) * answer.law_force_N[row];
      answer.laws[i] = laws[i]->answer(free[row] - others, compliance(row, row));
      moved = std::max(moved, std::abs(answer.laws[i].mean_force_N - mean[row]));
      mean[row] = answer.laws[i].mean_force_N;
      answer.law_force_N[row] = answer.laws[i].force_N;
    }
    if (pressing.size() == 1 || moved <= rest * mean.cwiseAbs().maxCoeff()) break;
    if (round == most_rounds)
      throw ConvergenceError("the contact forces of a step do not come to rest", rest,
                             moved / mean.cwiseAbs().maxCoeff(), most_rounds);
  }
  if (!sticking.empty()) answer.force_N = stick.forces(trial.closing_speed - mobility.velocity * mean);
  for (const std::size_t i : pressing)
    answer.force_N[static_cast<Eigen::Index>(i)] = mean[static_cast<Eigen::Index>(i)];
  return answer;
}

void apply(JoinedBodies& bodies, const StepForces& forces, StepForce shape,
           const std::vector<std::optional<LawContact>>& laws) {
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double force = forces.force_N[static_cast<Eigen::Index>(i)];
    if (force != 0) bodies.add(i, laws[i] ? StepForce::held : shape, force);
  }
}

}  // namespace impulse
