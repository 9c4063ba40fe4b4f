#pragma once

#include "impulse/measured/blow.hpp"
#include "impulse/response/modal_response.hpp"
#include "tests/support/records.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// Bodies with exact modes, and hammer records of them.
namespace impulse::structures {

inline ModalModel modal(std::vector<double> frequency_Hz, double damping, const std::vector<double>& participation) {
  const auto count = static_cast<Eigen::Index>(frequency_Hz.size());
  std::vector<std::size_t> order(frequency_Hz.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::sort(order, {}, [&](std::size_t k) { return frequency_Hz[k]; });
  ModalModel model{Eigen::VectorXd(count), Eigen::VectorXd::Constant(count, damping), Eigen::MatrixXd(count, 1),
                   Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
  for (Eigen::Index m = 0; m < count; ++m) {
    const std::size_t k = order[static_cast<std::size_t>(m)];
    model.angular_frequency(m) = 2 * std::numbers::pi * frequency_Hz[k];
    model.participation(m, 0) = participation[k];
  }
  return model;
}

/// A simply supported beam of 1.2 kg, first frequency 150 Hz, struck at 0.3 of its length: ω ~ n², φ² = 2 sin²(nπx)/m.
inline ModalModel beam() {
  std::vector<double> frequency, participation;
  for (int n = 1; n <= 6; ++n) {
    frequency.push_back(150.0 * n * n);
    participation.push_back(std::sqrt(2 / 1.2) * std::abs(std::sin(0.3 * std::numbers::pi * n)));
  }
  return modal(frequency, 0.01, participation);
}

/// A simply supported plate of 2 kg and sides 3:2, struck at (0.4, 0.45): ω ~ m²/9 + n²/4, φ² = 4 sin² sin²/m.
inline ModalModel plate() {
  std::vector<double> frequency, participation;
  for (int m = 1; m <= 7; ++m)
    for (int n = 1; n <= 5; ++n) {
      const double f = 900 * (m * m / 9.0 + n * n / 4.0);
      if (f > 5500) continue;
      frequency.push_back(f);
      participation.push_back(std::sqrt(4 / 2.0) * std::abs(std::sin(0.4 * std::numbers::pi * m)) *
                              std::abs(std::sin(0.45 * std::numbers::pi * n)));
    }
  return modal(frequency, 0.01, participation);
}

struct HammerTest {
  double step_s = 1e-5;
  std::size_t size = 4000;
  std::size_t blow_count = 5;
  std::size_t pulse = 10;  ///< half sine, in steps
  double noise_dB = 40;    ///< below the root mean square of each channel, of the force in its pulse
  double quietest = 80;    ///< peak forces [N] from here, 10 % up from blow to blow
};

/// Blows of a half sine on a body whose response reaches one step past the records.
inline std::vector<Blow> blows(const PairResponse& body, const HammerTest& test, unsigned seed) {
  std::mt19937_64 engine(seed);
  const double level = std::pow(10, -test.noise_dB / 20);
  std::vector<Blow> made;
  for (std::size_t b = 0; b < test.blow_count; ++b) {
    const double peak = test.quietest * (1 + 0.1 * static_cast<double>(b));
    Blow blow{"blow", records::half_sine(test.size, 60, test.pulse, peak), {}};
    blow.response = records::velocity(body, test.step_s, blow.force_N);
    records::add_noise(blow.force_N, level * peak / std::sqrt(2.0), engine);
    records::add_noise(blow.response, level * records::rms(blow.response), engine);
    made.push_back(std::move(blow));
  }
  return made;
}

}  // namespace impulse::structures
