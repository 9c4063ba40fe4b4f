#include "lib/transform/real_fft.hpp"

#include "lib/contract/require.hpp"
#include "lib/transform/spectrum_product.hpp"

#include <fftw3.h>

#include <algorithm>
#include <mutex>
#include <new>

namespace impulse {

template <class T>
T* FftAllocator<T>::allocate(std::size_t count) {
  void* memory = fftw_malloc(count * sizeof(T));
  if (memory == nullptr) throw std::bad_alloc();
  return static_cast<T*>(memory);
}
template <class T>
void FftAllocator<T>::deallocate(T* memory, std::size_t) noexcept {
  fftw_free(memory);
}
template struct FftAllocator<double>;
template struct FftAllocator<std::complex<double>>;

namespace {

/// FFTW executes plans from several threads, but makes and destroys them from one at a time.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

fftw_complex* fftw_pointer(std::complex<double>* data) { return reinterpret_cast<fftw_complex*>(data); }

}  // namespace

struct RealFft::Plans {
  fftw_plan forward = nullptr;
  fftw_plan inverse = nullptr;

  Plans(std::size_t size, unsigned flags) {
    RealBuffer time(size);
    ComplexBuffer spectrum(size / 2 + 1);
    const int n = static_cast<int>(size);
    const std::lock_guard lock(planner());
    forward = fftw_plan_dft_r2c_1d(n, time.data(), fftw_pointer(spectrum.data()), flags);
    inverse = fftw_plan_dft_c2r_1d(n, fftw_pointer(spectrum.data()), time.data(), flags);
    if (forward == nullptr || inverse == nullptr) {
      destroy();
      throw std::runtime_error(fmt::format("FFTW has no plan for a real transform of length {}", size));
    }
  }
  ~Plans() {
    const std::lock_guard lock(planner());
    destroy();
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;

 private:
  void destroy() {
    if (forward != nullptr) fftw_destroy_plan(forward);
    if (inverse != nullptr) fftw_destroy_plan(inverse);
  }
};

RealFft::RealFft(std::size_t size, Planning planning) : size_(size) {
  require(size >= 1 && size <= (std::size_t{1} << 30), "transform length {} is outside 1 .. 2^30", size);
  const unsigned flags = planning == Planning::measure ? FFTW_MEASURE : FFTW_ESTIMATE;
  plans_ = std::make_shared<const Plans>(size, flags);
}

void RealFft::forward(const RealBuffer& time, ComplexBuffer& spectrum) const {
  require(time.size() >= size_ && spectrum.size() >= spectrum_size(),
          "transform of length {} needs buffers of {} and {}", size_, size_, spectrum_size());
  // FFTW's r2c leaves its input alone (out of place, 1-D), but takes it as non-const.
  fftw_execute_dft_r2c(plans_->forward, const_cast<double*>(time.data()), fftw_pointer(spectrum.data()));
}

void RealFft::inverse_sum(ComplexBuffer& spectrum, RealBuffer& time) const {
  require(time.size() >= size_ && spectrum.size() >= spectrum_size(),
          "transform of length {} needs buffers of {} and {}", size_, size_, spectrum_size());
  fftw_execute_dft_c2r(plans_->inverse, fftw_pointer(spectrum.data()), time.data());
}

void RealFft::inverse(ComplexBuffer& spectrum, RealBuffer& time) const {
  inverse_sum(spectrum, time);
  const double scale = 1.0 / static_cast<double>(size_);
  for (std::size_t j = 0; j < size_; ++j) time[j] *= scale;
}

std::size_t fast_transform_size(std::size_t size) {
  std::size_t best = 2;
  while (best < size) best *= 2;
  for (std::size_t fives = 1; fives < best; fives *= 5)
    for (std::size_t odd = fives; odd < best; odd *= 3) {
      std::size_t candidate = 2 * odd;
      while (candidate < size) candidate *= 2;
      best = std::min(best, candidate);
    }
  return best;
}

std::vector<double> convolution(std::span<const double> a, std::span<const double> b, std::size_t count) {
  a = a.first(std::min(a.size(), count));
  b = b.first(std::min(b.size(), count));
  if (a.empty() || b.empty()) return std::vector<double>(count, 0.0);
  const RealFft fft(fast_transform_size(a.size() + b.size()));
  RealBuffer time(fft.size(), 0.0);
  ComplexBuffer spectrum_a(fft.spectrum_size());
  ComplexBuffer spectrum_b(fft.spectrum_size());
  std::ranges::copy(a, time.begin());
  fft.forward(time, spectrum_a);
  std::ranges::fill(time, 0.0);
  std::ranges::copy(b, time.begin());
  fft.forward(time, spectrum_b);
  multiply(spectrum_a, spectrum_b);
  fft.inverse(spectrum_a, time);
  std::vector<double> result(count, 0.0);
  std::copy_n(time.begin(), std::min(count, time.size()), result.begin());
  return result;
}

}  // namespace impulse
