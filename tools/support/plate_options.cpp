#include "tools/support/plate_options.hpp"

#include "lib/cli/blamed_on.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace impulse {
namespace {

struct SpringColumn {
  const char* name;
  double EdgeSprings::*stiffness;
  bool HeldEdge::*held;
  const char* motion;
};

constexpr std::array<SpringColumn, 5> spring_columns{{
    {"deflection_N_per_m2", &EdgeSprings::deflection_N_per_m2, &HeldEdge::deflection, "deflection"},
    {"normal_displacement_N_per_m2", &EdgeSprings::normal_displacement_N_per_m2, &HeldEdge::normal_displacement,
     "normal displacement"},
    {"tangential_displacement_N_per_m2", &EdgeSprings::tangential_displacement_N_per_m2,
     &HeldEdge::tangential_displacement, "tangential displacement"},
    {"normal_rotation_N", &EdgeSprings::normal_rotation_N, &HeldEdge::normal_rotation, "normal rotation"},
    {"tangential_rotation_N", &EdgeSprings::tangential_rotation_N, &HeldEdge::tangential_rotation,
     "tangential rotation"},
}};

void require_known_columns(const CsvTable& table) {
  bool any = false;
  for (const std::string& name : table.names()) {
    bool known = name == "edge";
    for (const SpringColumn& column : spring_columns) {
      known = known || name == column.name;
      any = any || name == column.name;
    }
    if (!known)
      throw InputError(table.file(), 1, table.field(name),
                       fmt::format("column {} is none of edge, deflection_N_per_m2, normal_displacement_N_per_m2, "
                                   "tangential_displacement_N_per_m2, normal_rotation_N, tangential_rotation_N",
                                   name));
  }
  if (!any) throw InputError(table.file(), 1, 0, "no column of springs, deflection_N_per_m2 say");
}

std::array<EdgeSprings, 4> read_springs(const std::string& path, const std::array<HeldEdge, 4>& supports) {
  const CsvTable table = read_csv(path);
  require_known_columns(table);
  std::array<EdgeSprings, 4> springs{};
  const std::vector<double>& edges = table.column("edge");
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (!(edges[row] == 1 || edges[row] == 2 || edges[row] == 3 || edges[row] == 4))
      throw InputError(table.file(), table.line(row), table.field("edge"),
                       fmt::format("edge {} is none of 1, 2, 3, 4", edges[row]));
    const std::size_t edge = static_cast<std::size_t>(edges[row]) - 1;
    for (const SpringColumn& column : spring_columns) {
      if (!table.has(column.name)) continue;
      const double stiffness = table.column(column.name)[row];
      const auto refuse = [&](const std::string& why) {
        throw InputError(table.file(), table.line(row), table.field(column.name), why);
      };
      if (stiffness < 0) refuse(fmt::format("the stiffness {} is negative", stiffness));
      if (stiffness > 0 && supports[edge].*column.held)
        refuse(fmt::format("a spring does nothing where --edges hold the {} of edge {}; give it 0, or another letter",
                           column.motion, edge + 1));
      springs[edge].*column.stiffness += stiffness;
    }
  }
  return springs;
}

/// Springs in the plane do something only to a plate that moves in it.
void require_moving(const Plate& plate) {
  if (moves_in_plane(plate)) return;
  for (std::size_t i = 0; i < 4; ++i)
    if (plate.springs[i].normal_displacement_N_per_m2 > 0 || plate.springs[i].tangential_displacement_N_per_m2 > 0)
      throw UsageError("--edge-springs",
                       fmt::format("edge {} has springs against displacement in the plane, where nothing moves a flat "
                                   "plate without coupling; leave them out, or ask for --in-plane always",
                                   i + 1));
}

}  // namespace

