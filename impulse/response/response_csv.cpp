#include "impulse/response/response_csv.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"

#include <algorithm>
#include <numbers>

namespace impulse {
namespace {

/// From this many contacts on the two numbers of a pair stand apart, since 111 could be 1, 11 or 11, 1.
constexpr std::size_t many_contacts = 10;

/// `stem_unit` for one contact, `stem_ij_unit` for several (i, j from 0), `stem_i_j_unit` for ten and more.
std::string pair_name(const char* stem, const char* unit, std::size_t contacts, std::size_t i, std::size_t j) {
  if (contacts == 1) return fmt::format("{}_{}", stem, unit);
  return fmt::format("{}_{}{}{}_{}", stem, i + 1, contacts < many_contacts ? "" : "_", j + 1, unit);
}

struct PairNames {
  std::string g, h, u;
};

PairNames names_of(std::size_t contacts, std::size_t i, std::size_t j) {
  return {pair_name("impulse_response", "per_kg", contacts, i, j),
          pair_name("step_velocity", "m_per_Ns", contacts, i, j),
          pair_name("step_displacement", "m_per_N", contacts, i, j)};
}

constexpr std::size_t largest_contact_count = 99;  // that files are searched for

std::string participation_name(std::size_t contacts, std::size_t i) {
  return contacts == 1 ? "participation_per_sqrt_kg" : fmt::format("participation_{}_per_sqrt_kg", i + 1);
}

/// `stem_ij_unit` for one contact too.
std::string constant_name(const char* stem, const char* unit, Eigen::Index contacts, Eigen::Index i, Eigen::Index j) {
  return pair_name(stem, unit, std::max<std::size_t>(2, static_cast<std::size_t>(contacts)),
                   static_cast<std::size_t>(i), static_cast<std::size_t>(j));
}

bool has_any(const CsvTable& table, const PairNames& names) {
  return table.has(names.g) || table.has(names.h) || table.has(names.u);
}

/// The largest number that any pair names, so that a pair that is not there is missed.
std::size_t contact_count(const CsvTable& table) {
  const bool many = has_any(table, names_of(many_contacts, 0, 0));
  const std::size_t style = many ? many_contacts : many_contacts - 1;
  const std::size_t most = many ? largest_contact_count : many_contacts - 1;
  std::size_t count = 1;
  for (std::size_t i = 0; i < most; ++i)
    for (std::size_t j = 0; j < most; ++j)
      if (has_any(table, names_of(style, i, j))) count = std::max({count, i + 1, j + 1});
  return count;
}

void require_pair(const CsvTable& table, std::size_t contacts, std::size_t i, std::size_t j) {
  const PairNames names = names_of(contacts, i, j);
  if (contacts == 1 || has_any(table, names)) return;
  throw InputError(
      table.file(), 1, 0,
      fmt::format("pair {}{}{} is missing: no column {} (responses of {} contacts to each other are {} "
                  "pairs)",
                  i + 1, contacts < many_contacts ? "" : ",", j + 1, names.u, contacts, contacts * contacts));
}

/// Columns that hold one number, repeated; zero where there are none.
Eigen::MatrixXd constants(const CsvTable& table, const char* stem, const char* unit, Eigen::Index contacts) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(contacts, contacts);
  std::string missing, there;
  for (Eigen::Index i = 0; i < contacts; ++i)
    for (Eigen::Index j = 0; j < contacts; ++j) {
      const std::string name = constant_name(stem, unit, contacts, i, j);
      (table.has(name) ? there : missing) = name;
      if (!table.has(name)) continue;
      const std::vector<double>& column = table.column(name);
      for (std::size_t row = 1; row < column.size(); ++row)
        if (column[row] != column[0])
          throw InputError(
              table.file(), table.line(row), table.field(name),
              fmt::format("{} is one number repeated down the rows, but {} follows {}", name, column[row], column[0]));
      values(i, j) = column[0];
    }
  if (!there.empty() && !missing.empty())
    throw InputError(table.file(), 1, 0, fmt::format("column {} is missing beside {}", missing, there));
  return values;
}

void read_pair(const CsvTable& table, DiracParts dirac, const PairNames& names, const UniformGrid& grid,
               PairResponse& pair) {
  (void)table.field(names.g);
  const bool complete = table.has(names.h) && table.has(names.u);
  if (!complete && dirac == DiracParts::as_columns_say) {
    const std::string& missing = table.has(names.h) ? names.u : names.h;
    throw InputError(
        table.file(), 1, 0,
        fmt::format(
            "column {} is missing ({} alone leaves out the Dirac pulses of a rod); give it, or say --no-dirac if "
            "the impulse response is a plain function",
            missing, names.g));
  }
  pair.impulse_response_per_kg = table.column(names.g);
  pair.step_velocity_m_per_Ns =
      table.has(names.h) ? table.column(names.h) : cumulative_integral(pair.impulse_response_per_kg, grid.step_s);
  pair.step_displacement_m_per_N =
      table.has(names.u) ? table.column(names.u) : cumulative_integral(pair.step_velocity_m_per_Ns, grid.step_s);
}

}  // namespace

