#include "fem/reduced_basis/nonlinear_cost.hpp"
#include "fem/reduced_basis/panel_impact.hpp"
#include "lib/cli/law_options.hpp"
#include "lib/cli/progress.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/law/impact_csv.hpp"
#include "lib/law/indentation_time.hpp"
#include "tools/support/shell_body.hpp"
#include "tools/support/shell_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace impulse;

enum class Method { newmark, conserving, wilson, modes, ritz, tensor, reduced };

struct Request {
  ShellOptions body;
  LawOptions law;
  ImplicitImpactSetup setup;
  double duration_s = 0;
  Method method = Method::newmark;
  PanelImpactOptions options;
  StepRule rule = StepRule::newmark;
  bool linear = false;
  std::optional<double> update_tolerance;
  bool summary = false;
  std::optional<std::string> contacts, points, statistics;
  std::vector<PanelFraction> probes;
  std::optional<std::string> vtu;
  std::size_t vtu_count = 10;
  std::string output;

  void declare(Command& command) {
    body.declare(command, ShellOptions::Use::impact);
    law.declare(command);
    command.quantity("--mass", setup.striker_mass_kg, "kg", Sign::positive, "of the rigid striker").required();
    command.quantity("--speed", setup.speed_m_per_s, "m/s", Sign::positive, "of the striker").required();
    command.quantity("--step", setup.step_s, "s", Sign::positive, "time step").required();
    command.quantity("--duration", duration_s, "s", Sign::positive, "round(duration/step) + 1 samples").required();
    command.choice<Method>("--method", method,
                           {{"newmark", Method::newmark},
                            {"conserving", Method::conserving},
                            {"wilson", Method::wilson},
                            {"modes", Method::modes},
                            {"ritz", Method::ritz},
                            {"tensor", Method::tensor},
                            {"reduced", Method::reduced}},
                           "the whole mesh by one of three rules, or its motion in a basis: modes of vibration, Ritz "
                           "vectors of the contact force, or these with tensors for the nonlinearity; reduced: Ritz "
                           "vectors with tensors or with the mesh evaluated, whichever is cheaper, and says which");
    command.choice<StepRule>(
        "--rule", rule,
        {{"newmark", StepRule::newmark}, {"conserving", StepRule::conserving}, {"wilson", StepRule::wilson}},
        "step of what is in a basis");
    command.flag("--linear", linear, "small displacements of the panel");
    command.count("--vectors", options.vectors, 1, "of a basis");
    command.choice<ModeKind>("--modes", options.modes, {{"any", ModeKind::any}, {"flexural", ModeKind::flexural}},
                             "which modes, the lowest first: any, or those that move mostly along the normal");
    command.count("--nonlinear-vectors", options.nonlinear_vectors, 1,
                  "of tensor and reduced: how many of the vectors have finite amplitudes, the first ones; at most 40");
    command.choice<LeftOut>("--left-out", options.left_out, {{"static", LeftOut::static_}, {"rigid", LeftOut::rigid}},
                            "whether what the vectors leave out yields statically under the contact force");
    command.quantity("--update", options.update_s, "s", Sign::positive,
                     "of ritz: times at which vectors of the present state are added");
    command.quantity("--update-tolerance", update_tolerance, "1", Sign::positive,
                     "of ritz: add them whenever the unbalanced force is above this");
    command.count("--update-vectors", options.update_vectors, 1, "how many are added each time");
    command.parsed<PanelFraction>("--probe", probes, parse_panel_fraction, "FX,FY",
                                  "point whose deflection and strains go to --points, as fractions of the sides");
    command.output_file("--points", points, "write deflection and strains of every --probe to FILE");
    command.output_file("--contacts", contacts, "write a row for every period of contact to FILE");
    command.output_file(
        "--statistics", statistics,
        "write one row to FILE: unknowns, iterations, factorisations, energy drift, unbalanced force (the "
        "largest of some fifty steps), seconds of the parts of the set-up and of the steps");
    command.output_file("--vtu", vtu, "write the panel with its displacements to FILE (VTK)");
    command.count("--vtu-count", vtu_count, 1, "at how many moments, equally spaced, the last one the end");
    command.flag("--summary", summary, "write one row about the impact instead of its history");
    command.output(output);
  }

  [[nodiscard]] bool reduced() const {
    return method != Method::newmark && method != Method::conserving && method != Method::wilson;
  }

