#include "impulse/bodies/ritz_plate.hpp"

#include "lib/model/modal_model.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

using namespace impulse;
using Theory = Plate::Theory;

namespace {

constexpr double pi = std::numbers::pi;
const Ply ply{"test", 40, 1, 0.25, 0.6, 0.6, 0.5, 1};

Plate plate_of(const PlateShape& shape, const std::string& layup, double thickness, Theory theory,
               const std::string& edges) {
  Plate plate;
  plate.shape = shape;
  plate.laminate = laminate(layers_of(layup, ply, thickness));
  plate.theory = theory;
  plate.edges = parse_plate_edges(edges);
  return plate;
}

PlateShape rhombus(double skew_deg) {
  const double s = std::sin(skew_deg * pi / 180), c = std::cos(skew_deg * pi / 180);
  return {{{{0, 0}, {1, 0}, {1 + s, c}, {s, c}}}};
}

const PlateShape trapezoid{{{{0.1, -0.5}, {1, -0.25}, {1.3, 0.4}, {0, 0.5}}}};

Eigen::VectorXd frequencies(const Plate& plate, std::size_t terms, std::size_t count = 12) {
  return modal_model(RitzPlate(plate, terms).structure(), {.mode_count = count}).angular_frequency;
}

double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return ((a - b).array() / b.array()).abs().maxCoeff();
}

/// Static deflection at one point under a unit force at another.
double flexibility(const RitzPlate& plate, const Eigen::VectorXd& at, const Eigen::VectorXd& load) {
  return at.dot(Eigen::VectorXd(DenseCholesky::of(plate.structure().stiffness)->solve(load)));
}

}  // namespace

TEST_CASE("a simply supported thin plate has Navier's frequencies and flexibility") {
  const Plate plate = plate_of(rectangle(3, 2), "[0/90/0]", 0.02, Theory::thin, "WWWW");
  const Eigen::Matrix3d& d = plate.laminate.bending;
  const auto navier = [&](int m, int n) {
    const double a = m * pi / 3, b = n * pi / 2;
    return d(0, 0) * std::pow(a, 4) + 2 * (d(0, 1) + 2 * d(2, 2)) * a * a * b * b + d(1, 1) * std::pow(b, 4);
  };
  std::vector<double> exact;
  for (int m = 1; m < 30; ++m)
    for (int n = 1; n < 30; ++n) exact.push_back(std::sqrt(navier(m, n) / plate.laminate.mass_kg_per_m2));
  std::ranges::sort(exact);
  const Eigen::VectorXd omega = frequencies(plate, 20);
  for (Eigen::Index i = 0; i < 12; ++i)  // 20 terms converge to rounding
    CHECK(omega(i) == about(exact[static_cast<std::size_t>(i)]).epsilon(1e-9));
  // The edge of a patch is a kink of the load: n^-4.
  const double radius = 0.3;
  double patch = 0;
  for (int m = 1; m < 200; m += 2)
    for (int n = 1; n < 200; n += 2) {
      const double k = pi * radius * std::hypot(m / 3.0, n / 2.0), mean = 2 * std::cyl_bessel_j(1, k) / k;
      patch += mean * mean * 4 / (6 * navier(m, n));
    }
  const RitzPlate ritz(plate, 20);
  const Eigen::VectorXd load = ritz.mean_deflection({0, 0}, radius);
  CHECK(flexibility(ritz, load, load) == about(patch).epsilon(5e-5));
}

TEST_CASE("Ritz frequencies fall towards their limits, without losing digits, and the matrices are well conditioned") {
  const Plate plate = plate_of(rhombus(45), "[45/-45]", 0.1, Theory::shear, "CCCC");
  Eigen::VectorXd before;
  for (const std::size_t terms : {6, 9, 12, 15}) {
    const DenseStructure body = RitzPlate(plate, terms).structure();
    const Eigen::VectorXd omega = modal_model(body, {.mode_count = 10}).angular_frequency;
    // A larger space cannot raise a frequency: rounding is all that could.
    if (before.size() > 0) CHECK(((before - omega).array() / omega.array()).minCoeff() > -1e-12);
    before = omega;
    CHECK(scaled_condition(body.stiffness) < 200);
    CHECK(scaled_condition(body.mass) < 1 + 1e-9);
  }
  // Functions of free ends overlap with the others; M is never factorised.
  CHECK(scaled_condition(
            RitzPlate(plate_of(rhombus(45), "[45/-45]", 0.1, Theory::shear, "FFFF"), 12).structure().mass) < 1e5);
}

