#include "impulse/contact/force_history.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <utility>

namespace impulse {

ConvolutionHistory::ConvolutionHistory(std::vector<std::vector<double>> weights, std::size_t contact_count)
    : count_(contact_count), weights_(std::move(weights)) {
  require(weights_.size() == count_ * count_, "{} contacts need {} kernels, not {}", count_, count_ * count_,
          weights_.size());
  for (const std::vector<double>& w : weights_) {
    require(!w.empty() && w.size() == weights_.front().size(), "kernels of {} and {} weights", w.size(),
            weights_.front().size());
    const bool vanishes = std::ranges::all_of(w, [](double value) { return value == 0; });
    pairs_.push_back(vanishes ? nullptr : std::make_unique<CausalConvolution>(w));
  }
}

double ConvolutionHistory::past(std::size_t i) const {
  double sum = 0;
  for (std::size_t j = 0; j < count_; ++j)
    if (pairs_[i * count_ + j]) sum += pairs_[i * count_ + j]->history();
  return sum;
}

void ConvolutionHistory::push(std::span<const double> forces) {
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = 0; j < count_; ++j)
      if (pairs_[i * count_ + j]) pairs_[i * count_ + j]->push(forces[j]);
}

}  // namespace impulse
