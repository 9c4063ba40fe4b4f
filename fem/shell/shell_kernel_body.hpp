// The kernel of shell_kernel.hpp, compiled once for each instruction set: the including file defines
// IMPULSE_SHELL_KERNEL, the function's name, and IMPULSE_SHELL_REGISTER, the bytes of a vector register. Everything
// else has internal linkage and no library function is called, so that no code for a better processor can be linked
// into the rest of the program.

#include "fem/shell/hermite.hpp"
#include "fem/shell/shell_kernel.hpp"

namespace impulse {
namespace {

using Lane = double __attribute__((vector_size(IMPULSE_SHELL_REGISTER)));

/// Registers that the lanes fill: they are done one after the other, every `parts`-th of an array's vectors.
constexpr std::size_t parts = 8 * shell_lanes / IMPULSE_SHELL_REGISTER;

constexpr CubicHermite basis[4] = {cubic_hermite(gauss_point[0]), cubic_hermite(gauss_point[1]),
                                   cubic_hermite(gauss_point[2]), cubic_hermite(gauss_point[3])};

/// Derivatives of the displacement at a point, or what is conjugate to them; [component].
struct Derivatives {
  Lane d1[3], d2[3], d11[3], d12[3], d22[3];
};

/// Sums along t1 of one column of Gauss points: [component][function of t2], by order of the derivative by t1.
struct Column {
  Lane value[3][4], first[3][4], second[3][4];
};

inline __attribute__((always_inline)) Lane dot(const Lane* a, const Lane* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Turns derivatives into the forces conjugate to them; returns the energy.
inline __attribute__((always_inline)) Lane forces_at_point(const Lane* geometry, Derivatives& u) {
  Lane g[shell_point_numbers];
#pragma GCC unroll 36
  for (std::size_t k = 0; k < shell_point_numbers; ++k) g[k] = geometry[parts * k];
  const Lane *a1 = g, *a2 = g + 3, *n = g + 6, *gamma1 = g + 9, *gamma2 = g + 12, *c = g + 15;
  Lane x1[3], x2[3], half1[3], half2[3];
  for (int k = 0; k < 3; ++k) {
    x1[k] = a1[k] + u.d1[k];
    x2[k] = a2[k] + u.d2[k];
    half1[k] = a1[k] + 0.5 * u.d1[k];
    half2[k] = a2[k] + 0.5 * u.d2[k];
  }
  const Lane n1 = dot(n, u.d1), n2 = dot(n, u.d2);
  const Lane e[6] = {dot(half1, u.d1),
                     dot(half2, u.d2),
                     dot(a1, u.d2) + dot(x2, u.d1),
                     gamma1[0] * n1 + gamma2[0] * n2 - dot(n, u.d11),
                     gamma1[1] * n1 + gamma2[1] * n2 - dot(n, u.d22),
                     gamma1[2] * n1 + gamma2[2] * n2 - 2.0 * dot(n, u.d12)};
  Lane s[6] = {};
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) s[i] += c[i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i] * e[j];
  }
  Lane energy = s[0] * e[0];
  for (int i = 1; i < 6; ++i) energy += s[i] * e[i];
  const Lane m1 = s[3] * gamma1[0] + s[4] * gamma1[1] + s[5] * gamma1[2];
  const Lane m2 = s[3] * gamma2[0] + s[4] * gamma2[1] + s[5] * gamma2[2];
  for (int k = 0; k < 3; ++k) {
    u.d1[k] = s[0] * x1[k] + s[2] * x2[k] + m1 * n[k];
    u.d2[k] = s[1] * x2[k] + s[2] * x1[k] + m2 * n[k];
    u.d11[k] = -s[3] * n[k];
    u.d22[k] = -s[4] * n[k];
    u.d12[k] = -2.0 * s[5] * n[k];
  }
  return 0.5 * energy;
}

inline __attribute__((always_inline)) void contract_column(const Lane* q, int i, Column& column) {
  const CubicHermite& h = basis[i];
  for (int c = 0; c < 3; ++c)
#pragma GCC unroll 4
    for (int b = 0; b < 4; ++b) {
      const Lane* p = q + 16 * c + 4 * b;
      column.value[c][b] = h.value[0] * p[0] + h.value[1] * p[1] + h.value[2] * p[2] + h.value[3] * p[3];
      column.first[c][b] = h.first[0] * p[0] + h.first[1] * p[1] + h.first[2] * p[2] + h.first[3] * p[3];
      column.second[c][b] = h.second[0] * p[0] + h.second[1] * p[1] + h.second[2] * p[2] + h.second[3] * p[3];
    }
}

inline __attribute__((always_inline)) void evaluate(const Column& column, int j, Derivatives& u) {
  const CubicHermite& h = basis[j];
  for (int c = 0; c < 3; ++c) {
    const Lane *v = column.value[c], *f = column.first[c], *s = column.second[c];
    u.d1[c] = h.value[0] * f[0] + h.value[1] * f[1] + h.value[2] * f[2] + h.value[3] * f[3];
    u.d2[c] = h.first[0] * v[0] + h.first[1] * v[1] + h.first[2] * v[2] + h.first[3] * v[3];
    u.d11[c] = h.value[0] * s[0] + h.value[1] * s[1] + h.value[2] * s[2] + h.value[3] * s[3];
    u.d12[c] = h.first[0] * f[0] + h.first[1] * f[1] + h.first[2] * f[2] + h.first[3] * f[3];
    u.d22[c] = h.second[0] * v[0] + h.second[1] * v[1] + h.second[2] * v[2] + h.second[3] * v[3];
  }
}

/// The transposed of `evaluate`.
inline __attribute__((always_inline)) void collect(const Derivatives& f, int j, Column& column) {
  const CubicHermite& h = basis[j];
  for (int c = 0; c < 3; ++c)
#pragma GCC unroll 4
    for (int b = 0; b < 4; ++b) {
      column.value[c][b] += h.first[b] * f.d2[c] + h.second[b] * f.d22[c];
      column.first[c][b] += h.value[b] * f.d1[c] + h.first[b] * f.d12[c];
      column.second[c][b] += h.value[b] * f.d11[c];
    }
}

/// The transposed of `contract_column`.
inline __attribute__((always_inline)) void expand_column(const Column& column, int i, Lane* forces) {
  const CubicHermite& h = basis[i];
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 4; ++b)
#pragma GCC unroll 4
      for (int a = 0; a < 4; ++a)
        forces[16 * c + 4 * b + a] +=
            h.value[a] * column.value[c][b] + h.first[a] * column.first[c][b] + h.second[a] * column.second[c][b];
}

}  // namespace

