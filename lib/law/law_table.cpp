#include "lib/law/law_table.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/csv/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace impulse {
namespace {

constexpr const char* indentation_column = "indentation_m";
constexpr const char* loading_column = "loading_force_N";
constexpr const char* unloading_column = "unloading_force_N";

/// Part of the work of loading that rounding may turn into a gain.
constexpr double rounding = 1e-12;

std::vector<double> cumulative_work(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> work(y.size(), 0);
  for (std::size_t i = 1; i < y.size(); ++i) work[i] = work[i - 1] + 0.5 * (x[i] - x[i - 1]) * (y[i - 1] + y[i]);
  return work;
}

// Not gsl_interp: value, slope and integral come from one bisection here, its integral is a sum over all intervals.
LawPoint point_on(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& work,
                  double at) {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto i = static_cast<std::size_t>(above - x.begin()) - 1;
  const double slope = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  const double beyond = at - x[i];
  return {y[i] + slope * beyond, slope, work[i] + beyond * (y[i] + 0.5 * slope * beyond)};
}

std::optional<LawTableFault> fault_of_loading(const LawTable& table) {
  const std::vector<double>& a = table.indentation_m;
  const std::vector<double>& f = table.loading_force_N;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i])) return {{i, indentation_column, fmt::format("indentation {} m is not finite", a[i])}};
    if (!std::isfinite(f[i])) return {{i, loading_column, fmt::format("force {} N is not finite", f[i])}};
    if (i == 0 && a[0] != 0)
      return {{i, indentation_column, fmt::format("the first indentation is {} m; the table must start at 0", a[0])}};
    if (i == 0 && f[0] != 0)
      return {{i, loading_column, fmt::format("the force at indentation 0 is {} N, not 0", f[0])}};
    if (i > 0 && a[i] <= a[i - 1])
      return {
          {i, indentation_column, fmt::format("indentation {} m does not increase (before: {} m)", a[i], a[i - 1])}};
    if (i > 0 && f[i] <= f[i - 1])
      return {{i, loading_column, fmt::format("loading force {} N does not increase (before: {} N)", f[i], f[i - 1])}};
  }
  return std::nullopt;
}

std::optional<LawTableFault> fault_of_unloading(const LawTable& table) {
  const std::vector<double>& f = table.loading_force_N;
  const std::vector<double>& u = table.unloading_force_N;
  const auto fault = [](std::size_t row, std::string message) {
    return LawTableFault{row, unloading_column, std::move(message)};
  };
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (!std::isfinite(u[i])) return fault(i, fmt::format("force {} N is not finite", u[i]));
    if (i == 0 && u[0] != 0) return fault(i, fmt::format("the force at indentation 0 is {} N, not 0", u[0]));
    if (i > 0 && u[i] < u[i - 1])
      return fault(i, fmt::format("unloading force {} N is less than at the indentation before, {} N", u[i], u[i - 1]));
    if (u[i] > f[i]) return fault(i, fmt::format("unloading force {} N is above the loading force {} N", u[i], f[i]));
  }
  if (u.back() != f.back())
    return fault(u.size() - 1, fmt::format("unloading starts at {} N, but loading ends at {} N", u.back(), f.back()));
  return std::nullopt;
}

// The loss D(α) = ∫F dα - c α F(α) is a parabola between two points.
std::optional<LawTableFault> fault_of_energy(const LawTable& table) {
  const std::vector<double>& a = table.indentation_m;
  const std::vector<double>& f = table.loading_force_N;
  const std::vector<double> work = cumulative_work(a, f);
  const double share = cumulative_work(a, table.unloading_force_N).back() / (a.back() * f.back());
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    const double width = a[i + 1] - a[i];
    const double slope = (f[i + 1] - f[i]) / width;
    const double descent = share * slope * a[i] - (1 - share) * f[i];
    const double curvature = slope * (1 - 2 * share);
    const double lowest = curvature > 0 ? std::clamp(descent / curvature, 0.0, width) : width;
    const double turn = a[i] + lowest;
    const LawPoint load = point_on(a, f, work, turn);
    if (load.energy_J - share * turn * load.force_N < -rounding * load.energy_J)
      return {{i + 1, unloading_column,
               fmt::format("unloading from {} m gives back {} J, more than the {} J that loading took (the tabulated "
                           "curve, scaled to that point); lower the unloading forces",
                           turn, share * turn * load.force_N, load.energy_J)}};
  }
  return std::nullopt;
}

}  // namespace

std::optional<LawTableFault> find_fault(const LawTable& table) {
  const std::size_t count = table.indentation_m.size();
  const std::size_t loading_count = table.loading_force_N.size();
  const std::size_t unloading_count = table.unloading_force_N.size();
  if (loading_count != count || (unloading_count != count && unloading_count != 0))
    return {{0, indentation_column,
             fmt::format("{} indentations with {} loading and {} unloading forces", count, loading_count,
                         unloading_count)}};
  if (count < 2) return {{0, indentation_column, fmt::format("a table of {} point(s); two or more are needed", count)}};
  if (std::optional<LawTableFault> fault = fault_of_loading(table)) return fault;
  if (unloading_count == 0) return std::nullopt;
  if (std::optional<LawTableFault> fault = fault_of_unloading(table)) return fault;
  if (table.unloading_force_N == table.loading_force_N) return std::nullopt;
  return fault_of_energy(table);
}

LawTable read_law_table(const std::string& path) {
  const CsvTable csv = read_csv(path);
  LawTable table{csv.column(indentation_column), csv.column(loading_column), {}};
  if (csv.has(unloading_column)) table.unloading_force_N = csv.column(unloading_column);
  if (const std::optional<LawTableFault> fault = find_fault(table))
    throw InputError(csv.file(), csv.line(fault->row), csv.field(fault->column), fault->message);
  return table;
}

LawCurves::LawCurves(LawTable table) {
  if (const std::optional<LawTableFault> fault = find_fault(table))
    throw std::invalid_argument(fmt::format("point {} of the table: {}", fault->row + 1, fault->message));
  indentation_ = std::move(table.indentation_m);
  loading_ = std::move(table.loading_force_N);
  loading_work_ = cumulative_work(indentation_, loading_);
  if (table.unloading_force_N.empty() || table.unloading_force_N == loading_) return;
  unloading_ = std::move(table.unloading_force_N);
  unloading_work_ = cumulative_work(indentation_, unloading_);
}

LawPoint LawCurves::loading(double indentation_m) const {
  require(indentation_m <= last_indentation_m(), "indentation {} m exceeds the table's last {} m", indentation_m,
          last_indentation_m());
  return point_on(indentation_, loading_, loading_work_, indentation_m);
}

LawPoint LawCurves::unloading(double indentation_m, double largest_indentation_m, double largest_force_N) const {
  if (elastic()) return loading(indentation_m);
  const double length = largest_indentation_m / last_indentation_m();
  const double height = largest_force_N / loading_.back();
  const LawPoint point = point_on(indentation_, unloading_, unloading_work_, indentation_m / length);
  return {height * point.force_N, height / length * point.tangent_N_per_m, height * length * point.energy_J};
}

double LawCurves::permanent_indentation_m(double largest_indentation_m) const {
  if (elastic()) return 0;
  const auto positive = std::upper_bound(unloading_.begin(), unloading_.end(), 0.0);
  const double last_zero = indentation_[static_cast<std::size_t>(positive - unloading_.begin()) - 1];
  return largest_indentation_m * (last_zero / last_indentation_m());
}

}  // namespace impulse
