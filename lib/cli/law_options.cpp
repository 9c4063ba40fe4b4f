#include "lib/cli/law_options.hpp"

#include "lib/cli/quantity.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/hertz.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace impulse {
namespace {

void refuse_if(bool given, const std::string& flag, const std::string& law) {
  if (given) throw UsageError(flag, fmt::format("means nothing to --law {}", law));
}

void need(bool given, const std::string& flag, const std::string& message) {
  if (!given) throw UsageError(flag, message);
}

constexpr const char* unit_32 = "N/m^1.5";

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Whether constants follow the name of a law; the name of a file may have colons of its own.
bool has_constants(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return false;
  const std::string name = text.substr(0, colon);
  return name == "rigid" || name == "linear" || name == "hertz" || name == "tan-sun";
}

}  // namespace

/// Which options a law takes.
struct LawOptions::Use {
  bool stiffness, tip, permanent;
};

void LawOptions::declare(Command& command) {
  command.text(
      "--law", laws_, "rigid|linear|hertz|tan-sun|TABLE.csv",
      "contact law (default: rigid); a table has columns indentation_m,loading_force_N[,unloading_force_N]; constants "
      "in options of their own, or after colons: linear:1e8N/m, hertz:1e9N/m^1.5, tan-sun:STIFFNESS:BETA:INDENTATION; "
      "once for all contacts, or with colons once for each");
  command
      .text("--stiffness", stiffness_, "STIFFNESS", "contact stiffness: N/m for linear, N/m^1.5 for hertz and tan-sun")
      .or_number();
  command.quantity("--tip-radius", tip_radius_m_, "m", Sign::positive,
                   "radius of the striking tip: hertz and tan-sun, in place of --stiffness");
  command.parsed<Material>("--tip-material", tip_material_, parse_material, "MATERIAL",
                           "of the tip, with Poisson's ratio: steel:0.3 or E:rho:nu");
  command.quantity("--target-modulus", target_modulus_Pa_, "Pa", Sign::positive,
                   "E/(1-nu^2) of an isotropic target, E2 of the ply of a laminate");
  command.quantity("--permanent-beta", permanent_beta_, "1", Sign::non_negative,
                   "tan-sun: permanent indentation per indentation beyond the critical one");
  command.quantity("--critical-indentation", critical_indentation_m_, "m", Sign::non_negative,
                   "tan-sun: largest indentation that leaves none behind");
}

void LawOptions::require_use(const Use& use) const {
  if (!use.stiffness) refuse_if(stiffness_.has_value(), "--stiffness", name());
  if (!use.tip) {
    refuse_if(tip_radius_m_.has_value(), "--tip-radius", name());
    refuse_if(tip_material_.has_value(), "--tip-material", name());
    refuse_if(target_modulus_Pa_.has_value(), "--target-modulus", name());
  }
  if (!use.permanent) {
    refuse_if(permanent_beta_.has_value(), "--permanent-beta", name());
    refuse_if(critical_indentation_m_.has_value(), "--critical-indentation", name());
  } else {
    const std::string message = fmt::format("--law {} needs it", name());
    need(permanent_beta_.has_value(), "--permanent-beta", message);
    need(critical_indentation_m_.has_value(), "--critical-indentation", message);
    if (*permanent_beta_ >= 1) throw UsageError("--permanent-beta", fmt::format("{} is not below 1", *permanent_beta_));
  }
}

double LawOptions::stiffness(const std::string& unit) const {
  const bool three_halves = unit == unit_32;
  const bool any_of_tip = tip_radius_m_ || tip_material_ || target_modulus_Pa_;
  if (any_of_tip && stiffness_) throw UsageError("--stiffness", "given beside a tip or target, which determine it");
  if (any_of_tip) return stiffness_of_tip();
  need(stiffness_.has_value(), "--stiffness",
       fmt::format("--law {} needs it, {}{}", name(), quantity_description(unit),
                   three_halves ? ", or --tip-radius, --tip-material and --target-modulus" : ""));
  double value = 0;
  try {
    value = parse_quantity(*stiffness_, unit);
  } catch (const std::invalid_argument& error) {
    throw UsageError("--stiffness", error.what());
  }
  if (value <= 0) throw UsageError("--stiffness", fmt::format("'{}' is not positive", *stiffness_));
  return value;
}

