#include "fem/implicit/equilibrium_path.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/numerics/sparse_cholesky.hpp"
#include "tools/support/shell_body.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace {

using namespace impulse;
using Eigen::VectorXd;

enum class Control { load, displacement, arc };

struct Request {
  ShellOptions body;
  std::optional<double> force_N;
  std::optional<double> pressure_Pa;
  Control control = Control::load;
  std::optional<double> deflection_m;
  std::optional<double> arc_m;
  std::size_t steps = 20;
  bool linear = false;
  std::string output;

  void declare(Command& command) {
    body.declare(command, ShellOptions::Use::statics);
    command.quantity("--force", force_N, "N", Sign::any, "along the normal at the first point --at");
    command.quantity("--pressure", pressure_Pa, "Pa", Sign::any,
                     "along z on every unit of area, in place of --force; keeps its direction");
    command.choice<Control>(
        "--control", control, {{"load", Control::load}, {"displacement", Control::displacement}, {"arc", Control::arc}},
        "what goes in equal steps: the load up to what is given, the deflection at the first point, or the length of "
        "arc; the latter two pass limit points of the load, arc those of the deflection too");
    command.quantity("--deflection", deflection_m, "m", Sign::any,
                     "with --control displacement and arc: where to end, at the first point --at");
    command.quantity("--arc", arc_m, "m", Sign::positive,
                     "with --control arc: longest step, as a root mean square displacement of the panel");
    command.count("--steps", steps, 1, "number of steps; with --control arc the most");
    command.flag("--linear", linear, "small displacements: one row, of the whole load");
    command.output(output);
  }

  void require_consistent(const Command& command) const {
    if (force_N.has_value() == pressure_Pa.has_value())
      throw UsageError("--force",
                       force_N ? "given beside --pressure; leave one of them out" : "is required (or --pressure)");
    if (force_N.value_or(pressure_Pa.value_or(0)) == 0) throw UsageError(force_N ? "--force" : "--pressure", "is zero");
    if (linear)
      for (const char* flag : {"--control", "--deflection", "--arc", "--steps"})
        if (command.given(flag)) throw UsageError(flag, "means nothing with --linear");
    if (control == Control::load && deflection_m) throw UsageError("--deflection", "means nothing to --control load");
    if (control != Control::load && !deflection_m) throw UsageError("--deflection", "is required: where to end");
    if (control != Control::arc && arc_m) throw UsageError("--arc", "belongs to --control arc");
    if (control == Control::arc && !arc_m) throw UsageError("--arc", "is required with --control arc");
  }
};

/// The rows of the answer.
class LoadDeflection {
 public:
  LoadDeflection(const Request& request, const Shell& shell) : request_(request), shell_(shell) {
    const std::vector<PanelPoint> points = request.body.points();
    for (const PanelPoint& point : points)
      readings_.push_back(shell.displacement_functional(point, shell.normal(point)));
    if (readings_.front().isZero(1e-12) && (request.force_N || request.control != Control::load))
      throw UsageError("--at", "the first point is on a support, which doesn't let it move");
  }

  [[nodiscard]] VectorXd load() const {
    return request_.force_N ? VectorXd(*request_.force_N * readings_.front())
                            : shell_.uniform_load({0, 0, *request_.pressure_Pa});
  }
  [[nodiscard]] const VectorXd& deflection() const { return readings_.front(); }

  void add(const PathPoint& point, double energy_J) { rows_.push_back({point, energy_J}); }

  void write() const {
    std::vector<std::string> names{request_.force_N ? "force_N" : "pressure_Pa"};
    for (std::size_t i = 0; i < readings_.size(); ++i)
      names.push_back(readings_.size() == 1 ? "deflection_m" : fmt::format("deflection_{}_m", i + 1));
    names.insert(names.end(), {"energy_J", "iterations"});
    CsvOutput csv(request_.output, names);
    for (const auto& [point, energy_J] : rows_) {
      std::vector<CsvField> row{point.load_factor * request_.force_N.value_or(request_.pressure_Pa.value_or(0))};
      for (const VectorXd& reading : readings_) row.emplace_back(reading.dot(point.displacement));
      row.emplace_back(energy_J);
      row.emplace_back(static_cast<double>(point.iterations));
      csv.row(row);
    }
    csv.close();
  }

 private:
  struct Row {
    PathPoint point;
    double energy_J;
  };
  const Request& request_;
  const Shell& shell_;
  std::vector<VectorXd> readings_;
  std::vector<Row> rows_;
};

/// What theory of small displacements has for the whole load. Refuses supports that leave a rigid motion, on which
/// Newton's method would only be said to fail.
PathPoint linear_answer(const Shell& shell, const VectorXd& load) {
  const Eigen::SparseMatrix<double> stiffness = shell.tangent(VectorXd::Zero(shell.size()));
  const std::optional<SparseCholesky> factor = SparseCholesky::of(stiffness);
  const std::optional<VectorXd> z = factor ? answer_of_held(*factor, stiffness, load) : std::nullopt;
  if (!z) throw UsageError("--edges", "the supports leave the panel free to move as a rigid body");
  return {1, *z, 1};
}

/// One step; false at the end of the path.
bool step(const Request& request, const LoadDeflection& answer, std::size_t k, EquilibriumPath& path) {
  const double part = static_cast<double>(k) / static_cast<double>(request.steps);
  const double end = request.deflection_m.value_or(0);
  switch (request.control) {
    case Control::load:
      (void)path.load_to(part);
      break;
    case Control::displacement:
      (void)path.displace_to(answer.deflection(), part * end);
      break;
    case Control::arc: {
      const double before = answer.deflection().dot(path.point().displacement);
      const double after = answer.deflection().dot(path.follow_arc(*request.arc_m).displacement);
      return (before - end) * (after - end) > 0;
    }
  }
  return k < request.steps;
}

int run(const Request& request, const Command& command) {
  request.require_consistent(command);
  const Shell shell(request.body.panel());
  LoadDeflection answer(request, shell);
  const PathPoint linear = linear_answer(shell, answer.load());
  if (request.linear) {
    answer.add(linear, linear.displacement.dot(answer.load()) / 2);
    answer.write();
    return 0;
  }
  EquilibriumPath path(elastic_body(shell), answer.load());
  answer.add(path.point(), 0);
  try {
    for (std::size_t k = 1; k <= request.steps; ++k) {
      const bool goes_on = step(request, answer, k, path);
      answer.add(path.point(), shell.internal(path.point().displacement).energy_J);
      if (!goes_on) break;
    }
  } catch (const ConvergenceError&) {
    answer.write();  // what there is up to here
    throw;
  }
  answer.write();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"fe-panel-static", "load and deflection of a thin laminated panel, through its limit points",
       "Shell elements with moderately large rotations, the exact tangent and Newton's method. Columns: force_N or "
       "pressure_Pa; deflection_m along the normal at each point --at; energy_J, elastic; iterations. If no "
       "equilibrium is found the rows up to there are written.",
       "fe-panel-static --size 508mm,508mm --curvature-radius 2.54m --edges IFIF --material 3.10275GPa:1200kg/m3:0.3 "
       "\\\n  --thickness 12.7mm --elements 6,6 --force 3kN --control displacement --deflection 25mm --steps 25"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
