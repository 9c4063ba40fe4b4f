#include "fem/bodies/axisymmetric_solid.hpp"
#include "fem/implicit/step_response.hpp"
#include "impulse/response/displacement_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/vtu/vtu_file.hpp"
#include "tools/support/solid_options.hpp"
#include "tools/support/two_outputs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

namespace {

using namespace impulse;

enum class Output { response, modes };
enum class Route { modes, steps };

struct Request {
  SolidOptions body;
  Output as = Output::response;
  std::optional<Route> route;
  std::optional<double> step_s;
  std::optional<double> duration_s;
  std::size_t modes = 200;
  std::optional<std::size_t> substeps;
  std::optional<std::size_t> observed_node;
  std::optional<std::string> vtu;
  std::size_t vtu_count = 10;
  std::string output;

  void declare(Command& command) {
    body.declare(command);
    command.quantity("--step", step_s, "s", Sign::positive, "time step of the response");
    command.quantity("--duration", duration_s, "s", Sign::positive, "duration; round(duration/step) + 1 samples");
    command.choice<Output>("--as", as, {{"response", Output::response}, {"modes", Output::modes}}, "what to write");
    command.choice<Route>("--response", route, {{"modes", Route::modes}, {"steps", Route::steps}},
                          "superposition of modes, the others' flexibility added, or integration in time (default: the "
                          "cheaper one, which a message names)");
    command.count("--modes", modes, 1, "number of modes, the rigid-body mode included");
    command.count("--substeps", substeps, 1,
                  "steps of the integration within one of the response (default: so that waves cross the radius of "
                  "contact in four or more)");
    command.count("--observe-node", observed_node, 1,
                  "with --contact pressure: not the mean motion of the circle, but that of its node with this number, "
                  "from the axis; not passive, since the force does no work on it");
    command.output_file("--vtu", vtu, "write mode shapes, or the body's motion under a unit step force, to FILE (VTK)");
    command.count("--vtu-count", vtu_count, 1, "how many mode shapes or moments, these equally spaced");
    command.output(output);
  }

  void require_consistent(const Command& command) const {
    if (as == Output::modes) {
      for (const char* flag : {"--step", "--duration", "--response", "--substeps", "--observe-node"})
        if (command.given(flag)) throw UsageError(flag, "is for a response; leave it out with --as modes");
      require_modal_contact("--as");
    } else {
      if (!step_s) throw UsageError("--step", "is required for a response");
      if (!duration_s) throw UsageError("--duration", "is required for a response");
    }
    if (observed_node && body.contact() != CircleContact::pressure)
      throw UsageError("--observe-node", "goes with --contact pressure");
    if (observed_node && body.face_count() != 1) throw UsageError("--observe-node", "takes one --face");
    if (!route && substeps && command.given("--modes"))
      throw UsageError("--substeps", "is for a response by steps, --modes for one by modes; leave one of them out");
    if (route == Route::modes || (!route && command.given("--modes"))) {
      require_modal_contact(route ? "--response" : "--modes");
      if (observed_node) throw UsageError("--observe-node", "needs --response steps");
      if (substeps) throw UsageError("--substeps", "is for --response steps");
    }
    if (route == Route::steps && command.given("--modes")) throw UsageError("--modes", "is for --response modes");
    if (command.given("--vtu-count") && !vtu) throw UsageError("--vtu-count", "goes with --vtu");
    require_apart("--vtu", vtu, output);
  }

