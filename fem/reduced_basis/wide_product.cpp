#include "fem/reduced_basis/wide_product.hpp"

namespace impulse {
namespace {

// Clones of plain loops, which the compiler vectorises in each; four columns at a time, so that y stays in registers.
#if defined(__x86_64__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
void add_columns(const double* a, const double* x, double* y, long rows, long columns) {
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
