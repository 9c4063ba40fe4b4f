#include "lib/transform/real_fft.hpp"

#include "tests/support/direct_sums.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("real_fft: sign and normalisation are those of the definition") {
  for (std::size_t n : {1u, 2u, 5u, 12u, 64u, 90u}) {
    CAPTURE(n);
    const std::vector<double> x = direct::random_values(n, 7);
    const auto expected = direct::transform(x);
    const RealFft fft(n);
    RealBuffer time(x.begin(), x.end());
    ComplexBuffer spectrum(fft.spectrum_size());
    fft.forward(time, spectrum);
    for (std::size_t k = 0; k < spectrum.size(); ++k)
      CHECK(std::abs(spectrum[k] - expected[k]) < 1e-13 * static_cast<double>(n));
    RealBuffer back(n);
    fft.inverse(spectrum, back);
    for (std::size_t j = 0; j < n; ++j) CHECK(std::abs(back[j] - x[j]) < 1e-14);
  }
}

TEST_CASE("real_fft: fast lengths are the smallest even 5-smooth ones") {
  CHECK(fast_transform_size(1) == 2);
  CHECK(fast_transform_size(7) == 8);
  CHECK(fast_transform_size(11) == 12);
  CHECK(fast_transform_size(1025) == 1080);
  CHECK(fast_transform_size(4096) == 4096);
}

TEST_CASE("real_fft: convolution equals the direct sum") {
  const std::vector<double> a = direct::random_values(301, 1);
  const std::vector<double> b = direct::random_values(301, 2);
  CHECK(direct::largest_difference(convolution(a, b, 301), direct::convolution(a, b)) < 1e-13);
}

TEST_CASE("real_fft: refuses impossible lengths and short buffers") {
  CHECK_THROWS_WITH_AS(RealFft(0), doctest::Contains("outside 1 .. 2^30"), std::invalid_argument);
  const RealFft fft(8);
  RealBuffer time(4);
  ComplexBuffer spectrum(5);
  CHECK_THROWS_WITH_AS(fft.forward(time, spectrum), doctest::Contains("needs buffers of 8"), std::invalid_argument);
}
