#pragma once

#include "impulse/response/response.hpp"
#include "lib/cli/command.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace impulse {

/// What the tool of a body that has modes is asked to write: the options --as, --step, --duration, --modes and -o.
class ModalRequest {
 public:
  /// `standard` says in the help what is taken if --modes isn't given.
  void declare(Command& command, const std::string& standard = "up to the step's Nyquist frequency");

  /// @throws UsageError for options that are missing or do not go together.
  void require_consistent(const Command& command) const;

  /// As many modes as --modes says, otherwise those up to the Nyquist frequency of the step.
  [[nodiscard]] std::optional<std::size_t> mode_count() const { return modes_; }
  [[nodiscard]] double highest_frequency_Hz() const;

  /// Writes the response or the modes.
  void write(const ModalModel& body) const;

  [[nodiscard]] bool wants_modes() const { return as_ == Output::modes; }
  [[nodiscard]] const std::string& output() const { return output_; }

  /// Of the response, and a response on it that was found without modes.
  [[nodiscard]] UniformGrid grid() const;
  void write(const Response& response) const;

 private:
  enum class Output { response, modes };
  Output as_ = Output::response;
  std::optional<double> step_s_;
  std::optional<double> duration_s_;
  std::optional<std::size_t> modes_;
  std::string output_;
};

}  // namespace impulse
