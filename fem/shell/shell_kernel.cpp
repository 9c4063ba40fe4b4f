#include "fem/shell/shell_kernel.hpp"

namespace impulse {

ShellKernel fastest_shell_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return shell_kernel_avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return shell_kernel_avx2;
#endif
  return shell_kernel_baseline;
}

}  // namespace impulse
