#pragma once

#include "lib/records/record.hpp"
#include "lib/records/record_file.hpp"
#include "lib/records/universal_file.hpp"

#include <vector>

namespace impulse {

/// Reads a WAV file (RIFF, RIFX, RF64; integer or floating point) through libsndfile. Channels are called channel_1,
/// ...; integers become fractions of full scale, which a calibration (--scale) makes a physical quantity. @throws
/// InputError for a damaged file, or one that breaks off. Verified by: tests/tools/ir-convert/wav
[[nodiscard]] Record read_wav_file(const RecordFile& file, Incomplete incomplete);

[[nodiscard]] bool is_wav_file(std::string_view head);

}  // namespace impulse
