#include "impulse/bodies/ritz_plate.hpp"

#include "lib/model/modal_model.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

// Values of independent p-Ritz, series and finite-element programs, all digits printed converged, where not said
// otherwise.

using namespace impulse;

namespace {

using Values = std::vector<double>;
constexpr double pi = std::numbers::pi;
using Theory = Plate::Theory;

PlateShape rhombus(double skew_deg) {
  const double s = std::sin(skew_deg * pi / 180), c = std::cos(skew_deg * pi / 180);
  return {{{{0, 0}, {1, 0}, {1 + s, c}, {s, c}}}};
}

Plate isotropic(const PlateShape& shape, double thickness, Theory theory, double e = 1, double rho = 1) {
  Plate plate;
  plate.shape = shape;
  const Ply ply{"isotropic", e, e, 0.3, e / 2.6, e / 2.6, e / 2.6, rho};
  plate.laminate = laminate({{ply, 0, thickness}});
  plate.theory = theory;
  return plate;
}

Plate laminated(const PlateShape& shape, const std::string& layup, double thickness, double e1, double g = 0.6,
                double g23 = 0.5) {
  Plate plate;
  plate.shape = shape;
  plate.laminate = laminate(layers_of(layup, {"composite", e1, 1, 0.25, g, g, g23, 1}, thickness));
  return plate;
}

/// Angular frequencies, the rigid-body modes left out.
Values frequencies(Plate plate, const std::string& edges, std::size_t terms, std::size_t count) {
  plate.edges = parse_plate_edges(edges);
  const ModalModel modes = modal_model(RitzPlate(plate, terms).structure(), {.mode_count = count + 6});
  Values result;
  for (const double omega : modes.angular_frequency)
    if (omega > 0 && result.size() < count) result.push_back(omega);
  return result;
}

void check(const std::string& what, const Values& values, double scale, const Values& expected, double tolerance) {
  REQUIRE(values.size() >= expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    INFO(what, ", mode ", i + 1, ": ", values[i] * scale, " for ", expected[i]);
    CHECK(std::abs(values[i] * scale - expected[i]) <= tolerance * expected[i]);
  }
}

double skew_tolerance(const std::string& edges, double skew) {
  if (edges == "CCCC") return 1e-3;
  if (edges == "FFFC") return 3e-3;
  return skew <= 15 ? 3e-3 : 1.5e-2;  // the obtuse corner is singular
}

}  // namespace

TEST_CASE("NAFEMS plates FV12, FV13, FV15, FV16, FV21") {
  const Plate thin = isotropic(rectangle(10, 10), 0.05, Theory::shear, 200e9, 8000);
  const double to_Hz = 1 / (2 * pi);
  const Values fv12 = frequencies(thin, "FFFF", 14, 8);
  check("FV12", fv12, to_Hz, {1.6206, 2.3593, 2.9219, 4.1870, 4.1870, 7.3537, 7.3537, 7.660}, 2e-4);
  check("FV12, published", fv12, to_Hz, {1.622, 2.360, 2.922, 4.233, 4.233, 7.416, 7.416}, 0.02);
  const Values fv13 = frequencies(thin, "SSSS", 14, 8);
  check("FV13", fv13, to_Hz, {2.3765, 5.9405, 5.9405, 9.5034, 11.8782, 11.8782, 15.4396, 15.4396}, 2e-5);
  check("FV13, published", fv13, to_Hz, {2.377, 5.942, 5.942, 9.507, 11.884, 11.884, 15.449, 15.449}, 0.02);
  const Values fv16 = frequencies(thin, "FFFC", 16, 6);
  check("FV16", fv16, to_Hz, {0.4179, 1.0236, 2.5621, 3.2733, 3.7244, 6.5171}, 3e-4);
  check("FV16, published", fv16, to_Hz, {0.421, 1.029, 2.582, 3.306, 3.753, 6.555}, 0.02);
  PlateShape skew = rhombus(45);
  for (Eigen::Vector2d& corner : skew.corners) corner *= 10;
  const Values fv15 = frequencies(isotropic(skew, 0.05, Theory::shear, 200e9, 8000), "CCCC", 16, 6);
  check("FV15", fv15, to_Hz, {7.8995, 12.812, 17.838, 18.911, 23.660, 27.590}, 1e-3);
  check("FV15, published", fv15, to_Hz, {7.938, 12.835, 17.941, 19.133, 24.009, 27.922}, 0.02);
  const Plate thick = isotropic(rectangle(10, 10), 1, Theory::shear, 200e9, 8000);
  const Values fv21 = frequencies(thick, "SSSS", 14, 8);
  check("FV21", fv21, to_Hz, {45.911, 109.528, 109.528, 168.074, 204.782, 204.782, 256.907, 256.907}, 2e-5);
  check("FV21, published", fv21, to_Hz, {45.897, 109.44, 109.44, 167.89, 204.51, 204.51, 256.50, 256.50}, 0.02);
  check("FV21, soft", frequencies(thick, "WWWW", 16, 4), to_Hz, {44.110, 106.98, 106.98, 162.33}, 2e-4);
}

