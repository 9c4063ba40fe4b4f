#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace impulse {

/// What a tool says about itself.
struct ToolPage {
  std::string name;         ///< of the command, `ir-bar`
  std::string summary;      ///< one line
  std::string description;  ///< paragraphs; may be empty
  std::string example;      ///< shell lines that run as they stand in the project's folder, with the tools in PATH
};

enum class Sign { any, positive, non_negative };

/// Names of the values of an enumeration, in the order of the help.
template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

/// Declaration of a tool's options: the one place from which parser, help and configuration file follow.
///
/// Each declaration binds a variable. A plain variable that is not required() keeps its value as the default, which the
/// help shows; a std::optional stays empty unless given; a std::vector takes the option several times (quantities and
/// choices also separated by commas) and loses its default when the option is given.
/// Every tool also has --help, --version and --config FILE (TOML; keys are the long option names without dashes, an
/// array repeats an option). The command line replaces what the file says; no option is accepted and ignored.
/// Verified by: tests/lib/command.test.cpp
class Command {
 public:
  class Option {
   public:
    /// Given on the command line or in the configuration file, or else a UsageError.
    Option& required();

    /// The file may give a text also as a bare number: `stiffness = 5e9`.
    Option& or_number();

   private:
    friend class Command;
    enum class Toml { text, number, count, flag };
    std::string flag;  ///< `--speed`
    std::string metavar;
    std::string help;
    std::string default_text;
    Toml toml = Toml::text;
    bool repeatable = false;
    bool is_required = false;
    bool given = false;
    std::function<void(const std::vector<std::string>&)> assign;
  };

  explicit Command(ToolPage page);
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  ~Command();

  /// A physical quantity in SI `unit` (parse_quantity); unit "1" is a plain number.
  Option& quantity(const std::string& flag, double& value, const std::string& unit, Sign sign, const std::string& help);
  Option& quantity(const std::string& flag, std::optional<double>& value, const std::string& unit, Sign sign,
                   const std::string& help);
  Option& quantity(const std::string& flag, std::vector<double>& values, const std::string& unit, Sign sign,
                   const std::string& help);

  /// A whole number, at least `least`.
  Option& count(const std::string& flag, std::size_t& value, std::size_t least, const std::string& help);
  Option& count(const std::string& flag, std::optional<std::size_t>& value, std::size_t least, const std::string& help);

  /// A text; `metavar` stands for it in the help, FILE for instance.
  Option& text(const std::string& flag, std::string& value, const std::string& metavar, const std::string& help);
  Option& text(const std::string& flag, std::optional<std::string>& value, const std::string& metavar,
               const std::string& help);
  Option& text(const std::string& flag, std::vector<std::string>& values, const std::string& metavar,
               const std::string& help);

  /// A switch without a value (`true` in TOML).
  Option& flag(const std::string& flag, bool& value, const std::string& help);

  /// What `read` makes of the text, parse_material for instance; its std::invalid_argument becomes the message.
  template <class T>
  Option& parsed(const std::string& flag, T& value, std::type_identity_t<std::function<T(const std::string&)>> read,
                 const std::string& metavar, const std::string& help) {
    return add(flag, metavar, help, [&value, read](const Values& texts) { value = read(texts.front()); });
  }
  template <class T>
  Option& parsed(const std::string& flag, std::optional<T>& value,
                 std::type_identity_t<std::function<T(const std::string&)>> read, const std::string& metavar,
                 const std::string& help) {
    return add(flag, metavar, help, [&value, read](const Values& texts) { value = read(texts.front()); });
  }
  template <class T>
  Option& parsed(const std::string& flag, std::vector<T>& values,
                 std::type_identity_t<std::function<T(const std::string&)>> read, const std::string& metavar,
                 const std::string& help) {
    Option& option = add(flag, metavar, help, [&values, read](const Values& texts) {
      values.clear();
      for (const std::string& item : texts) values.push_back(read(item));
    });
    option.repeatable = true;
    return option;
  }

