#include "fem/reduced_basis/wide_product.hpp"

#include <cstring>

namespace impulse {
namespace {

using Four = double __attribute__((vector_size(32)));

[[gnu::always_inline]] inline void add_scaled(const double* column, double x, Four& sum) {
  Four values;
  std::memcpy(&values, column, sizeof values);
  sum += values * x;
}

/// 4·Blocks rows: y and four sums for it stay in registers over all columns.
template <int Blocks>
[[gnu::always_inline]] inline void add_few_rows(const double* a, const double* x, double* y, long columns) {
  constexpr long rows = 4 * Blocks;
  Four sum[4][Blocks] = {};
  long j = 0;
  for (; j + 4 <= columns; j += 4)
    for (int k = 0; k < 4; ++k)
      for (int b = 0; b < Blocks; ++b) add_scaled(a + (j + k) * rows + 4 * b, x[j + k], sum[k][b]);
  for (; j < columns; ++j)
    for (int b = 0; b < Blocks; ++b) add_scaled(a + j * rows + 4 * b, x[j], sum[0][b]);
  for (int b = 0; b < Blocks; ++b) {
    Four all = (sum[0][b] + sum[1][b]) + (sum[2][b] + sum[3][b]);
    add_scaled(y + 4 * b, 1, all);
    std::memcpy(y + 4 * b, &all, sizeof all);
  }
}

// Clones of plain loops, which the compiler vectorises in each; four columns at a time, so that y stays in registers.
#if defined(__x86_64__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
void add_columns(const double* a, const double* x, double* y, long rows, long columns) {
  if (rows == 12) return add_few_rows<3>(a, x, y, columns);
  if (rows == 8) return add_few_rows<2>(a, x, y, columns);
  long j = 0;
  for (; j + 4 <= columns; j += 4) {
    const double* c = a + j * rows;
    const double x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
#pragma GCC ivdep
    for (long i = 0; i < rows; ++i)
      y[i] = (((y[i] + c[i] * x0) + c[rows + i] * x1) + c[2 * rows + i] * x2) + c[3 * rows + i] * x3;
  }
  for (; j < columns; ++j)
#pragma GCC ivdep
    for (long i = 0; i < rows; ++i) y[i] += a[j * rows + i] * x[j];
}

}  // namespace

void add_product(const Eigen::MatrixXd& a, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> y) {
  add_columns(a.data(), x.data(), y.data(), a.rows(), a.cols());
}

}  // namespace impulse
