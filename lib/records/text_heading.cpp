#include "lib/records/text_heading.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/text_dialects.hpp"
#include "lib/records/text_encoding.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace impulse {
namespace {

// Headings are a few lines; the second length is for those who keep a diary in them.
constexpr std::array head_sizes{std::size_t{1} << 16, std::size_t{1} << 22};

TextHead decoded_head(const RecordFile& file, std::size_t most, const TextOptions& options) {
  std::string bytes = file.head(most);
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw InputError(file.name(), 0, 0, "the text is UTF-16 (iconv -f UTF-16 -t UTF-8 converts it)");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  const std::size_t zero = bytes.find('\0');
  if (zero != std::string::npos)
    throw InputError(file.name(), 0, 0,
                     fmt::format("byte {} is zero: neither text nor a format that is known", zero + 1));
  const std::string encoding = options.encoding.value_or(text_encoding(bytes));
  const char terminator = bytes.find('\n') == std::string::npos ? '\r' : '\n';
  TextHead head{
      .file = file.name(), .is_whole = bytes.size() == file.size() || file.size() <= most, .encoding = encoding};
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const std::size_t end = rest.find(terminator);
    if (end == rest.npos && !head.is_whole) break;
    std::string_view line = rest.substr(0, end);
    while (line.ends_with('\r')) line.remove_suffix(1);
    head.lines.push_back(to_utf8(line, encoding));
    rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
  }
  return head;
}

std::pair<TextHead, TextLayout> first_layout(const RecordFile& file, TextDialect dialect, const TextOptions& options) {
  if (file.size() == 0) throw InputError(file.name(), 0, 0, "empty (expected a record)");
  for (const std::size_t most : head_sizes) {
    TextHead head = decoded_head(file, most, options);
    const bool last_try = head.is_whole || most == head_sizes.back();
    try {
      TextLayout layout = text_layout(head, dialect, options);
      // Rows that end where the head does may be those of a table in the heading.
      if (last_try || layout.first_line + 100 < head.lines.size() + 1) return {std::move(head), std::move(layout)};
    } catch (const InputError&) {
      if (last_try) throw;
    }
  }
  throw InputError(file.name(), 0, 0, "no rows of numbers in the first 4 MiB");
}

// A segment's heading is a dozen lines.
constexpr std::size_t longest_segment_heading = 1000;

/// The heading of the whole file, and the lines from `lines` on as far as names of columns.
TextHead segment_head(const TextHead& head, TextLines& lines, std::string_view first_line) {
  TextHead segment{.file = head.file, .is_whole = head.is_whole, .encoding = head.encoding};
  for (const std::string& line : head.lines) {
    segment.lines.push_back(line);
    if (line.starts_with(labview_end_of_header)) break;
  }
  segment.kept = segment.lines.size();
  segment.passed_over = lines.number() - 1 - segment.kept;
  segment.lines.push_back(to_utf8(first_line, head.encoding));
  std::string_view line;
  while (segment.lines.size() < segment.kept + longest_segment_heading && lines.next(line)) {
    segment.lines.push_back(to_utf8(line, head.encoding));
    if (line.starts_with(labview_names)) break;
  }
  return segment;
}

std::vector<TextLayout> labview_segments(const RecordFile& file, const TextHead& head, TextLayout first) {
  std::vector<TextLayout> segments{std::move(first)};
  TextLines lines(file);
  std::string_view line;
  while (lines.next(line)) {
    if (lines.number() < segments.back().first_line || !line.starts_with(labview_segment)) continue;
    segments.back().last_line = lines.number() - 1;
    segments.push_back(*labview_layout(segment_head(head, lines, line)));
    segments.back().begin = lines.place();
  }
  for (std::size_t k = 0; segments.size() > 1 && k < segments.size(); ++k)
    segments[k].format += fmt::format(", segment {} of {}", k + 1, segments.size());
  return segments;
}

}  // namespace

std::vector<TextLayout> text_layouts(const RecordFile& file, TextDialect dialect, const TextOptions& options) {
  auto [head, layout] = first_layout(file, dialect, options);
  if (layout.format.starts_with("LabVIEW")) return labview_segments(file, head, std::move(layout));
  return {std::move(layout)};
}

}  // namespace impulse
