#include "fem/elements/bar_element.hpp"
// Verified by: tests/impulse/nowhere.test.cpp
