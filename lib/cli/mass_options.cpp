#include "lib/cli/mass_options.hpp"

#include "lib/contract/errors.hpp"

namespace impulse {

void MassOptions::declare(Command& command) {
  command.body("mass");
  command.quantity("--mass", mass_kg, "kg", Sign::positive, "mass").required();
  command.choice<Face>("--face", faces, {{"A", Face::a}, {"B", Face::b}},
                       "side that is struck; A,B for a mass between two bodies (2x2 response)");
}

void MassOptions::require_valid() const {
  if (faces.size() > 2 || (faces.size() == 2 && faces[0] == faces[1]))
    throw UsageError("--face", "a mass has two sides; give A, B or A,B");
}

}  // namespace impulse