double IMPULSE_SHELL_KERNEL(const double* geometry, const double* coefficients, double* forces) {
  double sum = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    const auto* g = reinterpret_cast<const Lane*>(geometry) + part;
    const auto* q = reinterpret_cast<const Lane*>(coefficients) + part;
    auto* f = reinterpret_cast<Lane*>(forces) + part;
    Lane energy{};
    Lane own_q[shell_coefficients], own_f[shell_coefficients] = {};
    for (std::size_t k = 0; k < shell_coefficients; ++k) own_q[k] = q[parts * k];
    for (int i = 0; i < 4; ++i) {
      Column displacement, force{};
      contract_column(own_q, i, displacement);
      for (int j = 0; j < 4; ++j) {
        Derivatives at_point;
        evaluate(displacement, j, at_point);
        const std::size_t point = static_cast<std::size_t>(4 * j + i);
        energy += forces_at_point(g + parts * shell_point_numbers * point, at_point);
        collect(at_point, j, force);
      }
      expand_column(force, i, own_f);
    }
    for (std::size_t k = 0; k < shell_coefficients; ++k) f[parts * k] = own_f[k];
    for (std::size_t l = 0; l < shell_lanes / parts; ++l) sum += energy[l];
  }
  return sum;
}

}  // namespace impulse
