#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace impulse {

[[nodiscard]] std::string_view trimmed_field(std::string_view text);

/// The fields of a line, blanks and quotes around them removed; a delimiter of ' ' is any number of blanks and tabs.
/// Empty fields at the end don't count.
[[nodiscard]] std::vector<std::string> split_fields(std::string_view line, char delimiter);

/// The whole field as a number; empty if it is none.
[[nodiscard]] std::optional<double> field_number(std::string_view field, char decimal_sign);

/// `Sample Rate (Hz)` as `sampleratehz`, for comparing keys.
[[nodiscard]] std::string plain_key(std::string_view key);

}  // namespace impulse