TEST_CASE("isotropic rhombic thin plates") {
  struct Row {
    double skew;
    const char* edges;
    Values expected;
  };
  for (const Row& row : {
           Row{0, "CCCC", {35.9852, 73.3938, 73.3938, 108.2165}},
           {15, "CCCC", {38.1867, 72.8960, 82.6182, 109.561}},
           {30, "CCCC", {46.0895, 81.6006, 105.167, 119.252}},
           {45, "CCCC", {65.643, 106.495, 148.312, 157.235}},
           {60, "CCCC", {121.645, 177.721, 231.750, 291.52}},
           {0, "WWWW", {19.7392, 49.348, 49.348, 78.957}},
           {15, "WWWW", {20.869, 48.205, 56.108, 79.04}},
           {30, "WWWW", {24.92, 52.638, 71.76, 83.84}},
           {45, "WWWW", {35.0, 66.278, 100.33, 107.6}},
           {60, "WWWW", {64.7, 104.955, 148.29, 196.29}},
           {0, "FFFC", {3.471, 8.506, 21.284, 27.199}},
           {15, "FFFC", {3.583, 8.697, 22.230, 26.332}},
           {30, "FFFC", {3.929, 9.410, 25.289, 25.932}},
           {45, "FFFC", {4.508, 11.250, 26.972, 31.511}},
           {60, "FFFC", {5.250, 16.06, 30.41, 45.33}},
       }) {
    const Plate plate = isotropic(rhombus(row.skew), 0.01, Theory::thin);
    const double scale = std::sqrt(plate.laminate.mass_kg_per_m2 / plate.laminate.bending(0, 0));
    check(fmt::format("skew {}, {}", row.skew, row.edges), frequencies(plate, row.edges, 20, 4), scale, row.expected,
          skew_tolerance(row.edges, row.skew));
  }
}

TEST_CASE("laminated squares") {
  const auto square = [](const std::string& layup, double ratio, double e1, const std::string& edges,
                         std::size_t count) {
    Values values = frequencies(laminated(rectangle(1, 1), layup, 1 / ratio, e1), edges, count > 1 ? 12 : 9, count);
    for (double& value : values) value *= ratio;
    return values;
  };
  const auto lowest = [&](const std::string& layup, const Values& ratios, const Values& moduli,
                          const std::string& edges, const Values& expected, double tolerance) {
    Values values;
    for (const double ratio : ratios)
      for (const double e1 : moduli) values.push_back(square(layup, ratio, e1, edges, 1)[0]);
    check(layup + " " + edges, values, 1, expected, tolerance);
  };
  lowest("[0/90/90/0]", {4, 5, 10, 20, 25, 50, 100}, {40}, "TTTT",
         {9.3949, 10.8540, 15.1426, 17.6596, 18.0708, 18.6742, 18.8362}, 2e-5);
  lowest("[0/90/90/0]", {5}, {3, 10, 20, 30, 40}, "TTTT", {6.5695, 8.2982, 9.5671, 10.3258, 10.8540}, 2e-5);
  lowest("[0/90]", {5}, {3, 10, 20, 30, 40}, "TTTT", {6.2085, 6.9392, 7.7060, 8.3211, 8.8333}, 2e-5);
  lowest("[0/90]2", {5}, {3, 10, 20, 30, 40}, "TTTT", {6.5043, 8.2246, 9.6885, 10.6198, 11.2708}, 2e-5);
  lowest("[0/90]", {5, 10, 20, 50, 100}, {40}, "TTTT", {8.8333, 10.4731, 11.0779, 11.2705, 11.2990}, 2e-5);
  lowest("[45/-45]", {5, 10, 20, 50, 100}, {40}, "SSSS", {10.335, 13.044, 14.179, 14.561, 14.618}, 5e-5);
  lowest("[45/-45]4", {5, 10, 20, 50, 100}, {40}, "SSSS", {12.892, 19.289, 23.259, 24.909, 25.176}, 5e-5);
  for (const auto& [layup, expected] : {std::pair{"[30/-30]", 12.6807},
                                        {"[30/-30]2", 17.6343},
                                        {"[30/-30]5", 18.5058},
                                        {"[45/-45]", 13.0439},
                                        {"[45/-45]2", 18.4633},
                                        {"[45/-45]5", 19.3804}})
    lowest(layup, {10}, {40}, "SSSS", {expected}, 2e-5);
  for (const auto& [layup, expected] : {std::pair{"[30/-30]", 6.9479},
                                        {"[30/-30]2", 9.6111},
                                        {"[30/-30]5", 10.1075},
                                        {"[45/-45]", 4.7631},
                                        {"[45/-45]2", 6.2645},
                                        {"[45/-45]5", 6.5655}})
    lowest(layup, {10}, {40}, "FSFS", {expected}, 2e-4);
  check("[45/-45]2, in-plane modes between", square("[45/-45]2", 10, 40, "SSSS", 7), 1,
        {18.4633, 34.414, 34.8739, 34.8739, 50.520, 54.274, 54.274}, 5e-5);
}

