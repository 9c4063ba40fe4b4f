#include "lib/material/layup.hpp"

#include "lib/contract/require.hpp"
#include "lib/csv/decimal.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

namespace impulse {
namespace {

constexpr std::size_t most_plies = 100'000;

using Angles = std::vector<double>;

/// Recursive descent over the text; every refusal names the column.
class LayupReader {
 public:
  explicit LayupReader(std::string_view text) : text_(text) {}

  Angles read() {
    skip_blanks();
    if (!text_.substr(at_).starts_with('[')) refuse("expected '['; a layup reads [0/90]s");
    Angles angles = item().angles;
    if (at_ < text_.size())
      refuse(fmt::format("unexpected '{}' after the layup; s, T or a count may follow ']'", next_character()));
    return angles;
  }

 private:
  struct Item {
    Angles angles;
    bool barred = false;
  };

  /// Columns are those of characters, not bytes: ± takes two of these.
  [[noreturn]] void refuse(const std::string& problem) const {
    const auto is_start = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    const auto column = 1 + std::ranges::count_if(text_.substr(0, at_), is_start);
    throw std::invalid_argument(fmt::format("layup '{}': column {}: {}", text_, column, problem));
  }

  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }

  [[nodiscard]] std::string_view next_character() const {
    std::size_t length = 1;
    while (at_ + length < text_.size() && (static_cast<unsigned char>(text_[at_ + length]) & 0xC0) == 0x80) ++length;
    return text_.substr(at_, length);
  }

  bool take(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    skip_blanks();
    return true;
  }

  Item item() {
    if (depth_ > 50) refuse("groups are nested too deeply");
    if (take("[")) return group("]");
    if (take("(")) return group(")");
    return ply();
  }

  Item group(std::string_view closing) {
    ++depth_;
    Angles angles;
    bool barred = false;
    do {
      if (barred) refuse("a barred ply is the middle one, so it must be the last of its group");
      const Item part = item();
      barred = part.barred;
      angles.insert(angles.end(), part.angles.begin(), part.angles.end());
      require_size(angles.size());
    } while (take("/"));
    if (!take(closing))
      refuse(at_ < text_.size() ? fmt::format("expected '/' or '{}', not '{}'", closing, next_character())
                                : fmt::format("the closing '{}' is missing", closing));
    --depth_;
    return {with_suffix(std::move(angles), barred)};
  }

  Angles with_suffix(Angles angles, bool barred) {
    const bool subscript = take("_");
    const bool counted = at_digit();
    if (subscript && !counted && !at_letter()) refuse("expected a count, s or T after '_'");
    if (barred && counted) refuse("a group with a barred ply is not repeated");
    if (counted) angles = repeated(angles, count());
    if (take("s") || take("S")) {
      require_size(2 * angles.size());
      const std::size_t mirrored = angles.size() - (barred ? 1 : 0);
      for (std::size_t i = mirrored; i-- > 0;) angles.push_back(angles[i]);
    } else if (barred) {
      refuse("a barred ply is the middle one of a symmetric group; write ]s");
    } else if (!take("T")) {
      take("t");
    }
    return angles;
  }

  Item ply() {
    static constexpr std::array<std::pair<std::string_view, std::array<double, 2>>, 6> signs{
        {{"±", {1, -1}}, {"∓", {-1, 1}}, {"+-", {1, -1}}, {"-+", {-1, 1}}, {"+", {1, 0}}, {"-", {-1, 0}}}};
    std::array<double, 2> sign{1, 0};
    for (const auto& [token, value] : signs)
      if (take(token)) {
        sign = value;
        break;
      }
    if (at_ == text_.size()) refuse("the layup ends where an angle is expected");
    const Decimal number = at_digit() || text_[at_] == '.' ? leading_decimal(text_.substr(at_)) : Decimal{};
    if (number.length == 0) refuse(fmt::format("expected an angle in degrees, not '{}'", next_character()));
    if (!(number.value <= 360)) refuse(fmt::format("the angle {} is beyond 360 degrees", number.value));
    at_ += number.length;
    Item item{{sign[0] * number.value}, take("\u0304") || take("\u0305")};
    skip_blanks();
    if (sign[1] != 0) item.angles.push_back(sign[1] * number.value);
    if (item.barred && item.angles.size() > 1) refuse("a pair of plies cannot be the middle ply");
    if (take("_")) {
      if (!at_digit()) refuse("expected a count after '_'");
      if (item.barred) refuse("the middle ply is one; leave its count out");
      item.angles = repeated(item.angles, count());
    }
    return item;
  }

  [[nodiscard]] bool at_digit() const {
    return at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]));
  }
  [[nodiscard]] bool at_letter() const {
    return at_ < text_.size() && std::string_view("sStT").find(text_[at_]) != std::string_view::npos;
  }

  std::size_t count() {
    std::size_t value = 0;
    const std::size_t start = at_;
    for (; at_digit(); ++at_) value = std::min(most_plies + 1, 10 * value + static_cast<std::size_t>(text_[at_] - '0'));
    if (value == 0 || value > most_plies) {
      at_ = start;
      refuse(value == 0 ? "a count is at least 1" : fmt::format("more than {} plies", most_plies));
    }
    skip_blanks();
    return value;
  }

  Angles repeated(const Angles& angles, std::size_t times) {
    require_size(times * angles.size());
    Angles result;
    result.reserve(times * angles.size());
    for (std::size_t i = 0; i < times; ++i) result.insert(result.end(), angles.begin(), angles.end());
    return result;
  }

  void require_size(std::size_t size) const {
    if (size > most_plies) refuse(fmt::format("more than {} plies", most_plies));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::vector<double> parse_layup(std::string_view text) { return LayupReader(text).read(); }

}  // namespace impulse
