#include "fem/mesh/solid_mesh.hpp"

#include "fem/mesh/gmsh_triangles.hpp"
#include "lib/contract/require.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace impulse {
namespace {

namespace geometry = gmsh::model::geo;

constexpr int frontal_delaunay = 6;  // Gmsh's number
constexpr double most_elements = 1e6;

/// Radii that differ by less are one.
constexpr double same_radius = 1e-9;

bool same(double a, double b) { return std::abs(a - b) <= same_radius * std::max(a, b); }

void require_options(const SolidMeshOptions& options) {
  require(std::isfinite(options.growth) && options.growth > 1, "growth {} of the elements is not above 1",
          options.growth);
  require(std::isfinite(options.largest_per_radius) && options.largest_per_radius > 0,
          "largest element size {} per radius is not positive", options.largest_per_radius);
}

/// Wanted size of the elements anywhere in the section.
class SizeField {
 public:
  SizeField(const Profile& profile, const std::vector<MeshedCircle>& circles, const SolidMeshOptions& options)
      : profile_(profile), circles_(circles), options_(options) {
    for (const Segment& segment : profile) length_ += segment.length_m;
  }

  [[nodiscard]] double operator()(double r, double z) const {
    double size = options_.largest_per_radius * radius(z);
    for (const MeshedCircle& circle : circles_) {
      const double distance = std::hypot(r - circle.radius_m, z - (circle.face == Face::a ? 0 : length_));
      size = std::min(size, circle.size_m + (options_.growth - 1) * distance);
    }
    return size;
  }

  /// Elements there will be, to some 20 %: equilateral triangles of that size, summed over a lattice that follows it.
  [[nodiscard]] double element_estimate() const {
    double sum = 0;
    double z = 0;
    while (z < length_) {
      const double outside = radius(z);
      double r = 0, dz = outside;
      double across = 0;
      while (r < outside) {
        const double size = (*this)(r, z);
        dz = std::min(dz, size);
        across += 4 / std::sqrt(3.0) / size;
        r += size;
        if (across * dz > most_elements) break;
      }
      sum += across * std::min(dz, length_ - z);
      z += dz;
      if (sum > most_elements) break;
    }
    return sum;
  }

 private:
  /// Of the section at z; of the thinner one at a step.
  [[nodiscard]] double radius(double z) const {
    double radius = std::numeric_limits<double>::infinity(), begin = 0;
    for (const Segment& segment : profile_) {
      const double end = begin + segment.length_m, slack = 1e-9 * length_;
      if (z >= begin - slack && z <= end + slack) {
        const double part = std::clamp((z - begin) / segment.length_m, 0.0, 1.0);
        radius = std::min(radius, (segment.diameter_a_m + part * (segment.diameter_b_m - segment.diameter_a_m)) / 2);
      }
      begin = end;
    }
    return radius;
  }

  const Profile& profile_;
  const std::vector<MeshedCircle>& circles_;
  SolidMeshOptions options_;
  double length_ = 0;
};

/// Points of one cross plane by radius, and the lines between neighbours.
class CrossPlane {
 public:
  CrossPlane(double z, std::vector<double> radii) {
    radii.push_back(0);
    std::ranges::sort(radii);
    for (const double r : radii)
      if (points_.empty() || !same(r, points_.back().r)) points_.push_back({r, geometry::addPoint(r, z, 0)});
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
      lines_.push_back(geometry::addLine(points_[i].tag, points_[i + 1].tag));
  }

  [[nodiscard]] int point_at(double r) const {
    return std::ranges::find_if(points_, [&](const Point& point) { return same(r, point.r); })->tag;
  }
  [[nodiscard]] int axis() const { return points_.front().tag; }

  /// Lines from the axis out to r.
  [[nodiscard]] std::vector<int> lines_to(double r) const {
    std::vector<int> lines;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (points_[i + 1].r < r || same(points_[i + 1].r, r)) lines.push_back(lines_[i]);
    return lines;
  }

 private:
  struct Point {
    double r;
    int tag;
  };
  std::vector<Point> points_;
  std::vector<int> lines_;
};

void draw(const Profile& profile, const std::vector<MeshedCircle>& circles) {
  std::vector<CrossPlane> planes;
  double z = 0;
  for (std::size_t i = 0; i <= profile.size(); ++i) {
    std::vector<double> radii;
    if (i > 0) radii.push_back(profile[i - 1].diameter_b_m / 2);
    if (i < profile.size()) radii.push_back(profile[i].diameter_a_m / 2);
    for (const MeshedCircle& circle : circles)
      if (i == (circle.face == Face::a ? 0 : profile.size())) radii.push_back(circle.radius_m);
    planes.emplace_back(z, radii);
    if (i < profile.size()) z += profile[i].length_m;
  }
  std::vector<int> surfaces;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double ra = profile[i].diameter_a_m / 2, rb = profile[i].diameter_b_m / 2;
    std::vector<int> loop = planes[i].lines_to(ra);
    loop.push_back(geometry::addLine(planes[i].point_at(ra), planes[i + 1].point_at(rb)));
    std::vector<int> back = planes[i + 1].lines_to(rb);
    for (auto line = back.rbegin(); line != back.rend(); ++line) loop.push_back(-*line);
    loop.push_back(geometry::addLine(planes[i + 1].axis(), planes[i].axis()));
    surfaces.push_back(geometry::addPlaneSurface({geometry::addCurveLoop(loop)}));
  }
  geometry::synchronize();
  for (const int surface : surfaces) gmsh::model::addPhysicalGroup(2, {surface});
}

}  // namespace

void require_circles(const Profile& profile, const std::vector<MeshedCircle>& circles) {
  require_valid(Bar{.profile = profile});
  for (const MeshedCircle& circle : circles) {
    require(std::isfinite(circle.radius_m) && circle.radius_m > 0, "contact radius {} m is not positive",
            circle.radius_m);
    require(std::isfinite(circle.size_m) && circle.size_m > 0, "mesh size {} m at the contact is not positive",
            circle.size_m);
    const bool is_a = circle.face == Face::a;
    const double face = (is_a ? profile.front().diameter_a_m : profile.back().diameter_b_m) / 2;
    require(circle.radius_m < face || same(circle.radius_m, face),
            "contact radius {:.6g} m is larger than face {}, whose radius is {:.6g} m; use that or less",
            circle.radius_m, is_a ? "A" : "B", face);
  }
}

TriangleMesh solid_mesh(const Profile& profile, const std::vector<MeshedCircle>& circles,
                        const SolidMeshOptions& options) {
  require_circles(profile, circles);
  require_options(options);
  const SizeField size(profile, circles, options);
  const double estimate = size.element_estimate();
  require(estimate <= most_elements,
          "the mesh would have more than {:g} elements; use a larger mesh size, a faster growth or larger elements",
          most_elements);
  const GmshSession session;
  session.run("Gmsh cannot mesh the solid", [&] {
    gmsh::model::add("solid");
    draw(profile, circles);
    gmsh::option::setNumber("Mesh.Algorithm", frontal_delaunay);
    gmsh::option::setNumber("Mesh.ElementOrder", 2);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::model::mesh::setSizeCallback([&](int, int, double r, double z, double) { return size(r, z); });
    gmsh::model::mesh::generate(2);
  });
  return gmsh_triangles(session);
}

}  // namespace impulse
