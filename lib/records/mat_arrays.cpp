#include "lib/records/mat_arrays.hpp"

#include "lib/contract/errors.hpp"

#include <fmt/format.h>
#include <matio.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace impulse {
namespace {

constexpr int deepest = 8;

/// What the reading process hands over: fields of fixed size and blocks that begin with their length.
class ArraySender {
 public:
  explicit ArraySender(int descriptor) : descriptor_(descriptor) {}

  void send(const MatArray& array) {
    put_text(array.name);
    put_number(array.rows);
    put_number(array.columns);
    put_number((array.is_complex ? 1U : 0U) | (array.is_text ? 2U : 0U));
    put_text(array.text);
    put_block(array.real);
    put_block(array.imaginary);
  }

 private:
  void put(const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
      const ssize_t count = ::write(descriptor_, bytes, size);
      if (count < 0 && errno != EINTR) _exit(1);
      if (count <= 0) continue;
      bytes += count;
      size -= static_cast<std::size_t>(count);
    }
  }
  void put_number(std::uint64_t number) { put(&number, sizeof number); }
  void put_text(const std::string& text) {
    put_number(text.size());
    put(text.data(), text.size());
  }
  void put_block(const std::vector<double>& values) {
    put_number(values.size());
    put(values.data(), values.size() * sizeof(double));
  }

  int descriptor_;
};

template <class T>
void append_as(const void* data, std::size_t count, std::vector<double>& values) {
  const T* const typed = static_cast<const T*>(data);
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<double>(typed[i]));
}

bool append_numbers(const void* data, matio_classes type, std::size_t count, std::vector<double>& values) {
  switch (type) {
    case MAT_C_DOUBLE:
      append_as<double>(data, count, values);
      return true;
    case MAT_C_SINGLE:
      append_as<float>(data, count, values);
      return true;
    case MAT_C_INT8:
      append_as<std::int8_t>(data, count, values);
      return true;
    case MAT_C_UINT8:
      append_as<std::uint8_t>(data, count, values);
      return true;
    case MAT_C_INT16:
      append_as<std::int16_t>(data, count, values);
      return true;
    case MAT_C_UINT16:
      append_as<std::uint16_t>(data, count, values);
      return true;
    case MAT_C_INT32:
      append_as<std::int32_t>(data, count, values);
      return true;
    case MAT_C_UINT32:
      append_as<std::uint32_t>(data, count, values);
      return true;
    case MAT_C_INT64:
      append_as<std::int64_t>(data, count, values);
      return true;
    case MAT_C_UINT64:
      append_as<std::uint64_t>(data, count, values);
      return true;
    default:
      return false;
  }
}

void append_utf8(std::string& text, unsigned code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | code >> 6);
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    text += static_cast<char>(0xE0 | code >> 12);
    text += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
}

class ArrayWalker {
 public:
  ArrayWalker(int descriptor, std::uint64_t most_elements) : sender_(descriptor), elements_left_(most_elements) {}

  void walk(const std::string& name, matvar_t* variable, int depth) {
    if (!variable || !variable->data || !variable->dims || variable->rank != 2 || depth > deepest) return;
    // matio makes zeros of what a matrix lacks: one with more elements than the file could hold is damaged.
    const std::size_t rows = variable->dims[0], columns = variable->dims[1];
    if (columns > 0 && rows > elements_left_ / columns) _exit(1);
    const std::size_t count = rows * columns;
    elements_left_ -= count;
    if (variable->class_type == MAT_C_STRUCT) return walk_structure(name, variable, count, depth);
    if (variable->class_type == MAT_C_CELL) {
      for (std::size_t i = 0; i < count; ++i)
        walk(fmt::format("{}{{{}}}", name, i + 1), Mat_VarGetCell(variable, static_cast<int>(i)), depth + 1);
      return;
    }
    MatArray array{name, rows, columns, variable->isComplex != 0, false, {}, {}, {}};
    if (variable->class_type == MAT_C_CHAR ? take_text(variable, count, array) : take_numbers(variable, count, array))
      sender_.send(array);
  }

 private:
  void walk_structure(const std::string& name, matvar_t* variable, std::size_t count, int depth) {
    char* const* fields = Mat_VarGetStructFieldnames(variable);
    const unsigned field_count = Mat_VarGetNumberOfFields(variable);
    for (std::size_t i = 0; fields && i < count; ++i)
      for (unsigned f = 0; f < field_count; ++f) {
        const std::string element = count > 1 ? fmt::format("{}({})", name, i + 1) : name;
        walk(element + "." + fields[f], Mat_VarGetStructFieldByIndex(variable, f, i), depth + 1);
      }
  }

  static bool take_text(const matvar_t* variable, std::size_t count, MatArray& array) {
    array.is_text = true;
    array.is_complex = false;
    if (variable->data_type == MAT_T_UTF8) {
      // The dimensions count letters, the data are bytes.
      array.text.assign(static_cast<const char*>(variable->data), variable->nbytes);
      return true;
    }
    for (std::size_t i = 0; i < count; ++i)
      append_utf8(array.text, variable->data_size == 2 ? static_cast<const std::uint16_t*>(variable->data)[i]
                                                       : static_cast<const std::uint8_t*>(variable->data)[i]);
    return true;
  }

