#include "lib/transform/causal_convolution.hpp"

#include "tests/support/direct_sums.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("causal_convolution: the history is the direct sum, at every sample, whatever the length") {
  for (std::size_t size : {1u, 2u, 127u, 128u, 129u, 1000u, 2049u}) {
    CAPTURE(size);
    const std::vector<double> w = direct::random_values(size, 3);
    const std::vector<double> x = direct::random_values(size, 4);
    CausalConvolution past(w);
    double largest = 0;
    for (std::size_t n = 0; n < size; ++n) {
      double expected = 0;
      for (std::size_t k = 0; k < n; ++k) expected += w[n - k] * x[k];
      largest = std::max(largest, std::abs(past.history() - expected));
      past.push(x[n]);
    }
    CHECK(largest < 1e-13 * std::sqrt(static_cast<double>(size)));
    CHECK(past.count() == size);
  }
}
