#include "lib/plot/column_picture.hpp"
#include "lib/contract/errors.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace impulse;
using impulse::test::TemporaryDirectory;

namespace {

const std::string history = "time_s,force_N,velocity_1_m_per_s,velocity_2_m_per_s\n0,1,5,0\n2e-3,2,4,1\n";

struct Tables {
  TemporaryDirectory directory;
  std::vector<CsvTable> tables;
  Tables& add(const std::string& name, const std::string& text) {
    tables.push_back(read_csv(directory.write(name, text)));
    return *this;
  }
};

}  // namespace

TEST_CASE("column_picture draws the force by default, over a readable time") {
  Tables t;
  t.add("a.csv", history);
  const Picture picture = column_picture(t.tables, {});
  REQUIRE(picture.curves.size() == 1);
  CHECK(picture.frame.x.label == "time (ms)");
  CHECK(picture.frame.y.label == "force (N)");
  CHECK(picture.curves[0].x == std::vector<double>{0, 2});
  CHECK(picture.curves[0].y == std::vector<double>{1, 2});
}

TEST_CASE("column_picture draws every column if there is no force") {
  Tables t;
  t.add("a.csv", "time_s,velocity_1_m_per_s,indentation_m\n0,1,2\n1,1,2\n");
  const Picture picture = column_picture(t.tables, {});
  REQUIRE(picture.curves.size() == 2);
  CHECK(picture.frame.x.label == "time (s)");
  CHECK(picture.frame.y.label == "velocity 1 (m/s), indentation (m)");
  CHECK(picture.curves[1].label == "indentation");
}

TEST_CASE("column_picture tells curves apart by file, by column, or both") {
  Tables t;
  t.add("a.csv", history).add("b.csv", history);
  CHECK(column_picture(t.tables, {}).curves[1].label == "b.csv");
  const Picture both = column_picture(t.tables, {"time_s", {"velocity_1_m_per_s", "velocity_2_m_per_s"}, "", {}});
  REQUIRE(both.curves.size() == 4);
  CHECK(both.curves[1].label == "a.csv: velocity 2");
  CHECK(both.frame.y.label == "velocity 1, velocity 2 (m/s)");
  const Picture phase = column_picture(std::vector{t.tables[0]}, {"force_N", {"velocity_1_m_per_s"}, "", {}});
  CHECK(phase.frame.x.label == "force (N)");
  CHECK(phase.curves[0].x == std::vector<double>{1, 2});
}

TEST_CASE("column_picture refuses what makes no curve") {
  Tables t;
  t.add("a.csv", "time_s\n0\n1\n");
  CHECK_THROWS_WITH_AS((void)column_picture(t.tables, {}), doctest::Contains("no column to draw besides 'time_s'"),
                       InputError);
  CHECK_THROWS_WITH_AS((void)column_picture(t.tables, {"x", {}, "", {}}), doctest::Contains("no column 'x'"),
                       InputError);
  CHECK_THROWS_WITH_AS((void)column_picture(t.tables, {"time_s", {"y"}, "", {}}), doctest::Contains("no column 'y'"),
                       InputError);
  Tables one;
  one.add("a.csv", "time_s,force_N\n0,1\n");
  CHECK_THROWS_WITH_AS((void)column_picture(one.tables, {}), doctest::Contains("a.csv:2: one row only"), InputError);
}

TEST_CASE("column_picture: a line is interrupted where the pen's column changes") {
  Tables t;
  t.add("a.csv", "time_s,force_N,element\n0,1,1\n2e-3,2,1\n3e-3,2,2\n");
  const Picture picture = column_picture(t.tables, {"time_s", {"force_N"}, "element", {}});
  CHECK(picture.curves[0].pen_lifts == std::vector<std::size_t>{2});
}

TEST_CASE("column_picture: one marked row is drawn, labels in order, too many refused") {
  Tables t, measured;
  t.add("a.csv", history);
  measured.add("m.csv", "time_s,force_N\n1e-3,1.5\n");
  const Picture picture = column_picture(t.tables, {"time_s", {}, "", {"predicted", "measured"}}, measured.tables);
  REQUIRE(picture.curves.size() == 2);
  CHECK(picture.curves[0].label == "predicted");
  CHECK(picture.curves[1].label == "measured");
  CHECK((picture.curves[1].mark == Mark::points));
  CHECK(picture.curves[1].x == std::vector<double>{1});
  CHECK_THROWS_WITH_AS((void)column_picture(t.tables, {"time_s", {}, "", {"a", "b"}}, {}), doctest::Contains("--label"),
                       UsageError);
}

TEST_CASE("column_map takes rows line by line as a grid and refuses other rows") {
  Tables t;
  t.add("a.csv", "x_m,y_m,w_m\n0,0,0\n1,0,1\n2,0,1\n1,1,0\n2,1,5\n3,1,0\n");
  const FieldMap map = column_map(t.tables[0], "x_m", "y_m", "w_m");
  REQUIRE(map.scans.size() == 2);
  CHECK(map.scans[1][1].z == 5);
  CHECK(map.frame.x.label == "x (m)");
  CHECK(map.z_label == "w (m)");
  t.add("b.csv", "x_m,y_m,w_m\n0,0,0\n1,0,1\n2,0,1\n0,1,0\n1,1,5\n0,2,0\n");
  CHECK_THROWS_WITH_AS((void)column_map(t.tables[1], "x_m", "y_m", "w_m"),
                       doctest::Contains("b.csv:5: the rows make no grid"), InputError);
}