  static bool take_numbers(const matvar_t* variable, std::size_t count, MatArray& array) {
    if (!variable->isComplex) return append_numbers(variable->data, variable->class_type, count, array.real);
    const auto* split = static_cast<const mat_complex_split_t*>(variable->data);
    return append_numbers(split->Re, variable->class_type, count, array.real) &&
           append_numbers(split->Im, variable->class_type, count, array.imaginary);
  }

  ArraySender sender_;
  std::uint64_t elements_left_;
};

#if defined(__SANITIZE_ADDRESS__)
constexpr bool address_sanitizer = true;
#elif defined(__has_feature)
constexpr bool address_sanitizer = __has_feature(address_sanitizer);
#else
constexpr bool address_sanitizer = false;
#endif

/// The reading process. Never returns.
[[noreturn]] void read_and_exit(const RecordFile& file, int result) {
  // deflate packs a thousand to one at the best; the sanitizer reserves more memory than any limit allows.
  const std::uint64_t unpacked = 1100 * file.size();
  const rlim_t memory = (rlim_t{1} << 30) + unpacked;
  const rlimit limit{memory, memory};
  if (!address_sanitizer) ::setrlimit(RLIMIT_AS, &limit);
  // A damaged length can keep matio busy for ever; the slowest disk and packing deliver 2 MB/s.
  const rlim_t time = 1 + file.size() / 2000000;
  const rlimit seconds{time, time};
  ::setrlimit(RLIMIT_CPU, &seconds);
  const int null = ::open("/dev/null", O_WRONLY);
  if (null >= 0) ::dup2(null, STDERR_FILENO);
  mat_t* mat = Mat_Open(file.path().c_str(), MAT_ACC_RDONLY);
  if (!mat) _exit(2);
  ArrayWalker walker(result, unpacked);
  while (matvar_t* variable = Mat_VarReadNext(mat)) {
    walker.walk(variable->name ? variable->name : "", variable, 0);
    Mat_VarFree(variable);
  }
  _exit(0);
}

/// Takes apart what the reading process left; it may be anything if that process went wrong.
class ArrayReceiver {
 public:
  explicit ArrayReceiver(std::string bytes) : bytes_(std::move(bytes)) {}

  bool receive(MatArray& array) {
    std::uint64_t rows = 0, columns = 0, kind = 0;
    if (!take_text(array.name) || !take_number(rows) || !take_number(columns) || !take_number(kind) ||
        !take_text(array.text) || !take_block(array.real) || !take_block(array.imaginary))
      return false;
    array.rows = rows;
    array.columns = columns;
    array.is_complex = (kind & 1) != 0;
    array.is_text = (kind & 2) != 0;
    const std::size_t count = array.real.size();
    return array.is_text || ((columns == 0 ? count == 0 : count / columns == rows && count % columns == 0) &&
                             array.imaginary.size() == (array.is_complex ? count : 0));
  }
  [[nodiscard]] bool is_empty() const { return at_ == bytes_.size(); }

 private:
  bool take(void* data, std::size_t size) {
    if (size > bytes_.size() - at_) return false;
    if (size > 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
    return true;
  }
  bool take_number(std::uint64_t& number) { return take(&number, sizeof number); }
  bool take_text(std::string& text) {
    std::uint64_t size = 0;
    if (!take_number(size) || size > bytes_.size() - at_) return false;
    text.resize(size);
    return take(text.data(), size);
  }
  bool take_block(std::vector<double>& values) {
    std::uint64_t size = 0;
    if (!take_number(size) || size > (bytes_.size() - at_) / sizeof(double)) return false;
    values.resize(size);
    return take(values.data(), size * sizeof(double));
  }

  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<MatArray> read_mat_arrays(const RecordFile& file) {
  const int result = ::memfd_create("arrays", MFD_CLOEXEC);
  if (result < 0) throw InputError(file.name(), 0, 0, fmt::format("cannot make room for it: {}", std::strerror(errno)));
  const RecordFile handed(fmt::format("/proc/self/fd/{}", result));
  const pid_t reader = ::fork();
  if (reader == 0) read_and_exit(file, result);
  int status = -1;
  while (reader > 0 && ::waitpid(reader, &status, 0) < 0 && errno == EINTR) {
  }
  ::close(result);
  if (reader < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw InputError(file.name(), 0, 0,
                     WIFEXITED(status) && WEXITSTATUS(status) == 2
                         ? "no MATLAB file that matio can open"
                         : "matio breaks down on this MATLAB file: it is damaged, or cut off");
  const off_t size = ::lseek(handed.descriptor(), 0, SEEK_END);
  std::string bytes(static_cast<std::size_t>(size > 0 ? size : 0), '\0');
  for (std::size_t filled = 0; filled < bytes.size();) {
    const std::size_t count = handed.read_at(filled, bytes.data() + filled, bytes.size() - filled);
    if (count == 0) break;
    filled += count;
  }
  ArrayReceiver receiver(std::move(bytes));
  std::vector<MatArray> arrays;
  while (!receiver.is_empty()) {
    MatArray array;
    if (!receiver.receive(array))
      throw InputError(file.name(), 0, 0, "matio makes no sense of this MATLAB file: it is damaged");
    arrays.push_back(std::move(array));
  }
  return arrays;
}

}  // namespace impulse
