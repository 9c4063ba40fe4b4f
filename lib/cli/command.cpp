#include "lib/cli/command.hpp"

#include "lib/cli/config_toml.hpp"
#include "lib/cli/help_formatter.hpp"
#include "lib/cli/quantity.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/csv/output_file.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <set>

namespace impulse {
namespace {

void require_sign(double value, const std::string& text, Sign sign) {
  require(sign != Sign::positive || value > 0, "'{}' is not positive", text);
  require(sign != Sign::non_negative || value >= 0, "'{}' is negative", text);
}

std::function<double(const std::string&)> quantity_reader(const std::string& unit, Sign sign) {
  return [unit, sign](const std::string& text) {
    const double value = parse_quantity(text, unit);
    require_sign(value, text, sign);
    return value;
  };
}

std::function<std::size_t(const std::string&)> count_reader(std::size_t least) {
  return [least](const std::string& text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    require(error == std::errc() && end == text.data() + text.size(), "'{}' is not a whole number", text);
    require(value >= least, "{} is too small (at least {})", value, least);
    return value;
  };
}

std::string with_unit(const std::string& help, const std::string& unit) {
  return unit == "1" || unit.empty() ? help : fmt::format("{} [{}]", help, unit);
}

std::string quantity_metavar(const std::string& unit) { return unit == "1" || unit.empty() ? "NUMBER" : "QUANTITY"; }

std::string with_article(const std::string& noun) {
  const bool vowel = noun.find_first_of("aeiou") == 0;
  return (vowel ? "an " : "a ") + noun;
}

}  // namespace

struct Command::Parser {
  CLI::App app;
  std::vector<CLI::Option*> options;  ///< one for each of options_
  CLI::Option* files = nullptr;
  std::vector<std::string>* file_values = nullptr;
  std::string file_metavar;
  std::size_t least_files = 0;
  std::size_t most_files = 0;
  CLI::Option* config = nullptr;
};

Command::Option& Command::Option::required() {
  is_required = true;
  return *this;
}

Command::Command(ToolPage page) : page_(std::move(page)), parser_(std::make_unique<Parser>()) {
  CLI::App& app = parser_->app;
  app.name(page_.name);
  app.formatter(std::make_shared<HelpFormatter>(page_));
  app.allow_extras();  // so that unknown options are reported here, before anything that may be missing
  app.set_help_flag("-h,--help", "print this help and exit");
  app.set_version_flag("--version", fmt::format("{} (impulse) {}", page_.name, IMPULSE_VERSION),
                       "print the version and exit");
  parser_->config =
      app.add_option("--config", CLI::callback_t{}, "read options from a TOML file; the command line wins");
  parser_->config->type_name("FILE")->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

Command::~Command() = default;

Command::Option& Command::add(const std::string& flag, const std::string& metavar, const std::string& help,
                              std::function<void(const Values&)> assign) {
  Option& option = options_.emplace_back();
  option.flag = flag.substr(flag.find("--"));
  option.metavar = metavar;
  option.help = help;
  option.assign = std::move(assign);
  CLI::Option* cli = metavar.empty() ? parser_->app.add_flag(flag) : parser_->app.add_option(flag, CLI::callback_t{});
  cli->type_name(metavar)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  parser_->options.push_back(cli);
  return option;
}

Command::Option& Command::quantity(const std::string& flag, double& value, const std::string& unit, Sign sign,
                                   const std::string& help) {
  Option& option =
      parsed<double>(flag, value, quantity_reader(unit, sign), quantity_metavar(unit), with_unit(help, unit));
  option.toml = Option::Toml::number;
  option.default_text = fmt::format("{}", value);
  return option;
}

Command::Option& Command::quantity(const std::string& flag, std::optional<double>& value, const std::string& unit,
                                   Sign sign, const std::string& help) {
  Option& option =
      parsed<double>(flag, value, quantity_reader(unit, sign), quantity_metavar(unit), with_unit(help, unit));
  option.toml = Option::Toml::number;
  return option;
}

Command::Option& Command::quantity(const std::string& flag, std::vector<double>& values, const std::string& unit,
                                   Sign sign, const std::string& help) {
  Option& option = add(flag, quantity_metavar(unit) + ",...", with_unit(help, unit),
                       [&values, read = quantity_reader(unit, sign)](const Values& texts) {
                         values.clear();
                         for (const std::string& item : split_at_commas(texts)) values.push_back(read(item));
                       });
  option.toml = Option::Toml::number;
  option.repeatable = true;
  option.default_text = fmt::format("{}", fmt::join(values, ","));
  return option;
}

Command::Option& Command::count(const std::string& flag, std::size_t& value, std::size_t least,
                                const std::string& help) {
  Option& option = parsed<std::size_t>(flag, value, count_reader(least), "COUNT", help);
  option.toml = Option::Toml::count;
  option.default_text = fmt::format("{}", value);
  return option;
}

Command::Option& Command::count(const std::string& flag, std::optional<std::size_t>& value, std::size_t least,
                                const std::string& help) {
  Option& option = parsed<std::size_t>(flag, value, count_reader(least), "COUNT", help);
  option.toml = Option::Toml::count;
  return option;
}

Command::Option& Command::text(const std::string& flag, std::string& value, const std::string& metavar,
                               const std::string& help) {
  Option& option = parsed<std::string>(
      flag, value, [](const std::string& text) { return text; }, metavar, help);
  option.default_text = value;
  return option;
}

Command::Option& Command::text(const std::string& flag, std::optional<std::string>& value, const std::string& metavar,
                               const std::string& help) {
  return parsed<std::string>(
      flag, value, [](const std::string& text) { return text; }, metavar, help);
}

Command::Option& Command::text(const std::string& flag, std::vector<std::string>& values, const std::string& metavar,
                               const std::string& help) {
  return parsed<std::string>(
      flag, values, [](const std::string& text) { return text; }, metavar, help);
}

Command::Option& Command::flag(const std::string& flag, bool& value, const std::string& help) {
  Option& option = add(flag, "", help, [&value](const Values& texts) {
    require(texts.front() == "true" || texts.front() == "false", "takes no value");
    value = texts.front() == "true";
  });
  option.toml = Option::Toml::flag;
  return option;
}

void Command::files(const std::string& metavar, std::vector<std::string>& values, std::size_t least, std::size_t most,
                    const std::string& help) {
  std::string shown = metavar;
  if (most > least && most > 1 && shown.find("...") == shown.npos) shown += "...";
  if (least == 0) shown = "[" + shown + "]";
  parser_->files = parser_->app.add_option("files", CLI::callback_t{}, wrapped(help, 70));
  parser_->files->type_name(shown)->expected(1, -1)->allow_extra_args()->multi_option_policy(
      CLI::MultiOptionPolicy::TakeAll);
  parser_->file_values = &values;
  parser_->file_metavar = shown;
  parser_->least_files = least;
  parser_->most_files = most;
}

Command::Option& Command::output(std::string& path) {
  return parsed<std::string>(
      "-o,--output", path,
      [](const std::string& text) {
        require(!text.empty(), "the name of the file is empty");
        return text;
      },
      "FILE", "write the result to FILE (default: standard output)");
}

void Command::body(const std::string& kind) { body_ = kind; }

bool Command::given(const std::string& flag) const {
  for (const Option& option : options_)
    if (option.flag == flag) return option.given;
  throw std::logic_error("no option " + flag);
}

const ToolPage& Command::page() const { return page_; }

std::string Command::help_text() const {
  for (std::size_t i = 0; i < options_.size(); ++i) {
    const Option& option = options_[i];
    std::string help = option.help;
    if (option.is_required)
      help += " (required)";
    else if (!option.default_text.empty())
      help += fmt::format(" (default: {})", option.default_text);
    parser_->options[i]->description(wrapped(help, 70));
  }
  return parser_->app.help();
}

namespace {

/// CLI11 would take the next argument as the value of `--title=`, and the next option as that of `--title --step`.
void refuse_missing_values(int argc, const char* const* argv, const std::set<std::string>& valued) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--") return;
    if (i + 1 < argc && valued.contains(argument) && std::string_view(argv[i + 1]).starts_with("--"))
      throw UsageError(argument, "needs a value");
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1)
      throw UsageError(argument.substr(0, argument.size() - 1), "needs a value");
  }
}

