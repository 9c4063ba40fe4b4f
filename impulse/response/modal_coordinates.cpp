#include "impulse/response/modal_coordinates.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

/// A unit oscillator over one step h under f0 + r t.
class Oscillator {
 public:
  Oscillator(double omega, double zeta, double h) : omega_(omega), zeta_(zeta), h_(h) {
    const double decay = zeta * omega, damped = omega * std::sqrt(1 - zeta * zeta);
    const double envelope = std::exp(-decay * h), c = std::cos(damped * h);
    const double s = damped > 0 ? std::sin(damped * h) / damped : h;
    from_q_ = envelope * (c + decay * s);
    from_v_ = envelope * s;
    v_from_q_ = -envelope * omega * omega * s;
    v_from_v_ = envelope * (c - decay * s);
  }

  void advance(double f0, double f1, double& q, double& v) const {
    const double r = (f1 - f0) / h_;
    if (omega_ == 0) {
      q += h_ * v + h_ * h_ * (f0 / 2 + r * h_ / 6);
      v += h_ * (f0 + f1) / 2;
      return;
    }
    // Particular solution a + b t.
    const double b = r / (omega_ * omega_), a = f0 / (omega_ * omega_) - 2 * zeta_ * b / omega_;
    const double q0 = q - a, v0 = v - b;
    q = from_q_ * q0 + from_v_ * v0 + a + b * h_;
    v = v_from_q_ * q0 + v_from_v_ * v0 + b;
  }

 private:
  double omega_, zeta_, h_;
  double from_q_, from_v_, v_from_q_, v_from_v_;
};

}  // namespace

Eigen::MatrixXd modal_coordinates(const ModalModel& body, const UniformSeries& force, Eigen::Index contact) {
  require_valid(body);
  require(contact >= 0 && contact < body.contact_count(), "the body has {} contacts, none numbered {}",
          body.contact_count(), contact);
  const auto samples = static_cast<Eigen::Index>(force.values.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(body.mode_count(), samples);
  for (Eigen::Index i = 0; i < body.mode_count(); ++i) {
    const double phi = body.participation(i, contact);
    const Oscillator oscillator(body.angular_frequency(i), body.damping_ratio(i), force.grid.step_s);
    double q = 0, v = 0;
    for (Eigen::Index k = 1; k < samples; ++k) {
      const auto now = static_cast<std::size_t>(k);
      oscillator.advance(phi * force.values[now - 1], phi * force.values[now], q, v);
      result(i, k) = q;
    }
  }
  return result;
}

}  // namespace impulse
