#include "fem/explicit/explicit_bodies.hpp"

#include "fem/explicit/central_difference.hpp"
#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

void require_sizes(const Structure& body, const std::string& name) {
  const Eigen::Index n = body.mass.rows(), p = body.contacts.cols();
  require(p > 0, "the {} has no contact", name);
  require(body.contacts.rows() == n && body.stiffness.rows() == n,
          "stiffness, mass and contact of the {} disagree in size", name);
  require(body.residual_flexibility.size() == 0 ||
              (body.residual_flexibility.rows() == p && body.residual_flexibility.cols() == p),
          "residual flexibility {} x {} of the {} for {} contacts", body.residual_flexibility.rows(),
          body.residual_flexibility.cols(), name, p);
  require(body.translation.size() == 0 || body.translation.size() == n,
          "a translation of {} degrees of freedom for the {}'s {}", body.translation.size(), name, n);
  for (Eigen::Index i = 0; i < p; ++i)
    require(body.contacts.col(i).cwiseAbs().maxCoeff() > 0, "contact {} of the {} does not move with anything", i + 1,
            name);
}

/// The contacts of a body that flies move with it: side 1 against its functional, side 2 along it.
void require_free(const ExplicitBody& body, std::size_t index, const std::vector<RowJoint>& all,
                  const std::string& name) {
  if (body.speed_m_per_s == 0) return;
  const std::optional<Eigen::VectorXd> translation = rigid_translation(body.structure);
  require(translation.has_value(),
          "the {} is held (moving it without strain is not possible); a body with speed needs a free or infinite far "
          "end, or free edges",
          name);
  const double along = index == 0 ? -1 : 1;
  for (const RowJoint& joint : all) {
    const auto moves = [&](Eigen::Index contact, double expected) {
      const double motion = along * body.structure.contacts.col(contact).dot(*translation);
      require(std::abs(motion - expected) <= 1e-9, "contact {} of the {} does not fly with it towards the other body",
              contact + 1, name);
    };
    if (joint.body_1 == index) moves(joint.contact_1, -1);
    if (joint.body_2 == index) moves(joint.contact_2, 1);
  }
}

void require_stable(const ExplicitBody& body, double step_s, const std::string& name) {
  require(body.subcycles >= 1, "0 subcycles of the {} (it takes at least one step); use 1 or more", name);
  if (name != "projectile" && body.subcycles == 1) {
    require_stable_step(body.structure, step_s, name.c_str());
    return;
  }
  const double limit = stability_limit_s(body.structure), step = step_s / static_cast<double>(body.subcycles);
  require(step <= limit * (1 + 1e-12),
          "{} step {:.4g} us ({:.4g} us in {}) exceeds its stability limit {:.4g} us; use --subcycles {}", name,
          step * 1e6, step_s * 1e6, body.subcycles, limit * 1e6, std::ceil(step_s / limit * (1 - 1e-12)));
}

}  // namespace

std::vector<RowJoint> row_joints(const std::vector<ExplicitBody>& bodies) {
  require(bodies.size() >= 2, "{} body cannot collide; give two or more", bodies.size());
  std::vector<RowJoint> all;
  const auto contacts = [&](std::size_t b) { return bodies[b].structure.contacts.cols(); };
  if (bodies.size() == 2) {
    require(contacts(0) == contacts(1), "the projectile has {} contacts, the target {}; they meet pair by pair",
            contacts(0), contacts(1));
    for (Eigen::Index i = 0; i < contacts(0); ++i) all.push_back({0, i, 1, i});
    return all;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bool inner = b > 0 && b + 1 < bodies.size();
    require(contacts(b) == (inner ? 2 : 1), "the {} has {} contacts; in a row of {} bodies it takes {}",
            body_name(b, bodies.size()), contacts(b), bodies.size(), inner ? "two, entry and exit" : "one");
    if (b > 0) all.push_back({b - 1, contacts(b - 1) - 1, b, 0});
  }
  return all;
}

std::optional<Eigen::VectorXd> rigid_translation(const Structure& body) {
  Eigen::VectorXd translation = body.translation;
  if (translation.size() == 0) {
    const double sum = body.contacts.col(0).sum();
    if (sum == 0) return std::nullopt;
    translation = Eigen::VectorXd::Constant(body.mass.rows(), 1 / sum);
  }
  const Eigen::VectorXd force = body.stiffness * translation;
  const Eigen::VectorXd diagonal = body.stiffness.diagonal();
  const double scale = diagonal.maxCoeff() * translation.cwiseAbs().maxCoeff();
  if (force.cwiseAbs().maxCoeff() > 1e-9 * scale) return std::nullopt;
  return translation;
}

std::string body_name(std::size_t index, std::size_t body_count) {
  if (index == 0) return "projectile";
  if (index + 1 == body_count) return "target";
  const std::size_t n = index + 1;
  const bool teen = n % 100 / 10 == 1;
  const char* ending = teen ? "th" : n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : n % 10 == 3 ? "rd" : "th";
  return fmt::format("{}{} body", n, ending);
}

void require_valid(const std::vector<ExplicitBody>& bodies, double step_s) {
  for (std::size_t b = 0; b < bodies.size(); ++b) require_sizes(bodies[b].structure, body_name(b, bodies.size()));
  const std::vector<RowJoint> all = row_joints(bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) require_free(bodies[b], b, all, body_name(b, bodies.size()));
  // The row's step is that of all but the projectile, whose subcycles can follow it.
  for (std::size_t b = bodies.size(); b-- > 0;) require_stable(bodies[b], step_s, body_name(b, bodies.size()));
}

std::optional<Eigen::MatrixXd> known_wave_admittance(const Structure& body) {
  const Eigen::Index contacts = body.contacts.cols();
  const Eigen::MatrixXd& known = body.wave_admittance;
  if (known.rows() == contacts && known.diagonal().minCoeff() > 0) return known;
  if (body.stiffness.nonZeros() == 0) return Eigen::MatrixXd::Zero(contacts, contacts);
  return std::nullopt;
}

}  // namespace impulse
