#define IMPULSE_SHELL_KERNEL shell_kernel_baseline
#define IMPULSE_SHELL_REGISTER 16
#include "fem/shell/shell_kernel_body.hpp"