  void require_consistent(const Command& command) const {
    const auto refuse_unless = [&](bool applies, const char* flag, const char* where) {
      if (!applies && command.given(flag)) throw UsageError(flag, where);
    };
    for (const char* flag : {"--vectors", "--rule", "--left-out"})
      refuse_unless(reduced(), flag, "belongs to --method modes, ritz, tensor or reduced");
    refuse_unless(method == Method::modes, "--modes", "belongs to --method modes");
    refuse_unless((method == Method::tensor || method == Method::reduced) && !linear, "--nonlinear-vectors",
                  "belongs to --method tensor or reduced without --linear");
    refuse_unless(options.nonlinear_vectors <= options.vectors, "--nonlinear-vectors", "more than there are --vectors");
    for (const char* flag : {"--update", "--update-tolerance"})
      refuse_unless(method == Method::ritz, flag, "belongs to --method ritz");
    for (const double time : options.update_s)
      refuse_unless(time < duration_s, "--update", "is after the end, --duration");
    refuse_unless(command.given("--update") || command.given("--update-tolerance"), "--update-vectors",
                  "belongs to --update or --update-tolerance");
    if (points.has_value() != !probes.empty())
      throw UsageError(points ? "--points" : "--probe", "--probe says where, --points to which file; give both");
    refuse_unless(vtu.has_value(), "--vtu-count", "goes with --vtu");
    if (rule == StepRule::wilson && reduced() && options.left_out == LeftOut::static_)
      throw UsageError("--rule", "wilson takes no static flexibility; add --left-out rigid");
    if (body.points().size() != 1) throw UsageError("--at", "an impact has one point");
  }

  /// The options of the parts that follow from --method.
  void settle() {
    static constexpr PanelMethod methods[7] = {PanelMethod::full,  PanelMethod::full, PanelMethod::full,
                                               PanelMethod::modes, PanelMethod::ritz, PanelMethod::tensor,
                                               PanelMethod::tensor};
    static constexpr StepRule rules[3] = {StepRule::newmark, StepRule::conserving, StepRule::wilson};
    options.method = methods[static_cast<std::size_t>(method)];
    setup.rule = reduced() ? rule : rules[static_cast<std::size_t>(method)];
    options.geometry = linear ? Geometry::linear : Geometry::nonlinear;
    if (update_tolerance) options.update_tolerance = *update_tolerance;
    if (method == Method::reduced && linear) options.method = PanelMethod::ritz;
    if (options.method == PanelMethod::tensor)
      options.nonlinear_vectors = std::min(options.nonlinear_vectors, options.vectors);
  }

  /// Of --method reduced: tensors or the mesh.
  void choose_evaluation(std::size_t elements) {
    if (linear) return;
    const NonlinearCost cost = nonlinear_cost(options.nonlinear_vectors, elements);
    const bool tensors = cost.tensors < cost.mesh;
    if (!tensors) options.method = PanelMethod::ritz;
    fmt::print(stderr,
               "fe-shell: nonlinear forces by {}: tensors of {} vectors cost {:.2g} of evaluating {} elements\n",
               tensors ? "tensors" : "the mesh", options.nonlinear_vectors, cost.tensors / cost.mesh, elements);
  }
};

/// Deflections and strains of the probes, one row per sample.
class ProbeRecord {
 public:
  ProbeRecord(const Request& request, const Shell& shell) : request_(request), shell_(shell) {
    const PanelShape& shape = shell.panel().shape;
    for (const PanelFraction& at : request.probes) points_.push_back({at.x * shape.length_m, at.y * shape.width_m});
  }

  void add(double time_s, const PanelImpact& run) {
    if (points_.empty()) return;
    const Eigen::VectorXd q = run.displacement();
    const double half = shell_.panel().laminate.thickness_m / 2;
    std::vector<CsvField> row{time_s};
    for (const PanelPoint& point : points_) {
      row.emplace_back(shell_.normal(point).dot(shell_.displacement(q, point)));
      const ShellStrain strain = request_.linear ? shell_.small_strain(q, point) : shell_.strain(q, point);
      for (const double z : {-half, half})
        for (int k = 0; k < 3; ++k) row.emplace_back(strain.membrane(k) + z * strain.curvature(k));
    }
    rows_.push_back(std::move(row));
  }

  void write() const {
    if (points_.empty()) return;
    std::vector<std::string> names{"time_s"};
    for (std::size_t i = 1; i <= points_.size(); ++i) {
      names.push_back(fmt::format("deflection_{}_m", i));
      for (const char* side : {"struck", "far"})
        for (const char* component : {"x", "y", "xy"})
          names.push_back(fmt::format("strain_{}_{}_{}", component, side, i));
    }
    CsvOutput csv(*request_.points, names);
    for (const auto& row : rows_) csv.row(row);
    csv.close();
  }

 private:
  const Request& request_;
  const Shell& shell_;
  std::vector<PanelPoint> points_;
  std::vector<std::vector<CsvField>> rows_;
};

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Times {
  double mesh_s = 0, set_up_s = 0, stepping_s = 0;
};