TEST_CASE("laminated rhombic plates") {
  struct Row {
    double skew;
    const char* layup;
    const char* edges;
    double expected;
  };
  std::vector<Row> rows;
  const double skews[] = {0, 15, 30, 45, 60};
  const auto add = [&](const char* layup, const char* edges, const Values& expected) {
    for (std::size_t i = 0; i < 5; ++i) rows.push_back({skews[i], layup, edges, expected[i]});
  };
  add("[90/0/90/0/90]", "CCCC", {2.3820, 2.4749, 2.7921, 3.4737, 4.9529});
  add("[90/0/90/0/90]", "HHHH", {1.5699, 1.6862, 2.0813, 2.8728, 4.4793});
  add("[90/0/90/0/90]", "IIII", {1.5628, 1.6658, 2.0084, 2.7344, 4.3132});
  add("[90/0/90/0/90]", "FFFC", {0.2986, 0.3011, 0.3144, 0.3438, 0.3839});
  add("[45/-45/45/-45/45]", "CCCC", {2.2857, 2.3514, 2.6626, 3.3522, 4.8507});
  add("[45/-45/45/-45/45]", "HHHH", {1.8790, 1.8792, 1.9992, 2.4732, 3.8445});
  add("[45/-45/45/-45/45]", "IIII", {1.6701, 1.6767, 1.8585, 2.3676, 3.7143});
  add("[45/-45]", "CCCC", {1.8141, 1.9123, 2.2365, 2.9179, 4.4152});
  add("[45/-45]", "HHHH", {1.5823, 1.6319, 1.8527, 2.4217, 3.8175});
  add("[0/90]", "CCCC", {1.8963, 1.9766, 2.2620, 2.9179, 4.4261});
  for (const Row& row : rows) {
    const Plate plate = laminated(rhombus(row.skew), row.layup, 0.1, 40);
    check(fmt::format("skew {}, {} {}", row.skew, row.layup, row.edges), frequencies(plate, row.edges, 11, 1),
          10 / (pi * pi), {row.expected}, skew_tolerance(row.edges, row.skew));
  }
}

TEST_CASE("trapezoids and a wing") {
  const PlateShape t1{{{{0, -0.5}, {1, -0.25}, {1, 0.25}, {0, 0.5}}}};
  const PlateShape t2{{{{0, 0}, {2, 1}, {2, 1.5}, {0, 1}}}};
  const auto isotropic_row = [](const char* what, const PlateShape& shape, double h, const char* edges,
                                const Values& expected) {
    const Plate plate = isotropic(shape, h, Theory::shear);
    check(what, frequencies(plate, edges, 16, 5),
          std::sqrt(plate.laminate.mass_kg_per_m2 / plate.laminate.bending(0, 0)), expected,
          std::string(edges) == "CCCC" ? 1e-3 : 3e-3);
  };
  isotropic_row("T1 thin", t1, 0.01, "FFFC", {4.180, 14.548, 22.634, 41.774, 56.410});
  isotropic_row("T1 thin", t1, 0.01, "CCCC", {52.193, 89.283, 114.395, 145.341, 162.654});
  isotropic_row("T1", t1, 0.1, "FFFC", {4.1247, 13.6079, 21.3813, 37.4412, 50.472});
  isotropic_row("T1", t1, 0.1, "CCCC", {45.3602, 73.3338, 90.0835, 111.561, 120.873});
  isotropic_row("T2", t2, 0.1, "FFFC", {0.9469, 4.8801, 6.1820, 12.6548, 16.2229});
  isotropic_row("T2", t2, 0.1, "CCCC", {36.5804, 47.1607, 57.7377, 69.2812, 80.2101});
  const auto laminated_row = [](const char* what, const PlateShape& shape, const char* layup, const char* edges,
                                const Values& expected) {
    Plate plate = laminated(shape, layup, 0.1, 40);
    plate.in_plane = Plate::InPlane::always;  // mode 4 of the last row is in the plane
    check(what, frequencies(plate, edges, 14, expected.size()), 10, expected,
          std::string(edges) == "CCCC" ? 1e-3 : 3e-3);
  };
  laminated_row("T1 [30/-30]s", t1, "[30/-30]s", "FFFC", {4.345, 11.7405, 17.8201, 25.9427});
  laminated_row("T1 [30/-30]s", t1, "[30/-30]s", "CCCC", {25.7821, 41.0832, 44.5157, 57.7356});
  laminated_row("T1 [45/-45]", t1, "[45/-45]", "FFFC", {2.1544, 9.5739, 10.4558, 17.2081});
  laminated_row("T2 [30/-30]s", t2, "[30/-30]s", "FFFC", {1.3204, 4.5522, 6.5112, 7.2916});
}

