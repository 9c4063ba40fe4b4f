#pragma once

#include "lib/model/modal_model.hpp"
#include "lib/model/structure.hpp"

#include <cstddef>

namespace impulse {

/// Which of two bodies meets every point of the other with its one contact.
enum class PlaneFace { first, second };

/// A body whose one contact is a plane face that meets another body at `points` points: each of them moves as the face,
/// and each force acts on it whole. Every functional is the same, so all matrices between points have equal elements.
/// @throws std::invalid_argument if the body has not one contact, has a residual flexibility (which would couple the
/// points at once), or there is no point. Verified by: tests/lib/plane_face.test.cpp
[[nodiscard]] ModalModel plane_face(ModalModel body, std::size_t points);
[[nodiscard]] Structure plane_face(Structure body, std::size_t points);

/// What both refuse.
void require_plane_face(std::size_t contact_count, double residual_flexibility_m_per_N, std::size_t points);

}  // namespace impulse
