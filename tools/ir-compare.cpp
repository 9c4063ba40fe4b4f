#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/csv/csv_table.hpp"
#include "lib/series/series_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace {

using namespace impulse;

struct Options {
  std::vector<std::string> files;
  std::string column = "force_N";
  std::optional<double> tolerance;
  std::optional<std::string> jumps;
  std::optional<std::size_t> leave_out;
  std::string output;
};

const ToolPage page{
    "ir-compare", "Compare a column of CSV files with that of a reference.",
    "For every OTHER one row file,column,relative_l2,peak_difference,impulse_difference, each relative to the "
    "reference: relative_l2 = ||F - F_ref||/||F_ref|| with both piecewise linear, integrated exactly over the "
    "reference's contact (its first one; for a column other than a force, as far as both records go). The grids may "
    "differ; what is missing of a shorter force counts as zero.",
    "printf 'time_s,force_N\\n0,0\\n1e-5,8\\n2e-5,0\\n' > reference.csv\n"
    "printf 'time_s,force_N\\n0,0\\n0.5e-5,4.1\\n1e-5,8.1\\n1.5e-5,4\\n2e-5,0\\n' > other.csv\n"
    "ir-compare reference.csv other.csv --tolerance 0.05"};

void declare(Command& command, Options& options) {
  command.files("REFERENCE OTHER...", options.files, 2, 10000,
                "CSV files with a uniform time_s; '-' is standard input");
  command.text("--column", options.column, "NAME", "column to compare");
  command.quantity("--tolerance", options.tolerance, "1", Sign::non_negative,
                   "exit with 1 if a relative_l2 is larger than this");
  command.text("--jumps", options.jumps, "FILE", "CSV with the times (time_s) at which the reference jumps");
  command.count("--leave-out", options.leave_out, 1,
                "leave out so many samples of the reference on each side of every jump");
  command.output(options.output);
}

UniformSeries read_series(const CsvTable& table, const std::string& column) {
  return {uniform_time(table), table.column(column)};
}

int run(const Options& options) {
  if (options.jumps.has_value() != options.leave_out.has_value())
    throw UsageError(options.jumps ? "--jumps" : "--leave-out", "--jumps and --leave-out go together");
  const UniformSeries reference = read_series(read_csv(options.files.front()), options.column);
  const bool is_force = options.column.starts_with("force");
  ComparisonWindow window{is_force ? first_contact_end_s(reference) : reference.grid.duration_s(), {}, 0};
  if (options.jumps) window.jumps_s = read_csv(*options.jumps).column("time_s");
  if (options.leave_out) window.leave_out = *options.leave_out;

  CsvOutput output(options.output, {"file", "column", "relative_l2", "peak_difference", "impulse_difference"});
  std::vector<std::string> beyond;
  for (std::size_t i = 1; i < options.files.size(); ++i) {
    const UniformSeries other = read_series(read_csv(options.files[i]), options.column);
    ComparisonWindow common = window;
    if (!is_force) common.end_s = std::min(window.end_s, other.grid.duration_s());
    const SeriesDifference d = series_difference(reference, other, common);
    output.row({options.files[i], options.column, d.relative_l2, d.peak_difference, d.impulse_difference});
    if (options.tolerance && d.relative_l2 > *options.tolerance)
      beyond.push_back(fmt::format("{}: relative_l2 {:.3g} is beyond the tolerance {}", options.files[i], d.relative_l2,
                                   *options.tolerance));
  }
  output.close();
  for (const std::string& message : beyond) fmt::print(stderr, "{}: {}\n", page.name, message);
  return beyond.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Command command(page);
  declare(command, options);
  return run_tool(argc, argv, command, [&] { return run(options); });
}
