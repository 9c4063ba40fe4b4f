#pragma once

#include <gsl/gsl_errno.h>

namespace impulse {

/// GSL's default handler aborts the process; its wrappers look at the statuses instead. Once, because the handler is
/// process-wide.
inline void use_gsl_statuses() { [[maybe_unused]] static const bool once = (gsl_set_error_handler_off(), true); }

}  // namespace impulse
