#include "fem/bodies/dispersion_correction.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impulse {
namespace {

/// The elements' common travel time: total over count.
double element_travel_time_s(const Bar& bar, const BarMesh& mesh) {
  double total = 0;
  double count = 0;
  double shortest = HUGE_VAL;
  double longest = 0;
  for (std::size_t i = 0; i < bar.profile.size(); ++i) {
    const double elements = static_cast<double>(mesh.elements[i]);
    const double own = bar.profile[i].travel_time_s() / elements;
    shortest = std::min(shortest, own);
    longest = std::max(longest, own);
    total += bar.profile[i].travel_time_s();
    count += elements;
  }
  require(
      longest <= 1.05 * shortest,
      "element travel times from {:.4g} to {:.4g} s are too unlike for one dispersion correction; use more --elements",
      shortest, longest);
  return total / count;
}

}  // namespace

ModalModel dispersion_corrected(ModalModel modes, const Bar& bar, const BarMesh& mesh, double highest_frequency_Hz) {
  require(mesh.mass == MassMatrix::lumped, "the dispersion correction is that of the lumped mass matrix");
  const double delta = element_travel_time_s(bar, mesh);
  Eigen::Index kept = 0;
  for (Eigen::Index n = 0; n < modes.mode_count(); ++n) {
    // The highest mode reaches ωδ/2 = 1, and passes it by the spread of the travel times.
    double& omega = modes.angular_frequency(n);
    omega = 2 / delta * std::asin(std::min(1.0, omega * delta / 2));
    if (omega <= 2 * std::numbers::pi * highest_frequency_Hz) kept = n + 1;
  }
  modes.angular_frequency.conservativeResize(kept);
  modes.damping_ratio.conservativeResize(kept);
  modes.participation.conservativeResize(kept, Eigen::NoChange);
  return modes;
}

}  // namespace impulse
