#include "lib/records/even_time.hpp"

#include "lib/csv/decimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace impulse {
namespace {

// Values rounded to any lattice have far fewer corners; those of a bent curve need not be kept.
constexpr std::size_t most_corners = 20000;

struct Rounded {
  double value;
  int digits;
};

Rounded fewest_digits(double least, double most) {
  if (least <= 0 && most >= 0) return {0, 0};
  const double middle = least + (most - least) / 2;
  for (int digits = 1; digits < 17; ++digits) {
    const double value = leading_decimal(fmt::format("{:.{}e}", middle, digits - 1)).value;
    if (value >= least && value <= most) return {value, digits};
  }
  return {middle, 17};
}

}  // namespace

double roundest(double least, double most) { return fewest_digits(least, most).value; }

double printed_half_digit(std::string_view decimal) {
  int decimals = 0, exponent = 0;
  bool after_point = false;
  std::size_t i = 0;
  for (; i < decimal.size(); ++i) {
    const char c = decimal[i];
    if (c >= '0' && c <= '9') {
      decimals += after_point ? 1 : 0;
    } else if (c == '.' || c == ',') {
      after_point = true;
    } else if (c == 'e' || c == 'E') {
      break;
    }
  }
  bool negative = false;
  for (++i; i < decimal.size(); ++i) {
    if (decimal[i] == '-') negative = true;
    if (decimal[i] >= '0' && decimal[i] <= '9') exponent = std::min(exponent * 10 + (decimal[i] - '0'), 1000);
  }
  static const std::vector<double> powers = [] {
    std::vector<double> list;
    for (int p = -330; p <= 330; ++p) list.push_back(0.5 * std::pow(10.0, p));
    return list;
  }();
  return powers[static_cast<std::size_t>(std::clamp((negative ? -exponent : exponent) - decimals, -330, 330) + 330)];
}

void PrintedDigits::add(std::string_view decimal) {
  const std::size_t exponent = decimal.find_first_of("eE");
  const std::string_view mantissa = decimal.substr(0, exponent);
  const std::size_t length = mantissa.size() - (mantissa.starts_with('-') || mantissa.starts_with('+') ? 1 : 0);
  if (exponent == decimal.npos || (mantissa_ > 0 && length != mantissa_)) same_mantissa_ = false;
  mantissa_ = length;
  finest_ = std::min(finest_, printed_half_digit(decimal));
}

double PrintedDigits::half_digit(std::string_view decimal) const {
  const double own = printed_half_digit(decimal);
  return same_mantissa_ ? own : std::min(own, finest_);
}

void EvenTimeFit::add(double value, double half_width) {
  const double index = static_cast<double>(size_);
  if (size_++ == 0) first_ = value;
  last_ = value;
  if (hopeless_) return;
  // a·b is rounded, and so was the sum that made the value: a few units in the last place are no evidence.
  const double width = half_width + 1e-15 * std::abs(value);
  const auto push = [&](std::vector<Corner>& hull, double end, double side) {
    while (hull.size() > 1) {
      const Corner &a = hull[hull.size() - 2], &b = hull.back();
      const double bend = (b.value - a.value) * (index - b.index) - (end - b.value) * (b.index - a.index);
      if (side * bend < 0) break;
      hull.pop_back();
    }
    hull.push_back({index, end});
  };
  push(upper_, value + width, 1);
  push(lower_, value - width, -1);
  hopeless_ = upper_.size() > most_corners || lower_.size() > most_corners;
}

double EvenTimeFit::upper_start(double step) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Corner& corner : upper_) least = std::min(least, corner.value - step * corner.index);
  return least;
}

double EvenTimeFit::lower_start(double step) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Corner& corner : lower_) most = std::max(most, corner.value - step * corner.index);
  return most;
}

std::optional<EvenTime> EvenTimeFit::fit() const {
  if (size_ < 2 || hopeless_) return std::nullopt;
  const double mean = (last_ - first_) / static_cast<double>(size_ - 1);
  if (!(mean > 0) || !std::isfinite(mean)) return std::nullopt;
  double low = 0, high = 2 * mean;
  double best = mean;
  if (gap(best) < 0) {
    double a = low, b = high;
    for (int i = 0; i < 200 && gap(best) < 0; ++i) {
      const double c = a + (b - a) / 3, d = b - (b - a) / 3;
      (gap(c) < gap(d) ? a : b) = gap(c) < gap(d) ? c : d;
      best = a + (b - a) / 2;
    }
    if (gap(best) < 0) return std::nullopt;
  }
  const auto edge = [&](double outside) {
    double inside = best;
    for (int i = 0; i < 100; ++i) {
      const double middle = inside + (outside - inside) / 2;
      (gap(middle) >= 0 ? inside : outside) = middle;
    }
    return inside;
  };
  const double least = edge(low), most = edge(high);
  const Rounded step = fewest_digits(least, most);
  const Rounded rate = least > 0 ? fewest_digits(1 / most, 1 / least) : Rounded{0, 99};
  const double of_rate = rate.value > 0 ? 1 / rate.value : 0;
  double chosen = rate.digits < step.digits && gap(of_rate) >= 0 ? of_rate : step.value;
  if (!(chosen > 0) || gap(chosen) < 0) chosen = best;
  return EvenTime{roundest(lower_start(chosen), upper_start(chosen)), chosen, least, most};
}

}  // namespace impulse
