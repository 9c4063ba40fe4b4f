#pragma once

#include "lib/law/contact_law.hpp"

#include <doctest/doctest.h>

#include <vector>

/// What tests of contact laws have in common.
namespace impulse::laws {

/// Equal but for rounding.
inline doctest::Approx rounded(double value) { return doctest::Approx(value).epsilon(1e-13).scale(1e-30); }

/// A table that dissipates.
inline const LawTable lossy{{0, 1e-4, 2e-4, 4e-4, 6e-4}, {0, 100, 250, 800, 1500}, {0, 0, 40, 400, 1500}};

/// What a new contact remembers after these indentations.
inline LawHistory after(const ContactLaw& law, const std::vector<double>& indentations_m) {
  LawHistory history;
  for (const double indentation : indentations_m) history = law.advanced(history, indentation);
  return history;
}

}  // namespace impulse::laws
