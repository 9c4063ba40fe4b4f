#include "tools/support/modal_request.hpp"

#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/contract/errors.hpp"

#include <limits>

namespace impulse {

void ModalRequest::declare(Command& command, const std::string& standard) {
  command.choice<Output>("--as", as_, {{"response", Output::response}, {"modes", Output::modes}}, "what to write");
  command.quantity("--step", step_s_, "s", Sign::positive, "time step of the response");
  command.quantity("--duration", duration_s_, "s", Sign::positive, "duration; round(duration/step) + 1 samples");
  command.count("--modes", modes_, 1, "number of modes, rigid-body modes included (default: " + standard + ")");
  command.output(output_);
}

void ModalRequest::require_consistent(const Command& command) const {
  if (as_ == Output::response) {
    if (!step_s_) throw UsageError("--step", "is required for a response");
    if (!duration_s_) throw UsageError("--duration", "is required for a response");
    return;
  }
  if (command.given("--duration"))
    throw UsageError("--duration", "modes have no duration; leave it out with --as modes");
  if (step_s_ && modes_)
    throw UsageError("--step", "sets the number of modes, which --modes gives; leave one of them out");
  if (!step_s_ && !modes_)
    throw UsageError("--modes", "is required with --as modes (or --step, for the modes up to its Nyquist frequency)");
}

double ModalRequest::highest_frequency_Hz() const {
  // A mode on the Nyquist frequency to rounding is wanted.
  return modes_ ? std::numeric_limits<double>::infinity() : (0.5 + 1e-9) / *step_s_;
}

UniformGrid ModalRequest::grid() const { return grid_over(*duration_s_, *step_s_); }

void ModalRequest::write(const ModalModel& body) const {
  if (wants_modes())
    write_modes(output_, body);
  else
    write(modal_response(body, grid()));
}

void ModalRequest::write(const Response& response) const { write_response(output_, response); }

}  // namespace impulse
