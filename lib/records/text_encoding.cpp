#include "lib/records/text_encoding.hpp"

#include "lib/contract/require.hpp"

#include <iconv.h>

#include <algorithm>
#include <cerrno>

namespace impulse {
namespace {

std::size_t sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// Whether the text is UTF-8; it may end inside a letter.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(static_cast<unsigned char>(text[i]));
    if (length == 0) return false;
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    i += length;
  }
  return true;
}

bool has_greek_of_gb(std::string_view text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const auto second = static_cast<unsigned char>(text[i + 1]);
    if (static_cast<unsigned char>(text[i]) == 0xA6 && second >= 0xA1 && second <= 0xD8) return true;
  }
  return false;
}

class Converter {
 public:
  explicit Converter(const std::string& encoding) : handle_(iconv_open("UTF-8", encoding.c_str())) {
    require(handle_ != reinterpret_cast<iconv_t>(-1), "'{}' is no encoding that iconv knows (iconv -l lists them)",
            encoding);
  }
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;
  ~Converter() { iconv_close(handle_); }

  std::string convert(std::string_view text) {
    std::string result;
    std::string input(text);
    char* in = input.data();
    std::size_t in_left = input.size();
    char buffer[256];
    while (in_left > 0) {
      char* out = buffer;
      std::size_t out_left = sizeof buffer;
      const std::size_t status = iconv(handle_, &in, &in_left, &out, &out_left);
      result.append(buffer, sizeof buffer - out_left);
      if (status != static_cast<std::size_t>(-1) || errno == E2BIG) continue;
      result += "\xEF\xBF\xBD";
      ++in;
      --in_left;
    }
    return result;
  }

 private:
  iconv_t handle_;
};

}  // namespace

std::string text_encoding(std::string_view text) {
  if (is_utf8(text)) return "UTF-8";
  return has_greek_of_gb(text) ? "GB18030" : "WINDOWS-1252";
}

std::string to_utf8(std::string_view text, const std::string& encoding) {
  const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return (c & 0x80) == 0; });
  const bool contains_ascii = encoding == "UTF-8" || encoding == "WINDOWS-1252" || encoding == "GB18030";
  if (ascii && contains_ascii) return std::string(text);
  return Converter(encoding).convert(text);
}

}  // namespace impulse