double LawOptions::stiffness_of_tip() const {
  const char* message = "the stiffness follows from --tip-radius, --tip-material and --target-modulus together";
  need(tip_radius_m_.has_value(), "--tip-radius", message);
  need(tip_material_.has_value(), "--tip-material", message);
  need(target_modulus_Pa_.has_value(), "--target-modulus", message);
  if (!tip_material_->poissons_ratio)
    throw UsageError("--tip-material",
                     fmt::format("'{0}' has no Poisson's ratio; add one, {0}:0.3", tip_material_->name));
  return hertz_stiffness(*tip_radius_m_, *tip_material_, *target_modulus_Pa_);
}

void LawOptions::refuse_separate_constants(const std::string& message) const {
  const std::pair<const char*, bool> constants[] = {{"--stiffness", stiffness_.has_value()},
                                                    {"--tip-radius", tip_radius_m_.has_value()},
                                                    {"--tip-material", tip_material_.has_value()},
                                                    {"--target-modulus", target_modulus_Pa_.has_value()},
                                                    {"--permanent-beta", permanent_beta_.has_value()},
                                                    {"--critical-indentation", critical_indentation_m_.has_value()}};
  for (const auto& [flag, given] : constants)
    if (given) throw UsageError(flag, message);
}

std::vector<ContactLaw> LawOptions::laws(std::size_t contact_count) const {
  if (laws_.size() <= 1) return std::vector<ContactLaw>(contact_count, law());
  refuse_separate_constants("each of several laws has its constants after colons, --law linear:1e8N/m");
  if (laws_.size() != contact_count)
    throw UsageError("--law", fmt::format("given {} times for {} contact{}; give it once, or once for each",
                                          laws_.size(), contact_count, contact_count == 1 ? "" : "s"));
  std::vector<ContactLaw> laws;
  for (const std::string& text : laws_) laws.push_back(law_in(text));
  return laws;
}

ContactLaw LawOptions::law() const {
  if (!has_constants(name())) return separate_law();
  refuse_separate_constants(fmt::format("'{}' has its constants already", name()));
  return law_in(name());
}

ContactLaw LawOptions::law_in(const std::string& text) {
  LawOptions one;
  one.laws_ = {text};
  if (has_constants(text)) {
    const std::vector<std::string> parts = split(text, ':');
    const std::size_t most = parts[0] == "rigid" ? 0 : parts[0] == "tan-sun" ? 3 : 1;
    if (parts.size() > most + 1)
      throw UsageError("--law", fmt::format("'{}': {} takes {}", text, parts[0],
                                            most == 0   ? "no constants"
                                            : most == 1 ? "one constant, its stiffness"
                                                        : "three constants, STIFFNESS:BETA:INDENTATION"));
    one.laws_ = {parts[0]};
    one.stiffness_ = parts[1];
    try {
      if (parts.size() > 2) one.permanent_beta_ = parse_quantity(parts[2], "1");
      if (parts.size() > 3) one.critical_indentation_m_ = parse_quantity(parts[3], "m");
    } catch (const std::invalid_argument& error) {
      throw UsageError("--law", fmt::format("'{}': {}", text, error.what()));
    }
  }
  try {
    return one.separate_law();
  } catch (const UsageError& error) {
    const std::string_view message = error.what();
    throw UsageError("--law", fmt::format("'{}': {}", text, message));
  }
}

ContactLaw LawOptions::separate_law() const {
  const std::string law = name();
  if (law == "rigid") {
    require_use({.stiffness = false, .tip = false, .permanent = false});
    return ContactLaw::rigid();
  }
  if (law == "linear") {
    require_use({.stiffness = true, .tip = false, .permanent = false});
    return ContactLaw::linear(stiffness("N/m"));
  }
  if (law == "hertz") {
    require_use({.stiffness = true, .tip = true, .permanent = false});
    return ContactLaw::hertz(stiffness(unit_32));
  }
  if (law == "tan-sun") {
    require_use({.stiffness = true, .tip = true, .permanent = true});
    return ContactLaw::tan_sun(stiffness(unit_32), *permanent_beta_, *critical_indentation_m_);
  }
  if (law != "-" && !std::filesystem::exists(law))
    throw UsageError("--law", fmt::format("'{}' is neither rigid, linear, hertz or tan-sun nor a file", law));
  require_use({.stiffness = false, .tip = false, .permanent = false});
  return ContactLaw::table(read_law_table(law));
}

}  // namespace impulse
