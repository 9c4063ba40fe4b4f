#include "tools/support/struck_bodies.hpp"

#include "impulse/measured/force_band.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/contract/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace impulse {
namespace {

/// From the translation at 0 Hz; several modes there (a body that can turn too) do not tell it.
std::optional<double> free_mass(const ModalModel& modes) {
  const bool translates = modes.mode_count() > 0 && modes.angular_frequency(0) == 0 && modes.participation(0, 0) != 0;
  const bool turns = modes.mode_count() > 1 && modes.angular_frequency(1) == 0;
  if (!translates || turns) return std::nullopt;
  return 1 / std::pow(modes.participation(0, 0), 2);
}

StruckBodies::Body body_from(const CsvTable& table, DiracParts dirac) {
  if (!holds_modes(table)) {
    MeasuredResponse measured = measured_response_from(table, response_from(table, dirac));
    return {table.file(), std::move(measured.response), std::nullopt, std::move(measured.deviations),
            measured.degrees_of_freedom};
  }
  ModalModel modes = modes_from(table);
  const std::optional<double> mass = free_mass(modes);
  return {table.file(), std::move(modes), mass};
}

const Response* sampled(const StruckBodies::Body& body) { return std::get_if<Response>(&body.seen); }

std::size_t contacts_of(const StruckBodies::Body& body) {
  return std::visit([](const auto& seen) { return contact_count(std::cref(seen)); }, body.seen);
}

/// Has one of two bodies meet every point of the other with its plane face.
void spread_plane_face(std::vector<StruckBodies::Body>& bodies, PlaneFace which) {
  if (bodies.size() != 2) throw UsageError("--plane-face", "is for two bodies");
  StruckBodies::Body& plane = which == PlaneFace::first ? bodies.front() : bodies.back();
  const std::size_t points = contacts_of(which == PlaneFace::first ? bodies.back() : bodies.front());
  try {
    std::visit([points](auto& seen) { seen = plane_face(seen, points); }, plane.seen);
  } catch (const std::invalid_argument& error) {
    throw InputError(plane.file, 0, 0, error.what());
  }
}

std::string counted(std::size_t contacts) { return fmt::format("{} contact{}", contacts, contacts == 1 ? "" : "s"); }

}  // namespace

StruckBodies::StruckBodies(std::vector<Body> bodies, const UniformGrid& grid)
    : bodies_(std::move(bodies)), grid_(grid) {
  require_one_grid();
  require_contacts_that_fit();
  joints_ = joints_of(contact_bodies());
}

void StruckBodies::require_one_grid() const {
  const auto own = std::ranges::find_if(
      bodies_, [&](const Body& body) { return sampled(body) && same_grid(sampled(body)->grid, grid_); });
  const std::string grid_of = own == bodies_.end() ? "--step and --duration have" : own->file + " has";
  for (const Body& body : bodies_)
    if (const Response* response = sampled(body); response && !same_grid(response->grid, grid_))
      throw InputError(body.file, 0, 0,
                       fmt::format("has {} samples of {:.6g} s, but {} {} of {:.6g} s; compute all responses with the "
                                   "same --step and --duration",
                                   response->grid.size, response->grid.step_s, grid_of, grid_.size, grid_.step_s));
}

void StruckBodies::require_contacts_that_fit() const {
  const Body& first = bodies_.front();
  if (bodies_.size() == 2) {
    const Body& second = bodies_.back();
    if (contacts_of(first) != contacts_of(second))
      throw InputError(second.file, 0, 0,
                       fmt::format("has {}, but {} has {}; two bodies must meet at the same number of points",
                                   counted(contacts_of(second)), first.file, counted(contacts_of(first))));
    return;
  }
  for (const Body& body : bodies_) {
    const bool is_end = &body == &bodies_.front() || &body == &bodies_.back();
    if (contacts_of(body) == (is_end ? 1u : 2u)) continue;
    throw InputError(body.file, 0, 0,
                     fmt::format("has {}, but {}", counted(contacts_of(body)),
                                 is_end ? "the ends of a row of bodies have 1"
                                        : "an inner body of a row has 2, an entry and an exit (--face A,B)"));
  }
}

