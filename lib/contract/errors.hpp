#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace impulse {

/// Wrong data or file; `what()` reads `file:line:column: message`, leaving out a line or column that is 0. Exit code 2.
struct InputError : std::runtime_error {
  InputError(std::string file_name, std::size_t line_number, std::size_t column_number, const std::string& message);
  std::string file;
  std::size_t line;    ///< from 1, 0 if none
  std::size_t column;  ///< field (CSV) or character (TOML) from 1, 0 if none
};

/// Wrong command line; `what()` reads `--flag: message`. Exit code 2.
struct UsageError : std::runtime_error {
  UsageError(const std::string& flag, const std::string& message);
};

/// A result could not be written (full disk, closed device). Exit code 1.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Nobody reads the output any more (EPIPE). Not an error: exit code 0.
struct ClosedPipe : std::runtime_error {
  ClosedPipe() : std::runtime_error("the reader closed the pipe") {}
};

/// A method missed its tolerance. Exit code 1.
struct ConvergenceError : std::runtime_error {
  ConvergenceError(const std::string& message, double requested_tolerance, double achieved_tolerance,
                   std::size_t iteration_count);
  double requested;
  double achieved;
  std::size_t iterations;
};

}  // namespace impulse
