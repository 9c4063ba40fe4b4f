#include "lib/law/resolved_law.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

namespace impulse {

TEST_CASE("require_resolved_law: twice the stiffness of the bodies within a step, and no more") {
  CHECK_NOTHROW(require_resolved_law(2, 1, 1e-6));
  CHECK_THROWS_WITH_AS(require_resolved_law(2.5, 3, 1e-6),
                       "contact 3: a step of 1e-06 s is too long for its law, which is so stiff that the force would "
                       "alternate from step to step; use a step of 4e-07 s, or --law rigid",
                       std::invalid_argument);
}

}  // namespace impulse
