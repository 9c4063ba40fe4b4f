#include "lib/records/text_lines.hpp"

#include "lib/contract/errors.hpp"

#include <algorithm>
#include <cstring>

namespace impulse {

TextLines::TextLines(const RecordFile& file, const TextPlace& from)
    : file_(file), buffer_(std::size_t{1} << 20), offset_(from.offset), number_(from.lines) {
  refill();
  const std::string_view head(buffer_.data(), end_);
  if (head.find('\n') == head.npos && head.find('\r') != head.npos) terminator_ = '\r';
  if (from.offset == 0 && head.starts_with("\xEF\xBB\xBF")) begin_ = 3;
}

void TextLines::refill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) {
    if (buffer_.size() >= std::size_t{1} << 26)
      throw InputError(file_.name(), number_ + 1, 0, "the line is longer than 64 MiB (is this text?)");
    buffer_.resize(2 * buffer_.size());
  }
  const std::size_t count = file_.read_at(offset_, buffer_.data() + end_, buffer_.size() - end_);
  offset_ += count;
  end_ += count;
}

bool TextLines::next(std::string_view& line) {
  std::size_t searched = 0;
  while (true) {
    const std::string_view rest(buffer_.data() + begin_, end_ - begin_);
    std::size_t stop = rest.find(terminator_, searched);
    if (stop == rest.npos) {
      searched = rest.size();
      refill();
      if (end_ - begin_ > searched) continue;
      if (searched == 0) return false;
      line = {buffer_.data() + begin_, searched};
      begin_ = end_;
    } else {
      line = rest.substr(0, stop);
      begin_ += stop + 1;
    }
    while (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return true;
  }
}

}  // namespace impulse
