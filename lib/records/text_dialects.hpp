#pragma once

#include "lib/records/text_layout.hpp"

#include <string_view>

namespace impulse {

/// Lines of a LabVIEW measurement: the end of a heading, the first line of a segment, its line of column names.
inline constexpr std::string_view labview_end_of_header = "***End_of_Header***";
inline constexpr std::string_view labview_segment = "Channels";
inline constexpr std::string_view labview_names = "X_Value";

/// LabVIEW measurement (.lvm): two headings, each ended by ***End_of_Header***, then a line of column names that begins
/// with X_Value and ends with Comment. With X_Columns `No` the time is X0 + k·Delta_X, with `One` or `Multi` there are
/// columns of it. Of a file of several segments, each with a second heading, the first that `head` holds. Empty if the
/// text isn't one. @throws InputError if the heading breaks off.
[[nodiscard]] std::optional<TextLayout> labview_layout(const TextHead& head);

/// Kolsky bar of Los Alamos (.raw): tabs; keys and values in fields 1 and 2; the waveforms, in volts, from field 3 on,
/// under their name, their first time and their time step. Empty if the text isn't one.
/// @throws InputError if the waveforms have different times.
[[nodiscard]] std::optional<TextLayout> lanl_layout(const TextHead& head);

}  // namespace impulse
