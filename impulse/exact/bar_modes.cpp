#include "impulse/exact/bar_modes.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/roots.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace impulse {
namespace {

/// What the walk along the chain needs of a segment; `stiffness` is E·π/4, so that N = stiffness·(D ψ' - D' ψ).
struct Piece {
  double length;
  double speed;
  double stiffness;
  double density_factor;  ///< ρ·π/4
  double diameter_a;
  double diameter_b;
  double slope;  ///< D'
};

std::vector<Piece> pieces_of(const Profile& profile) {
  std::vector<Piece> pieces;
  for (const Segment& s : profile)
    pieces.push_back({s.length_m, s.material.rod_wave_speed_m_per_s(), s.material.youngs_modulus_Pa * M_PI / 4,
                      s.material.density_kg_per_m3 * M_PI / 4, s.diameter_a_m, s.diameter_b_m,
                      (s.diameter_b_m - s.diameter_a_m) / s.length_m});
  return pieces;
}

struct Ends {
  bool a_fixed = false;
  bool b_fixed = false;
};

/// Displacement and force at one section, and the Prüfer angle there.
struct Section {
  double u;
  double n;
  double angle;
};

/// The angle of (sine part, cosine part) in the same interval [mπ, (m+1)π) as `near`: both vanish together there.
double on_branch(double sine_part, double cosine_part, double near) {
  const double half_turns = std::floor(near / M_PI);
  double angle = std::atan2(sine_part, cosine_part);
  if (angle < 0) angle += M_PI;
  // At a node rounding may put the angle on either side of the branch's end; keep it next to `near`.
  const double candidate = angle + half_turns * M_PI;
  if (candidate - near > M_PI / 2 && near - half_turns * M_PI < 1e-9) return candidate - M_PI;
  if (near - candidate > M_PI / 2 && (half_turns + 1) * M_PI - near < 1e-9) return candidate + M_PI;
  return candidate;
}

class Walk {
 public:
  Walk(const Bar& bar, Ends ends) : pieces_(pieces_of(bar.profile)), ends_(ends) {}

  /// From end A to end B at frequency ω; adds up ∫ρA u².
  struct Result {
    Section a;
    Section b;
    double modal_mass;
  };
  [[nodiscard]] Result at(double omega) const {
    const Section start = ends_.a_fixed ? Section{0, 1, 0} : Section{1, 0, M_PI / 2};
    Section here = start;
    double modal_mass = 0;
    for (const Piece& piece : pieces_) {
      const double k = omega / piece.speed;
      // ψ = R sin θ, ψ' = k R cos θ
      const double psi = here.u * piece.diameter_a;
      const double psi_slope = (here.n / piece.stiffness + piece.slope * psi) / piece.diameter_a;
      const double amplitude = std::hypot(psi, psi_slope / k);
      const double theta_a = on_branch(signed_by(here.angle, psi), signed_by(here.angle, psi_slope / k), here.angle);
      const double theta_b = theta_a + k * piece.length;
      modal_mass += piece.density_factor * amplitude * amplitude *
                    (piece.length / 2 - (std::sin(2 * theta_b) - std::sin(2 * theta_a)) / (4 * k));
      const double psi_b = amplitude * std::sin(theta_b);
      const double slope_b = amplitude * k * std::cos(theta_b);
      const double u = psi_b / piece.diameter_b;
      const double n = piece.stiffness * (piece.diameter_b * slope_b - piece.slope * psi_b);
      const double z_omega = piece.stiffness * k * piece.diameter_b * piece.diameter_b;
      here = {u, n, on_branch(signed_by(theta_b, u * z_omega), signed_by(theta_b, n), theta_b)};
    }
    return {start, here, modal_mass};
  }

  /// Θ at end B minus the angle that its condition asks of mode 0.
  [[nodiscard]] double end_angle(double omega) const { return at(omega).b.angle - (ends_.b_fixed ? 0 : M_PI / 2); }

 private:
  /// Flips a pair so that its sine part is positive, as it is at the start of every branch: atan2 then lies in [0, π].
  static double signed_by(double angle, double value) {
    const double half_turns = std::floor(angle / M_PI);
    return std::fmod(std::abs(half_turns), 2.0) == 1.0 ? -value : value;
  }

  std::vector<Piece> pieces_;
  Ends ends_;
};

Ends ends_of(const Bar& bar) {
  require(bar.far_end != FarEnd::infinite, "an infinite bar has no modes; use its travelling waves (--method wave)");
  Ends ends;
  if (bar.faces.size() == 1 && bar.far_end == FarEnd::fixed)
    (bar.faces.front() == Face::a ? ends.b_fixed : ends.a_fixed) = true;
  return ends;
}

}  // namespace

ModalModel exact_bar_modes(const Bar& bar, const ModeRange& range) {
  require_valid(bar);
  const Ends ends = ends_of(bar);
  require(std::isfinite(range.highest_frequency_Hz) || range.count < std::numeric_limits<std::size_t>::max(),
          "a bar has infinitely many modes; give a highest frequency or a count");
  const double expected_count =
      std::min(2 * travel_time_s(bar.profile) * range.highest_frequency_Hz, static_cast<double>(range.count));
  require(expected_count <= 1e7, "{:.3g} modes are more than can be had (1e7); ask for fewer, or use a longer step",
          expected_count);
  const Walk walk(bar, ends);
  const double spacing = M_PI / travel_time_s(bar.profile);
  const bool free = !ends.a_fixed && !ends.b_fixed;
  const double highest = 2 * M_PI * range.highest_frequency_Hz;

  std::vector<double> omega;
  std::vector<std::vector<double>> participation;
  if (free && range.count > 0) {
    omega.push_back(0);
    participation.emplace_back();
    for (Face face : bar.faces)
      participation.back().push_back((face == Face::a ? 1 : -1) / std::sqrt(mass_kg(bar.profile)));
  }
  double low = 1e-9 * spacing;
  for (int n = free || ends.b_fixed ? 1 : 0; omega.size() < range.count; ++n) {
    const auto mismatch = [&](double w) { return walk.end_angle(w) - n * M_PI; };
    double high = low + spacing;
    while (mismatch(high) < 0) {
      low = high;
      high += 0.5 * spacing;
    }
    const double root = bracketed_root(mismatch, low, high);
    if (root > highest) break;
    low = root;
    const Walk::Result mode = walk.at(root);
    omega.push_back(root);
    participation.emplace_back();
    for (Face face : bar.faces)
      participation.back().push_back((face == Face::a ? mode.a.u : -mode.b.u) / std::sqrt(mode.modal_mass));
  }

  const auto mode_count = static_cast<Eigen::Index>(omega.size());
  const auto contact_count = static_cast<Eigen::Index>(bar.faces.size());
  ModalModel model{Eigen::VectorXd(mode_count), Eigen::VectorXd::Zero(mode_count),
                   Eigen::MatrixXd(mode_count, contact_count), Eigen::MatrixXd::Zero(contact_count, contact_count),
                   Eigen::MatrixXd::Zero(contact_count, contact_count)};
  for (Eigen::Index mode = 0; mode < mode_count; ++mode) {
    model.angular_frequency(mode) = omega[static_cast<std::size_t>(mode)];
    for (Eigen::Index i = 0; i < contact_count; ++i)
      model.participation(mode, i) = participation[static_cast<std::size_t>(mode)][static_cast<std::size_t>(i)];
  }
  for (Eigen::Index i = 0; i < contact_count; ++i)
    model.wave_admittance(i, i) = 1 / face_impedance_kg_per_s(bar.profile, bar.faces[static_cast<std::size_t>(i)]);
  return model;
}

}  // namespace impulse
