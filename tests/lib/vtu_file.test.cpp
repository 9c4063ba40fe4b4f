#include "lib/vtu/vtu_file.hpp"

#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>
#include <pugixml.hpp>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace impulse {
namespace {

std::vector<double> numbers(const pugi::xml_node& array) {
  std::istringstream text(array.text().get());
  std::vector<double> values;
  for (double value = 0; text >> value;) values.push_back(value);
  return values;
}

const VtuGrid triangle{
    .points = (Eigen::MatrixX3d(6, 3) << 0, 0, 0, 1, 0, 0, 0, 1.0 / 3, 0, 0.5, 0, 0, 0.5, 1.0 / 6, 0, 0, 1.0 / 6, 0)
                  .finished(),
    .cells = Eigen::Matrix<Eigen::Index, 1, 6>(0, 1, 2, 3, 4, 5),
    .kind = VtuCell::quadratic_triangle};

TEST_CASE("a .vtu file read back by an XML parser holds points, cells and fields to the last bit") {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "a.vtu";
  const Eigen::MatrixXd shape = Eigen::MatrixXd::NullaryExpr(
      6, 3, [](Eigen::Index i, Eigen::Index j) { return std::sin(1e9 * double(i) + double(j)); });
  write_vtu(path, triangle, {{"first <&> \"shape\"", shape}, {"u_m", shape.col(0)}},
            {{"material", Eigen::VectorXd::Ones(1)}});
  pugi::xml_document document;
  REQUIRE(document.load_file(path.c_str()));
  const pugi::xml_node root = document.child("VTKFile"), piece = root.child("UnstructuredGrid").child("Piece");
  CHECK(std::string(root.attribute("type").value()) == "UnstructuredGrid");
  CHECK(piece.attribute("NumberOfPoints").as_int() == 6);
  CHECK(piece.attribute("NumberOfCells").as_int() == 1);
  const std::vector<double> points = numbers(piece.child("Points").child("DataArray"));
  REQUIRE(points.size() == 18);
  CHECK(points[7] == 1.0 / 3);
  const pugi::xml_node field = piece.child("PointData").child("DataArray");
  CHECK(std::string(field.attribute("Name").value()) == "first <&> \"shape\"");
  CHECK(field.attribute("NumberOfComponents").as_int() == 3);
  const std::vector<double> values = numbers(field);
  REQUIRE(values.size() == 18);
  for (int i = 0; i < 18; ++i) CHECK(values[static_cast<std::size_t>(i)] == shape(i / 3, i % 3));
  CHECK(numbers(field.next_sibling()).size() == 6);
  CHECK(numbers(piece.child("CellData").child("DataArray")) == std::vector<double>{1});
  const pugi::xml_node cells = piece.child("Cells");
  CHECK(numbers(cells.find_child_by_attribute("Name", "connectivity")) == std::vector<double>{0, 1, 2, 3, 4, 5});
  CHECK(numbers(cells.find_child_by_attribute("Name", "offsets")) == std::vector<double>{6});
  CHECK(numbers(cells.find_child_by_attribute("Name", "types")) == std::vector<double>{22});
}

TEST_CASE("fields that do not fit are refused, and nothing is written") {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "a.vtu";
  CHECK_THROWS_WITH(write_vtu(path, triangle, {{"u_m", Eigen::VectorXd::Zero(5)}}),
                    "field 'u_m' is 5 x 1, not 6 x 1 or 3");
  CHECK_THROWS_WITH(write_vtu(path, triangle, {{"u_m", Eigen::VectorXd::Constant(6, NAN)}}),
                    "field 'u_m' has a value that is not finite");
  VtuGrid wrong = triangle;
  wrong.cells(0, 5) = 6;
  CHECK_THROWS_WITH(write_vtu(path, wrong, {}), doctest::Contains("a cell names a point that the grid does not have"));
  CHECK(directory.file_count() == 0);
}

}  // namespace
}  // namespace impulse
