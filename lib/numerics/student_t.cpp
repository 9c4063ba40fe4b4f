#include "lib/numerics/student_t.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/gsl_status.hpp"

#include <gsl/gsl_cdf.h>

namespace impulse {

double student_t_quantile(double p, double degrees_of_freedom) {
  require(p > 0 && p < 1, "{} is not a probability between 0 and 1", p);
  require(degrees_of_freedom > 0, "{} degrees of freedom leave no distribution; at least 1 is needed",
          degrees_of_freedom);
  use_gsl_statuses();
  return gsl_cdf_tdist_Pinv(p, degrees_of_freedom);
}

double curve_band_factor(double confidence, double outside, double degrees_of_freedom) {
  require(confidence > 0 && confidence < 1, "the confidence {} is not between 0 and 1", confidence);
  require(outside > 0 && outside < 1, "the share {} left outside is not between 0 and 1", outside);
  return student_t_quantile(1 - outside * (1 - confidence) / 2, degrees_of_freedom);
}

}  // namespace impulse