void write_statistics(const std::string& path, const PanelImpact& run, const std::vector<PanelStep>& samples,
                      const Times& times) {
  double unbalanced = 0;
  for (const PanelStep& step : samples) unbalanced = std::max(unbalanced, run.unbalanced_force(step));
  const auto steps = static_cast<double>(run.impact().trace().force_N.size() - 1);
  CsvOutput csv(path,
                {"unknowns", "updates", "steps", "iterations", "factorisations", "energy_drift", "unbalanced_force",
                 "mesh_s", "factorisation_s", "vectors_s", "tensors_s", "set_up_s", "stepping_s", "time_per_step_s"});
  csv.row({static_cast<double>(run.unknowns()), static_cast<double>(run.update_count()), steps,
           static_cast<double>(run.impact().iteration_count()), static_cast<double>(run.impact().factorisation_count()),
           run.energy_drift(), unbalanced, times.mesh_s, run.set_up().factorisation_s, run.set_up().vectors_s,
           run.set_up().tensors_s, times.set_up_s, times.stepping_s, times.stepping_s / steps});
  csv.close();
}

/// Whether the record goes on to the time that was asked for.
enum class Ending { reached, broken_off };

void write_impact(const Request& request, const PanelImpact& run, Ending ending) {
  const ContactTrace& trace = run.impact().trace();
  if (trace.force_N.size() < 2) return;
  const UniformGrid grid{request.setup.step_s, trace.force_N.size()};
  if (ending == Ending::reached && trace.in_contact.back())
    fmt::print(stderr, "fe-shell: the record ends during contact, after {:g} s; use a longer --duration\n",
               grid.duration_s());
  if (request.contacts) write_intervals(*request.contacts, grid, {trace});
  if (!request.summary) {
    write_traces(request.output, grid, {trace});
    return;
  }
  const double lost = trace.work_1_J.back() + trace.work_2_J.back() + trace.stored_J.back() + trace.dissipated_J.back();
  const double scale = request.setup.speed_m_per_s * trace.running_impulse_Ns.back();
  write_summary(request.output, contacts_summary({trace}, grid,
                                                 {.speed_1_m_per_s = request.setup.speed_m_per_s,
                                                  .mass_1_kg = request.setup.striker_mass_kg,
                                                  .energy_error = scale > 0 ? std::abs(lost) / scale : 0}));
}

int run(Request& request, const Command& command) {
  request.require_consistent(command);
  request.settle();
  const UniformGrid grid = grid_over(request.duration_s, request.setup.step_s);
  const ContactLaw law = request.law.laws(1).front();
  if (law.is_rigid()) throw UsageError("--law", "a striker on a panel needs a law that yields; give --law hertz");
  const double time = indentation_time_s(law, request.setup.striker_mass_kg, request.setup.speed_m_per_s);
  if (request.setup.step_s > time)
    throw UsageError(
        "--step",
        fmt::format(
            "{:g} s is too long for the law, whose force a rigid wall would raise in {:.2g} s; use {:.2g} s or less",
            request.setup.step_s, time, time / 10));
  const double start = seconds();
  const Shell shell(request.body.panel());
  if (request.method == Method::reduced) request.choose_evaluation(shell.elements().size());
  const Structure structure = shell_structure(shell, request.body.points());
  Times times{.mesh_s = seconds() - start};
  PanelImpact panel(shell, structure, law, request.setup, request.options);
  times.set_up_s = seconds() - start;
  ProbeRecord record(request, shell);
  record.add(0, panel);
  ShellPicture picture(shell, request.vtu, request.vtu_count, grid);
  Progress progress("fe-shell");
  std::vector<PanelStep> samples;
  const std::size_t every = std::max<std::size_t>(1, grid.size / 50);
  try {
    for (std::size_t k = 1; k < grid.size; ++k) {
      const double before = seconds();
      panel.advance();
      times.stepping_s += seconds() - before;
      record.add(panel.impact().time_s(), panel);
      picture.add(k, panel);
      if (request.statistics && k % every == 0) samples.push_back(panel.last_step());
      progress(static_cast<double>(k) / static_cast<double>(grid.size));
    }
  } catch (const std::exception&) {                    // no equilibrium, or the end of a law's table
    write_impact(request, panel, Ending::broken_off);  // what there is up to here
    record.write();
    picture.write();
    throw;
  }
  record.write();
  picture.write();
  if (request.statistics) write_statistics(*request.statistics, panel, samples, times);
  write_impact(request, panel, Ending::reached);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"fe-shell", "impact of a rigid striker on a thin laminated panel, by shell elements",
       "Moderately large deflections unless --linear. Panel, striker and contact law are solved together in every "
       "step; bodies that parted may touch again. The columns are those of ir-impact; --points has the deflection "
       "along "
       "the normal and the strains on the struck and on the far side, along x, y and in shear.",
       "fe-shell --size 152.4mm,101.6mm --layup '[0/45/0/-45/0]2s' --ply graphite-epoxy --thickness 2.69mm \\\n"
       "  --curvature-radius 0.6725m --edges IIII --mass 8.537g --speed 3m/s --law tan-sun --stiffness 1.413e9 \\\n"
       "  --permanent-beta 0.094 --critical-indentation 166.7um --method tensor --step 2us --duration 500us "
       "--summary"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
