#include "lib/model/modal_model.hpp"

#include "lib/contract/errors.hpp"
#include "lib/model/rigid_modes.hpp"
#include "tests/support/about.hpp"
#include "tests/support/chain.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

using namespace impulse;
using namespace impulse::test;
using Route = ModalOptions::Route;
using Residual = ModalOptions::Residual;

namespace {

constexpr Route all_routes[] = {Route::tridiagonal, Route::dense, Route::arpack};
constexpr double two_pi = 2 * std::numbers::pi;

Structure structure(Pencil pencil, Eigen::MatrixXd contacts) {
  Structure body;
  body.stiffness = std::move(pencil.k);
  body.mass = std::move(pencil.m);
  body.contacts = std::move(contacts);
  return body;
}

/// Unit forces at the given degrees of freedom.
Eigen::MatrixXd at(Eigen::Index n, std::initializer_list<Eigen::Index> places) {
  Eigen::MatrixXd contacts = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(places.size()));
  Eigen::Index column = 0;
  for (const Eigen::Index place : places) contacts(place, column++) = 1;
  return contacts;
}

Structure chain(Eigen::Index n, double k, double m, Ends ends) {
  return structure({chain_stiffness(n, k, ends), lumped_mass(n, m)}, at(n, {0, n / 3}));
}

/// Springs and masses all different, fixed at one end.
Structure irregular_chain(Eigen::Index n) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n), m = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = static_cast<double>(i), spring = 1e6 * (1.5 + std::sin(x));
    k(i, i) += spring;
    if (i > 0) {
      k(i - 1, i - 1) += spring;
      k(i, i - 1) = k(i - 1, i) = -spring;
    }
    m(i, i) = 0.1 + 0.05 * std::cos(2 * x);
  }
  return structure({sparse(k), sparse(m)}, at(n, {0, n - 1}));
}

Eigen::MatrixXd modal_flexibility(const ModalModel& model) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(model.contact_count(), model.contact_count());
  for (Eigen::Index i = 0; i < model.mode_count(); ++i)
    if (model.angular_frequency(i) > 0)
      sum +=
          model.participation.row(i).transpose() * model.participation.row(i) / std::pow(model.angular_frequency(i), 2);
  return sum;
}

double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("modal_model: a chain between walls, by every route, in any units") {
  constexpr Eigen::Index n = 150;
  for (const auto& [k, m] : {std::pair{1.0, 1.0}, {1e9, 1e-4}, {1e-9, 3e3}})
    for (const Route route : all_routes) {
      const ModalModel model = modal_model(chain(n, k, m, Ends::fixed), {.mode_count = 12, .route = route});
      REQUIRE(model.mode_count() == 12);
      // ε times the largest eigenvalue, 4k/m, is 4e-12 of the lowest.
      for (Eigen::Index j = 0; j < 12; ++j)
        CHECK(model.angular_frequency(j) == about(chain_frequency(j, n, k, m, Ends::fixed)).epsilon(1e-11));
      CHECK(model.damping_ratio.isZero(0));
      CHECK(model.residual_flexibility.isZero(0));
      CHECK(model.wave_admittance.isZero(0));
    }
}

TEST_CASE("modal_model: a free chain has one rigid-body mode, exactly at 0 and uniform") {
  for (const auto& [k, m] : {std::pair{1.0, 1.0}, {1e9, 1e-4}, {3e-9, 3e3}})
    for (const Eigen::Index n : {10, 100, 1000})
      for (const Route route : all_routes) {
        if (route == Route::dense && n == 1000) continue;
        const ModalModel model = modal_model(chain(n, k, m, Ends::free), {.mode_count = 5, .route = route});
        CHECK(model.angular_frequency(0) == 0);
        const double uniform = 1 / std::sqrt(static_cast<double>(n) * m);
        for (Eigen::Index contact = 0; contact < 2; ++contact)
          CHECK(std::abs(model.participation(0, contact)) == about(uniform).epsilon(1e-12));
        for (Eigen::Index j = 1; j < 5; ++j)
          CHECK(model.angular_frequency(j) ==
                about(chain_frequency(j, n, k, m, Ends::free)).epsilon(n < 1000 ? 1e-11 : 1e-9));
      }
}

