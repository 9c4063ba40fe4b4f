#include "tools/support/body_file.hpp"

#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"
#include "tools/support/bar_body.hpp"
#include "tools/support/beam_body.hpp"
#include "tools/support/described_shell.hpp"
#include "tools/support/mass_body.hpp"
#include "tools/support/plate_body.hpp"
#include "tools/support/solid_body.hpp"

#include <fmt/format.h>

#include <iterator>

namespace impulse {
namespace {

struct BodyKind {
  const char* name;
  DescribedBody (*read)(const TomlFile& file);
};

/// By name.
constexpr BodyKind kinds[] = {
    {"bar", read_bar_body},
    {"beam", read_beam_body},
    {"cone", read_bar_body},
    {"mass", read_mass_body},
    {"plate", read_plate_body},
    {"shell", read_shell_body},
    {"solid", read_solid_body},
};

}  // namespace

DescribedBody read_body_file(const std::string& path) {
  const TomlFile file = read_toml(path);
  const std::string name = body_kind(file);
  for (const BodyKind& kind : kinds) {
    if (name != kind.name) continue;
    DescribedBody body = kind.read(file);
    body.kind = name;
    return body;
  }
  throw InputError(file.name, 0, 0, fmt::format("body \"{}\" is not a {}", name, body_kinds()));
}

std::string body_kinds() {
  std::string names;
  for (std::size_t i = 0; i < std::size(kinds); ++i)
    names += fmt::format("{}{}", i == 0 ? "" : i + 1 == std::size(kinds) ? " or " : ", ", kinds[i].name);
  return names;
}

}  // namespace impulse
