#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_table.hpp"
#include "lib/csv/output_file.hpp"
#include "lib/plot/column_picture.hpp"
#include "lib/plot/gnuplot.hpp"

#include <algorithm>
#include <filesystem>

namespace {

using namespace impulse;

struct Options {
  std::vector<std::string> files;
  ColumnSelection selection;
  std::string title;
  std::string output;
};

const ToolPage page{"ir-plot", "Draw columns of CSV files with gnuplot.",
                    "Without --output the picture is drawn in characters on standard output. Labels and units come "
                    "from the names of the "
                    "columns; time is shown in s, ms, µs or ns, whichever reads best.",
                    "printf 'time_s,force_N\\n0,0\\n1e-5,8\\n2e-5,6\\n3e-5,0\\n' > force.csv\n"
                    "ir-plot force.csv\n"
                    "ir-plot force.csv --title 'An impact' -o force.svg"};

void declare(Command& command, Options& options) {
  command.files("FILE", options.files, 0, 10000, "CSV files; '-' or none is standard input");
  command.text("--x", options.selection.x, "NAME", "column of the horizontal axis");
  command.text("--y", options.selection.y, "NAME",
               "column to draw; may be repeated (default: force_N if there is one, else every column but --x)");
  command.text("--title", options.title, "TEXT", "title above the picture");
  command.text("-o,--output", options.output, "FILE", "write FILE.svg, FILE.png or FILE.pdf");
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

int run(const Options& options) {
  const PictureFormat format = picture_format(options.output);
  std::vector<CsvTable> tables;
  for (const std::string& file : options.files) tables.push_back(read_csv(file));
  Picture picture = column_picture(tables, options.selection);
  picture.title = options.title;
  write_text(options.output, gnuplot_output(gnuplot_script(picture, format)));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Command command(page);
  declare(command, options);
  return run_tool(argc, argv, command, [&] { return run(options); });
}