void PlateOptions::declare(Command& command) {
  command.body("plate");
  command.quantity("--size", size_m_, "m", Sign::positive, "sides A,B of a rectangle, along x and y");
  command.quantity("--corners", corners_m_, "m", Sign::any,
                   "in place of --size: X1,Y1,X2,Y2,X3,Y3,X4,Y4 of any convex quadrilateral, in order round it");
  laminate_.declare(command);
  command
      .text("--edges", edges_, "LETTERS",
            "what holds edge 1 (from corner 1 to 2), 2, 3 and 4: C clamped; F free; I u=v=w=0; H as I, and tangential "
            "rotation 0; S w, normal displacement and tangential rotation 0; T w, tangential displacement and rotation "
            "0; W w=0")
      .required();
  command.text("--edge-springs", edge_springs_, "FILE",
               "springs along edges: column edge (1 to 4), and some of deflection_N_per_m2, "
               "normal_displacement_N_per_m2, tangential_displacement_N_per_m2, normal_rotation_N, "
               "tangential_rotation_N");
  command.quantity("--at", at_, "1", Sign::any,
                   "point struck, as fractions X,Y: 0,0 is corner 1, 1,1 corner 3; repeat for several points");
  command.choice<Plate::Theory>("--theory", theory_, {{"shear", Plate::Theory::shear}, {"thin", Plate::Theory::thin}},
                                "first-order shear deformation, or the classical thin plate");
  command.quantity("--shear-correction", shear_correction_, "1", Sign::positive,
                   "factor of the transverse shear stiffness (default: 5/6)");
  command.quantity("--patch-radius", patch_radius_m_, "m", Sign::positive,
                   "of the disc on which the force presses evenly, the radius of contact say (default: a point; a "
                   "shear-deformable plate needs a patch)");
  command.quantity("--curvature-radius", curvature_radius_m_, "m", Sign::any,
                   "of a panel curved along y; positive: the convex side is struck (default: flat)");
  command.count("--terms", terms_, 2, "of the series, along each side");
  command.choice<Plate::InPlane>("--in-plane", in_plane_,
                                 {{"when-coupled", Plate::InPlane::when_coupled}, {"always", Plate::InPlane::always}},
                                 "motion in the plane: where the force causes some, or always (its modes too)");
}

PlateShape PlateOptions::shape() const {
  if (size_m_.empty() && corners_m_.empty()) throw UsageError("--size", "is required (or --corners)");
  if (!size_m_.empty() && !corners_m_.empty())
    throw UsageError("--size", "given beside --corners; leave one of them out");
  if (!size_m_.empty()) {
    if (size_m_.size() != 2)
      throw UsageError("--size", fmt::format("{} lengths, two are needed: 15cm,10cm", size_m_.size()));
    const PlateShape shape = rectangle(size_m_[0], size_m_[1]);
    blamed_on("--size", [&] { require_valid(shape); });
    return shape;
  }
  if (corners_m_.size() != 8)
    throw UsageError("--corners",
                     fmt::format("{} coordinates, eight are needed: X1,Y1,X2,Y2,X3,Y3,X4,Y4", corners_m_.size()));
  PlateShape shape;
  for (std::size_t i = 0; i < 4; ++i) shape.corners[i] = {corners_m_[2 * i], corners_m_[2 * i + 1]};
  blamed_on("--corners", [&] { require_valid(shape); });
  return shape;
}

bool PlateOptions::is_clockwise() const { return shape().signed_area() < 0; }

RitzPlate PlateOptions::plate() const {
  Plate plate;
  plate.shape = shape();
  plate.laminate = laminate_.laminate();
  plate.edges = blamed_on("--edges", [&] { return parse_plate_edges(edges_); });
  if (edge_springs_) plate.springs = read_springs(*edge_springs_, plate.edges);
  plate.theory = theory_;
  plate.in_plane = in_plane_;
  if (shear_correction_) {
    if (theory_ == Plate::Theory::thin)
      throw UsageError("--shear-correction", "means nothing to --theory thin; leave it out");
    plate.shear_correction = *shear_correction_;
  }
  if (curvature_radius_m_) {
    if (*curvature_radius_m_ == 0) throw UsageError("--curvature-radius", "is 0; leave it out for a flat plate");
    plate.curvature_per_m = 1 / *curvature_radius_m_;
    blamed_on("--curvature-radius", [&] { require_valid(plate); });
  }
  if (edge_springs_) require_moving(plate);
  return blamed_on("--terms", [&] { return RitzPlate(plate, terms_); });
}