void write_response(const std::string& path, const Response& response) {
  std::vector<double> time(response.grid.size);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = response.grid.time_s(k);
  std::vector<NamedColumn> columns{{"time_s", time}};
  for (std::size_t i = 0; i < response.contact_count; ++i)
    for (std::size_t j = 0; j < response.contact_count; ++j) {
      const PairNames names = names_of(response.contact_count, i, j);
      const PairResponse& pair = response.pair(i, j);
      columns.push_back({names.g, pair.impulse_response_per_kg});
      columns.push_back({names.h, pair.step_velocity_m_per_Ns});
      columns.push_back({names.u, pair.step_displacement_m_per_N});
    }
  write_csv(path, columns);
}

void write_modes(const std::string& path, const ModalModel& body) {
  const auto modes = static_cast<std::size_t>(body.mode_count());
  const Eigen::Index contacts = body.contact_count();
  std::vector<std::string> names{"frequency_Hz", "damping_ratio"};
  std::vector<std::vector<double>> values(2, std::vector<double>(modes));
  for (std::size_t k = 0; k < modes; ++k) {
    values[0][k] = body.angular_frequency(static_cast<Eigen::Index>(k)) / (2 * std::numbers::pi);
    values[1][k] = body.damping_ratio(static_cast<Eigen::Index>(k));
  }
  for (Eigen::Index i = 0; i < contacts; ++i) {
    names.push_back(participation_name(static_cast<std::size_t>(contacts), static_cast<std::size_t>(i)));
    values.emplace_back(modes);
    for (std::size_t k = 0; k < modes; ++k) values.back()[k] = body.participation(static_cast<Eigen::Index>(k), i);
  }
  const auto add_constants = [&](const Eigen::MatrixXd& matrix, const char* stem, const char* unit) {
    if (matrix.isZero(0)) return;
    for (Eigen::Index i = 0; i < contacts; ++i)
      for (Eigen::Index j = 0; j < contacts; ++j) {
        names.push_back(constant_name(stem, unit, contacts, i, j));
        values.emplace_back(modes, matrix(i, j));
      }
  };
  add_constants(body.residual_flexibility, "residual_flexibility", "m_per_N");
  add_constants(body.wave_admittance, "wave_admittance", "m_per_Ns");
  std::vector<NamedColumn> columns;
  for (std::size_t k = 0; k < names.size(); ++k) columns.push_back({names[k], values[k]});
  write_csv(path, columns);
}

Response response_from(const CsvTable& table, DiracParts dirac) {
  Response response = zero_response(uniform_time(table), contact_count(table));
  for (std::size_t i = 0; i < response.contact_count; ++i)
    for (std::size_t j = 0; j < response.contact_count; ++j) require_pair(table, response.contact_count, i, j);
  for (std::size_t i = 0; i < response.contact_count; ++i)
    for (std::size_t j = 0; j < response.contact_count; ++j)
      read_pair(table, dirac, names_of(response.contact_count, i, j), response.grid, response.pair(i, j));
  return response;
}

bool holds_modes(const CsvTable& table) { return table.has("frequency_Hz"); }

ModalModel modes_from(const CsvTable& table) {
  std::size_t contacts = 1;
  for (std::size_t i = 0; i < largest_contact_count; ++i)
    if (table.has(participation_name(largest_contact_count, i))) contacts = i + 1;
  for (std::size_t i = 0; i < contacts; ++i) (void)table.field(participation_name(contacts, i));
  const auto p = static_cast<Eigen::Index>(contacts);
  const auto modes = static_cast<Eigen::Index>(table.row_count());
  ModalModel body{2 * std::numbers::pi * Eigen::Map<const Eigen::VectorXd>(table.column("frequency_Hz").data(), modes),
                  Eigen::Map<const Eigen::VectorXd>(table.column("damping_ratio").data(), modes),
                  Eigen::MatrixXd(modes, p), constants(table, "residual_flexibility", "m_per_N", p),
                  constants(table, "wave_admittance", "m_per_Ns", p)};
  for (std::size_t i = 0; i < contacts; ++i)
    body.participation.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXd>(table.column(participation_name(contacts, i)).data(), modes);
  try {
    require_valid(body);
  } catch (const std::invalid_argument& error) {
    throw InputError(table.file(), 0, 0, error.what());
  }
  return body;
}

}  // namespace impulse
