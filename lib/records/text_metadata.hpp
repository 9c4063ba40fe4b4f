#pragma once

#include "lib/records/text_layout.hpp"

#include <initializer_list>
#include <string_view>

namespace impulse {

/// What the heading of a text says, by its keys; a value of several fields stays several.
struct TextMetadata {
  struct Entry {
    std::string key;
    std::vector<std::string> values;
    std::size_t line;
    /// Whether the key, spelled as plain_key does, is one of these.
    [[nodiscard]] bool is(std::initializer_list<std::string_view> keys) const;
  };
  std::string file;
  char decimal_sign = '.';
  std::vector<Entry> entries;

  /// The first entry under one of the keys (plain_key). Null if there is none.
  [[nodiscard]] const Entry* find(std::initializer_list<std::string_view> keys) const;
  [[nodiscard]] const Entry* find_if(bool (*is_key)(std::string_view)) const;
};

/// `key: value`, `key = value`, or fields of which the first is the key. Nothing for lines of one field.
[[nodiscard]] std::optional<TextMetadata::Entry> metadata_entry(std::string_view line, char delimiter,
                                                                std::size_t number);

/// Takes start and step (s) from the metadata, where they are.
/// @throws InputError if channels have different ones, or a step isn't positive.
void take_timing(const TextMetadata& metadata, TextLayout& layout);

/// Whether a plain_key is one under which a time step, or a sampling rate, is said.
[[nodiscard]] bool is_interval_key(std::string_view key);
[[nodiscard]] bool is_rate_key(std::string_view key);

/// The unit of the times that the metadata say, if they do.
[[nodiscard]] std::optional<std::string> time_unit(const TextMetadata& metadata);

/// Takes names and units of the channels from the metadata, where a line has one for each of them and the layout none.
void take_channels(const TextMetadata& metadata, TextLayout& layout);

}  // namespace impulse