  /// The flexibility that modes leave out couples neighbouring nodes at once, which no solver of contacts takes.
  void require_modal_contact(const char* flag) const {
    if (body.contact() == CircleContact::nodes)
      throw UsageError(flag,
                       "modes do not tell how neighbouring nodes of a circle press on each other at once; use "
                       "--response steps, or --contact punch or pressure");
  }
};

VtuGrid vtu_grid(const TriangleMesh& mesh) {
  VtuGrid grid{.points = Eigen::MatrixX3d::Zero(mesh.node_count(), 3),
               .cells = mesh.elements,
               .kind = VtuCell::quadratic_triangle};
  grid.points.leftCols<2>() = mesh.nodes;
  return grid;
}

VtuField vtu_field(const SolidStructure& solid, std::string name, const Eigen::Ref<const Eigen::VectorXd>& u) {
  VtuField field{std::move(name), Eigen::MatrixXd::Zero(solid.freedoms.rows(), 3)};
  field.values.leftCols<2>() = solid.nodal(u);
  return field;
}

void write_picture(const std::string& path, const AxisymmetricSolid& body, const std::vector<VtuField>& fields) {
  const Eigen::VectorXd region = Eigen::Map<const Eigen::VectorX<std::size_t>>(
                                     body.mesh.region.data(), static_cast<Eigen::Index>(body.mesh.region.size()))
                                     .cast<double>()
                                     .array() +
                                 1;
  write_vtu(path, vtu_grid(body.mesh), fields, {{"material_number", region}});
}

ModalModel modes_of(const Request& request, const AxisymmetricSolid& body, const SolidStructure& solid) {
  const ModalModel modes = modal_model(
      solid.structure, {.mode_count = request.modes,
                        .residual = ModalOptions::Residual::attached,
                        .shapes = request.vtu ? ModalOptions::Shapes::kept : ModalOptions::Shapes::left_out});
  if (request.vtu) {
    std::vector<VtuField> fields;
    for (Eigen::Index i = 0; i < std::min<Eigen::Index>(modes.mode_count(), request.vtu_count); ++i)
      fields.push_back(vtu_field(
          solid,
          fmt::format("mode_{}_{:.6g}_Hz_per_sqrt_kg", i + 1, modes.angular_frequency(i) / (2 * std::numbers::pi)),
          modes.shapes.col(i)));
    write_picture(*request.vtu, body, fields);
  }
  return modes;
}

/// Waves of the fastest kind cross the circle's radius in four steps.
std::size_t resolving_substeps(const Request& request, const AxisymmetricSolid& body) {
  double fastest = 0;
  for (const AxisymmetricElasticity& material : body.materials)
    fastest = std::max(fastest, material.axial_wave_speed_m_per_s());
  return static_cast<std::size_t>(std::ceil(4 * fastest * *request.step_s / request.body.contact_radius_m()));
}

Response response_by_steps(const Request& request, const UniformGrid& grid, const AxisymmetricSolid& body,
                           SolidStructure& solid, std::size_t substeps) {
  Structure& structure = solid.structure;
  if (request.observed_node) {
    const std::size_t count = solid.contact_nodes.size(), node = *request.observed_node;
    if (node > count) throw UsageError("--observe-node", fmt::format("the circle has {} nodes, not {}", count, node));
    const bool at_edge = node == count;
    structure.outputs = Eigen::MatrixXd::Zero(structure.contacts.rows(), 1);
    structure.outputs(solid.freedoms(solid.contact_nodes[node - 1], 1), 0) = structure.contacts.sum() > 0 ? 1 : -1;
    // Beside the edge there is pressure on one side only, and at first half the velocity.
    if (at_edge) structure.wave_admittance /= 2;
  }
  std::vector<VtuField> moments;
  StepResponseOptions options{.substeps = substeps, .observer = {}};
  if (request.vtu)
    options.observer = [&](std::size_t load, std::size_t sample, const Eigen::VectorXd& u) {
      // Of the equally spaced moments the one that this sample is the first not to precede.
      const auto moment = [&](std::size_t n) { return n * request.vtu_count / (grid.size - 1); };
      if (load == 0 && sample > 0 && moment(sample) > moment(sample - 1))
        moments.push_back(vtu_field(solid, fmt::format("step_displacement_at_{:g}_s_m_per_N", grid.time_s(sample)), u));
    };
  std::vector<std::vector<double>> u = step_displacements(structure, grid, options);
  if (request.observed_node) u.erase(u.begin());
  if (request.vtu) write_picture(*request.vtu, body, moments);
  return displacement_response(grid, u, structure.wave_admittance);
}

/// One mode costs about as much as ten solutions of a time step, its orthogonalisation counted.
constexpr std::size_t solutions_per_mode = 10;

/// What was asked for, or the cheaper one.
Route chosen_route(const Request& request, const Command& command, const UniformGrid& grid, std::size_t substeps) {
  if (request.route) return *request.route;
  if (request.substeps) return Route::steps;
  if (command.given("--modes")) return Route::modes;
  const std::size_t solutions = (grid.size - 1) * substeps * request.body.face_count();
  if (request.body.contact() == CircleContact::nodes || request.observed_node) {
    fmt::print(stderr, "ir-solid: response by steps (single nodes need it)\n");
    return Route::steps;
  }
  const std::size_t modal = solutions_per_mode * request.modes;
  const bool by_steps = solutions < modal;
  fmt::print(stderr,
             "ir-solid: response by {} ({} steps against {} modes, each worth about {} steps); --response chooses\n",
             by_steps ? "steps" : "modes", solutions, request.modes, solutions_per_mode);
  return by_steps ? Route::steps : Route::modes;
}

int run(const Request& request, const Command& command) {
  request.require_consistent(command);
  std::optional<UniformGrid> grid;
  if (request.as == Output::response) grid = grid_over(*request.duration_s, *request.step_s);
  const AxisymmetricSolid body = request.body.solid(MassMatrix::consistent);
  SolidStructure solid = axisymmetric_structure(body);
  if (!grid) {
    write_modes(request.output, modes_of(request, body, solid));
    return 0;
  }
  const std::size_t substeps = request.substeps.value_or(resolving_substeps(request, body));
  if (chosen_route(request, command, *grid, substeps) == Route::modes)
    write_response(request.output, modal_response(modes_of(request, body, solid), *grid));
  else
    write_response(request.output, response_by_steps(request, *grid, body, solid, substeps));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-solid", "impulse response of a solid of revolution struck on a circle about its axis",
       "Axisymmetric elasticity without twist by 6-node triangles, for bodies whose face is larger than what strikes "
       "it: "
       "local compliance, waves that spread, dispersion of thick rods. Columns as ir-bar; with --contact nodes a "
       "matrix "
       "of the nodes of the circle. The rigid flat's circle is held together by the punch, so its edge is singular: "
       "with "
       "elements of a size h there the compliance is too small by about 0.09 h/a of the radius a. The response by "
       "modes "
       "holds the flexibility of the modes left out (U(0) > 0); the response by steps resolves the first waves.",
       "ir-solid --segment 400mm,30mm,75mm,nylon-6:0.40 --face B --contact-radius 5mm --contact punch --step 1us "
       "--duration 0.2ms --response steps"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
