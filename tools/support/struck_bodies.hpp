#pragma once

#include "impulse/contact/bodies_history.hpp"
#include "lib/cli/command.hpp"
#include "lib/model/plane_face.hpp"

#include <optional>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace impulse {

/// The bodies of an impact as their files give them, sampled or as modes, all on one grid and with contacts that fit.
class StruckBodies {
 public:
  struct Body {
    std::string file;
    std::variant<Response, ModalModel> seen;
    std::optional<double> mass_kg;
    std::vector<PairResponse> deviations = {};  ///< of a measured response, see measured_response.hpp
    std::size_t degrees_of_freedom = 0;
  };

  /// @throws InputError naming the files if grids or contacts disagree.
  StruckBodies(std::vector<Body> bodies, const UniformGrid& grid);

  [[nodiscard]] std::size_t count() const { return bodies_.size(); }
  [[nodiscard]] std::size_t joint_count() const { return joints_.size(); }
  [[nodiscard]] const UniformGrid& grid() const { return grid_; }
  [[nodiscard]] bool any_modal() const;

  /// Whether any body is known with an uncertainty; and the bodies as one draw from it has them.
  [[nodiscard]] bool uncertain() const;
  [[nodiscard]] StruckBodies drawn(std::mt19937_64& engine) const;

  /// Mass of the first and of the last body, where known.
  [[nodiscard]] std::optional<double> mass_1_kg() const { return bodies_.front().mass_kg; }
  [[nodiscard]] std::optional<double> mass_2_kg() const { return bodies_.back().mass_kg; }

  /// Of one body, modes superposed on the grid.
  [[nodiscard]] Response response(std::size_t body) const;
  /// References to what this object holds.
  [[nodiscard]] std::vector<ContactBody> contact_bodies() const;

 private:
  void require_one_grid() const;
  void require_contacts_that_fit() const;

  std::vector<Body> bodies_;
  UniformGrid grid_;
  std::vector<Joint> joints_;
};

/// The options of `ir-impact` that say what its files are.
class StruckBodiesRequest {
 public:
  void declare(Command& command);

  /// @throws UsageError for options that do not apply or are missing; InputError for the files.
  [[nodiscard]] StruckBodies read(const Command& command) const;

 private:
  std::vector<std::string> files_;
  std::optional<double> mass_1_kg_;
  std::optional<double> mass_2_kg_;
  std::optional<double> step_s_;
  std::optional<double> duration_s_;
  bool no_dirac_ = false;
  std::optional<PlaneFace> plane_face_;
};

}  // namespace impulse
