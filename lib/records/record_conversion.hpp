#pragma once

#include "lib/records/record.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// What is to become of a record. Channels go by their name or their number from 1.
struct RecordConversion {
  struct Named {
    std::string channel;
    std::string text;
  };
  /// SI value of a channel times factor, or divided by it; the unit of the product is that of the two.
  struct Calibration {
    enum class Use { multiply, divide };
    std::string channel;
    double factor = 1;       ///< SI, not 0
    std::string unit = "1";  ///< SI
    Use use = Use::multiply;
    std::string flag;  ///< for messages
  };
  std::vector<std::string> channels;  ///< those that stay, in this order; empty: all
  std::vector<Named> names;           ///< new names
  std::vector<Named> units;           ///< units to take the values in, whatever the record says
  std::vector<Calibration> calibrations;
  std::optional<double> from, to;  ///< part of the abscissa that stays, SI, both ends in
  enum class Origin { keep, first_sample } origin = Origin::keep;
};

/// `CH1=9.2e-4`, `CH1=400N/V` or `CH1=2.25mV/N` as a calibration.
/// @throws std::invalid_argument for what is none.
[[nodiscard]] RecordConversion::Calibration parse_calibration(const std::string& text,
                                                              RecordConversion::Calibration::Use use);

/// `OLD=NEW`. @throws std::invalid_argument
[[nodiscard]] RecordConversion::Named parse_named(const std::string& text);

/// The record in SI with what the conversion asks for. A unit that isn't known keeps its name and its values; names
/// that occur twice get a number; both are in the notes.
/// @throws UsageError naming the flag for a channel there isn't or a product of units there isn't;
/// std::invalid_argument if nothing is left of the record. Verified by: tests/lib/record.test.cpp
[[nodiscard]] std::unique_ptr<RecordRows> converted_record(std::unique_ptr<RecordRows> rows,
                                                           const RecordConversion& conversion);

/// Number of the channel from 0. @throws UsageError under `flag`, listing the channels.
[[nodiscard]] std::size_t channel_index(const std::vector<ChannelInfo>& channels, const std::string& name,
                                        const std::string& flag);

}  // namespace impulse
