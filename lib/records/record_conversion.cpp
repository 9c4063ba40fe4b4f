#include "lib/records/record_conversion.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/csv/decimal.hpp"
#include "lib/records/record_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace impulse {
namespace {

/// One channel on its way: SI = (value · factor + offset) / divisor. Dividing by 1000 rounds once, multiplying by 0.001
/// twice.
struct Way {
  std::size_t column = 0;  ///< in the source's row
  bool is_complex = false;
  double factor = 1, divisor = 1, offset = 0;
};

void take_factor(Way& way, double factor) {
  const double inverse = std::nearbyint(1 / factor);
  if (std::abs(inverse * factor - 1) < 1e-12)
    way.divisor *= inverse;
  else
    way.factor *= factor;
}

class ConvertedRows : public RecordRows {
 public:
  ConvertedRows(std::unique_ptr<RecordRows> source, const RecordConversion& conversion)
      : source_(std::move(source)), conversion_(conversion), header_(source_->header()), row_(source_->width()) {
    const std::vector<ChannelInfo> all = header_.channels;
    std::vector<ChannelInfo> infos = all;
    std::vector<Way> ways = source_ways(all);
    for (const RecordConversion::Named& unit : conversion.units)
      infos[channel_index(all, unit.channel, "--unit")].unit = known_unit(unit);
    for (std::size_t i = 0; i < infos.size(); ++i) make_si(infos[i], ways[i]);
    for (const RecordConversion::Calibration& calibration : conversion.calibrations) {
      const std::size_t i = channel_index(all, calibration.channel, calibration.flag);
      calibrate(infos[i], ways[i], calibration);
    }
    for (const RecordConversion::Named& name : conversion.names)
      infos[channel_index(all, name.channel, "--rename")].name = name.text;
    select(all, infos, ways);
    make_names_different();
    crop();
  }

  [[nodiscard]] const RecordHeader& header() const override { return header_; }

  [[nodiscard]] bool next(std::span<double> row) override {
    while (index_ < end_ && source_->next(row_)) {
      if (index_++ < begin_) continue;
      if (!is_even_ &&
          ((conversion_.from && row_[0] < *conversion_.from) || (conversion_.to && row_[0] > *conversion_.to)))
        continue;
      if (conversion_.origin == RecordConversion::Origin::first_sample && !is_even_ && !origin_) origin_ = row_[0];
      row[0] = is_even_ ? header_.abscissa.at(given_++) : row_[0] - origin_.value_or(0);
      std::size_t column = 1;
      for (const Way& way : ways_) {
        row[column++] = (row_[way.column] * way.factor + way.offset) / way.divisor;
        if (way.is_complex) row[column++] = (row_[way.column + 1] * way.factor) / way.divisor;
      }
      return true;
    }
    return false;
  }

 private:
  static std::vector<Way> source_ways(const std::vector<ChannelInfo>& channels) {
    std::vector<Way> ways;
    std::size_t column = 1;
    for (const ChannelInfo& channel : channels) {
      ways.push_back({column, channel.is_complex, 1, 1, 0});
      column += channel.is_complex ? 2 : 1;
    }
    return ways;
  }

  static std::string known_unit(const RecordConversion::Named& unit) {
    if (!record_unit(unit.text) && !is_no_unit(unit.text))
      throw UsageError("--unit", fmt::format("unknown unit '{}'", unit.text));
    return unit.text;
  }

  void make_si(ChannelInfo& info, Way& way) {
    if (is_no_unit(info.unit)) {
      info.unit = "";
      return;
    }
    const std::optional<RecordUnit> unit = record_unit(info.unit);
    if (!unit) {
      header_.notes.push_back(
          fmt::format("channel '{}': unit '{}' is not known: values stay as they are", info.name, info.unit));
      return;
    }
    if (info.unit == "g") header_.notes.push_back(fmt::format("channel '{}': unit g is 9.80665 m/s2", info.name));
    info.unit = unit->si;
    take_factor(way, unit->factor);
    way.offset = unit->offset * way.divisor;
  }

  static void calibrate(ChannelInfo& info, Way& way, const RecordConversion::Calibration& calibration) {
    const bool multiply = calibration.use == RecordConversion::Calibration::Use::multiply;
    const std::string before = info.unit.empty() ? "1" : info.unit;
    info.unit = multiply ? unit_product(before, calibration.unit) : unit_quotient(before, calibration.unit);
    if (info.unit.empty())
      throw UsageError(calibration.flag, fmt::format("channel '{}' is in '{}', which does not go with {}", info.name,
                                                     before, calibration.unit));
    if (multiply) {
      way.factor *= calibration.factor;
      way.offset *= calibration.factor;
    } else {
      way.divisor *= calibration.factor;
    }
  }