TEST_SUITE("slow") {
  TEST_CASE("30 terms a side on a 45 degree skew laminate") {
    const Plate plate = plate_of(rhombus(45), "[45/-45/45/-45/45]", 0.1, Theory::shear, "CCCC");
    const DenseStructure body = RitzPlate(plate, 30).structure();
    CHECK(scaled_condition(body.stiffness) < 120);
    CHECK(scaled_condition(body.mass) < 1 + 1e-9);
    const Eigen::VectorXd coarse = frequencies(plate, 24, 10),
                          fine = modal_model(body, {.mode_count = 10}).angular_frequency;
    CHECK(((coarse - fine).array() / fine.array()).minCoeff() > -1e-12);
    CHECK(difference(coarse, fine) < 1e-5);  // the corners' singularity
  }
}

TEST_CASE("a free plate has its rigid-body modes, and its mass") {
  for (const Theory theory : {Theory::shear, Theory::thin})
    for (const char* layup : {"[0/90/0]", "[10/50]"}) {
      const Plate plate = plate_of(trapezoid, layup, 0.05, theory, "FFFF");
      const RitzPlate ritz(plate, 8);
      DenseStructure body = ritz.structure();
      body.contacts.resize(ritz.unknown_count(), 1);
      body.contacts << ritz.deflection(trapezoid.reference({0.5, 0.1}));
      const ModalModel modes = modal_model(body, {.mode_count = 9});
      const Eigen::Index rigid = (modes.angular_frequency.array() == 0).count();
      CHECK(rigid == (moves_in_plane(plate) ? 6 : 3));
      // A force at the centre of mass moves the plate like a point mass, one beside it more.
      const double mobility = modes.participation.topRows(rigid).squaredNorm();
      CHECK(mobility > 1 / mass_kg(plate));
      CHECK(mobility < 1.1 / mass_kg(plate));
    }
}

TEST_CASE("frequencies depend neither on the sense nor on the start of the corners, nor on where the plate lies") {
  for (const Theory theory : {Theory::shear, Theory::thin}) {
    const Plate plate = plate_of(trapezoid, "[10/50/-30]", 0.1, theory, "CSFW");
    const Eigen::VectorXd omega = frequencies(plate, 9);
    const auto& c = trapezoid.corners;
    Plate other = plate;
    other.shape = {{{c[1], c[2], c[3], c[0]}}};
    other.edges = parse_plate_edges("SFWC");
    CHECK(difference(frequencies(other, 9), omega) < 1e-9);
    other.shape = {{{c[0], c[3], c[2], c[1]}}};  // clockwise
    other.edges = parse_plate_edges("WFSC");
    CHECK(difference(frequencies(other, 9), omega) < 1e-9);
    // Turned by 35°, the fibres with it.
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(35 * pi / 180).toRotationMatrix();
    other = plate;
    for (Eigen::Vector2d& corner : other.shape.corners) corner = turn * corner + Eigen::Vector2d(3, -2);
    other.laminate = laminate(layers_of("[45/85/5]", ply, 0.1));
    CHECK(difference(frequencies(other, 9), omega) < 1e-9);
  }
}

