#include "fem/bodies/bar_structure.hpp"

#include "fem/elements/bar_element.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace impulse {
namespace {

/// Central differences on a million elements take 10^12 element steps for one passage of the wave.
constexpr double most_elements = 1e6;

/// Element `index` of `count` equal lengths of a segment.
Segment element_of(const Segment& segment, std::size_t index, std::size_t count) {
  const double n = static_cast<double>(count);
  const double slope = (segment.diameter_b_m - segment.diameter_a_m) / n;
  Segment element = segment;
  element.length_m = segment.length_m / n;
  element.diameter_a_m = segment.diameter_a_m + slope * static_cast<double>(index);
  element.diameter_b_m =
      index + 1 == count ? segment.diameter_b_m : segment.diameter_a_m + slope * static_cast<double>(index + 1);
  return element;
}

/// 2/ω of the fastest of `count` elements: the one at the small end, whose taper is the strongest.
double stable_step_s(const Segment& segment, std::size_t count) {
  const bool small_at_a = segment.diameter_a_m <= segment.diameter_b_m;
  return 2 / bar_element_highest_frequency(element_of(segment, small_at_a ? 0 : count - 1, count));
}

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_element(Triplets& triplets, Eigen::Index node, const Eigen::Matrix2d& matrix, Eigen::Index dof_count) {
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j)
      if (node + i >= 0 && node + j >= 0 && node + i < dof_count && node + j < dof_count && matrix(i, j) != 0)
        triplets.emplace_back(node + i, node + j, matrix(i, j));
}

Eigen::SparseMatrix<double> sparse(const Triplets& triplets, Eigen::Index dof_count) {
  Eigen::SparseMatrix<double> matrix(dof_count, dof_count);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace

BarMesh bar_mesh_by_count(const Bar& bar, std::size_t total_elements, MassMatrix mass) {
  require_valid(bar);
  const std::size_t segment_count = bar.profile.size();
  require(total_elements >= segment_count, "{} elements do not mesh {} segments (each needs one)", total_elements,
          segment_count);
  require(static_cast<double>(total_elements) <= most_elements, "{} elements are more than a bar takes ({:g}); use fewer",
          total_elements, most_elements);
  BarMesh mesh{std::vector<std::size_t>(segment_count, 1), mass};
  const auto element_time = [&](std::size_t i) {
    return bar.profile[i].travel_time_s() / static_cast<double>(mesh.elements[i]);
  };
  for (std::size_t used = segment_count; used < total_elements; ++used) {
    std::size_t slowest = 0;
    for (std::size_t i = 1; i < segment_count; ++i)
      if (element_time(i) > element_time(slowest)) slowest = i;
    ++mesh.elements[slowest];
  }
  return mesh;
}

BarMesh bar_mesh_by_step(const Bar& bar, double step_s, MassMatrix mass) {
  require_valid(bar);
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
  const double forgiving_step = step_s / (1 + 1e-12);
  BarMesh mesh{{}, mass};
  for (std::size_t i = 0; i < bar.profile.size(); ++i) {
    const Segment& segment = bar.profile[i];
    const double longest = stable_step_s(segment, 1);
    require(longest >= forgiving_step,
            "step {:.4g} us is too long for segment {} (one element of it is stable up to {:.4g} us); use a step of "
            "{:.4g} us or less",
            step_s * 1e6, i + 1, longest * 1e6, std::floor(longest * 1e8) / 100);
    const double ratio = segment.travel_time_s() / forgiving_step;
    require(ratio < most_elements, "step {:.6g} s makes {:.3g} elements in segment {} (more than {:g}); use a longer step",
            step_s, ratio, i + 1, most_elements);
    std::size_t count = std::max<std::size_t>(1, static_cast<std::size_t>(ratio));
    // A taper's fastest element is a little faster than c/h, so the last of the ⌊τ/step⌋ elements may be one too many.
    while (count > 1 && stable_step_s(segment, count) < forgiving_step) --count;
    mesh.elements.push_back(count);
  }
  return mesh;
}

Structure bar_structure(const Bar& bar, const BarMesh& mesh) {
  require_valid(bar);
  require(mesh.elements.size() == bar.profile.size(), "a mesh of {} segments for a bar of {}", mesh.elements.size(),
          bar.profile.size());
  for (std::size_t i = 0; i < mesh.elements.size(); ++i)
    require(mesh.elements[i] > 0, "segment {} has no element", i + 1);
  const std::size_t element_count = std::accumulate(mesh.elements.begin(), mesh.elements.end(), std::size_t{0});

  const bool fixed = bar.far_end == FarEnd::fixed;
  const bool far_is_a = bar.faces.front() == Face::b;
  const Eigen::Index dof_count = static_cast<Eigen::Index>(element_count) + (fixed ? 0 : 1);
  // The eliminated node falls outside 0 .. dof_count-1: below if it is the first, above if it is the last.
  const Eigen::Index first_node = fixed && far_is_a ? -1 : 0;

  Triplets stiffness;
  Triplets mass;
  Eigen::Index node = first_node;
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    for (std::size_t k = 0; k < mesh.elements[i]; ++k, ++node) {
      const Segment element = element_of(bar.profile[i], k, mesh.elements[i]);
      add_element(stiffness, node, bar_element_stiffness(element), dof_count);
      add_element(mass, node,
                  mesh.mass == MassMatrix::consistent ? bar_element_consistent_mass(element)
                                                      : Eigen::Matrix2d(bar_element_lumped_mass(element).asDiagonal()),
                  dof_count);
    }
  }

  Structure body;
  body.stiffness = sparse(stiffness, dof_count);
  body.mass = sparse(mass, dof_count);
  if (bar.far_end == FarEnd::infinite) {
    body.dashpots = Eigen::VectorXd::Zero(dof_count);
    body.dashpots[far_is_a ? 0 : dof_count - 1] = face_impedance_kg_per_s(bar.profile, far_is_a ? Face::a : Face::b);
  }
  const Eigen::Index contact_count = static_cast<Eigen::Index>(bar.faces.size());
  body.contacts = Eigen::MatrixXd::Zero(dof_count, contact_count);
  body.outputs = Eigen::MatrixXd::Zero(dof_count, 0);
  body.wave_admittance = Eigen::MatrixXd::Zero(contact_count, contact_count);
  for (Eigen::Index i = 0; i < contact_count; ++i) {
    const Face face = bar.faces[static_cast<std::size_t>(i)];
    if (face == Face::a)
      body.contacts(0, i) = 1;
    else
      body.contacts(dof_count - 1, i) = -1;
    body.wave_admittance(i, i) = 1 / face_impedance_kg_per_s(bar.profile, face);
  }
  return body;
}

}  // namespace impulse