bool StruckBodies::any_modal() const {
  return std::ranges::any_of(bodies_, [](const Body& body) { return sampled(body) == nullptr; });
}

bool StruckBodies::uncertain() const {
  return std::ranges::any_of(bodies_, [](const Body& body) { return !body.deviations.empty(); });
}

StruckBodies StruckBodies::drawn(std::mt19937_64& engine) const {
  std::vector<Body> bodies = bodies_;
  for (Body& body : bodies)
    if (!body.deviations.empty())
      body.seen = drawn_response({std::get<Response>(body.seen), body.deviations, body.degrees_of_freedom}, engine);
  return {std::move(bodies), grid_};
}

Response StruckBodies::response(std::size_t body) const {
  const Body& asked = bodies_[body];
  return sampled(asked) ? *sampled(asked) : modal_response(std::get<ModalModel>(asked.seen), grid_);
}

std::vector<ContactBody> StruckBodies::contact_bodies() const {
  std::vector<ContactBody> seen;
  for (const Body& body : bodies_) std::visit([&](const auto& own) { seen.emplace_back(std::cref(own)); }, body.seen);
  return seen;
}

void StruckBodiesRequest::declare(Command& command) {
  command.files("RESPONSE1 RESPONSE2", files_, 2, 64,
                "responses of the arriving body and of the one at rest, or of a row of bodies, the inner ones struck "
                "at both faces; - is stdin");
  command.quantity("--mass-1", mass_1_kg_, "kg", Sign::positive,
                   "mass of body 1, for its rebound speed and energy (default: from its 0 Hz mode)");
  command.quantity("--mass-2", mass_2_kg_, "kg", Sign::positive,
                   "mass of the last body, for restitution and energy (default: from its 0 Hz mode)");
  command.quantity("--step", step_s_, "s", Sign::positive, "time step, where a RESPONSE holds modes");
  command.quantity("--duration", duration_s_, "s", Sign::positive, "duration, where a RESPONSE holds modes");
  command.flag("--no-dirac", no_dirac_, "the impulse responses are plain functions; H and U may be missing");
  command.choice<PlaneFace>("--plane-face", plane_face_, {{"1", PlaneFace::first}, {"2", PlaneFace::second}},
                            "this body has one contact, a plane face, which meets every point of the other");
}

StruckBodies StruckBodiesRequest::read(const Command& command) const {
  std::vector<CsvTable> tables;
  for (const std::string& path : files_) tables.push_back(read_csv(path));
  const auto modal = std::ranges::find_if(tables, holds_modes);
  if (modal == tables.end())
    for (const char* flag : {"--step", "--duration"})
      if (command.given(flag)) throw UsageError(flag, "is that of the responses; it is for modes");
  if (no_dirac_ && std::ranges::all_of(tables, holds_modes))
    throw UsageError("--no-dirac", "is for impulse responses, but all files hold modes; leave it out");
  std::vector<StruckBodies::Body> bodies;
  for (const CsvTable& table : tables)
    bodies.push_back(body_from(table, no_dirac_ ? DiracParts::none : DiracParts::as_columns_say));
  if (mass_1_kg_) bodies.front().mass_kg = mass_1_kg_;
  if (mass_2_kg_) bodies.back().mass_kg = mass_2_kg_;
  if (plane_face_) spread_plane_face(bodies, *plane_face_);
  if (modal == tables.end()) {
    const UniformGrid grid = sampled(bodies.front())->grid;
    return {std::move(bodies), grid};
  }
  if (!step_s_) throw UsageError("--step", fmt::format("is required, since {} holds modes", modal->file()));
  if (!duration_s_) throw UsageError("--duration", fmt::format("is required, since {} holds modes", modal->file()));
  return {std::move(bodies), grid_over(*duration_s_, *step_s_)};
}

}  // namespace impulse
