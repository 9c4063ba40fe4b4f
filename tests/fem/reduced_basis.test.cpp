#include "fem/reduced_basis/reduced_basis.hpp"

#include "tests/support/about.hpp"
#include "tests/support/chain.hpp"
#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace impulse {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Shell flat_panel() {
  PanelShape shape{.length_m = 0.1524, .width_m = 0.1016};
  const Laminate plies = laminate(layers_of("[0/45/0/-45/0]2s", parse_ply("graphite-epoxy"), 2.69e-3));
  return Shell(shells::panel(shape, plies, "IIII", 5, 5));
}

TEST_CASE("Ritz vectors are M-orthonormal and begin with the static answer") {
  const Shell shell = flat_panel();
  const Structure body = shell_structure(shell, {{0.05, 0.04}});
  const ReducedBasis basis = ritz_basis(body.stiffness, body.mass, body.contacts.col(0), 40);
  REQUIRE(basis.vectors.cols() == 40);
  CHECK((basis.vectors.transpose() * body.mass * basis.vectors - MatrixXd::Identity(40, 40)).norm() <= 1e-11);
  const VectorXd seen = basis.vectors.transpose() * body.contacts.col(0);
  const VectorXd answer = shells::linear_solution(shell, body.contacts.col(0));
  CHECK(seen.dot(basis.stiffness.ldlt().solve(seen)) == about(body.contacts.col(0).dot(answer)).epsilon(1e-10));
}

TEST_CASE("modes are M-orthonormal, and flexural ones move along the normal") {
  const Shell shell = flat_panel();
  const Structure body = shell_structure(shell, {{0.05, 0.04}});
  const ReducedBasis any = modal_basis(shell, body, 30, ModeKind::any);
  const ReducedBasis flexural = modal_basis(shell, body, 30, ModeKind::flexural);
  CHECK((flexural.vectors.transpose() * body.mass * flexural.vectors - MatrixXd::Identity(30, 30)).norm() <= 1e-9);
  CHECK(normal_share(shell, flexural.vectors).minCoeff() > 0.99);  // flat and symmetric: all or nothing
  CHECK(normal_share(shell, any.vectors).minCoeff() < 0.01);
  CHECK(flexural.stiffness(29, 29) > any.stiffness(29, 29));
}

TEST_CASE("what is appended is new: the first coordinates stay and a vector from the span adds nothing") {
  const Shell shell = flat_panel();
  const Structure body = shell_structure(shell, {{0.05, 0.04}});
  const ReducedBasis basis = ritz_basis(body.stiffness, body.mass, body.contacts.col(0), 10);
  MatrixXd more(shell.size(), 2);
  more << basis.vectors * VectorXd::Ones(10), body.mass * basis.vectors.col(3);
  const ReducedBasis longer = appended(basis, more, body.stiffness, body.mass);
  REQUIRE(longer.vectors.cols() == 11);
  CHECK(longer.vectors.leftCols(10) == basis.vectors);
  CHECK((longer.vectors.transpose() * body.mass * longer.vectors - MatrixXd::Identity(11, 11)).norm() <= 1e-12);
}

TEST_CASE("bases that cannot be are refused") {
  const Shell shell = flat_panel();
  const Structure body = shell_structure(shell, {{0.05, 0.04}});
  CHECK_THROWS_WITH_AS((void)modal_basis(shell, body, 10000, ModeKind::any),
                       "10000 modes are asked for, but the mesh has 300 degrees of freedom; use more elements",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)ritz_basis(body.stiffness, body.mass, body.contacts.col(0), 10000),
                       "10000 vectors are asked for, but the mesh has 300 degrees of freedom; use more elements",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)ritz_basis(body.stiffness, body.mass, VectorXd::Zero(300), 3),
                       "Ritz vectors need a load that isn't zero", std::invalid_argument);
}

