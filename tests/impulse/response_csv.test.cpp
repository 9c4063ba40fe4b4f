#include "impulse/response/response_csv.hpp"

#include "impulse/response/mass_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/contract/errors.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>

using namespace impulse;
using impulse::test::TemporaryDirectory;

namespace {

ModalModel two_point_modes() {
  ModalModel body;
  body.angular_frequency = Eigen::Vector3d(0, 6283.1, 1e5 / 3);
  body.damping_ratio = Eigen::Vector3d(0, 0.01, 0.02);
  body.participation = Eigen::MatrixXd(3, 2);
  body.participation << 0.1, 0.2, 0.3, -0.7, 1.0 / 3, 5;
  body.residual_flexibility = Eigen::Matrix2d{{2e-9, -1e-10}, {-1e-10, 3e-9}};
  body.wave_admittance = Eigen::Matrix2d{{1e-3, 0}, {0, 2e-3}};
  return body;
}

}  // namespace

TEST_CASE("response_csv: what is written is read back digit for digit, one contact or two") {
  const UniformGrid grid{1e-6, 50};
  const TemporaryDirectory folder;
  for (const Response& written :
       {mass_response(0.3, grid), mass_response(0.3, {Face::a, Face::b}, grid),
        wave_response({bars::steel_rod(0.02).profile, {Face::a, Face::b}, FarEnd::free}, grid)}) {
    write_response(folder / "r.csv", written);
    const Response read = response_from(read_csv(folder / "r.csv"));
    REQUIRE(read.contact_count == written.contact_count);
    CHECK(same_grid(read.grid, grid));
    for (std::size_t k = 0; k < written.pairs.size(); ++k) {
      CHECK(read.pairs[k].impulse_response_per_kg == written.pairs[k].impulse_response_per_kg);
      CHECK(read.pairs[k].step_velocity_m_per_Ns == written.pairs[k].step_velocity_m_per_Ns);
      CHECK(read.pairs[k].step_displacement_m_per_N == written.pairs[k].step_displacement_m_per_N);
    }
  }
}

TEST_CASE("response_csv: modes of two contacts are read back, frequencies to rounding") {
  const TemporaryDirectory folder;
  const ModalModel written = two_point_modes();
  write_modes(folder / "m.csv", written);
  const CsvTable table = read_csv(folder / "m.csv");
  CHECK(holds_modes(table));
  const ModalModel read = modes_from(table);
  CHECK((read.angular_frequency - written.angular_frequency).norm() <= 1e-15 * written.angular_frequency.norm());
  CHECK(read.damping_ratio == written.damping_ratio);
  CHECK(read.participation == written.participation);
  CHECK(read.residual_flexibility == written.residual_flexibility);
  CHECK(read.wave_admittance == written.wave_admittance);
}

TEST_CASE("response_csv: G alone needs the word that it has no Dirac parts, and is then integrated") {
  const TemporaryDirectory folder;
  const std::string path = folder.write("g.csv", "time_s,impulse_response_per_kg\n0,2\n0.5,2\n1,2\n");
  CHECK_THROWS_AS((void)response_from(read_csv(path)), InputError);
  const Response read = response_from(read_csv(path), DiracParts::none);
  CHECK(read.pairs[0].step_velocity_m_per_Ns == std::vector<double>{0, 1, 2});
  CHECK(read.pairs[0].step_displacement_m_per_N == std::vector<double>{0, 0.25, 1});
}

TEST_CASE("response_csv: a value that is not a number or a time that is not uniform is found where it stands") {
  const TemporaryDirectory folder;
  const std::string header =
      "time_s,impulse_response_per_kg,step_velocity_m_per_Ns,step_displacement_m_per_N\n0,1,0,0\n";
  CHECK_THROWS_WITH_AS((void)response_from(read_csv(folder.write("a.csv", header + "1,nan,1,0.5\n"))),
                       doctest::Contains("a.csv:3:2"), InputError);
  CHECK_THROWS_WITH_AS((void)response_from(read_csv(folder.write("b.csv", header + "1,1,1,0.5\n3,1,3,4.5\n"))),
                       doctest::Contains("b.csv:"), InputError);
}
