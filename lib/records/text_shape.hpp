#pragma once

#include "lib/records/text_layout.hpp"

namespace impulse {

/// Which fields of which lines of a text are its rows.
struct TextShape {
  char delimiter = ',';
  char decimal_sign = '.';
  std::size_t first = 0;             ///< index of the first line that is a row
  std::vector<std::size_t> numbers;  ///< the fields that are numbers in every row, ascending
  std::size_t texts = 0;             ///< other fields of a usual row that aren't empty
};

/// The shape with most columns of numbers and fewest of text; text_layout() says how.
/// @throws InputError if no line has a number, or a line between rows is none of them.
[[nodiscard]] TextShape text_shape(const TextHead& head, const TextOptions& options);

/// What a delimiter is called: `tab`, `;`.
[[nodiscard]] std::string delimiter_name(char delimiter);

}  // namespace impulse
