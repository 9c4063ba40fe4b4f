#include "lib/material/layup.hpp"

#include <doctest/doctest.h>

#include <fmt/ranges.h>

#include <string>
#include <vector>

using impulse::parse_layup;
using Angles = std::vector<double>;

TEST_CASE("parse_layup reads standard notation") {
  struct Row {
    const char* text;
    Angles angles;
  };
  for (const Row& row : {Row{"[0]", {0}},
                         {"[0/90]", {0, 90}},
                         {"[0/90]T", {0, 90}},
                         {"[0/90]s", {0, 90, 90, 0}},
                         {"[0/90]S", {0, 90, 90, 0}},
                         {"[0/90]2", {0, 90, 0, 90}},
                         {"[0/90]_2", {0, 90, 0, 90}},
                         {"[0/90]2s", {0, 90, 0, 90, 90, 0, 90, 0}},
                         {"[0/90]_2s", {0, 90, 0, 90, 90, 0, 90, 0}},
                         {"[0/90]2T", {0, 90, 0, 90}},
                         {"[0_3]", {0, 0, 0}},
                         {"[0_2/-45_2]", {0, 0, -45, -45}},
                         {"[±45]", {45, -45}},
                         {"[+-45]", {45, -45}},
                         {"[∓45]", {-45, 45}},
                         {"[-+45]", {-45, 45}},
                         {"[±45_2]", {45, -45, 45, -45}},
                         {"[+30/-30]", {30, -30}},
                         {"[22.5/.5]", {22.5, 0.5}},
                         {"[±45/0_2/90]s", {45, -45, 0, 0, 90, 90, 0, 0, -45, 45}},
                         {"[(0/90)_2/45]", {0, 90, 0, 90, 45}},
                         {"[(0/90)2/45]", {0, 90, 0, 90, 45}},
                         {"[[0/90]s/45]", {0, 90, 90, 0, 45}},
                         {"[(0/(45/-45)2)2]", {0, 45, -45, 45, -45, 0, 45, -45, 45, -45}},
                         {"[0/90\u0305]s", {0, 90, 0}},
                         {"[0/45/90\u0304]_s", {0, 45, 90, 45, 0}},
                         {" [ 0 / ± 45 _ 2 ] 2 s ",
                          {0, 45, -45, 45, -45, 0, 45, -45, 45, -45, -45, 45, -45, 45, 0, -45, 45, -45, 45, 0}}}) {
    CAPTURE(row.text);
    CHECK(parse_layup(row.text) == row.angles);
  }
}

TEST_CASE("parse_layup reads the thesis' panels") {
  const Angles twenty = parse_layup("[0/45/0/-45/0]2s");
  CHECK(twenty == Angles{0, 45, 0, -45, 0, 0, 45, 0, -45, 0, 0, -45, 0, 45, 0, 0, -45, 0, 45, 0});
  CHECK(parse_layup("[(±45/0_2)_2/±45/0/90]_2s").size() == 48);
}

TEST_CASE("parse_layup names the column of what is wrong") {
  struct Row {
    const char* text;
    const char* message;
  };
  for (const Row& row : {
           Row{"", "layup '': column 1: expected '['; a layup reads [0/90]s"},
           {"0/90", "column 1: expected '['"},
           {"[0/90", "column 6: the closing ']' is missing"},
           {"[]", "column 2: expected an angle in degrees, not ']'"},
           {"[0//90]", "column 4: expected an angle in degrees, not '/'"},
           {"[0/x]", "column 4: expected an angle in degrees, not 'x'"},
           {"[0/", "column 4: the layup ends where an angle is expected"},
           {"[±45/y]", "column 6: expected an angle in degrees, not 'y'"},
           {"[0 90]", "column 4: expected '/' or ']', not '9'"},
           {"[(0/90]", "column 7: expected '/' or ')', not ']'"},
           {"[0/90]s2", "column 8: unexpected '2' after the layup"},
           {"[0/90]°", "column 7: unexpected '°' after the layup"},
           {"[0_/90]", "column 4: expected a count after '_'"},
           {"[0/90]_", "column 8: expected a count, s or T after '_'"},
           {"[0/90]0", "column 7: a count is at least 1"},
           {"[0_0]", "column 4: a count is at least 1"},
           {"[0/400]", "column 4: the angle 400 is beyond 360 degrees"},
           {"[0]99999999999999999999", "column 4: more than 100000 plies"},
           {"[0_400]400s", "more than 100000 plies"},
           {"[90\u0305/0]s", "column 6: a barred ply is the middle one, so it must be the last of its group"},
           {"[0/90\u0305]", "a barred ply is the middle one of a symmetric group"},
           {"[0/90\u0305]2s", "a group with a barred ply is not repeated"},
           {"[±45\u0305]s", "a pair of plies cannot be the middle ply"},
           {"[+±45]", "column 3: expected an angle in degrees, not '±'"},
       }) {
    CAPTURE(row.text);
    CHECK_THROWS_WITH((void)parse_layup(row.text), doctest::Contains(row.message));
  }
  CHECK_THROWS_WITH((void)parse_layup("[" + std::string(200, '(')), doctest::Contains("nested too deeply"));
}
