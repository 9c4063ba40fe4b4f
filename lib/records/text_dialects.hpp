#pragma once

#include "lib/records/text_layout.hpp"

namespace impulse {

/// LabVIEW measurement (.lvm): two headings, each ended by ***End_of_Header***, then a line of column names that begins
/// with X_Value and ends with Comment. With X_Columns `No` the time is X0 + k·Delta_X, with `One` or `Multi` there are
/// columns of it. Empty if the text isn't one. @throws InputError if the heading breaks off.
[[nodiscard]] std::optional<TextLayout> labview_layout(const TextHead& head);

/// Kolsky bar of Los Alamos (.raw): tabs; keys and values in fields 1 and 2; the waveforms, in volts, from field 3 on,
/// under their name, their first time and their time step. Empty if the text isn't one.
/// @throws InputError if the waveforms have different times.
[[nodiscard]] std::optional<TextLayout> lanl_layout(const TextHead& head);

}  // namespace impulse
