#include "lib/model/plane_face.hpp"

#include "lib/contract/require.hpp"

namespace impulse {
namespace {

/// The first column `points` times; a p × p matrix of one contact likewise in both directions.
Eigen::MatrixXd columns(const Eigen::MatrixXd& one, Eigen::Index points) { return one.replicate(1, points); }
Eigen::MatrixXd pairs(const Eigen::MatrixXd& one, Eigen::Index points) { return one.replicate(points, points); }

}  // namespace

void require_plane_face(std::size_t contact_count, double residual_flexibility_m_per_N, std::size_t points) {
  require(points >= 1, "a plane face meets at least one point");
  require(contact_count == 1, "a plane face is one contact, but the body has {}", contact_count);
  require(
      residual_flexibility_m_per_N == 0,
      "a plane face that meets several points must have no residual flexibility ({} m/N here couples them at once); "
      "use a response without",
      residual_flexibility_m_per_N);
}

ModalModel plane_face(ModalModel body, std::size_t points) {
  require_valid(body);
  require_plane_face(static_cast<std::size_t>(body.contact_count()),
                     body.contact_count() == 1 ? body.residual_flexibility(0, 0) : 0, points);
  const auto p = static_cast<Eigen::Index>(points);
  body.participation = columns(body.participation, p);
  body.residual_flexibility = pairs(body.residual_flexibility, p);
  body.wave_admittance = pairs(body.wave_admittance, p);
  return body;
}

Structure plane_face(Structure body, std::size_t points) {
  const bool residual = body.residual_flexibility.size() > 0;
  require_plane_face(static_cast<std::size_t>(body.contacts.cols()), residual ? body.residual_flexibility(0, 0) : 0,
                     points);
  const auto p = static_cast<Eigen::Index>(points);
  body.contacts = columns(body.contacts, p);
  if (residual) body.residual_flexibility = pairs(body.residual_flexibility, p);
  if (body.wave_admittance.size() > 0) body.wave_admittance = pairs(body.wave_admittance, p);
  return body;
}

}  // namespace impulse
