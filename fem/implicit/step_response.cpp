#include "fem/implicit/step_response.hpp"

#include "fem/implicit/newmark.hpp"
#include "lib/contract/require.hpp"

namespace impulse {

std::vector<std::vector<double>> step_displacements(const Structure& body, const UniformGrid& grid,
                                                    const StepResponseOptions& options) {
  const Eigen::Index p = body.contacts.cols(), q = body.outputs.cols();
  require(p > 0, "a body without a contact has no response");
  require(options.substeps >= 1, "0 substeps; use 1 or more");
  const auto loads = static_cast<std::size_t>(p);
  const double step = grid.step_s / static_cast<double>(options.substeps);
  Newmark newmark(body, step);
  std::vector<std::vector<double>> all(static_cast<std::size_t>(p + q) * loads, std::vector<double>(grid.size, 0.0));
  Eigen::MatrixXd functionals(body.contacts.rows(), p + q);
  functionals << body.contacts, body.outputs;
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(body.contacts.rows());
  for (std::size_t j = 0; j < loads; ++j) {
    MotionState state = MotionState::at_rest(body.contacts.rows());
    const Eigen::VectorXd load = body.contacts.col(static_cast<Eigen::Index>(j));
    Eigen::VectorXd before = nothing;
    // The integration starts half a step before t = 0, so that its times lie half a step off the samples.
    for (std::size_t n = 0; n < grid.size; ++n) {
      const std::size_t count = n == 0 ? 1 : options.substeps;
      for (std::size_t s = 0; s < count; ++s) {
        before = state.displacement;
        newmark.advance(state, load);
      }
      const Eigen::VectorXd now = 0.5 * (before + state.displacement);
      if (n > 0) {
        const Eigen::VectorXd seen = functionals.transpose() * now;
        for (std::size_t i = 0; i < static_cast<std::size_t>(p + q); ++i)
          all[i * loads + j][n] = seen(static_cast<Eigen::Index>(i));
      }
      if (options.observer) options.observer(j, n, n == 0 ? nothing : now);
    }
  }
  return all;
}

}  // namespace impulse
