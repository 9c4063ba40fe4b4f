#pragma once

#include "lib/law/impact_history.hpp"
#include "lib/model/structure.hpp"

#include <cstddef>

namespace impulse {

/// How the contact force at the end of a step is found.
enum class Matching {
  direct,     ///< the end velocities are affine in it: one trial, corrected by the faces' responses to a unit ramp
  bisection,  ///< the published procedure: bisection on the force increment, each evaluation a trial of both bodies
};

/// How the force begins at first touch. At Courant number 1 it is soon forgotten; below, velocities do not see a force
/// (-1)ⁿ without subcycles, and what a start misses of F₀ = V/(½Δt Σ cᵀM⁻¹c), with which the half step that follows
/// brings the faces to one velocity, rings on undamped with about half its size.
enum class ImpactStart {
  wave_admittance,  ///< that force acts, the record shows V/(H₁(0+) + H₂(0+)), the jump of the continuous bodies (the
                    ///< force of the next sample where either is unknown): no ringing without subcycles
  held,  ///< F₀ = F₁
  zero,  ///< F₀ = 0, the published flow chart: rings with half the force
};

enum class AfterContact {
  go_on,        ///< both bodies move on freely up to the duration, through each other if need be
  stop,         ///< the record ends with the third sample without compression
  touch_again,  ///< the bodies may meet again (explicit_contact only)
};

struct ExplicitImpact {
  double speed_m_per_s = 0;              ///< V > 0, of every node of the projectile, into the target
  double step_s = 0;                     ///< the target's; the force is linear within it
  std::size_t projectile_subcycles = 1;  ///< m ≥ 1: the projectile's step is step_s/m
  double duration_s = 0;                 ///< of the record
  Matching matching = Matching::direct;
  ImpactStart start = ImpactStart::wave_admittance;
  AfterContact after_contact = AfterContact::go_on;
};

/// A body at the end of the record.
struct BodyBalance {
  double momentum_Ns = 0;       ///< rᵀMv, positive in the direction in which the projectile arrives; 0 of a body that
                                ///< is held or turns, without a rigid translation r
  double kinetic_energy_J = 0;  ///< Σ ½ m v²
  double strain_energy_J = 0;   ///< ½ dᵀKd
  double dissipated_J = 0;      ///< ∫ vᵀCv dt in the dashpots, v relative to the motion before impact
  double step_s = 0;            ///< of its own integration
  std::size_t step_count = 0;   ///< its integration steps, trials included
};

struct ExplicitImpactResult {
  ImpactHistory history;
  BodyBalance projectile;
  BodyBalance target;
  std::size_t trial_count = 0;  ///< trial integrations of both bodies through a step of the target
};

/// Impact of two bodies with lumped mass by explicit central differences, at rest relative to each other's faces from
/// t = 0 until contact ends. At the end of each target step t_n = nΔt
///
///   V - c₁ᵀv₁ = c₂ᵀv₂
///
/// fixes the force F_n, linear in between and compressive positive; the projectile takes m steps of Δt/m through the
/// same ramp. d₁, v₁ are departures from the rigid flight with V, in which a linear body bears no force: the force of
/// both bodies acts along their contact functionals, c₁ pointing against V.
/// The contact ends as ImpactHistory says; a force below 1e-9 of the peak counts as none, so that rounding does not
/// prolong a contact. Both bodies then return to the last sample in compression and go on from there with a force
/// that falls to zero at contact_end_s (scaled so that each receives that impulse to rounding): the separated bodies
/// carry no trace of the tension that found the end, and Σ m v changes by ∓impulse_Ns(history) exactly, the force at
/// first touch counted as it acted (acted_impulse_Ns).
/// History: row 0 has the right limits of velocity for `wave_admittance`, V and 0 otherwise; at a wave front on a
/// sample force and velocity are the mean of both sides.
///
///   energy_error = |V ∫F dt - Σ W| / (V ∫F dt),   W = ½vᵀMv + ½dᵀKd - (δ²/8) aᵀMa + ∫vᵀCv dt
///
/// with the departures d, v, a of both bodies when contact ends and their own steps δ: W is the energy that central
/// differences conserve (StrikingBody::received_work), so ΣW = ∫F (V - v₁ + v₂) dt as each integration counts it. The
/// faces' masses meet like plastic bodies, which costs ½μV², μ = 1/Σ cᵀM⁻¹c: of V∫F dt the part μV/(2∫F dt), which
/// goes with the mesh; where the mesh goes with the step at Courant number 1 it is F₀Δt/(4∫F dt), order 1.
///
/// Order 2 away from wave fronts and in the impulse; nodally exact for rods where every element has Courant number 1
/// (step Δt = h/c, front on the samples). There the nodes fall into two sublattices that only a jump off the samples
/// sets against each other: an alternating strain that does no work and that force and velocities do not see.
/// `direct` and `bisection` agree to 1e-9 of the peak. The projectile's subcycles do not destabilise the pair (tried
/// over 30 ms without separation, m = 1 .. 7); but where its mesh does not carry a wave of two steps of the target,
/// C < sin(π/2m) of its Courant number C, a zigzag of up to half the force stays from the first touch.
/// @throws std::invalid_argument unless speed, step and duration are positive and finite, subcycles ≥ 1, each body has
/// one contact and lumped mass, both steps are stable, and the projectile is free to fly;
/// ConvergenceError if bisection misses its tolerance.
/// Verified by: tests/fem/explicit_impact.test.cpp, tests/fem/explicit_impact_balance.test.cpp,
/// tests/fem/explicit_rigid_contact.test.cpp
[[nodiscard]] ExplicitImpactResult explicit_impact(const Structure& projectile, const Structure& target,
                                                   const ExplicitImpact& impact);

}  // namespace impulse
