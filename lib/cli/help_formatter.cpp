#include "lib/cli/help_formatter.hpp"

#include <fmt/format.h>

namespace impulse {

std::string wrapped(const std::string& text, std::size_t width) {
  std::string result, word;
  std::size_t length = 0;
  const auto end_word = [&] {
    if (length > 0 && length + 1 + word.size() > width) {
      result += '\n';
      length = 0;
    } else if (length > 0 && !word.empty()) {
      result += ' ';
      ++length;
    }
    result += word;
    length += word.size();
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ' || c == '\n')
      end_word();
    else
      word += c;
    if (c == '\n') {
      result += '\n';
      length = 0;
    }
  }
  end_word();
  return result;
}

HelpFormatter::HelpFormatter(const ToolPage& page) : page_(page) {
  column_width(30);
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string) const {
  std::string usage = fmt::format("Usage: {} [OPTIONS]...", page_.name);
  for (const CLI::Option* option : app->get_options([](const CLI::Option* o) { return o->get_positional(); }))
    usage += " " + option->get_type_name();
  return usage + "\n";
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string help = make_usage(app, name) + page_.summary + "\n";
  if (!page_.description.empty()) help += "\n" + wrapped(page_.description, 100) + "\n";
  help += make_positionals(app) + make_groups(app, mode);
  if (page_.example.empty()) return help;
  help += "\nExample:\n";
  for (const std::string& line : CLI::detail::split(page_.example, '\n')) help += "  " + line + "\n";
  return help;
}

// The name by which CLI11 knows the arguments cannot hold what several different ones are called together.
std::string HelpFormatter::make_option_name(const CLI::Option* option, bool is_positional) const {
  return is_positional ? option->get_type_name() : option->get_name(false, true);
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  if (option->get_positional() || option->get_type_size() == 0) return "";
  std::string value = " " + option->get_type_name();
  // Two blanks before the description, which help2man asks for, or else a new line.
  const std::size_t length = 2 + option->get_name(false, true).size() + value.size();
  if (length + 1 == get_column_width()) value += ' ';
  return value;
}

}  // namespace impulse
