#include "fem/elements/bar_element.hpp"
