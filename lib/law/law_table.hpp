#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// A curve F(α) at one indentation: force in N, right derivative in N/m, ∫F dα from the curve's start in J.
struct LawPoint {
  double force_N = 0;
  double tangent_N_per_m = 0;
  double energy_J = 0;
};

/// A measured contact law: forces at increasing indentations, straight lines between them.
struct LawTable {
  std::vector<double> indentation_m;      ///< from 0, increasing
  std::vector<double> loading_force_N;    ///< from 0, increasing
  std::vector<double> unloading_force_N;  ///< of unloading from the last indentation; empty: an elastic law
};

/// Reads columns `indentation_m,loading_force_N` and, if there, `unloading_force_N`.
/// @throws InputError with file:line:column for what LawCurves refuses and for what read_csv refuses.
[[nodiscard]] LawTable read_law_table(const std::string& path);

/// The curves of a table. Loading is the table's, F(α). Unloading from the largest indentation αm at the force Fm is
/// the tabulated unloading curve U(α) of the last point (a_n, F_n), scaled to meet (αm, Fm),
///
///   F_u(α) = Fm·U(α a_n/αm)/F_n,   ∫F_u dα from 0 to α = Fm αm/(F_n a_n) ∫U da from 0 to α a_n/αm,
///
/// so that c = ∫U da/(F_n a_n), the recovered share of αm Fm, and α0/αm, where U leaves 0, are the same for every αm.
/// Limits: the shape of unloading does not depend on αm; a table whose U equals its F is elastic, and then not scaled.
/// Verified by: tests/lib/law_table.test.cpp
class LawCurves {
 public:
  /// @throws std::invalid_argument naming the point (from 1) unless there are n ≥ 2 points of finite numbers, α and F
  /// start at 0 and increase, U starts at 0, never decreases, is at most F and ends at it, and every αm has
  /// ∫F dα ≥ c αm F(αm): unloading gives back at most what loading put in.
  explicit LawCurves(LawTable table);

  [[nodiscard]] bool elastic() const { return unloading_.empty(); }
  [[nodiscard]] double last_indentation_m() const { return indentation_.back(); }

  /// @throws std::invalid_argument if α is beyond the last point.
  [[nodiscard]] LawPoint loading(double indentation_m) const;

  /// For 0 ≤ α ≤ αm. Elastic: loading.
  [[nodiscard]] LawPoint unloading(double indentation_m, double largest_indentation_m, double largest_force_N) const;

  /// α0 of unloading from αm; elastic: 0.
  [[nodiscard]] double permanent_indentation_m(double largest_indentation_m) const;

 private:
  std::vector<double> indentation_, loading_, unloading_, loading_work_, unloading_work_;
};

/// What is wrong with a table, by row (from 0) and column; nothing if LawCurves takes it.
struct LawTableFault {
  std::size_t row;
  std::string column;
  std::string message;
};
[[nodiscard]] std::optional<LawTableFault> find_fault(const LawTable& table);

}  // namespace impulse
