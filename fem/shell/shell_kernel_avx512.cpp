#define IMPULSE_SHELL_KERNEL shell_kernel_avx512
#define IMPULSE_SHELL_REGISTER 64
#include "fem/shell/shell_kernel_body.hpp"
