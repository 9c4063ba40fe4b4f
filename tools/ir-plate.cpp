#include "lib/cli/progress.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "tools/support/modal_request.hpp"
#include "tools/support/plate_motion.hpp"
#include "tools/support/plate_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace {

using namespace impulse;

struct Request {
  PlateOptions body;
  ModalRequest modal;
  PlateMotion motion;
  bool condition = false;

  void declare(Command& command) {
    body.declare(command);
    modal.declare(command);
    motion.declare(command);
    command.flag("--condition", condition,
                 "tell on stderr how many unknowns there are and the condition numbers of K and M, scaled to unit "
                 "diagonals");
  }

  void require_consistent(const Command& command) const {
    motion.require_consistent(command, body.point_count(), modal.output());
    if (motion.under_force()) return;
    modal.require_consistent(command);
    if (body.point_count() == 0 && !modal.wants_modes())
      throw UsageError("--at", "is required for a response: 0.5,0.5 is the middle");
  }

  void tell_condition(const DenseStructure& structure) const {
    fmt::print(stderr, "ir-plate: {} unknowns, condition number of K {:.3g}, of M {:.3g}\n", structure.stiffness.rows(),
               scaled_condition(structure.stiffness), scaled_condition(structure.mass));
  }

  [[nodiscard]] ModalModel modes(const DenseStructure& structure, double highest_frequency_Hz) const {
    const auto unknowns = static_cast<std::size_t>(structure.stiffness.rows());
    if (modal.mode_count() && *modal.mode_count() > unknowns)
      throw UsageError("--modes", fmt::format("{} modes are asked for, but the series has only {} unknowns; use more "
                                              "--terms",
                                              *modal.mode_count(), unknowns));
    using Residual = ModalOptions::Residual;
    return modal_model(structure, {.mode_count = modal.mode_count().value_or(std::numeric_limits<std::size_t>::max()),
                                   .highest_frequency_Hz = highest_frequency_Hz,
                                   .residual = structure.contacts.cols() > 0 ? Residual::attached : Residual::none});
  }

  void tell_doubts(const RitzPlate& plate, const ModalModel& model) const {
    for (Eigen::Index i = 0; i < model.contact_count(); ++i) {
      double flexibility = model.residual_flexibility(i, i);
      for (Eigen::Index k = 0; k < model.mode_count(); ++k)
        if (model.angular_frequency(k) > 0)
          flexibility += std::pow(model.participation(k, i) / model.angular_frequency(k), 2);
      if (const auto doubt = body.patch_doubt(plate, static_cast<std::size_t>(i), flexibility)) {
        fmt::print(stderr, "ir-plate: {}\n", *doubt);
        return;
      }
    }
  }

  /// LAPACK doesn't tell how far it has come, so a person is told beforehand.
  static void tell_duration(const RitzPlate& plate) {
    const auto n = static_cast<double>(plate.unknown_count());
    const double seconds = 2e-10 * n * n * n;  // of one core of 2020, within a factor of three
    if (seconds > 2 && stderr_is_terminal())
      fmt::print(stderr, "ir-plate: {} unknowns, which take roughly {:.0f} s (the sixth power of --terms)\n", n,
                 seconds);
  }

  void run() const {
    const RitzPlate plate = body.plate();
    tell_duration(plate);
    if (body.is_clockwise())
      fmt::print(stderr,
                 "ir-plate: the corners go round clockwise; edges and fractions count from corner 1 as given\n");
    StruckPlate struck = body.struck(plate);
    DenseStructure& structure = struck.structure;
    if (condition) tell_condition(structure);
    if (motion.under_force() || motion.wants_shapes()) structure.outputs = motion.outputs(plate);
    if (motion.under_force()) {
      const UniformSeries force = motion.force();
      const double nyquist = modal.mode_count() ? std::numeric_limits<double>::infinity() : 0.5 / force.grid.step_s;
      ModalModel model = modes(structure, nyquist);
      if (struck.missing) model.residual_outputs += motion.missing_outputs(plate, *struck.missing);
      tell_doubts(plate, model);
      motion.write_motion(modal.output(), plate, model, force);
      return;
    }
    const ModalModel model = modes(structure, modal.highest_frequency_Hz());
    tell_doubts(plate, model);
    if (motion.wants_shapes()) motion.write_shapes(plate, model);
    modal.write(model);
  }
};

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-plate", "impulse response of a laminated plate or curved panel, any convex quadrilateral",
       "Ritz series of Chebyshev polynomials, supports held exactly; modal superposition with the residual flexibility "
       "of the modes left out. Fibre angles count from the x axis; z points into the plate, the first ply is the "
       "struck "
       "one. Columns: time_s; impulse_response_per_kg (velocity after a unit impulse); step_velocity_m_per_Ns and "
       "step_displacement_m_per_N (under a unit step force). Of a flat plate without coupling only the motion across "
       "its plane is taken, unless --in-plane always.",
       "ir-plate --size 15.24cm,10.16cm --layup '[0/45/0/-45/0]2s' --ply graphite-epoxy --thickness 2.69mm --edges "
       "WWWW "
       "--theory thin --at 0.5,0.5 --step 1us --duration 1ms"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] {
    request.require_consistent(command);
    request.run();
    return 0;
  });
}
