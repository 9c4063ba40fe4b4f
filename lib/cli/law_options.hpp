#pragma once

#include "lib/cli/command.hpp"
#include "lib/law/contact_law.hpp"
#include "lib/material/material.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// The options that describe the contact law of two bodies, on the command line of a tool or as keys of its file:
///
///   --law rigid (default)   nothing else
///   --law linear            --stiffness in N/m
///   --law hertz             --stiffness in N/m^1.5, or --tip-radius --tip-material --target-modulus (hertz_stiffness)
///   --law tan-sun           as hertz, and --permanent-beta --critical-indentation
///   --law FILE              nothing else; a CSV table (read_law_table), `-` is stdin
///   --law NAME:CONSTANTS    nothing else: linear:STIFFNESS, hertz:STIFFNESS, tan-sun:STIFFNESS:BETA:INDENTATION
///
/// Verified by: tests/lib/law_options.test.cpp
class LawOptions {
 public:
  void declare(Command& command);

  /// One law a contact: the law that was described, for every contact; or, where --law is given once a contact, each by
  /// itself, its constants after colons.
  /// @throws as law(), and UsageError if the numbers of laws and contacts differ.
  [[nodiscard]] std::vector<ContactLaw> laws(std::size_t contact_count) const;

  /// The law that was described; reads its file.
  /// @throws UsageError naming the option that is missing, of no use to this law, or wrong; InputError for the file.
  [[nodiscard]] ContactLaw law() const;

 private:
  struct Use;
  [[nodiscard]] static ContactLaw law_in(const std::string& text);  ///< one --law with all that belongs to it
  [[nodiscard]] ContactLaw separate_law() const;                    ///< its constants in options of their own
  void refuse_separate_constants(const std::string& message) const;
  void require_use(const Use& use) const;
  [[nodiscard]] double stiffness(const std::string& unit) const;
  [[nodiscard]] double stiffness_of_tip() const;

  [[nodiscard]] std::string name() const { return laws_.empty() ? "rigid" : laws_.front(); }

  std::vector<std::string> laws_;         ///< empty: rigid
  std::optional<std::string> stiffness_;  ///< its unit depends on the law
  std::optional<double> tip_radius_m_;
  std::optional<Material> tip_material_;
  std::optional<double> target_modulus_Pa_;
  std::optional<double> permanent_beta_;
  std::optional<double> critical_indentation_m_;
};

}  // namespace impulse
