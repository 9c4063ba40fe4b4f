#pragma once

#include "lib/records/text_layout.hpp"

#include <span>
#include <string>
#include <string_view>

namespace impulse {

/// Takes the wanted numbers out of the rows of a text, without allocating.
class TextRow {
 public:
  /// `file` is for messages.
  TextRow(std::string file, const TextLayout& layout);

  /// Number of fields from the first to the last that is wanted.
  [[nodiscard]] std::size_t field_count() const { return targets_.size(); }

  /// Puts abscissa and channels of a row into `values`, one for each wanted field in their order, the abscissa first.
  /// Returns the number of fields the row has, at most field_count(): less means that it breaks off.
  /// @throws InputError at file:line:field for a field that is no finite number.
  std::size_t parse(std::string_view line, std::size_t number, std::span<double> values);

  struct Printed {
    double value;
    std::string_view text;
  };
  /// The abscissa alone. @throws as parse, also for a row that breaks off before it.
  Printed abscissa(std::string_view line, std::size_t number);

  [[nodiscard]] static bool counts(std::string_view line) {
    return !line.empty() && line.front() != '#' && line.front() != '%' && line.find_first_not_of(" \t,;|") != line.npos;
  }

 private:
  /// Fields, one after the other, in a line that has a point for its decimal sign.
  struct Cursor {
    std::string_view line;
    std::size_t at = 0;
    bool ended = false;
  };
  std::string_view with_points(std::string_view line);
  bool begin_field(Cursor& cursor) const;
  void skip(Cursor& cursor) const;
  double number(Cursor& cursor, std::size_t line_number, std::size_t field, std::string_view& text) const;

  std::string file_;
  char delimiter_;
  char decimal_sign_;
  std::vector<std::size_t> targets_;  ///< of each field; npos: not wanted
  std::size_t abscissa_field_;
  std::string copy_;
};

}  // namespace impulse
