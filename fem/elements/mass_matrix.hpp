#pragma once

namespace impulse {

/// `consistent`: exact integral of the interpolation. `lumped`: what explicit integration takes, a diagonal.
enum class MassMatrix { lumped, consistent };

}  // namespace impulse