void refuse_extras(const std::vector<std::string>& extras) {
  for (const std::string& argument : extras) {
    if (argument == "--") continue;
    if (argument.starts_with('-') && argument.size() > 1)
      throw UsageError(argument.substr(0, argument.find('=')), "unknown option (--help lists those there are)");
    throw std::invalid_argument(fmt::format("unexpected argument '{}'", argument));
  }
}

}  // namespace

bool Command::parse(int argc, const char* const* argv) {
  std::set<std::string> valued{"--config"};
  for (const Option& option : options_)
    if (!option.metavar.empty()) valued.insert(option.flag);
  refuse_missing_values(argc, argv, valued);
  try {
    parser_->app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    write_text("-", help_text());
    return false;
  } catch (const CLI::CallForVersion& version) {
    write_text("-", std::string(version.what()) + "\n");
    return false;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string message = error.what();
    throw UsageError(message.substr(0, message.find(':')), "needs a value");
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(error.what());
  }
  refuse_extras(parser_->app.remaining());
  apply_command_line();
  if (parser_->config->count() > 1) throw UsageError("--config", "given twice");
  if (parser_->config->count() == 1 && parser_->config->results().front().empty())
    throw UsageError("--config", "the name of the file is empty");
  if (parser_->config->count() == 1) apply_config(read_toml(parser_->config->results().front()));
  for (const Option& option : options_)
    if (option.is_required && !option.given) throw UsageError(option.flag, "required, but not given");
  return true;
}

void Command::apply_command_line() {
  for (std::size_t i = 0; i < options_.size(); ++i) {
    Option& option = options_[i];
    const std::vector<std::string>& values = parser_->options[i]->results();
    if (values.empty()) continue;
    if (values.size() > 1 && !option.repeatable) throw UsageError(option.flag, "given twice");
    try {
      option.assign(values);
    } catch (const std::invalid_argument& error) {
      throw UsageError(option.flag, error.what());
    }
    option.given = true;
  }
  if (!parser_->files) return;
  const std::vector<std::string>& values = parser_->files->results();
  require(values.size() >= parser_->least_files, "needs {}{} (see --help)", parser_->file_metavar,
          parser_->least_files > 1 && parser_->least_files < parser_->most_files
              ? fmt::format(", at least {}", parser_->least_files)
              : "");
  if (values.size() > parser_->most_files)
    throw std::invalid_argument(fmt::format("unexpected argument '{}'", values[parser_->most_files]));
  require(std::count(values.begin(), values.end(), "-") <= 1, "standard input ('-') can be read only once");
  *parser_->file_values = values.empty() ? std::vector<std::string>{"-"} : values;
}

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

std::vector<std::string> Command::split_at_commas(const Values& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    parts.emplace_back();
    for (const char c : text) {
      if (c == ',')
        parts.emplace_back();
      else
        parts.back() += c;
    }
  }
  return parts;
}

void Command::refuse_choice(const std::string& text, const std::vector<std::string>& names) {
  throw std::invalid_argument(fmt::format("'{}' is none of {}", text, fmt::join(names, ", ")));
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
