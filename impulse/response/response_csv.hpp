#pragma once

#include "impulse/response/response.hpp"
#include "lib/csv/csv_table.hpp"
#include "lib/model/modal_model.hpp"

#include <string>

namespace impulse {

/// Columns `time_s, impulse_response_per_kg, step_velocity_m_per_Ns, step_displacement_m_per_N`; with several contacts
/// one set per pair, the pair before the unit: `step_displacement_12_m_per_N`,
/// and from ten contacts on `step_displacement_3_12_m_per_N`. @throws OutputError.
void write_response(const std::string& path, const Response& response);

/// Columns `frequency_Hz, damping_ratio, participation_per_sqrt_kg` (several contacts: `participation_1_per_sqrt_kg`,
/// ...), then, where they are not zero, `residual_flexibility_11_m_per_N`, ... and `wave_admittance_11_m_per_Ns`, ...
/// repeated down the rows.
void write_modes(const std::string& path, const ModalModel& body);

/// What a response file holds besides U.
enum class DiracParts {
  as_columns_say,  ///< H and U are read, since G and H leave Dirac parts out
  none             ///< G is a plain function: H and U may be missing and are then its integrals
};

/// @throws InputError for missing columns or pairs, a non-uniform time, a value that is not a number; a file with G
/// alone is refused unless `dirac` says that it has no Dirac parts. Verified by: tests/impulse/response_csv.test.cpp
[[nodiscard]] Response response_from(const CsvTable& table, DiracParts dirac = DiracParts::as_columns_say);

[[nodiscard]] bool holds_modes(const CsvTable& table);

/// @throws InputError as above, and for a modal model that is not valid.
[[nodiscard]] ModalModel modes_from(const CsvTable& table);

}  // namespace impulse