  /// One of a few names.
  template <class T>
  Option& choice(const std::string& flag, T& value, const std::type_identity_t<Choices<T>>& choices,
                 const std::string& help) {
    std::string standard;
    for (const auto& [name, meaning] : choices)
      if (meaning == value) standard = name;
    Option& option = parsed<T>(flag, value, chooser(choices), joined_names(choices), help);
    set_default(option, standard);
    return option;
  }
  template <class T>
  Option& choice(const std::string& flag, std::optional<T>& value, const std::type_identity_t<Choices<T>>& choices,
                 const std::string& help) {
    return parsed<T>(flag, value, chooser(choices), joined_names(choices), help);
  }
  template <class T>
  Option& choice(const std::string& flag, std::vector<T>& values, const std::type_identity_t<Choices<T>>& choices,
                 const std::string& help) {
    std::string standard;
    for (const T& value : values)
      for (const auto& [name, meaning] : choices)
        if (meaning == value) standard += (standard.empty() ? "" : ",") + name;
    Option& option = add(flag, joined_names(choices) + ",...", help, [&values, choices](const Values& texts) {
      values.clear();
      for (const std::string& item : split_at_commas(texts)) values.push_back(chooser(choices)(item));
    });
    option.repeatable = true;
    set_default(option, standard);
    return option;
  }

  /// Positional arguments, at least `least` and at most `most`. With least = 0 and none given, `values` is {"-"}:
  /// stdin.
  void files(const std::string& metavar, std::vector<std::string>& values, std::size_t least, std::size_t most,
             const std::string& help);

  /// `-o FILE`; "" or `-` is stdout. A FILE that cannot be written is refused when the option is read.
  Option& output(std::string& path, const std::string& help = "write the result to FILE (default: standard output)");

  /// A further file that the tool writes; refused alike.
  Option& output_file(const std::string& flag, std::optional<std::string>& path, const std::string& help);

  /// The kind of body the options describe: a configuration file that says `body = "..."` must say the same.
  void body(const std::string& kind);

  /// Whether an option was given, on the command line or in the configuration file.
  [[nodiscard]] bool given(const std::string& flag) const;

  [[nodiscard]] const ToolPage& page() const;
  [[nodiscard]] std::string help_text() const;

  /// Reads the command line, then the configuration file. False if --help or --version was asked for and printed.
  /// @throws UsageError `--flag: message`; InputError `FILE:line:column: key: message` for what the file says.
  [[nodiscard]] bool parse(int argc, const char* const* argv);

  /// Reads the configuration file alone. @throws InputError, also if something required is missing.
  void read_config(const struct TomlFile& file);

 private:
  using Values = std::vector<std::string>;
  struct Parser;

  Option& add(const std::string& flag, const std::string& metavar, const std::string& help,
              std::function<void(const Values&)> assign);
  void set_default(Option& option, const std::string& text) { option.default_text = text; }
  void apply_command_line();
  void apply_config(const struct TomlFile& file);
  void apply_config_body(const std::string& path, const struct TomlEntry& entry);

  static std::size_t first_refused(const Option& option, const Values& texts);
  static std::vector<std::string> split_at_commas(const Values& texts);
  [[noreturn]] static void refuse_choice(const std::string& text, const std::vector<std::string>& names);

  template <class T>
  static std::string joined_names(const Choices<T>& choices) {
    std::string names;
    for (const auto& [name, meaning] : choices) names += (names.empty() ? "" : "|") + name;
    return names;
  }
  template <class T>
  static std::function<T(const std::string&)> chooser(const Choices<T>& choices) {
    return [choices](const std::string& text) {
      std::vector<std::string> names;
      for (const auto& [name, meaning] : choices) {
        if (name == text) return meaning;
        names.push_back(name);
      }
      refuse_choice(text, names);
    };
  }

  ToolPage page_;
  std::string body_;
  std::deque<Option> options_;  ///< a deque, because declarations hand out references
  std::unique_ptr<Parser> parser_;
};

/// Reads a body file as the options that `declare` declares, without a command line.
/// @throws InputError for what is wrong or missing in the file.
void read_config_file(const std::string& path, const std::function<void(Command&)>& declare);
void read_config_file(const struct TomlFile& file, const std::function<void(Command&)>& declare);

}  // namespace impulse
