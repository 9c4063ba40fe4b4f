#include "impulse/contact/modal_history.hpp"

#include "lib/contract/require.hpp"

#include <array>
#include <cmath>
#include <complex>

namespace impulse {
namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t forgetting_interval = 1024;

// Eight modes per vector, padded: no sum runs across lanes before the end, and there is no remainder.
[[gnu::target_clones("avx2,default")]] double turned_sum(std::size_t size, const double* __restrict turn_c,
                                                         const double* __restrict turn_s,
                                                         const double* __restrict drive_c,
                                                         const double* __restrict drive_s, double force,
                                                         double* __restrict x, double* __restrict y) {
  std::array<double, lanes> sum{};
  for (std::size_t m = 0; m < size; m += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t k = m + lane;
      const double next_x = turn_c[k] * x[k] - turn_s[k] * y[k] + drive_c[k] * force;
      const double next_y = turn_s[k] * x[k] + turn_c[k] * y[k] + drive_s[k] * force;
      x[k] = next_x;
      y[k] = next_y;
      sum[lane] += next_x;
    }
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

[[gnu::target_clones("avx2,default")]] void turn(std::size_t size, const double* __restrict turn_c,
                                                 const double* __restrict turn_s, const double* __restrict drive_c,
                                                 const double* __restrict drive_s, const double* __restrict force,
                                                 double* __restrict x, double* __restrict y) {
  for (std::size_t k = 0; k < size; ++k) {
    const double next_x = turn_c[k] * x[k] - turn_s[k] * y[k] + drive_c[k] * force[k];
    y[k] = turn_s[k] * x[k] + turn_c[k] * y[k] + drive_s[k] * force[k];
    x[k] = next_x;
  }
}

}  // namespace

ModalHistory::ModalHistory(const ModalModel& body, double step_s)
    : count_(static_cast<std::size_t>(body.contact_count())), within_(count_ * count_, 0.0), past_(count_, 0.0) {
  require_valid(body);
  require(step_s > 0 && std::isfinite(step_s), "step {} s is not positive", step_s);
  const auto modes = static_cast<std::size_t>(body.mode_count());
  const std::size_t padded = (modes + lanes - 1) / lanes * lanes;
  for (std::vector<double>* column :
       {&modes_.turn_c, &modes_.turn_s, &modes_.drive_c, &modes_.drive_s, &modes_.x, &modes_.y})
    column->assign(padded, 0.0);
  if (count_ > 1) {
    participation_.assign(count_, std::vector<double>(padded, 0.0));
    modal_force_.assign(padded, 0.0);
  }
  for (Eigen::Index mode = 0; mode < body.mode_count(); ++mode) set_mode(body, mode, step_s);
}

void ModalHistory::set_mode(const ModalModel& body, Eigen::Index mode, double step_s) {
  const auto k = static_cast<std::size_t>(mode);
  const double omega = body.angular_frequency(mode);
  std::complex<double> turn_less_1 = 0;
  std::complex<double> drive = step_s;
  double within = 0.5 * step_s;
  if (omega > 0) {
    const double zeta = body.damping_ratio(mode);
    const double sine_ratio = zeta / std::sqrt(1 - zeta * zeta);
    const double decay = -zeta * omega * step_s;
    const double angle = omega * std::sqrt(1 - zeta * zeta) * step_s;
    // λ - 1 without the cancellation that 1 - cos has at small angles.
    const double half_sine = std::sin(0.5 * angle);
    turn_less_1 = {std::expm1(decay) - 2 * std::exp(decay) * half_sine * half_sine, std::exp(decay) * std::sin(angle)};
    const double scale = 1 / (omega * omega * step_s);
    drive = -scale * std::complex<double>(1, -sine_ratio) * turn_less_1 * turn_less_1;
    within = -scale * (turn_less_1.real() + sine_ratio * turn_less_1.imag());
  }
  const double single = count_ == 1 ? body.participation(mode, 0) * body.participation(mode, 0) : 1.0;
  modes_.turn_c[k] = 1 + turn_less_1.real();
  modes_.turn_s[k] = turn_less_1.imag();
  modes_.drive_c[k] = single * drive.real();
  modes_.drive_s[k] = single * drive.imag();
  for (std::size_t i = 0; i < count_; ++i) {
    const double at_i = body.participation(mode, static_cast<Eigen::Index>(i));
    if (count_ > 1) participation_[i][k] = at_i;
    for (std::size_t j = 0; j < count_; ++j)
      within_[i * count_ + j] += at_i * body.participation(mode, static_cast<Eigen::Index>(j)) * within;
  }
}

void ModalHistory::push(std::span<const double> forces) {
  Rotations& m = modes_;
  const std::size_t size = m.x.size();
  if (count_ == 1) {
    past_[0] = turned_sum(size, m.turn_c.data(), m.turn_s.data(), m.drive_c.data(), m.drive_s.data(), forces[0],
                          m.x.data(), m.y.data());
  } else {
    const auto modes = static_cast<Eigen::Index>(size);
    Eigen::Map<Eigen::VectorXd> driving(modal_force_.data(), modes);
    driving.setZero();
    for (std::size_t j = 0; j < count_; ++j)
      driving += forces[j] * Eigen::Map<const Eigen::VectorXd>(participation_[j].data(), modes);
    turn(size, m.turn_c.data(), m.turn_s.data(), m.drive_c.data(), m.drive_s.data(), modal_force_.data(), m.x.data(),
         m.y.data());
    for (std::size_t i = 0; i < count_; ++i)
      past_[i] = Eigen::Map<const Eigen::VectorXd>(participation_[i].data(), modes)
                     .dot(Eigen::Map<const Eigen::VectorXd>(m.x.data(), modes));
  }
  if (++steps_ % forgetting_interval == 0) forget_what_has_decayed();
}

// Numbers that decay below the normal range would make every later step a hundred times slower.
void ModalHistory::forget_what_has_decayed() {
  constexpr double nothing = 1e-250;
  for (std::size_t k = 0; k < modes_.x.size(); ++k)
    if (std::abs(modes_.x[k]) + std::abs(modes_.y[k]) < nothing) modes_.x[k] = modes_.y[k] = 0;
}

}  // namespace impulse
