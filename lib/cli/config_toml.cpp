#include "lib/cli/config_toml.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/input_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <string_view>

namespace impulse {
namespace {

TomlValue toml_value(const toml::node& node) {
  TomlValue value;
  value.line = node.source().begin.line;
  value.column = node.source().begin.column;
  if (const auto* text = node.as_string()) {
    value = {TomlType::text, text->get(), "a string", value.line, value.column};
  } else if (const auto* integer = node.as_integer()) {
    value = {TomlType::integer, fmt::format("{}", integer->get()), "an integer", value.line, value.column};
  } else if (const auto* real = node.as_floating_point()) {
    value = {TomlType::real, fmt::format("{}", real->get()), "a number", value.line, value.column};
  } else if (const auto* boolean = node.as_boolean()) {
    value = {TomlType::boolean, boolean->get() ? "true" : "false", "a boolean", value.line, value.column};
  } else {
    value.type_name = node.is_table() ? "a table" : node.is_array() ? "an array" : "a date or time";
  }
  return value;
}

std::string line_of(const std::string& text, std::size_t number) {
  std::size_t begin = 0;
  for (std::size_t line = 1; line < number; ++line) {
    begin = text.find('\n', begin);
    if (begin == text.npos) return "";
    ++begin;
  }
  std::string line = text.substr(begin, text.find('\n', begin) - begin);
  constexpr std::size_t most = 60;
  return line.size() > most ? line.substr(0, most) + " ..." : line;
}

/// The parser's reason without the part that says where in its grammar it was, after the line that it stumbled over.
std::string syntax_message(const std::string& text, std::size_t line, std::string reason) {
  if (reason.find("utf-8") != reason.npos) return "is not a text in UTF-8, and so not TOML";
  constexpr std::string_view prefix = "Error while parsing ";
  if (const std::size_t colon = reason.find(": "); reason.starts_with(prefix) && colon != reason.npos)
    reason.erase(0, colon + 2);
  return fmt::format(
      "'{}' is not TOML ({}); write one key = value a line, texts and quantities with a unit in quotes: "
      "length = \"400mm\"",
      line_of(text, line), reason);
}

}  // namespace

TomlFile read_toml(const std::string& path) {
  const std::string text = read_text(path);
  TomlFile file{path == "-" ? "stdin" : path, {}};
  toml::table table;
  try {
    table = toml::parse(text, file.name);
  } catch (const toml::parse_error& error) {
    throw InputError(file.name, error.source().begin.line, error.source().begin.column,
                     syntax_message(text, error.source().begin.line, std::string(error.description())));
  }
  std::vector<TomlEntry>& entries = file.entries;
  for (const auto& [key, node] : table) {
    TomlEntry entry{std::string(key.str()), key.source().begin.line, key.source().begin.column, node.is_array(), {}};
    if (const toml::array* array = node.as_array()) {
      for (const toml::node& element : *array) entry.values.push_back(toml_value(element));
    } else {
      entry.values.push_back(toml_value(node));
    }
    entries.push_back(std::move(entry));
  }
  std::sort(entries.begin(), entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  return file;
}

std::string body_kind(const TomlFile& file) {
  for (const TomlEntry& entry : file.entries) {
    if (entry.key != "body") continue;
    if (entry.is_array || entry.values[0].type != TomlType::text)
      throw InputError(file.name, entry.line, entry.column, "body: expected a string such as \"cone\"");
    return entry.values[0].text;
  }
  throw InputError(file.name, 0, 0, "no key 'body' (a body file says what it is, such as body = \"cone\")");
}

}  // namespace impulse
