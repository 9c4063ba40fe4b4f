#pragma once

extern "C" void openblas_set_num_threads(int);

namespace impulse {

/// One BLAS thread for the whole process, from the first call on. How OpenBLAS splits a sum depends on the threads it
/// gets, so with several the last bits change between runs; and for the sizes of bodies (n ≲ 2000) the threads cost
/// more than they bring. Programs get their parallelism from running several of them. Declared here because <cblas.h>
/// may be another BLAS's.
inline void use_one_blas_thread() { [[maybe_unused]] static const bool once = (openblas_set_num_threads(1), true); }

}  // namespace impulse
