// What a Command takes from its TOML file.
#include "lib/cli/command.hpp"
#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace impulse {
namespace {

std::string with_article(const std::string& noun) {
  const bool vowel = noun.find_first_of("aeiou") == 0;
  return (vowel ? "an " : "a ") + noun;
}

}  // namespace

/// The value of an array that is refused by itself, else the first.
std::size_t Command::first_refused(const Option& option, const Values& texts) {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    try {
      option.assign({texts[i]});
    } catch (const std::invalid_argument&) {
      return i;
    }
  }
  return 0;
}

void Command::apply_config_body(const std::string& path, const TomlEntry& entry) {
  const TomlValue& value = entry.values.front();
  if (entry.is_array || value.type != TomlType::text)
    throw InputError(path, entry.line, entry.column, "body: expected a string such as \"cone\"");
  if (value.text == body_) return;
  const std::string wish = page_.name.empty() ? fmt::format("not {}", with_article(body_))
                                              : fmt::format("{} wants {}", page_.name, with_article(body_));
  throw InputError(path, value.line, value.column, fmt::format("is {}, {}", with_article(value.text), wish));
}

void Command::apply_config(const TomlFile& file) {
  using Toml = Option::Toml;
  const std::string& path = file.name;
  for (const TomlEntry& entry : file.entries) {
    if (entry.key == "body" && !body_.empty()) {
      apply_config_body(path, entry);
      continue;
    }
    const auto found = std::find_if(options_.begin(), options_.end(),
                                    [&](const Option& option) { return option.flag == "--" + entry.key; });
    if (found == options_.end())
      throw InputError(path, entry.line, entry.column, fmt::format("unknown key '{}'", entry.key));
    const auto fail = [&](std::size_t line, std::size_t column, const std::string& message) {
      throw InputError(path, line, column, fmt::format("{}: {}", entry.key, message));
    };
    if (entry.is_array && !found->repeatable) fail(entry.line, entry.column, "takes one value, not an array");
    if (entry.values.empty()) fail(entry.line, entry.column, "the array is empty");
    std::vector<std::string> texts;
    for (const TomlValue& value : entry.values) {
      const bool is_number = value.type == TomlType::integer || value.type == TomlType::real;
      if (found->toml == Toml::text && value.type != TomlType::text)
        fail(value.line, value.column, fmt::format("expected a string, not {}", value.type_name));
      if (found->toml == Toml::number && value.type != TomlType::text && !is_number)
        fail(value.line, value.column,
             fmt::format("expected a number or a string with a unit, not {}", value.type_name));
      if (found->toml == Toml::count && value.type != TomlType::integer)
        fail(value.line, value.column, fmt::format("expected a whole number, not {}", value.type_name));
      if (found->toml == Toml::flag && value.type != TomlType::boolean)
        fail(value.line, value.column, fmt::format("expected true or false, not {}", value.type_name));
      texts.push_back(value.text);
    }
    if (found->given) continue;
    try {
      found->assign(texts);
    } catch (const std::invalid_argument& error) {
      const TomlValue& wrong = entry.values[first_refused(*found, texts)];
      fail(wrong.line, wrong.column, error.what());
    }
    found->given = found->toml != Toml::flag || texts.front() == "true";
  }
}

void Command::read_config(const TomlFile& file) {
  apply_config(file);
  for (const Option& option : options_)
    if (option.is_required && !option.given)
      throw InputError(file.name, 0, 0, fmt::format("needs the key '{}'", option.flag.substr(2)));
}

void read_config_file(const std::string& path, const std::function<void(Command&)>& declare) {
  read_config_file(read_toml(path), declare);
}

void read_config_file(const TomlFile& file, const std::function<void(Command&)>& declare) {
  Command command(ToolPage{});
  declare(command);
  command.read_config(file);
}

}  // namespace impulse
