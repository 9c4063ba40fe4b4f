#include "lib/vtu/vtu_file.hpp"

#include "lib/contract/require.hpp"
#include "lib/csv/output_file.hpp"

#include <pugixml.hpp>

namespace impulse {
namespace {

using Index = Eigen::Index;

struct Text : pugi::xml_writer {
  std::string value;
  void write(const void* data, std::size_t size) override { value.append(static_cast<const char*>(data), size); }
};

/// A line per row.
template <class Matrix>
std::string as_text(const Matrix& values) {
  fmt::memory_buffer text;
  text.push_back('\n');
  for (Index i = 0; i < values.rows(); ++i)
    for (Index j = 0; j < values.cols(); ++j)
      fmt::format_to(std::back_inserter(text), "{}{}", values(i, j), j + 1 == values.cols() ? '\n' : ' ');
  return fmt::to_string(text);
}

template <class Matrix>
void add_array(pugi::xml_node& parent, const char* type, const std::string& name, Index components,
               const Matrix& values) {
  pugi::xml_node array = parent.append_child("DataArray");
  array.append_attribute("type") = type;
  array.append_attribute("Name") = name.c_str();
  if (components > 1) array.append_attribute("NumberOfComponents") = static_cast<long long>(components);
  array.append_attribute("format") = "ascii";
  array.text() = as_text(values).c_str();
}

void add_fields(pugi::xml_node& piece, const char* element, const std::vector<VtuField>& fields, Index rows) {
  if (fields.empty()) return;
  pugi::xml_node data = piece.append_child(element);
  for (const VtuField& field : fields) {
    require(field.values.rows() == rows && (field.values.cols() == 1 || field.values.cols() == 3),
            "field '{}' is {} x {}, not {} x 1 or 3", field.name, field.values.rows(), field.values.cols(), rows);
    require(field.values.allFinite(), "field '{}' has a value that is not finite", field.name);
    add_array(data, "Float64", field.name, field.values.cols(), field.values);
  }
}

void add_cells(pugi::xml_node& piece, const VtuGrid& grid) {
  const Index count = grid.cells.rows();
  require(count > 0 && grid.cells.minCoeff() >= 0 && grid.cells.maxCoeff() < grid.points.rows(),
          "a cell names a point that the grid does not have, or there is no cell");
  pugi::xml_node cells = piece.append_child("Cells");
  add_array(cells, "Int64", "connectivity", 1, grid.cells);
  const Eigen::VectorX<Index> ends = grid.cells.cols() * Eigen::VectorX<Index>::LinSpaced(count, 1, count);
  add_array(cells, "Int64", "offsets", 1, ends);
  const Eigen::VectorXi kinds = Eigen::VectorXi::Constant(count, static_cast<int>(grid.kind));
  add_array(cells, "UInt8", "types", 1, kinds);
}

}  // namespace

void write_vtu(const std::string& path, const VtuGrid& grid, const std::vector<VtuField>& point_fields,
               const std::vector<VtuField>& cell_fields) {
  require(grid.points.allFinite(), "a point has a coordinate that is not finite");
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = "UnstructuredGrid";
  root.append_attribute("version") = "1.0";
  root.append_attribute("byte_order") = "LittleEndian";
  pugi::xml_node piece = root.append_child("UnstructuredGrid").append_child("Piece");
  piece.append_attribute("NumberOfPoints") = static_cast<long long>(grid.points.rows());
  piece.append_attribute("NumberOfCells") = static_cast<long long>(grid.cells.rows());
  add_fields(piece, "PointData", point_fields, grid.points.rows());
  add_fields(piece, "CellData", cell_fields, grid.cells.rows());
  pugi::xml_node points = piece.append_child("Points");
  add_array(points, "Float64", "points_m", 3, grid.points);
  add_cells(piece, grid);
  Text text;
  document.save(text, " ");
  write_text(path, text.value);
}

}  // namespace impulse
