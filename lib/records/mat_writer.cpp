#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/records/mat_file.hpp"
#include "lib/records/record_csv.hpp"
#include "lib/records/record_unit.hpp"

#include <fmt/format.h>
#include <matio.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <set>

namespace impulse {
namespace {

struct MatClose {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
};
struct VariableFree {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, VariableFree>;

/// A name that MATLAB takes: letters, digits and _, a letter first, at most 63, none twice.
std::string identifier(const std::string& name, std::set<std::string>& taken) {
  const auto is_ascii_letter = [](char c) {
    return (c & 0x80) == 0 && std::isalpha(static_cast<unsigned char>(c)) != 0;
  };
  std::string result = !name.empty() && is_ascii_letter(name.front()) ? "" : "x";
  for (const char c : name) result += is_ascii_letter(c) || (c >= '0' && c <= '9') ? c : '_';
  result.resize(std::min<std::size_t>(result.size(), 55));
  std::string unique = result;
  for (int number = 2; !taken.insert(unique).second; ++number) unique = fmt::format("{}_{}", result, number);
  return unique;
}

Variable vector_of(const std::string& name, const std::vector<double>& real,
                   const std::vector<double>& imaginary = {}) {
  std::array<std::size_t, 2> dimensions{real.size(), 1};
  // matio copies; its interface is just not const-correct.
  auto* re = const_cast<double*>(real.data());       // NOLINT
  auto* im = const_cast<double*>(imaginary.data());  // NOLINT
  mat_complex_split_t split{re, im};
  const bool is_complex = !imaginary.empty();
  return Variable(Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dimensions.data(),
                                is_complex ? static_cast<void*>(&split) : re, is_complex ? MAT_F_COMPLEX : 0));
}

/// UTF-16, of which MATLAB counts the units; letters that take two of them are replaced by U+FFFD.
std::vector<std::uint16_t> utf16(const std::string& text) {
  std::vector<std::uint16_t> units;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    unsigned code = length == 1 ? lead : lead & (0x7FU >> length);
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3F);
    units.push_back(static_cast<std::uint16_t>(code > 0xFFFF ? 0xFFFD : code));
    i += length;
  }
  return units;
}

Variable text_of(const std::string& text) {
  std::vector<std::uint16_t> units = utf16(text);
  std::array<std::size_t, 2> dimensions{1, units.size()};
  return Variable(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT16, 2, dimensions.data(), units.data(), 0));
}

class MatWriter {
 public:
  MatWriter(const std::string& path, MatVersion version)
      : path_(path),
        temporary_(fmt::format("{}.{}.tmp", path, ::getpid())),
        mat_(Mat_CreateVer(temporary_.c_str(), nullptr, version == MatVersion::v5 ? MAT_FT_MAT5 : MAT_FT_MAT73)) {
    if (!mat_) fail();
  }
  MatWriter(const MatWriter&) = delete;
  MatWriter& operator=(const MatWriter&) = delete;
  ~MatWriter() {
    mat_.reset();
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  void write(const Record& record) {
    std::set<std::string> taken{"abscissa", "channels"};
    std::vector<double> times;
    for (std::size_t k = 0; k < record.abscissa.size; ++k)
      times.push_back(record.abscissa.is_even() ? record.abscissa.at(k) : record.abscissa_values[k]);
    const std::string time_name = identifier(column_name(record.abscissa.name, record.abscissa.unit), taken);
    put(vector_of(time_name, times));
    std::vector<std::string> names;
    for (const Channel& channel : record.channels) {
      names.push_back(identifier(column_name(channel.info.name, channel.info.unit), taken));
      put(vector_of(names.back(), channel.values, channel.imaginary));
    }
    put_abscissa(record.abscissa, time_name);
    put_channels(record, names);
  }

  void close() {
    mat_.reset();
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail();
    temporary_.clear();
  }

 private:
  [[noreturn]] void fail() const { throw OutputError(fmt::format("cannot write {} as a MATLAB file", path_)); }

  void put(const Variable& variable) {
    if (!variable || Mat_VarWrite(mat_.get(), variable.get(), MAT_COMPRESSION_NONE) != 0) fail();
  }

  static void set(matvar_t* structure, const char* field, std::size_t index, Variable value) {
    Mat_VarSetStructFieldByName(structure, field, index, value.release());
  }

  void put_abscissa(const Abscissa& abscissa, const std::string& variable) {
    std::array<const char*, 5> fields{"variable", "name", "unit", "start", "step"};
    std::array<std::size_t, 2> dimensions{1, 1};
    const Variable structure(
        Mat_VarCreateStruct("abscissa", 2, dimensions.data(), fields.data(), static_cast<unsigned>(fields.size())));
    if (!structure) fail();
    set(structure.get(), "variable", 0, text_of(variable));
    set(structure.get(), "name", 0, text_of(abscissa.name));
    set(structure.get(), "unit", 0, text_of(abscissa.unit));
    set(structure.get(), "start", 0, vector_of("", {abscissa.start}));
    set(structure.get(), "step", 0, vector_of("", {abscissa.step}));
    put(structure);
  }

  void put_channels(const Record& record, const std::vector<std::string>& variables) {
    std::array<const char*, 4> fields{"variable", "name", "unit", "quantity"};
    std::array<std::size_t, 2> dimensions{1, record.channels.size()};
    const Variable structure(
        Mat_VarCreateStruct("channels", 2, dimensions.data(), fields.data(), static_cast<unsigned>(fields.size())));
    if (!structure) fail();
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const ChannelInfo& info = record.channels[i].info;
      set(structure.get(), "variable", i, text_of(variables[i]));
      set(structure.get(), "name", i, text_of(info.name));
      set(structure.get(), "unit", i, text_of(info.unit));
      set(structure.get(), "quantity", i, text_of(info.quantity));
    }
    put(structure);
  }

  std::string path_, temporary_;
  std::unique_ptr<mat_t, MatClose> mat_;
};

}  // namespace

void write_mat_file(const std::string& path, const Record& record, MatVersion version) {
  require(!path.empty() && path != "-",
          "a MATLAB file cannot be written to a pipe (it is not written front to back): give -o FILE");
  require(record.abscissa.size > 0 && !record.channels.empty(),
          "a MATLAB file needs at least one sample and one channel");
  MatWriter writer(path, version);
  writer.write(record);
  writer.close();
}

}  // namespace impulse
