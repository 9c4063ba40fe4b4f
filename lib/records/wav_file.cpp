#include "lib/records/wav_file.hpp"

#include "lib/contract/errors.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <cmath>
#include <cstdint>
#include <memory>

namespace impulse {
namespace {

struct SoundClose {
  void operator()(SNDFILE* sound) const { sf_close(sound); }
};

/// What the first chunk says of the file's length. A recorder that was switched off leaves 0 or all ones.
std::uint64_t stated_size(std::string_view head) {
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t at = head.starts_with("RIFX") ? 4 + i : 7 - i;
    size = size << 8 | static_cast<unsigned char>(head[at]);
  }
  return size == 0 || size == 0xFFFFFFFF ? 0 : size + 8;
}

}  // namespace

bool is_wav_file(std::string_view head) {
  const bool riff = head.starts_with("RIFF") || head.starts_with("RIFX") || head.starts_with("RF64");
  return riff && head.size() >= 12 && head.substr(8, 4) == "WAVE";
}

Record read_wav_file(const RecordFile& file, Incomplete incomplete) {
  const std::string head = file.head(12);
  if (!is_wav_file(head)) throw InputError(file.name(), 0, 0, "byte 1: this is not a WAV file");
  const std::uint64_t stated = stated_size(head);
  // A chunk of odd length has a filling byte, which some writers count and don't write.
  const bool broken = stated > file.size() + 1;
  if (broken && incomplete == Incomplete::refuse)
    throw InputError(
        file.name(), 0, 0,
        fmt::format("byte {}: the file ends here, but says that it has {} bytes (--incomplete takes what there is)",
                    file.size(), stated));
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, SoundClose> sound(sf_open(file.path().c_str(), SFM_READ, &info));
  if (!sound) throw InputError(file.name(), 0, 0, sf_strerror(nullptr));
  if ((info.format & SF_FORMAT_TYPEMASK) != SF_FORMAT_WAV && (info.format & SF_FORMAT_TYPEMASK) != SF_FORMAT_WAVEX &&
      (info.format & SF_FORMAT_TYPEMASK) != SF_FORMAT_RF64)
    throw InputError(file.name(), 0, 0, "this is not a WAV file");
  if (info.samplerate <= 0) throw InputError(file.name(), 0, 0, "the sampling rate is not positive");
  Record record;
  record.format = "WAV file";
  record.abscissa.step = 1.0 / info.samplerate;
  const auto channels = static_cast<std::size_t>(info.channels);
  for (std::size_t c = 0; c < channels; ++c)
    record.channels.push_back({{fmt::format("channel_{}", c + 1), "", "", false}, {}, {}});
  std::vector<double> block(4096 * channels);
  while (const sf_count_t frames = sf_readf_double(sound.get(), block.data(), 4096)) {
    if (frames < 0) break;
    for (std::size_t i = 0; i < static_cast<std::size_t>(frames) * channels; ++i) {
      if (!std::isfinite(block[i]))
        throw InputError(file.name(), 0, 0,
                         fmt::format("sample {} of channel {} is not finite", record.abscissa.size + i / channels + 1,
                                     i % channels + 1));
      record.channels[i % channels].values.push_back(block[i]);
    }
    record.abscissa.size += static_cast<std::size_t>(frames);
  }
  if (record.abscissa.size == 0) throw InputError(file.name(), 0, 0, "no samples in it");
  if (broken) record.notes.push_back(fmt::format("the file breaks off: {} of {} bytes", file.size(), stated));
  record.notes.push_back("values are fractions of full scale: --scale calibrates them");
  return record;
}

}  // namespace impulse