TEST_CASE("stiff springs tend to the supports, from below") {
  for (const Theory theory : {Theory::shear, Theory::thin}) {
    const Eigen::VectorXd held = frequencies(plate_of(trapezoid, "[10/50]", 0.1, theory, "CCCC"), 9, 3);
    Plate sprung = plate_of(trapezoid, "[10/50]", 0.1, theory, "FFFF");
    double gap = 1;
    for (const double stiffness : {1e3, 1e5, 1e7}) {
      sprung.springs.fill({stiffness, stiffness, stiffness, stiffness, stiffness});
      const Eigen::VectorXd omega = frequencies(sprung, 9, 3);
      CHECK(omega(0) < held(0));
      CHECK(1 - omega(0) / held(0) < gap / 10);
      gap = 1 - omega(0) / held(0);
    }
    CHECK(gap < 1e-3);
  }
}

TEST_CASE("shear deformation fades with the thickness, like its square") {
  double before = 0;
  for (const double h : {0.04, 0.02, 0.01, 0.005}) {
    const double shear = frequencies(plate_of(trapezoid, "[10/50/10]", h, Theory::shear, "CCCC"), 10, 1)(0);
    const double thin = frequencies(plate_of(trapezoid, "[10/50/10]", h, Theory::thin, "CCCC"), 10, 1)(0);
    const double gap = 1 - shear / thin;
    CHECK(gap > 0);
    if (h < 0.03) CHECK(std::log2(before / gap) == about(2).epsilon(0.15));
    before = gap;
  }
}

TEST_CASE("a patch averages the deflection, whatever the shape") {
  const Plate plate = plate_of(trapezoid, "[0/90/0]", 0.1, Theory::shear, "FFFF");
  const RitzPlate ritz(plate, 8);
  const DenseStructure body = ritz.structure();
  const Eigen::VectorXd patch = ritz.mean_deflection({0.2, -0.1}, 0.1), point = ritz.deflection({0.2, -0.1});
  // Rigid-body motion: its mean over a disc is that of the centre. M⁻¹ times a load's rigid part would do; here the
  // tilt w = x is in the space, so take its coefficients by least squares at points.
  const Eigen::Index n = ritz.unknown_count();
  Eigen::MatrixXd samples(225, n);
  Eigen::VectorXd tilt(225), parabola(225);
  for (int i = 0; i < 15; ++i)
    for (int j = 0; j < 15; ++j) {
      const Eigen::Vector2d at(-1 + i / 7.0, -1 + j / 7.0), p = trapezoid.position(at);
      samples.row(15 * i + j) = ritz.deflection(at);
      tilt(15 * i + j) = 3 + 2 * p.x() - p.y();
      parabola(15 * i + j) = p.squaredNorm();
    }
  const Eigen::MatrixXd w = samples.leftCols(64);  // w comes first where there is no motion in the plane
  const auto coefficients = [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
    return w.colPivHouseholderQr().solve(values);
  };
  const Eigen::VectorXd a = coefficients(tilt), b = coefficients(parabola);
  CHECK(patch.head(64).dot(a) == about(point.head(64).dot(a)).epsilon(1e-12));
  // The mean of r² about the centre is R²/2.
  CHECK(patch.head(64).dot(b) - point.head(64).dot(b) == about(0.005).epsilon(1e-9));
  CHECK_THROWS_WITH((void)ritz.mean_deflection({0.9, 0}, 0.2), doctest::Contains("leaves the plate (an edge is 0.0"));
  CHECK_THROWS_WITH((void)ritz.mean_deflection({0, 0}, 0), doctest::Contains("is not positive and finite"));
}