TEST_CASE("boundary springs") {
  Plate plate = isotropic(rectangle(1, 1), 0.001, Theory::thin);
  const double d = plate.laminate.bending(0, 0), scale = std::sqrt(plate.laminate.mass_kg_per_m2 / d);
  const auto with = [&](double EdgeSprings::*spring, double stiffness, const char* edges) {
    Plate sprung = plate;
    for (EdgeSprings& s : sprung.springs) s.*spring = stiffness * d;
    return frequencies(sprung, edges, 14, 2);
  };
  const auto rotation = &EdgeSprings::normal_rotation_N;
  check("rotational 0", with(rotation, 0, "WWWW"), scale, {19.739, 49.347}, 1e-3);
  check("rotational 1", with(rotation, 1, "WWWW"), scale, {21.501, 51.190}, 1e-3);
  check("rotational 10", with(rotation, 10, "WWWW"), scale, {28.502, 60.215}, 1e-3);
  check("rotational 100", with(rotation, 100, "WWWW"), scale, {34.671, 70.779}, 1e-3);
  check("rotational 1000", with(rotation, 1000, "WWWW"), scale, {35.842, 73.102}, 1e-3);
  const auto deflection = &EdgeSprings::deflection_N_per_m2;
  for (const auto& [stiffness, expected] : {std::pair{1.0, 1.9866}, {10, 5.9274}, {100, 13.005}, {1000, 18.117}})
    check(fmt::format("deflection {}", stiffness), with(deflection, stiffness, "FFFF"), scale, {expected}, 1e-3);
  check("hard springs", with(deflection, 1e8, "FFFF"), scale, {19.739}, 1e-4);
  check("soft springs", with(deflection, 1e-4, "FFFF"), scale, {2 * std::sqrt(1e-4)}, 1e-4);
}

TEST_CASE("laminated cylindrical panels") {
  struct Row {
    const char* layup;
    double radius;
    double expected;
  };
  for (const Row& row : {Row{"[0/90]", 1, 65.485},
                         {"[0/90]", 2, 34.920},
                         {"[0/90]", 3, 24.520},
                         {"[0/90]", 4, 19.512},
                         {"[0/90]", 5, 16.670},
                         {"[0/90]", 10, 11.832},
                         {"[0/90]", 20, 10.266},
                         {"[0/90/0]", 1, 66.593},
                         {"[0/90/0]", 2, 36.775},
                         {"[0/90/0]", 3, 27.119},
                         {"[0/90/0]", 4, 22.711},
                         {"[0/90/0]", 5, 20.334},
                         {"[0/90/0]", 10, 16.625},
                         {"[0/90/0]", 20, 15.557}}) {
    Plate plate = laminated(rectangle(1, 1), row.layup, 0.01, 25, 0.5, 0.2);
    plate.edges = parse_plate_edges("TTTT");
    plate.curvature_per_m = -1 / row.radius;  // there the first ply is the inner one, here it is the struck one
    const RitzPlate ritz(plate, 12);
    DenseStructure body = ritz.structure();
    body.contacts.resize(ritz.unknown_count(), 3);
    body.contacts << ritz.deflection({0, 0}), ritz.deflection({-0.5, 0}), ritz.deflection({0, -0.5});
    const ModalModel modes = modal_model(body, {.mode_count = 12});
    Values found;
    for (Eigen::Index i = 0; i < modes.mode_count(); ++i) {
      const Eigen::VectorXd w = modes.participation.row(i) / modes.participation(i, 0);
      if (std::abs(w(1) - std::sqrt(0.5)) < 1e-3 && std::abs(w(2) - std::sqrt(0.5)) < 1e-3)
        found.push_back(modes.angular_frequency(i));
    }
    check(fmt::format("{} R/a = {}", row.layup, row.radius), found, 100, {row.expected}, 1e-3);
  }
}
