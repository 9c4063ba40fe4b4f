#include "lib/law/resolved_law.hpp"

#include "lib/contract/require.hpp"

namespace impulse {

void require_resolved_law(double stiffness_ratio, std::size_t contact, double step_s) {
  require(stiffness_ratio <= 2,
          "contact {}: a step of {:.4g} s is too long for its law, which is so stiff that the force would alternate "
          "from step to step; use a step of {:.2g} s, or --law rigid",
          contact, step_s, step_s / stiffness_ratio);
}

}  // namespace impulse
