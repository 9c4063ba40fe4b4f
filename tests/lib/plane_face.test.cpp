#include "lib/model/plane_face.hpp"

#include <doctest/doctest.h>

namespace impulse {
namespace {

const ModalModel modes{Eigen::Vector2d(0, 9), Eigen::Vector2d::Zero(), Eigen::Vector2d(0.5, 2),
                       Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Constant(1, 1, 3)};

TEST_CASE("every point of a plane face moves as the face, and every force acts on it whole") {
  const ModalModel body = plane_face(modes, 3);
  CHECK(body.contact_count() == 3);
  for (Eigen::Index i = 0; i < 3; ++i) CHECK(body.participation.col(i) == modes.participation.col(0));
  CHECK(body.wave_admittance == Eigen::MatrixXd::Constant(3, 3, 3.0));
  CHECK(body.angular_frequency == modes.angular_frequency);

  Structure structure;
  structure.contacts = Eigen::Vector2d(1, -1);
  structure.wave_admittance = Eigen::MatrixXd::Constant(1, 1, 7);
  const Structure face = plane_face(structure, 2);
  CHECK(face.contacts == (Eigen::Matrix2d() << 1, 1, -1, -1).finished());
  CHECK(face.wave_admittance == Eigen::MatrixXd::Constant(2, 2, 7.0));
}

TEST_CASE("a body of two contacts, with residual flexibility, or without a point is refused") {
  CHECK_THROWS_WITH(plane_face(plane_face(modes, 2), 2), "a plane face is one contact, but the body has 2");
  CHECK_THROWS_WITH(plane_face(modes, 0), "a plane face meets at least one point");
  ModalModel soft = modes;
  soft.residual_flexibility(0, 0) = 1e-9;
  CHECK_THROWS_WITH(plane_face(soft, 2), doctest::Contains("must have no residual flexibility"));
}

}  // namespace
}  // namespace impulse
