#include "lib/cli/command.hpp"

#include "lib/cli/config_toml.hpp"
#include "lib/cli/help_formatter.hpp"
#include "lib/cli/option_readers.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/csv/output_file.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <set>

namespace impulse {
namespace {

std::string with_unit(const std::string& help, const std::string& unit) {
  return unit == "1" || unit.empty() ? help : fmt::format("{} [{}]", help, unit);
}

std::string quantity_metavar(const std::string& unit) { return unit == "1" || unit.empty() ? "NUMBER" : "QUANTITY"; }

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

Command::Option& Command::Option::or_number() {
  toml = Toml::number;
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

Command::Option& Command::output(std::string& path, const std::string& help) {
  return parsed<std::string>("-o,--output", path, writable_path, "FILE", help);
}

Command::Option& Command::output_file(const std::string& flag, std::optional<std::string>& path,
                                      const std::string& help) {
  return parsed<std::string>(flag, path, writable_path, "FILE", help);
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

}  // namespace impulse
