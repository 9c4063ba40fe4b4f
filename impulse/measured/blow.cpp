#include "impulse/measured/blow.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace impulse {
namespace {

using Size = std::ptrdiff_t;

/// Standard deviation of normal noise from the median deviation, which a short pulse does not move.
double noise_level(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<Size>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = *middle;
  for (double& value : values) value = std::abs(value - median);
  std::nth_element(values.begin(), middle, values.end());
  return 1.4826 * *middle;
}

/// A plateau that lasts to the end of the record is a body that coasts.
bool clipped_at(const std::vector<double>& values, double extreme) {
  std::size_t run = 0;
  for (double value : values) {
    if (value == extreme)
      ++run;
    else if (run >= 3)
      return true;
    else
      run = 0;
  }
  return false;
}

bool clipped(const std::vector<double>& values) {
  const auto [least, largest] = std::ranges::minmax(values);
  // A rest at exactly zero is no clipping.
  return (largest > 0 && clipped_at(values, largest)) || (least < 0 && clipped_at(values, least));
}

bool exceeds(std::span<const double> force, double level) {
  return std::ranges::any_of(force, [&](double value) { return value > level; });
}

}  // namespace

std::string description(BlowFault fault) {
  switch (fault) {
    case BlowFault::none:
      return "no fault";
    case BlowFault::no_pulse:
      return "its force has no pulse";
    case BlowFault::clipped_force:
      return "its force is clipped";
    case BlowFault::clipped_response:
      return "its response is clipped";
    case BlowFault::second_hit:
      return "it hits twice";
  }
  return "";
}

BlowWindow examined_blow(const Blow& blow, double step_s, const BlowOptions& options) {
  for (double fraction : {options.trigger, options.second_hit})
    require(fraction > 0 && fraction < 1, "{} is not a fraction of the peak force between 0 and 1", fraction);
  const std::vector<double>& force = blow.force_N;
  require(force.size() == blow.response.size() && force.size() >= 2, "{}: {} samples of force and {} of response",
          blow.name, force.size(), blow.response.size());
  const auto peak = std::ranges::max_element(force);
  const double noise = noise_level(force);
  if (*peak <= 0 || *peak < 6 * noise) return {BlowFault::no_pulse, 0, 0};

  const double level = std::max(options.trigger * *peak, std::min(5 * noise, 0.5 * *peak));
  const auto at_peak = peak - force.begin();
  Size first = at_peak;
  while (first > 0 && force[static_cast<std::size_t>(first)] > level) --first;
  Size last = at_peak;
  const auto size = static_cast<Size>(force.size());
  while (last < size && force[static_cast<std::size_t>(last)] > level) ++last;
  const Size margin = std::max<Size>(2, (last - first) / 2);
  BlowWindow window{BlowFault::none, static_cast<std::size_t>(std::max<Size>(0, first - margin)),
                    static_cast<std::size_t>(std::min(size, last + margin))};
  if (options.force_window_s)
    window.force_end =
        std::min(force.size(), static_cast<std::size_t>(first) + 1 +
                                   static_cast<std::size_t>(std::lround(*options.force_window_s / step_s)));
  const double second = std::max(options.second_hit * *peak, 6 * noise);
  const std::span<const double> all(force);
  if (clipped(force))
    window.fault = BlowFault::clipped_force;
  else if (clipped(blow.response))
    window.fault = BlowFault::clipped_response;
  else if (exceeds(all.first(window.begin), second) || exceeds(all.subspan(window.force_end), second))
    window.fault = BlowFault::second_hit;
  return window;
}

Blow windowed(const Blow& blow, const BlowWindow& window, std::size_t size) {
  require(window.begin + size <= blow.force_N.size(), "{}: {} samples from sample {} are asked of {}", blow.name, size,
          window.begin, blow.force_N.size());
  const auto part = [&](const std::vector<double>& values) {
    const auto begin = values.begin() + static_cast<Size>(window.begin);
    return std::vector<double>(begin, begin + static_cast<Size>(size));
  };
  Blow result{blow.name, part(blow.force_N), part(blow.response)};
  const std::size_t length = std::min(size, window.force_end - window.begin);
  std::fill(result.force_N.begin() + static_cast<Size>(length), result.force_N.end(), 0.0);
  return result;
}

void remove_offset(std::vector<double>& values, std::size_t count) {
  require(count > 0 && count <= values.size(), "the mean of {} of {} samples cannot be taken", count, values.size());
  const double mean =
      std::accumulate(values.begin(), values.begin() + static_cast<Size>(count), 0.0) / static_cast<double>(count);
  for (double& value : values) value -= mean;
}

void remove_drift(std::vector<double>& velocity, double final_mean_m_per_s) {
  const std::size_t tail = velocity.size() / 10;
  require(tail > 0, "a record of {} samples is too short for its drift to be seen", velocity.size());
  const double mean =
      std::accumulate(velocity.end() - static_cast<Size>(tail), velocity.end(), 0.0) / static_cast<double>(tail);
  const double at = static_cast<double>(velocity.size()) - 0.5 * static_cast<double>(tail + 1);
  const double slope = (mean - final_mean_m_per_s) / at;
  for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] -= slope * static_cast<double>(n);
}

}  // namespace impulse
