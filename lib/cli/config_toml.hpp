#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace impulse {

enum class TomlType { text, integer, real, boolean, other };

/// One value of a TOML file; an array of plain values makes several.
struct TomlValue {
  TomlType type = TomlType::other;
  std::string text;       ///< as one would type it on the command line
  std::string type_name;  ///< for messages: `a boolean`
  std::size_t line = 0;
  std::size_t column = 0;
};

/// `key = value` or `key = [value, ...]` at the top level of a TOML file.
struct TomlEntry {
  std::string key;
  std::size_t line = 0;
  std::size_t column = 0;
  bool is_array = false;
  std::vector<TomlValue> values;
};

/// A TOML file as its top-level entries, in the order of the file.
struct TomlFile {
  std::string name;  ///< for messages: the path, or `stdin`
  std::vector<TomlEntry> entries;
};

/// Reads a TOML file once, front to back, so that it may be a pipe; `-` is stdin.
/// @throws InputError if it cannot be read, with file:line:column, the line and what to write at a syntax error.
/// Verified by: tests/lib/command.test.cpp
[[nodiscard]] TomlFile read_toml(const std::string& path);

/// The key `body` of a body file: `cone`, `beam`, ...
/// @throws InputError if there is none or it is not a string.
[[nodiscard]] std::string body_kind(const TomlFile& file);

}  // namespace impulse
