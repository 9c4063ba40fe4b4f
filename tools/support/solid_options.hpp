#pragma once

#include "fem/bodies/axisymmetric_solid.hpp"
#include "lib/cli/command.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// The options that describe a solid of revolution (body "solid"): a chain of segments that is meshed, or a mesh from a
/// file; its contacts, supports and materials. On the command line of a tool or as the keys of a body file.
class SolidOptions {
 public:
  void declare(Command& command);

  /// @throws UsageError or std::invalid_argument for what is missing, does not go together or cannot be meshed.
  [[nodiscard]] AxisymmetricSolid solid(MassMatrix mass) const;

  [[nodiscard]] CircleContact contact() const { return contact_; }
  [[nodiscard]] double contact_radius_m() const { return contact_radius_m_; }
  [[nodiscard]] std::size_t face_count() const { return faces_.size(); }
  [[nodiscard]] bool is_free() const { return far_end_ == EndSupport::free; }

 private:
  [[nodiscard]] TriangleMesh mesh() const;
  [[nodiscard]] std::vector<AxisymmetricElasticity> materials() const;

  std::vector<Segment> segments_;
  std::optional<std::string> mesh_;
  std::vector<Material> materials_;
  std::vector<Face> faces_;
  EndSupport far_end_ = EndSupport::free;
  double contact_radius_m_ = 0;
  CircleContact contact_ = CircleContact::punch;
  std::optional<double> mesh_size_m_;
  std::optional<double> growth_;
  std::optional<double> largest_per_radius_;
};

}  // namespace impulse
