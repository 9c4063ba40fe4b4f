#pragma once

#include <string>
#include <string_view>

namespace impulse {

/// How the letters of a text are coded, as iconv calls it: UTF-8 if the bytes are that, else GB18030 if there are Greek
/// letters in it (0xA6 0xA1-0xD8: in Latin-1 a broken bar before a letter, which nobody writes), else WINDOWS-1252,
/// which contains Latin-1.
[[nodiscard]] std::string text_encoding(std::string_view text);

/// The text in UTF-8; what the encoding doesn't know becomes U+FFFD.
/// @throws std::invalid_argument if iconv doesn't know the encoding. Verified by: tests/lib/text_record.test.cpp
[[nodiscard]] std::string to_utf8(std::string_view text, const std::string& encoding);

}  // namespace impulse