TEST_CASE("strains are the derivatives of the displacements") {
  for (const Theory theory : {Theory::shear, Theory::thin}) {
    Plate plate = plate_of(rectangle(1, 0.8), "[0]", 0.002, theory, "CCCC");
    const RitzPlate ritz(plate, 14);
    const Eigen::VectorXd u =
        DenseCholesky::of(ritz.structure().stiffness)->solve(ritz.mean_deflection({0, 0}, 0.2)).col(0);
    const double h = 1e-3;
    const auto w = [&](double a, double b) { return ritz.deflection({0.1 + 2 * a * h, 0.1 + 2 * b * h / 0.8}).dot(u); };
    const double w_xx = (w(1, 0) - 2 * w(0, 0) + w(-1, 0)) / (h * h),
                 w_yy = (w(0, 1) - 2 * w(0, 0) + w(0, -1)) / (h * h);
    const double w_xy = (w(1, 1) - w(1, -1) - w(-1, 1) + w(-1, -1)) / (4 * h * h);
    const Eigen::Vector3d strain = ritz.strains({0.1, 0.1}, 0.0008).transpose() * u;
    const double tolerance =
        theory == Theory::thin ? 1e-4 : 2e-3;  // w has a share from shear that bends nothing, like (h/a)²
    CHECK(strain(0) == about(-0.0008 * w_xx).epsilon(tolerance));
    CHECK(strain(1) == about(-0.0008 * w_yy).epsilon(tolerance));
    CHECK(strain(2) == about(-0.0016 * w_xy).epsilon(tolerance));
    CHECK_THROWS_WITH((void)ritz.strains({0, 0}, 0.0012), "z = 0.0012 m is outside the plate");
  }
}

TEST_CASE("a curved panel is struck on its convex side: it presses together along the arc") {
  Plate plate = plate_of(rectangle(1, 1), "[0]", 0.01, Theory::shear, "IIII");
  plate.curvature_per_m = 0.5;
  const RitzPlate ritz(plate, 10);
  const Eigen::VectorXd load = ritz.mean_deflection({0, 0}, 0.2);
  const Eigen::VectorXd u = DenseCholesky::of(ritz.structure().stiffness)->solve(load).col(0);
  CHECK((ritz.strains({0, 0}, 0).transpose() * u)(1) < 0);
  const double curved = load.dot(u);
  plate.curvature_per_m = -0.5;
  const RitzPlate concave(plate, 10);
  CHECK(flexibility(concave, load, load) == about(curved).epsilon(1e-9));  // linear: the sign is a mirror's
  plate.curvature_per_m = 0;
  const RitzPlate flat(plate, 10);
  const Eigen::VectorXd flat_load = flat.mean_deflection({0, 0}, 0.2);
  CHECK(flexibility(flat, flat_load, flat_load) > 2 * curved);
}

TEST_CASE("plates refuse what makes no sense") {
  const Plate plate = plate_of(rectangle(1, 1), "[0]", 0.01, Theory::shear, "SSSS");
  const auto refused = [&](auto&& change, const char* message) {
    Plate wrong = plate;
    change(wrong);
    CHECK_THROWS_WITH((void)RitzPlate(wrong, 8), doctest::Contains(message));
  };
  refused([](Plate& p) { p.shear_correction = 0; }, "the shear correction factor 0 is not positive and finite");
  refused([](Plate& p) { p.curvature_per_m = NAN; }, "the curvature nan 1/m is not finite");
  refused([](Plate& p) { p.curvature_per_m = -10; },
          "a panel of 1 m along y goes round its radius of 0.1 m once or more; use more than 0.1592 m");
  refused([](Plate& p) { p.springs[2].normal_rotation_N = -1; }, "a spring of edge 3 has the stiffness -1");
  refused([](Plate& p) { p.laminate = {}; }, "give it a laminate");
  refused([](Plate& p) { p.shape.corners[2] = {0.2, 0.2}; }, "makes the plate concave");
  CHECK_THROWS_WITH((void)RitzPlate(plate_of(rectangle(1, 1), "[0]", 0.01, Theory::shear, "CCCC"), 2),
                    "the edges hold every term of 2 a side; use more");
  CHECK_THROWS_WITH((void)RitzPlate(plate_of(rectangle(1, 1), "[0]", 0.01, Theory::thin, "CCCC"), 3),
                    "3 terms a side make no thin plate; use at least 4");
  CHECK_THROWS_WITH((void)parse_plate_edges("SSS"), "edges 'SSS' are 3, not four letters such as SSSS");
  CHECK_THROWS_WITH((void)parse_plate_edges("SSXS"), "edges 'SSXS': 'X' is none of C, F, I, H, S, T, W");
}
