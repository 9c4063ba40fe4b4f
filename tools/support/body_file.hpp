#pragma once

#include "lib/model/structure.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace impulse {

struct TomlFile;

/// How finely a body is divided for explicit integration.
struct ExplicitMesh {
  double step_s = 0;                                        ///< of the body's own integration; its mesh must be stable
  std::optional<std::size_t> element_count = std::nullopt;  ///< else the finest that the step is stable for
};

enum class Divisible { no, yes };

/// What a body file describes, whatever its kind.
struct DescribedBody {
  std::string kind;                                         ///< the key `body`
  std::size_t contact_count = 1;                            ///< of an inner body of a row 2: entry, exit
  std::optional<double> free_mass_kg = std::nullopt;        ///< of a body that nothing holds and that has an end
  std::optional<double> rigid_mass_kg = std::nullopt;       ///< of a body that does not deform
  Divisible divisible = Divisible::yes;                     ///< whether `structure` takes an element count
  std::function<Structure(const ExplicitMesh&)> structure;  ///< what explicit integration takes
};

/// Reads a body file: TOML whose keys are the options of the tool for that body, and `body = "..."`; `-` is stdin.
///
/// The kinds there are stand in one table in body_file.cpp. A new kind is a line in it and a source of its own that
/// reads the file into a DescribedBody (bar_body.hpp, mass_body.hpp).
/// @throws InputError for a kind that is not known and for what is wrong in the file.
/// Verified by: tests/tools/fe-impact/
[[nodiscard]] DescribedBody read_body_file(const std::string& path);

/// `bar, beam, cone, mass, plate, shell or solid`, for messages and help.
[[nodiscard]] std::string body_kinds();

}  // namespace impulse
