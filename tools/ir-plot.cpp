#include "lib/cli/quantity.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_table.hpp"
#include "lib/csv/output_file.hpp"
#include "lib/plot/column_picture.hpp"
#include "lib/plot/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace {

using namespace impulse;

enum class Logarithmic { x, y, both };

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> points;
  ColumnSelection selection;
  std::string z;
  std::string title;
  std::optional<std::string> x_range;
  std::optional<std::string> y_range;
  std::optional<std::string> size;
  std::optional<Logarithmic> logarithmic;
  std::optional<MapView> view;
  bool equal_scales = false;
  std::string output;
};

const ToolPage page{"ir-plot", "Draw columns of CSV files with gnuplot.",
                    "Without --output the picture is drawn in characters on standard output. Labels and units come "
                    "from the names of the columns; time is shown in s, ms, µs or ns, whichever reads best. Long "
                    "records are thinned to what can be seen, peaks kept. With --z a field over x and y, such as a "
                    "mode shape, is drawn by colours or as a surface.",
                    "printf 'time_s,force_N\\n0,0\\n1e-5,8\\n2e-5,6\\n3e-5,0\\n' > force.csv\n"
                    "ir-plot force.csv\n"
                    "ir-plot force.csv --title 'An impact' --x-range 0,25us -o force.svg\n"
                    "printf 'x_m,y_m,w_m\\n0,0,0\\n1,0,2\\n0,1,0\\n1,1,-1\\n' > field.csv\n"
                    "ir-plot field.csv --x x_m --y y_m --z w_m -o field.svg"};

void declare(Command& command, Options& options) {
  command.files("FILE", options.files, 0, 10000, "CSV files; '-' or none is standard input");
  command.text("--x", options.selection.x, "NAME", "column of the horizontal axis");
  command.text("--y", options.selection.y, "NAME",
               "column to draw; may be repeated (default: force_N if there is one, else every column but --x)");
  command.text("--z", options.z, "NAME",
               "draw this column as a field over --x and --y, whose rows go through a grid line by line");
  command.choice<MapView>("--view", options.view, {{"flat", MapView::flat}, {"surface", MapView::surface}},
                          "of a field: colours from above (default), or a surface seen from the side");
  command.text("--points", options.points, "FILE", "CSV file drawn as points, measured values say; may be repeated");
  command.text("--label", options.selection.labels, "TEXT",
               "name of a curve in the legend, in their order; may be repeated (default: file, column or both)");
  command.text("--pen", options.selection.pen, "NAME",
               "column at whose changes the line is interrupted, the outlines of elements say");
  command.text("--title", options.title, "TEXT", "title above the picture");
  command.text("--x-range", options.x_range, "FROM,TO", "part of the horizontal axis, 10us,60us say");
  command.text("--y-range", options.y_range, "FROM,TO", "part of the vertical axis");
  command.choice<Logarithmic>("--log", options.logarithmic,
                              {{"x", Logarithmic::x}, {"y", Logarithmic::y}, {"both", Logarithmic::both}},
                              "logarithmic axes");
  command.flag("--equal", options.equal_scales, "the same scale on both axes, for the shapes of bodies");
  command.text("--size", options.size, "WIDTH,HEIGHT", "in pixels (PDF: hundredths of an inch; default: 900,500)");
  command.output(options.output,
                 "write the picture to FILE.svg, FILE.png or FILE.pdf (default: in characters on standard output)");
}

PictureFormat picture_format(const std::string& path) {
  if (path.empty() || path == "-") return PictureFormat::text;
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (extension == ".svg") return PictureFormat::svg;
  if (extension == ".png") return PictureFormat::png;
  if (extension == ".pdf") return PictureFormat::pdf;
  throw UsageError("--output", "'" + path + "' is no picture; its name must end in .svg, .png or .pdf");
}

