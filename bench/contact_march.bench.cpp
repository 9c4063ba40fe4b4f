// Marching with a contact law: against direct O(N²) marching (vectorised history sums), and in units of one real
// transform of twice the length.
#include "impulse/contact/contact_march.hpp"
#include "impulse/contact/contacts_problem.hpp"
#include "lib/transform/real_fft.hpp"

#include <benchmark/benchmark.h>
#include <Eigen/Dense>

#include <chrono>
#include <cmath>

namespace {

using namespace impulse;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// A heavy sphere on a long rod whose far end keeps it bouncing: in contact for much of the record.
struct Case {
  UniformGrid grid;
  std::vector<double> w;
  std::vector<MarchedContact> contacts;
};

Case sphere_on_rod(std::size_t size) {
  Case c{{400e-6 / static_cast<double>(size), size + 1}, std::vector<double>(size), {}};
  const double m = 0.5, z = 300;
  for (std::size_t k = 0; k < size; ++k) c.w[k] = c.grid.step_s / m * (k == 0 ? 0.5 : 1.0) + (k == 0 ? 1 / z : 0.0);
  MarchedContact contact;
  contact.law = ContactLaw::hertz(1.5e10);
  contact.approach_m_per_s.assign(size, 1.0);
  c.contacts = {contact};
  return c;
}

void online(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const Case c = sphere_on_rod(size);
  const RealFft fft(2 * size, RealFft::Planning::measure);
  RealBuffer time(2 * size, 1.0);
  ComplexBuffer spectrum(size + 1);
  double own = 0;
  double transform = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    benchmark::DoNotOptimize(march_contacts(c.grid, c.contacts, {c.w}, Recontact::yes));
    own += seconds_since(start);
    state.PauseTiming();
    const auto transform_start = Clock::now();
    fft.forward(time, spectrum);
    transform += seconds_since(transform_start);
    state.ResumeTiming();
  }
  state.counters["transforms"] = own / transform;
}
BENCHMARK(online)->Arg(1 << 14)->Arg(1 << 17)->Arg(1 << 20)->Unit(benchmark::kMillisecond);

/// The history alone, by Eigen's dot product: what any direct marching has to pay.
void direct_history(benchmark::State& state) {
  const auto size = static_cast<Eigen::Index>(state.range(0));
  const Case c = sphere_on_rod(static_cast<std::size_t>(size));
  const Eigen::Map<const Eigen::VectorXd> w(c.w.data(), size);
  const Eigen::VectorXd reversed = w.reverse();
  for (auto _ : state) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
    for (Eigen::Index n = 0; n < size; ++n) x[n] = 1 - 1e-3 * reversed.segment(size - 1 - n, n).dot(x.head(n));
    benchmark::DoNotOptimize(x.data());
  }
}
BENCHMARK(direct_history)->Arg(1 << 14)->Arg(1 << 17)->Unit(benchmark::kMillisecond)->Iterations(1);

/// A mass against a body of so many modes, by either history.
void modal_body(benchmark::State& state, HistoryMethod method) {
  const auto steps = static_cast<std::size_t>(state.range(0));
  const Eigen::Index modes = state.range(1);
  ModalModel body{Eigen::VectorXd::LinSpaced(modes, 1e3, 1e6), Eigen::VectorXd::Constant(modes, 1e-3),
                  Eigen::MatrixXd::Constant(modes, 1, std::sqrt(2.0 / static_cast<double>(modes))),
                  Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
  ModalModel mass{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1),
                  Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
  const UniformGrid grid{1e-6, steps + 1};
  ContactsProblem problem;
  problem.speed_m_per_s = {1, 0};
  problem.laws = {ContactLaw::hertz(1e9)};
  problem.gaps_m = {0};
  problem.recontact = Recontact::yes;
  problem.history = method;
  for (auto _ : state) benchmark::DoNotOptimize(solve_contacts(std::vector<ContactBody>{mass, body}, grid, problem));
  state.counters["ns_per_step"] = benchmark::Counter(
      static_cast<double>(steps) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(modal_body, modes, HistoryMethod::modes)
    ->ArgsProduct({{1 << 12, 1 << 15, 1 << 18}, {16, 128, 512, 2048}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(modal_body, convolution, HistoryMethod::convolution)
    ->ArgsProduct({{1 << 12, 1 << 15, 1 << 18}, {16, 128, 512, 2048}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