  void select(const std::vector<ChannelInfo>& all, const std::vector<ChannelInfo>& infos,
              const std::vector<Way>& ways) {
    std::vector<std::size_t> chosen;
    for (const std::string& name : conversion_.channels) chosen.push_back(channel_index(all, name, "--channel"));
    if (conversion_.channels.empty())
      for (std::size_t i = 0; i < all.size(); ++i) chosen.push_back(i);
    header_.channels.clear();
    for (const std::size_t i : chosen) {
      header_.channels.push_back(infos[i]);
      ways_.push_back(ways[i]);
    }
  }

  void make_names_different() {
    std::set<std::string> seen;
    for (ChannelInfo& info : header_.channels) {
      const std::string name = info.name;
      for (std::size_t number = 2; !seen.insert(info.name).second; ++number)
        info.name = fmt::format("{}_{}", name, number);
      if (info.name != name)
        header_.notes.push_back(fmt::format("a second channel '{}' is called '{}'", name, info.name));
    }
  }

  void crop() {
    Abscissa& abscissa = header_.abscissa;
    is_even_ = abscissa.is_even();
    end_ = abscissa.size;
    if (!is_even_) return;
    // A bound on a sample takes it in, however the quotient was rounded.
    const auto position = [&](double bound) { return (bound - abscissa.start) / abscissa.step; };
    const auto last = static_cast<double>(abscissa.size);
    if (conversion_.from)
      begin_ = static_cast<std::size_t>(std::clamp(std::ceil(position(*conversion_.from) - 1e-6), 0.0, last));
    if (conversion_.to)
      end_ = static_cast<std::size_t>(std::clamp(std::floor(position(*conversion_.to) + 1e-6) + 1, 0.0, last));
    require(begin_ < end_, "no sample lies between --from and --to (the record runs from {} to {} {})", abscissa.start,
            abscissa.at(abscissa.size - 1), abscissa.unit);
    abscissa.start = abscissa.at(begin_);
    abscissa.size = end_ - begin_;
    if (conversion_.origin == RecordConversion::Origin::first_sample) abscissa.start = 0;
  }

  std::unique_ptr<RecordRows> source_;
  RecordConversion conversion_;
  RecordHeader header_;
  std::vector<double> row_;
  std::vector<Way> ways_;
  std::optional<double> origin_;
  bool is_even_ = true;
  std::size_t begin_ = 0, end_ = 0, index_ = 0, given_ = 0;
};

/// Splits at the last `=` with something on both sides, so that names may hold one.
RecordConversion::Named split_named(const std::string& text, const char* form) {
  const std::size_t mark = text.rfind('=');
  require(mark != std::string::npos && mark > 0 && mark + 1 < text.size(), "'{}' is not {}", text, form);
  return {text.substr(0, mark), text.substr(mark + 1)};
}

}  // namespace

std::size_t channel_index(const std::vector<ChannelInfo>& channels, const std::string& name, const std::string& flag) {
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name == name) return i;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (std::to_string(i + 1) == name) return i;
  std::vector<std::string> names;
  for (const ChannelInfo& channel : channels) names.push_back(channel.name);
  throw UsageError(flag, fmt::format("no channel '{}' (there are: {})", name, fmt::join(names, ", ")));
}

RecordConversion::Calibration parse_calibration(const std::string& text, RecordConversion::Calibration::Use use) {
  const RecordConversion::Named named = split_named(text, "CHANNEL=FACTOR with an optional unit");
  const Decimal number = leading_decimal(named.text);
  require(number.length > 0 && std::isfinite(number.value) && number.value != 0,
          "'{}' is no factor (it must be a number, not 0)", named.text);
  RecordConversion::Calibration calibration{named.channel, number.value, "1", use, ""};
  const std::string spelled = named.text.substr(number.length);
  if (spelled.empty()) return calibration;
  const std::optional<RecordUnit> unit = record_unit(spelled);
  require(unit && unit->offset == 0, "'{}': unknown unit '{}'", text, spelled);
  calibration.unit = unit->si;
  calibration.factor *= unit->factor;
  return calibration;
}

RecordConversion::Named parse_named(const std::string& text) { return split_named(text, "CHANNEL=TEXT"); }

std::unique_ptr<RecordRows> converted_record(std::unique_ptr<RecordRows> rows, const RecordConversion& conversion) {
  return std::make_unique<ConvertedRows>(std::move(rows), conversion);
}

}  // namespace impulse
