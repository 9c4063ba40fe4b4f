#include "tools/support/regularisation_option.hpp"

#include "lib/cli/quantity.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace impulse {
namespace {

Regularisation parse_regularisation(const std::string& text) {
  using Rule = Regularisation::Rule;
  if (text == "gcv") return {Rule::cross_validation, 0};
  if (text == "l-curve") return {Rule::l_curve, 0};
  if (text == "none") return {Rule::none, 0};
  const double value = parse_quantity(text, "1");
  if (!(value > 0)) throw std::invalid_argument(fmt::format("{} is neither gcv, l-curve, none nor positive", text));
  return {Rule::value, value};
}

}  // namespace

void declare_regularisation(Command& command, Regularisation& regularisation) {
  command.parsed<Regularisation>(
      "--regularisation", regularisation, parse_regularisation, "gcv|l-curve|none|NUMBER",
      "how much of the noise is held back: by generalised cross-validation (default), by the corner of the L-curve, "
      "not at all, or as a fraction of the largest power of what is divided by");
}

std::string rule_name(Regularisation::Rule rule) {
  switch (rule) {
    case Regularisation::Rule::cross_validation:
      return " (gcv)";
    case Regularisation::Rule::l_curve:
      return " (l-curve)";
    default:
      return "";
  }
}

}  // namespace impulse