TEST_CASE("modal_model: all routes agree") {
  const Structure body = irregular_chain(80);
  const ModalModel reference = modal_model(body, {.mode_count = 20, .route = Route::dense});
  for (const Route route : {Route::tridiagonal, Route::arpack}) {
    const ModalModel model = modal_model(body, {.mode_count = 20, .route = route});
    for (Eigen::Index i = 0; i < 20; ++i) {
      CHECK(model.angular_frequency(i) == about(reference.angular_frequency(i)).epsilon(1e-10));
      const double sign = model.participation(i, 0) * reference.participation(i, 0) > 0 ? 1 : -1;
      CHECK(largest_difference(sign * model.participation.row(i), reference.participation.row(i)) <=
            1e-10 * reference.participation.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("modal_model: modes are M-orthonormal, rigid-body ones included") {
  Pencil beam = free_beam(40);
  const Eigen::MatrixXd mass(beam.m);
  const Structure body = structure(std::move(beam), Eigen::MatrixXd::Identity(mass.rows(), mass.rows()));
  for (const Route route : {Route::dense, Route::arpack}) {
    const ModalModel model = modal_model(body, {.mode_count = 30, .route = route});
    CHECK(largest_difference(model.participation * mass * model.participation.transpose(),
                             Eigen::MatrixXd::Identity(30, 30)) <= 1e-11);
  }
}

TEST_CASE("modal_model: shapes that are kept are the modes: K u = w² M u, and their parts in the contacts") {
  const Structure body = irregular_chain(300);
  for (const Route route : {Route::dense, Route::arpack}) {
    const ModalModel model = modal_model(body, {.mode_count = 5, .route = route, .shapes = ModalOptions::Shapes::kept});
    REQUIRE(model.shapes.cols() == 5);
    const Eigen::MatrixXd inertia = body.mass * model.shapes * model.angular_frequency.cwiseAbs2().asDiagonal();
    CHECK((body.stiffness * model.shapes - inertia).norm() <= 1e-9 * inertia.norm());
    CHECK((model.shapes.transpose() * body.contacts - model.participation).norm() == 0);
  }
  CHECK(modal_model(body, {.mode_count = 5}).shapes.size() == 0);
}

TEST_CASE("modal_model: a free beam has two rigid-body modes, whatever its size and division") {
  for (const double length : {1e-3, 1.0, 6.0})
    for (const Eigen::Index elements : {4, 40, 400}) {
      CAPTURE(length);
      CAPTURE(elements);
      const double bending = 2.3e-7, line_mass = 7.1;
      Pencil beam = free_beam(elements, length, bending, line_mass);
      const Eigen::Index n = beam.k.rows();
      const ModalModel model = modal_model(structure(std::move(beam), at(n, {0})), {.mode_count = 3});
      CHECK(model.angular_frequency(0) == 0);
      CHECK(model.angular_frequency(1) == 0);
      const double exact = std::pow(4.730040744862704 / length, 2) * std::sqrt(bending / line_mass);
      CHECK(model.angular_frequency(2) == about(exact).epsilon(elements == 4 ? 2e-3 : 2e-7));
      // Translation and rotation of a free rod: (1 + 3)/mass at its end.
      CHECK(model.participation.col(0).head(2).squaredNorm() ==
            about(4 / (line_mass * length)).epsilon(elements < 400 ? 1e-10 : 1e-7));
    }
}

TEST_CASE("modal_model: unconnected bodies: every mode twice, or twelve times") {
  constexpr Eigen::Index n = 120;
  const Eigen::SparseMatrix<double> k = chain_stiffness(n, 2, Ends::free), m = lumped_mass(n, 3);
  const Structure two = structure({side_by_side(k, k), side_by_side(m, m)}, at(2 * n, {0, n}));
  for (const Route route : all_routes) {
    const ModalModel model = modal_model(two, {.mode_count = 20, .route = route, .residual = Residual::attached});
    CHECK(model.angular_frequency.head(2).isZero(0));
    for (Eigen::Index i = 2; i < 20; ++i)
      CHECK(model.angular_frequency(i) == about(chain_frequency(i / 2, n, 2, 3, Ends::free)).epsilon(1e-10));
    const Eigen::MatrixXd rigid = model.participation.topRows(2).transpose() * model.participation.topRows(2);
    CHECK(largest_difference(rigid, Eigen::MatrixXd::Identity(2, 2) / (3 * n)) <= 1e-12 / (3 * n));
    CHECK(std::abs(model.residual_flexibility(0, 1)) <= 1e-9 * model.residual_flexibility(0, 0));
  }
  Pencil many{chain_stiffness(20, 2, Ends::free), lumped_mass(20, 3)};
  for (int i = 1; i < 12; ++i)
    many = {side_by_side(many.k, chain_stiffness(20, 2, Ends::free)), side_by_side(many.m, lumped_mass(20, 3))};
  const ModalModel model = modal_model(structure(many, at(240, {0})), {.mode_count = 30, .route = Route::arpack});
  CHECK(model.angular_frequency.head(12).isZero(0));
  for (Eigen::Index i = 12; i < 30; ++i)
    CHECK(model.angular_frequency(i) == about(chain_frequency(i / 12, 20, 2, 3, Ends::free)).epsilon(1e-10));
}

TEST_CASE("modal_model: the consistent bar's closed form, and the whole spectrum") {
  constexpr Eigen::Index elements = 250;
  Pencil bar = consistent_bar(elements, 7, 0.3);
  const ModalModel model = modal_model(structure(std::move(bar), at(elements + 1, {0})));
  REQUIRE(model.mode_count() == elements + 1);
  for (Eigen::Index j = 0; j <= elements; ++j) {
    const double cosine = std::cos(static_cast<double>(j) * std::numbers::pi / static_cast<double>(elements));
    CHECK(model.angular_frequency(j) == about(std::sqrt(6 * 7 / 0.3 * (1 - cosine) / (2 + cosine))).epsilon(1e-10));
  }
  // All modes together answer a unit impulse with the mass matrix's inverse: (M⁻¹)₀₀ = Σφ².
  const Eigen::MatrixXd mass(consistent_bar(elements, 7, 0.3).m);
  CHECK(model.participation.squaredNorm() == about(mass.inverse()(0, 0)).epsilon(1e-12));
}

TEST_CASE("modal_model: the highest frequency selects exactly the modes up to it") {
  for (const Eigen::Index n : {100, 1000})
    for (const Ends ends : {Ends::fixed, Ends::free})
      for (const Route route : {Route::automatic, Route::tridiagonal, Route::dense, Route::arpack}) {
        if (route == Route::dense && n == 1000) continue;
        const Structure body = chain(n, 5, 2, ends);
        for (const Eigen::Index j : {0, 1, 17}) {
          const double limit = (chain_frequency(j, n, 5, 2, ends) + chain_frequency(j + 1, n, 5, 2, ends)) / 2;
          if (route == Route::arpack && n == 100) continue;  // counting by computing all modes: not for ARPACK
          CHECK(modal_model(body, {.highest_frequency_Hz = limit / two_pi, .route = route}).mode_count() == j + 1);
          CHECK(modal_model(body, {.mode_count = 1, .highest_frequency_Hz = limit / two_pi, .route = route})
                    .mode_count() == 1);
        }
        if (route == Route::arpack && n == 100) continue;
        CHECK(modal_model(body, {.highest_frequency_Hz = 0, .route = route}).mode_count() ==
              (ends == Ends::free ? 1 : 0));
      }
}

TEST_CASE("modal_model: a fixed body's residual flexibility completes its modes to the static answer") {
  for (const Eigen::Index n : {90, 600}) {
    const Structure body = chain(n, 5, 2, Ends::fixed);
    // (K⁻¹)ᵢⱼ = i (n + 1 - j)/(k (n + 1)), i ≤ j counted from 1.
    const auto exact = [n](double i, double j) {
      return i * (static_cast<double>(n) + 1 - j) / (5 * (static_cast<double>(n) + 1));
    };
    const double a = 1, b = static_cast<double>(n / 3 + 1);
    const Eigen::Matrix2d flexibility{{exact(a, a), exact(a, b)}, {exact(a, b), exact(b, b)}};
    for (const Route route : all_routes)
      for (const std::size_t count : {1U, 10U, 60U}) {
        const ModalModel model =
            modal_model(body, {.mode_count = count, .route = route, .residual = Residual::attached});
        CHECK(largest_difference(model.residual_flexibility + modal_flexibility(model), flexibility) <=
              1e-11 * flexibility.cwiseAbs().maxCoeff());
        CHECK(model.residual_flexibility(0, 0) > 0);
        CHECK(model.residual_flexibility(0, 1) == model.residual_flexibility(1, 0));
      }
  }
}

TEST_CASE("modal_model: a free body's residual flexibility is that of the modes left out") {
  Pencil beam = free_beam(30, 2, 3, 0.5);
  const Eigen::Index n = beam.k.rows();
  Eigen::MatrixXd contacts = at(n, {0, 20, 41});
  contacts(33, 1) = 0.4;
  const Structure body = structure(std::move(beam), contacts);
  const ModalModel whole = modal_model(body);
  const Eigen::MatrixXd flexibility = modal_flexibility(whole);
  for (const Route route : {Route::dense, Route::arpack})
    for (const std::size_t count : {2U, 3U, 12U, 40U}) {
      const ModalModel model = modal_model(body, {.mode_count = count, .route = route, .residual = Residual::attached});
      CHECK(largest_difference(model.residual_flexibility + modal_flexibility(model), flexibility) <=
            1e-8 * flexibility.cwiseAbs().maxCoeff());
      CHECK(model.residual_flexibility == model.residual_flexibility.transpose());
    }
  // A uniform free bar pressed at its end, inertia relief: (elastic) L/(3EA), here in its lumped form.
  for (const Eigen::Index masses : {50, 2000}) {
    const Structure bar = chain(masses, 5, 2, Ends::free);
    const ModalModel rigid = modal_model(bar, {.mode_count = 1, .residual = Residual::attached});
    const double count = static_cast<double>(masses);
    // Springs carry F(1 - i/n); free of rigid motion: Σ (1 - i/n)²/k, i = 1 ... n-1.
    CHECK(rigid.residual_flexibility(0, 0) == about((count - 1) * (2 * count - 1) / (6 * count) / 5).epsilon(1e-10));
  }
}

TEST_CASE("modal_model: nothing is left over when no mode is left out, nor where a contact does not move") {
  // The rounding of so fine a beam, 1e-7 of its static flexibility, must not pass for a residual flexibility.
  const ModalModel all = modal_model(structure(free_beam(200), at(402, {0, 120})), {.residual = Residual::attached});
  CHECK(all.residual_flexibility.isZero(0));
  for (const Eigen::Index n : {210, 250, 300, 350, 400, 450}) {
    Structure body = chain(n, 5, 2, Ends::free);
    body.contacts.col(1).setConstant(0.7);  // pushes every mass alike: rigid motion only
    const ModalModel model = modal_model(body, {.mode_count = 10, .residual = Residual::attached});
    CHECK(model.residual_flexibility(0, 0) > 0);
    CHECK(model.residual_flexibility.col(1).isZero(0));
    CHECK(model.residual_flexibility.row(1).isZero(0));
  }
}

TEST_CASE("modal_model: a rigid mass") {
  const Structure body = structure({Eigen::SparseMatrix<double>(1, 1), lumped_mass(1, 4)}, at(1, {0}));
  for (const Route route : {Route::automatic, Route::dense}) {
    const ModalModel model = modal_model(body, {.route = route, .residual = Residual::attached});
    CHECK(model.angular_frequency(0) == 0);
    CHECK(std::abs(model.participation(0, 0)) == 0.5);
    CHECK(model.residual_flexibility(0, 0) == 0);
  }
}

TEST_CASE("modal_model: the wave admittance is the structure's") {
  Structure body = chain(20, 5, 2, Ends::free);
  body.wave_admittance = Eigen::Matrix2d{{0.25, 0}, {0, 0.5}};
  CHECK(modal_model(body).wave_admittance == body.wave_admittance);
}

TEST_CASE("modal_model: the same input gives the same bits") {
  Pencil beam = free_beam(300);
  const Structure body = structure(std::move(beam), at(602, {0, 300}));
  for (const std::size_t count : {20U, 400U}) {
    const ModalOptions options{.mode_count = count, .residual = Residual::attached};
    const ModalModel a = modal_model(body, options), b = modal_model(body, options);
    CHECK(a.angular_frequency == b.angular_frequency);
    CHECK(a.participation == b.participation);
    CHECK(a.residual_flexibility == b.residual_flexibility);
  }
}

TEST_CASE("rigid_modes: the lowest elastic eigenvalue is found from millimetres to kilometres of elements") {
  for (const Eigen::Index elements : {3, 100, 3000, 100000}) {
    const Pencil bar = consistent_bar(elements, 7e3, 0.3);
    const double angle = std::numbers::pi / static_cast<double>(elements);
    const double exact = 6 * 7e3 / 0.3 * (1 - std::cos(angle)) / (2 + std::cos(angle));
    const double scale = elastic_eigenvalue_scale(bar.k, bar.m);
    CHECK(scale >= exact * (1 - 1e-6));
    CHECK(scale <= 5 * exact);
  }
  CHECK(elastic_eigenvalue_scale(sparse(Eigen::MatrixXd::Zero(3, 3)), lumped_mass(3, 1)) == 0);
}

TEST_CASE("modal_model: refusals") {
  const Structure good = chain(20, 5, 2, Ends::fixed);
  const auto refuses = [&good](const char* message, auto&& spoil) {
    Structure body = good;
    ModalOptions options;
    spoil(body, options);
    CHECK_THROWS_WITH_AS((void)modal_model(body, options), doctest::Contains(message), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses("dashpots", [](Structure& b, ModalOptions&) { b.dashpots = Eigen::VectorXd::Ones(20); });
  refuses("not square of the same size", [](Structure& b, ModalOptions&) { b.mass = lumped_mass(19, 1); });
  refuses("contacts have 19 rows", [](Structure& b, ModalOptions&) { b.contacts = Eigen::MatrixXd::Ones(19, 1); });
  refuses("a contact has an element", [nan](Structure& b, ModalOptions&) { b.contacts(3, 0) = nan; });
  refuses("wave admittance 3 x 3 for 2",
          [](Structure& b, ModalOptions&) { b.wave_admittance = Eigen::Matrix3d::Zero(); });
  refuses("stiffness matrix is not symmetric", [](Structure& b, ModalOptions&) { b.stiffness.coeffRef(0, 1) = 0; });
  refuses("stiffness matrix has an element that is not finite",
          [nan](Structure& b, ModalOptions&) { b.stiffness.coeffRef(0, 1) = nan; });
  refuses("degree of freedom 4 has 0", [](Structure& b, ModalOptions&) { b.mass.coeffRef(4, 4) = 0; });
  refuses("no modes are asked for", [](Structure&, ModalOptions& o) { o.mode_count = 0; });
  refuses("highest frequency of the modes, -1 Hz", [](Structure&, ModalOptions& o) { o.highest_frequency_Hz = -1; });
  refuses("highest frequency", [nan](Structure&, ModalOptions& o) { o.highest_frequency_Hz = nan; });
  refuses("use the dense or the arpack route", [](Structure& b, ModalOptions& o) {
    b.mass = sparse(Eigen::MatrixXd(b.mass) + Eigen::MatrixXd::Constant(20, 20, 0.01));
    o.route = Route::tridiagonal;
  });
  refuses("use the dense method", [](Structure&, ModalOptions& o) { o.route = Route::arpack; });
  for (const Route route : all_routes)
    refuses("not positive semidefinite", [route](Structure& b, ModalOptions& o) {
      b.stiffness.coeffRef(7, 7) = -1;
      o.route = route;
      o.mode_count = 5;
    });
  const Eigen::SparseMatrix<double> k = chain_stiffness(150, 2, Ends::free), m = lumped_mass(150, 3);
  refuses("1 of 2 rigid-body modes", [&](Structure& b, ModalOptions& o) {
    b = structure({side_by_side(k, k), side_by_side(m, m)}, at(300, {0}));
    o.mode_count = 1;
    o.residual = Residual::attached;
  });
}

TEST_CASE("require_valid: refusals") {
  const ModalModel good = modal_model(chain(20, 5, 2, Ends::free), {.mode_count = 4});
  CHECK_NOTHROW(require_valid(good));
  const auto refuses = [&good](const char* message, auto&& spoil) {
    ModalModel body = good;
    spoil(body);
    CHECK_THROWS_WITH_AS(require_valid(body), doctest::Contains(message), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses("do not make a modal model", [](ModalModel& b) { b.damping_ratio.resize(3); });
  refuses("residual flexibility 1 x 1 for 2", [](ModalModel& b) { b.residual_flexibility.setZero(1, 1); });
  refuses("wave admittance 1 x 1 for 2", [](ModalModel& b) { b.wave_admittance.setZero(1, 1); });
  refuses("not finite", [nan](ModalModel& b) { b.participation(1, 1) = nan; });
  refuses("not finite", [nan](ModalModel& b) { b.residual_flexibility(1, 1) = nan; });
  refuses("mode 1 has the negative angular frequency", [](ModalModel& b) { b.angular_frequency(0) = -1; });
  refuses("mode 2 (0 rad/s) is below",
          [](ModalModel& b) { std::swap(b.angular_frequency(0), b.angular_frequency(1)); });
  refuses("damping ratio 1,", [](ModalModel& b) { b.damping_ratio(0) = 1; });
  refuses("damping ratio -0.1,", [](ModalModel& b) { b.damping_ratio(0) = -0.1; });
}

TEST_CASE("modal_model: a dense structure has the modes, residuals and outputs of the sparse one") {
  for (const Structure& body : {irregular_chain(60), chain(60, 1e6, 0.2, Ends::free)}) {
    Structure with_outputs = body;
    with_outputs.outputs = at(60, {17, 40});
    DenseStructure dense;
    dense.stiffness = body.stiffness;
    dense.mass = body.mass;
    dense.contacts = body.contacts;
    dense.outputs = with_outputs.outputs;
    for (const ModalOptions& options :
         {ModalOptions{.mode_count = 9, .residual = Residual::attached},
          ModalOptions{.highest_frequency_Hz = 200, .residual = Residual::attached},
          ModalOptions{.mode_count = 1, .residual = Residual::attached}, ModalOptions{.highest_frequency_Hz = 0}}) {
      const ModalModel a = modal_model(dense, options), b = modal_model(with_outputs, options);
      REQUIRE(a.mode_count() == b.mode_count());
      if (a.mode_count() == 0) continue;
      CHECK((a.angular_frequency - b.angular_frequency).cwiseAbs().maxCoeff() <= 1e-9 * b.angular_frequency.maxCoeff());
      // Signs of modes are arbitrary: products of participations are not.
      for (Eigen::Index i = 0; i < a.mode_count(); ++i) {
        CHECK((a.participation.row(i).transpose() * a.participation.row(i) -
               b.participation.row(i).transpose() * b.participation.row(i))
                  .norm() < 1e-7);
        CHECK((a.output_participation.row(i).transpose() * a.participation.row(i) -
               b.output_participation.row(i).transpose() * b.participation.row(i))
                  .norm() < 1e-7);
      }
      CHECK((a.residual_flexibility - b.residual_flexibility).norm() <= 1e-9 * modal_flexibility(b).norm() + 1e-12);
      CHECK((a.residual_outputs - b.residual_outputs).norm() <= 1e-9 * modal_flexibility(b).norm() + 1e-12);
    }
  }
}

TEST_CASE("modal_model: outputs and what the modes leave out add up to the static answer") {
  Structure body = irregular_chain(50);
  body.outputs = at(50, {7, 30, 44});
  const Eigen::MatrixXd exact = body.outputs.transpose() * Eigen::MatrixXd(body.stiffness).llt().solve(body.contacts);
  for (const std::size_t count : {1u, 10u, 49u, 50u}) {
    const ModalModel model = modal_model(body, {.mode_count = count, .residual = Residual::attached});
    const Eigen::MatrixXd sum =
        model.residual_outputs + model.output_participation.transpose() *
                                     model.angular_frequency.array().square().inverse().matrix().asDiagonal() *
                                     model.participation;
    CHECK((sum - exact).norm() < 1e-10 * exact.norm());
  }
}

TEST_CASE("modal_model: refusals of dense structures and of outputs") {
  DenseStructure body;
  body.stiffness = Eigen::MatrixXd::Identity(70, 70);
  body.mass = Eigen::MatrixXd::Identity(70, 70);
  body.contacts = at(70, {0});
  CHECK_NOTHROW((void)modal_model(body));
  CHECK_THROWS_WITH((void)modal_model(body, {.route = Route::arpack}), "a dense structure takes the dense route only");
  body.outputs = Eigen::MatrixXd::Zero(3, 1);
  CHECK_THROWS_WITH((void)modal_model(body), doctest::Contains("outputs 3 x 1 do not fit 70 degrees of freedom"));
  body.outputs.resize(0, 0);
  body.stiffness(68, 1) = 1e-3;
  CHECK_THROWS_WITH((void)modal_model(body), doctest::Contains("the stiffness matrix is not symmetric"));
  body.stiffness(1, 68) = 1e-3;
  body.stiffness(0, 0) = -1;
  CHECK_THROWS_WITH((void)modal_model(body), doctest::Contains("the stiffness matrix is not positive semidefinite"));
  ModalModel model = modal_model(irregular_chain(5));
  model.output_participation = Eigen::MatrixXd::Zero(2, 1);
  CHECK_THROWS_WITH(require_valid(model), doctest::Contains("output participations 2 x 1 and their residuals"));
}
