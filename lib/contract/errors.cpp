#include "lib/contract/errors.hpp"

#include <fmt/format.h>

namespace impulse {
namespace {

std::string located(const std::string& file, std::size_t line, std::size_t column, const std::string& message) {
  std::string place = file;
  if (line > 0) place += fmt::format(":{}", line);
  if (line > 0 && column > 0) place += fmt::format(":{}", column);
  return fmt::format("{}: {}", place, message);
}

}  // namespace

InputError::InputError(std::string file_name, std::size_t line_number, std::size_t column_number,
                       const std::string& message)
    : std::runtime_error(located(file_name, line_number, column_number, message)),
      file(std::move(file_name)),
      line(line_number),
      column(column_number) {}

UsageError::UsageError(const std::string& flag, const std::string& message)
    : std::runtime_error(flag + ": " + message) {}

ConvergenceError::ConvergenceError(const std::string& message, double requested_tolerance, double achieved_tolerance,
                                   std::size_t iteration_count)
    : std::runtime_error(message),
      requested(requested_tolerance),
      achieved(achieved_tolerance),
      iterations(iteration_count) {}

}  // namespace impulse