/// Simply supported beam of 40 Hermite elements, EI = ρA = L = 1: deflection and moment at the load under a unit step.
class SteppedBeam {
 public:
  explicit SteppedBeam(double load_at) {
    const test::Pencil free = test::free_beam(40);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < 82; ++i)
      if (i != 0 && i != 80) kept.push_back(i);
    k_ = MatrixXd(free.k)(kept, kept);
    m_ = MatrixXd(free.m)(kept, kept);
    load_ = VectorXd::Zero(80);
    const Eigen::Index w = static_cast<Eigen::Index>(std::lround(load_at * 40)) * 2 - 1;
    load_(w) = 1;
    // Curvature at the end of the element before the load; the one after it has the same but for the mesh.
    moment_ = VectorXd::Zero(80);
    moment_(w - 2) = 6 * 40 * 40;
    moment_(w) = -6 * 40 * 40;
    moment_(w - 1) = 2 * 40;
    moment_(w + 1) = 4 * 40;
    const MatrixXd all = MatrixXd::Identity(80, 80);
    deflection_history_ = history(all, load_);
    moment_history_ = history(all, moment_);
  }

  struct Error {
    double deflection, moment;
  };

  /// Relative L2 errors over 0 ≤ t ≤ 2 in a basis, against the whole beam.
  [[nodiscard]] Error error(const MatrixXd& basis) const {
    const auto off = [](const VectorXd& found, const VectorXd& exact) { return (found - exact).norm() / exact.norm(); };
    return {off(history(basis, load_), deflection_history_), off(history(basis, moment_), moment_history_)};
  }
  [[nodiscard]] Error ritz_error(std::size_t count) const {
    return error(ritz_basis(k_.sparseView(), m_.sparseView(), load_, count).vectors);
  }
  [[nodiscard]] Error modal_error(Eigen::Index count) const {
    return error(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(k_, m_).eigenvectors().leftCols(count));
  }

 private:
  [[nodiscard]] VectorXd history(const MatrixXd& basis, const VectorXd& output) const {
    const MatrixXd k = basis.transpose() * k_ * basis, m = basis.transpose() * m_ * basis;
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(k, m);
    const VectorXd share = modes.eigenvectors().transpose() * (basis.transpose() * load_);
    const VectorXd seen = modes.eigenvectors().transpose() * (basis.transpose() * output);
    VectorXd w(4001);
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      const double t = 2.0 * static_cast<double>(i) / 4000;
      const Eigen::ArrayXd lambda = modes.eigenvalues().array();
      w(i) = (share.array() * seen.array() / lambda * (1 - (lambda.sqrt() * t).cos())).sum();
    }
    return w;
  }

  MatrixXd k_, m_;
  VectorXd load_, moment_, deflection_history_, moment_history_;
};

TEST_CASE("Ritz vectors against modes: errors of a stepped beam as tabulated, deflection and moment") {
  const SteppedBeam centre(0.5), quarter(0.25);
  struct Row {
    double at;
    bool ritz;
    std::size_t count;
    double deflection, moment;
  };
  for (const Row& row :
       {Row{0.5, false, 3, 2.2e-3, 9.1e-2}, Row{0.5, false, 5, 6.6e-4, 6.0e-2}, Row{0.5, false, 10, 1.4e-4, 3.5e-2},
        Row{0.5, true, 3, 1.7e-3, 6.9e-2}, Row{0.5, true, 5, 4.0e-4, 3.7e-2}, Row{0.5, true, 10, 4.2e-5, 1.4e-2},
        Row{0.25, false, 3, 3.4e-3, 1.2e-1}, Row{0.25, false, 5, 2.1e-3, 1.0e-1}, Row{0.25, false, 10, 2.0e-4, 4.4e-2},
        Row{0.25, true, 1, .41, .48}, Row{0.25, true, 2, .11, .39}, Row{0.25, true, 3, 1.1e-2, .14},
        Row{0.25, true, 4, 2.6e-3, 9.3e-2}, Row{0.25, true, 5, 2.0e-3, 8.0e-2}, Row{0.25, true, 10, 2.2e-4, 2.9e-2}}) {
    CAPTURE(row.at);
    CAPTURE(row.ritz);
    CAPTURE(row.count);
    const SteppedBeam& beam = row.at == 0.5 ? centre : quarter;
    const auto error = row.ritz ? beam.ritz_error(row.count) : beam.modal_error(static_cast<Eigen::Index>(row.count));
    // Two digits are printed, so that five percent is their rounding.
    CHECK(error.deflection == about(row.deflection).epsilon(0.05));
    CHECK(error.moment == about(row.moment).epsilon(0.05));
  }
  CHECK(quarter.ritz_error(3).deflection > quarter.modal_error(3).deflection);  // few Ritz vectors off the centre lose
  CHECK(quarter.ritz_error(4).moment < quarter.modal_error(4).moment);          // moments gain from the fourth on
}

}  // namespace
}  // namespace impulse