/// Two numbers with a comma between them; a unit that UDUNITS can't read (1/√kg) is for the eye only.
AxisRange range(const std::string& flag, const std::string& text, const Axis& axis) {
  static constexpr std::array readable{"s", "m", "N", "Hz", "Pa", "J", "W", "kg", "m/s", "N/m", "m/N"};
  const std::string unit =
      std::find(readable.begin(), readable.end(), axis.si_unit) == readable.end() ? "1" : axis.si_unit;
  const std::size_t comma = text.find(',');
  if (comma == text.npos) throw UsageError(flag, fmt::format("'{}' is not FROM,TO", text));
  AxisRange result;
  try {
    result = {axis.per_si * parse_quantity(text.substr(0, comma), unit),
              axis.per_si * parse_quantity(text.substr(comma + 1), unit)};
  } catch (const std::invalid_argument& error) {
    throw UsageError(flag, error.what());
  }
  if (result.from == result.to) throw UsageError(flag, fmt::format("'{}' has no extent", text));
  return result;
}

void set_size(Frame& frame, const std::string& text) {
  const std::size_t comma = text.find(',');
  double width = 0, height = 0;
  try {
    if (comma == text.npos) throw std::invalid_argument(fmt::format("'{}' is not WIDTH,HEIGHT", text));
    width = parse_quantity(text.substr(0, comma), "1");
    height = parse_quantity(text.substr(comma + 1), "1");
  } catch (const std::invalid_argument& error) {
    throw UsageError("--size", error.what());
  }
  for (const double length : {width, height})
    if (!(length >= 100 && length <= 10000))
      throw UsageError("--size", fmt::format("'{}' is not from 100,100 to 10000,10000", text));
  frame.width_px = static_cast<std::size_t>(width);
  frame.height_px = static_cast<std::size_t>(height);
}

/// What the options say of the frame; the axes know their quantities already.
void complete(Frame& frame, const Options& options) {
  frame.title = options.title;
  frame.equal_scales = options.equal_scales;
  if (options.x_range) frame.x.range = range("--x-range", *options.x_range, frame.x);
  if (options.y_range) frame.y.range = range("--y-range", *options.y_range, frame.y);
  frame.x.logarithmic = options.logarithmic && options.logarithmic != Logarithmic::y;
  frame.y.logarithmic = options.logarithmic && options.logarithmic != Logarithmic::x;
  if (options.size) set_size(frame, *options.size);
}

std::string map_script(const std::vector<CsvTable>& tables, const Options& options, const Command& command,
                       PictureFormat format) {
  for (const char* flag : {"--points", "--label", "--pen", "--log"})
    if (command.given(flag)) throw UsageError(flag, "is for curves; leave it out beside --z");
  if (tables.size() != 1) throw UsageError("--z", "draws the field of one file");
  if (!command.given("--x") || options.selection.y.size() != 1)
    throw UsageError("--z", "needs --x and one --y, over which the field is drawn");
  FieldMap map = column_map(tables.front(), options.selection.x, options.selection.y.front(), options.z);
  map.view = options.view.value_or(MapView::flat);
  complete(map.frame, options);
  return gnuplot_script(map, format);
}

std::string curve_script(const std::vector<CsvTable>& tables, const Options& options, PictureFormat format) {
  std::vector<CsvTable> marked;
  for (const std::string& file : options.points) marked.push_back(read_csv(file));
  Picture picture = column_picture(tables, options.selection, marked);
  complete(picture.frame, options);
  return gnuplot_script(picture, format);
}

int run(const Options& options, const Command& command) {
  const PictureFormat format = picture_format(options.output);
  if (options.view && options.z.empty()) throw UsageError("--view", "is for a field; add --z");
  std::vector<CsvTable> tables;
  for (const std::string& file : options.files) tables.push_back(read_csv(file));
  const std::string script =
      options.z.empty() ? curve_script(tables, options, format) : map_script(tables, options, command, format);
  write_text(options.output, gnuplot_output(script));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Command command(page);
  declare(command, options);
  return run_tool(argc, argv, command, [&] { return run(options, command); });
}