std::vector<Eigen::Vector2d> PlateOptions::reference_points(const std::string& flag,
                                                            const std::vector<double>& fractions) {
  if (fractions.size() % 2 != 0)
    throw UsageError(flag, fmt::format("{} fractions make no points; give X,Y for each", fractions.size()));
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < fractions.size(); i += 2) {
    for (const double fraction : {fractions[i], fractions[i + 1]})
      if (!(fraction >= 0 && fraction <= 1))
        throw UsageError(flag, fmt::format("{},{} is outside the plate; fractions are from 0 to 1, and 0.5,0.5 is the "
                                           "middle",
                                           fractions[i], fractions[i + 1]));
    points.emplace_back(2 * fractions[i] - 1, 2 * fractions[i + 1] - 1);
  }
  return points;
}

StruckPlate PlateOptions::struck(const RitzPlate& plate) const {
  const std::vector<Eigen::Vector2d> points = struck_points();
  if (!points.empty() && theory_ == Plate::Theory::shear && !patch_radius_m_)
    throw UsageError("--patch-radius",
                     "is required with --theory shear (under a point force the deflection of a shear-deformable plate "
                     "has no limit); give the radius of the contact, or take --theory thin");
  if (points.empty() && patch_radius_m_) throw UsageError("--at", "is required with --patch-radius");
  Eigen::MatrixXd contacts(plate.unknown_count(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    contacts.col(static_cast<Eigen::Index>(i)) =
        patch_radius_m_
            ? blamed_on("--patch-radius", [&] { return plate.mean_deflection(points[i], *patch_radius_m_); })
            : plate.deflection(points[i]);
  // A point on an edge that is held does not move, whatever the force.
  for (Eigen::Index i = 0; i < contacts.cols(); ++i)
    if (contacts.col(i).norm() <= 1e-12 * plate.deflection({0, 0}).norm())
      throw UsageError("--at",
                       fmt::format("{},{} is held; a force there moves nothing", at_[2 * static_cast<std::size_t>(i)],
                                   at_[2 * static_cast<std::size_t>(i) + 1]));
  StruckPlate struck{plate.structure(), {}};
  struck.structure.contacts = contacts;
  if (theory_ == Plate::Theory::thin && !patch_radius_m_ && !points.empty()) {
    struck.missing.emplace(plate, struck.structure, points);
    struck.structure.residual_flexibility = struck.missing->flexibility();
  }
  return struck;
}

std::optional<std::string> PlateOptions::patch_doubt(const RitzPlate& plate, std::size_t point,
                                                     double flexibility_m_per_N) const {
  if (theory_ == Plate::Theory::thin || !patch_radius_m_) return std::nullopt;
  const Plate& body = plate.plate();
  // Below this radius the terms (fitted to squares, 16 to 32 terms) or the theory see a point.
  const double side = std::sqrt(std::abs(body.shape.jacobian(struck_points()[point]).determinant()));
  const double series = 0.7 * side / static_cast<double>(terms_), theory = body.laminate.thickness_m / 4;
  const double seen = std::max(series, theory);
  const double share = std::log(seen / *patch_radius_m_) /
                       (2 * std::numbers::pi * body.shear_correction *
                        std::sqrt(body.laminate.transverse_shear.determinant()) * flexibility_m_per_N);
  if (!(share > 0.01)) return std::nullopt;
  return fmt::format(
      "--patch-radius: {:.3g} m is far below {:.3g} m, {}; {:.2g} % of the deflection under the force hang on that and "
      "would grow with --terms, since a shear-deformable plate yields to a point without limit. Give the radius of the "
      "contact, or take --theory thin",
      *patch_radius_m_, seen,
      series > theory ? "the smallest patch that the series resolve" : "a quarter of the thickness", 100 * share);
}

}  // namespace impulse
