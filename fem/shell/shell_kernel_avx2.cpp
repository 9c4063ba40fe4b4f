#define IMPULSE_SHELL_KERNEL shell_kernel_avx2
#define IMPULSE_SHELL_REGISTER 32
#include "fem/shell/shell_kernel_body.hpp"
