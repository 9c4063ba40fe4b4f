#pragma once

#include "impulse/contact/bodies_history.hpp"
#include "impulse/contact/contact_march.hpp"
#include "impulse/response/response.hpp"
#include "lib/law/contact_trace.hpp"

#include <functional>
#include <vector>

namespace impulse {

/// How a march remembers the forces on bodies given by modes; on bodies given by responses it is always convolution.
///
/// Measured, per step: advancing the modes costs 150 ns + 0.5 ns a mode (0.65 ns beyond 20 000, out of cache), sampling
/// them for convolution 1.5 ns a mode and the convolution itself 200 to 500 ns at 2^15 to 2^18 samples. So modes win at
/// any number of modes and samples, also beside a neighbour that has to be convolved; convolution would win from some
/// 100 (2^12 samples) to 800 modes (2^18) only with a response that is there already, and then there are no modes.
/// `automatic` takes the modes. Figures: bench/contact_march.bench.cpp.
enum class HistoryMethod { automatic, convolution, modes };

/// What several bodies, or two that touch at several points, are asked.
struct ContactsProblem {
  std::vector<double> speed_m_per_s;  ///< of each body at t = 0, in the direction from the first to the last
  std::vector<ContactLaw> laws;       ///< of each contact
  std::vector<double> gaps_m;         ///< of each contact at t = 0
  double preload_N = 0;  ///< constant force through every contact before t = 0, held by what holds the bodies
  /// Velocity of each body's face at a contact were there no contact force, beyond its speed; empty: none. Of the first
  /// and the last body.
  std::vector<double> free_velocity_first_m_per_s;
  std::vector<double> free_velocity_last_m_per_s;
  Recontact recontact = Recontact::no;
  HistoryMethod history = HistoryMethod::automatic;  ///< of bodies given by modes
  std::function<void(double)> progress = {};         ///< hears what part of the steps is done, 0 to 1
};

struct ContactsSolution {
  std::vector<ContactTrace> traces;  ///< one a contact
  double energy_error = 0;  ///< |Σ ∫F α' dt - stored - dissipated| / Σ|work of the approach|: what rigid contacts lose
                            ///< in closing, and rounding
  bool in_contact_at_end = false;
  HistoryMethod history = HistoryMethod::convolution;  ///< that was taken
};

/// Contact forces of a row of bodies or of two bodies at several points.
///
/// * Two responses with p contacts each: contact i joins their i-th contacts; w_ij is that of the sum of both.
/// * A chain of B ≥ 2 bodies, the inner ones with two contacts (entry, exit), the ends with one: contact c joins the
/// exit of body c to the entry of body c+1.
///   w_cc = exit of c + entry of c+1, w_c,c+1 = entry-exit of body c+1.
///
/// The law of a rigid contact whose bodies have a residual flexibility R in all is that flexibility, a spring 1/R; of
/// any other law R lies in series with it. What R_ij of a body does across two of its contacts is in it too. See
/// contact_march.hpp for the march and its order. A body given by modes is sampled on the grid or advances its modes;
/// the answer is the same to rounding.
/// @throws std::invalid_argument if grids, contacts or lengths disagree, and if HistoryMethod::modes is asked for but
/// no body is given by modes. Verified by: tests/impulse/contacts_problem.test.cpp,
/// tests/impulse/contact_scenes.test.cpp, tests/impulse/modal_history.test.cpp, tests/cross/contacts.test.cpp,
/// tests/cross/newmark_contacts.test.cpp
[[nodiscard]] ContactsSolution solve_contacts(const std::vector<ContactBody>& bodies, const UniformGrid& grid,
                                              const ContactsProblem& problem);

/// The same of sampled responses, on their own grid.
[[nodiscard]] ContactsSolution solve_contacts(const std::vector<Response>& bodies, const ContactsProblem& problem);

}  // namespace impulse
