#pragma once

#include "lib/cli/command.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace impulse {

/// Breaks a text into lines of at most `width` characters; line breaks in the text stay.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t width);

/// Help in the form that help2man reads: usage first, then what the tool does, arguments, options, example.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(const ToolPage& page);
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;

 private:
  const ToolPage& page_;
};

}  // namespace impulse
