#include "lib/contract/require.hpp"
#include "lib/csv/output_file.hpp"
#include "lib/records/universal_file.hpp"
#include "lib/records/universal_function.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace impulse {
namespace {

/// At most `length` bytes, cut between letters.
std::string cut(const std::string& text, std::size_t length) {
  if (text.size() <= length) return text;
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80) --length;
  return text.substr(0, length);
}

int quantity_of(const std::string& unit) {
  if (unit == "N") return 13;
  if (unit == "m/s2") return 12;
  if (unit == "m/s") return 11;
  if (unit == "m") return 8;
  if (unit == "Pa") return 15;
  if (unit == "s") return 17;
  return unit == "Hz" ? 18 : 0;
}

std::string axis_line(const std::string& label, const std::string& unit) {
  const auto shown = [](const std::string& text) { return text.empty() ? std::string("NONE") : cut(text, 20); };
  return fmt::format("{:10}{:5}{:5}{:5} {:<20} {:<20}\n", quantity_of(unit), 0, 0, 0, shown(label), shown(unit));
}

void append_double(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (int byte = 0; byte < 8; ++byte) bytes += static_cast<char>(bits >> (8 * byte) & 0xFF);
}

class UniversalWriter {
 public:
  UniversalWriter(const std::string& path, const Record& record, UniversalForm form)
      : file_(path), record_(record), form_(form) {}

  void write() {
    for (const Channel& channel : record_.channels) write_channel(channel);
    file_.close();
  }

 private:
  [[nodiscard]] bool is_even() const { return record_.abscissa.is_even(); }

  void write_channel(const Channel& channel) {
    const Abscissa& abscissa = record_.abscissa;
    const std::size_t width = (is_even() ? 0U : 1U) + (channel.info.is_complex ? 2U : 1U);
    std::string heading = "    -1\n    58";
    heading += form_ == UniversalForm::binary ? fmt::format("b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}\n", 1, 2, 11,
                                                            abscissa.size * width * 8, 0, 0, 0, 0)
                                              : "\n";
    heading += cut(channel.info.name, 80) + "\nNONE\nNONE\n" + exact_abscissa_text(abscissa) + "\nNONE\n";
    const bool is_spectrum = abscissa.unit == "Hz";
    heading += fmt::format("{:5}{:10}{:5}{:10} {:<10}{:10}{:4} {:<10}{:10}{:4}\n", is_spectrum ? 4 : 1, 0, 0, 0, "NONE",
                           0, 0, "NONE", 0, 0);
    heading += fmt::format("{:10}{:10}{:10}{:13.5e}{:13.5e}{:13.5e}\n", channel.info.is_complex ? 6 : 4, abscissa.size,
                           is_even() ? 1 : 0, is_even() ? abscissa.start : 0.0, is_even() ? abscissa.step : 0.0, 0.0);
    heading += axis_line(abscissa.name, abscissa.unit) + axis_line(channel.info.name, channel.info.unit) +
               axis_line("", "") + axis_line("", "");
    file_.write(heading);
    line_.clear();
    for (std::size_t k = 0; k < abscissa.size; ++k) {
      if (!is_even()) put(record_.abscissa_values[k], 13);
      put(channel.values[k], 20);
      if (channel.info.is_complex) put(channel.imaginary[k], 20);
      // Lines of 80 columns, but never a sample in two of them.
      if (form_ == UniversalForm::text && line_.size() + (is_even() ? 20 * width : 13 + 20 * (width - 1)) > 80)
        end_line();
      if (form_ == UniversalForm::binary && line_.size() > 65536) flush();
    }
    if (form_ == UniversalForm::text && !line_.empty()) end_line();
    flush();
    file_.write("    -1\n");
  }

  void put(double value, int columns) {
    if (form_ == UniversalForm::binary)
      append_double(line_, value);
    else
      line_ += columns == 13 ? fmt::format("{:13.5e}", value) : fmt::format("{:20.12e}", value);
  }

  void end_line() {
    line_ += '\n';
    flush();
  }

  void flush() {
    file_.write(line_);
    line_.clear();
  }

  OutputFile file_;
  const Record& record_;
  UniversalForm form_;
  std::string line_;
};

}  // namespace

void write_universal_file(const std::string& path, const Record& record, UniversalForm form) {
  require(record.abscissa.size > 0 && !record.channels.empty(),
          "a universal file needs at least one sample and one channel");
  for (const Channel& channel : record.channels)
    for (const auto* values : {&channel.values, &channel.imaginary})
      for (const double value : *values)
        require(std::isfinite(value), "channel {} is not written: a value is {}", channel.info.name, value);
  UniversalWriter(path, record, form).write();
}

}  // namespace impulse
