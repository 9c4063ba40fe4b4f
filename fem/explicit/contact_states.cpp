#include "fem/explicit/contact_states.hpp"

#include <algorithm>

namespace impulse {

std::vector<std::size_t> ContactStates::sticking() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < rigid.size(); ++i)
    if (rigid[i].sticks()) found.push_back(i);
  return found;
}

bool ContactStates::any_closed() const {
  for (std::size_t i = 0; i < count(); ++i)
    if (is_closed(i)) return true;
  return false;
}

bool ContactStates::any_sticks() const { return std::ranges::any_of(rigid, &RigidContact::sticks); }

bool ContactStates::all_over() const {
  for (std::size_t i = 0; i < count(); ++i)
    if (!is_over(i)) return false;
  return true;
}

}  // namespace impulse
