#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace impulse {

/// The bytes of a universal file, in lines or in blocks.
class UniversalCursor {
 public:
  explicit UniversalCursor(std::string_view bytes) : bytes_(bytes) {}

  /// The next line without its end; false at the end of the file.
  [[nodiscard]] bool next_line(std::string_view& line);
  [[nodiscard]] std::size_t line() const { return line_; }  ///< number of the line that next_line gave
  [[nodiscard]] std::size_t byte() const { return at_; }    ///< from 0
  [[nodiscard]] std::string_view rest() const { return bytes_.substr(at_); }
  void skip(std::size_t count) { at_ += count; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
};

/// Whether a line is the -1 that begins and ends a dataset.
[[nodiscard]] bool is_dataset_mark(std::string_view line);

/// Takes the next number of Fortran's off the front of a line: no blank need follow it, an exponent may have D or no
/// letter. Empty at the end of the line, or if what follows is no number: then the line still holds it.
[[nodiscard]] std::optional<double> take_number(std::string_view& line);

/// Columns `begin` to `begin + length` of a line, letters counted where it is UTF-8, bytes elsewhere; blanks around it
/// removed.
[[nodiscard]] std::string_view columns_of(std::string_view line, std::size_t begin, std::size_t length);

}  // namespace impulse
