#include "lib/cli/command.hpp"
#include "lib/cli/blamed_on.hpp"
#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"
#include "lib/material/material.hpp"
#include "lib/material/profile.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace impulse;
using impulse::test::TemporaryDirectory;

namespace {

/// One option of every kind.
struct Values {
  double speed = 0;
  double tolerance = 0.25;
  std::optional<double> gap;
  std::vector<double> diameters;
  std::size_t repeat = 1;
  std::optional<std::size_t> modes;
  std::string title;
  std::vector<std::string> notes;
  bool thin = false;
  Face face = Face::a;
  std::vector<Face> faces{Face::a};
  Material material;
  std::vector<Segment> segments;
  std::vector<std::string> files;
  std::string stiffness;
  std::string output;
  std::optional<std::string> second_output;
};

void declare(Command& command, Values& v) {
  command.body("cone");
  command.quantity("--speed", v.speed, "m/s", Sign::positive, "impact speed").required();
  command.quantity("--tolerance", v.tolerance, "1", Sign::non_negative, "tolerance");
  command.quantity("--gap", v.gap, "m", Sign::any, "gap");
  command.quantity("--diameters", v.diameters, "m", Sign::positive, "diameters");
  command.count("--repeat", v.repeat, 1, "repetitions");
  command.count("--modes", v.modes, 0, "number of modes");
  command.text("--title", v.title, "TEXT", "title");
  command.text("--note", v.notes, "TEXT", "notes");
  command.flag("--thin", v.thin, "thin");
  command.choice("--face", v.face, {{"A", Face::a}, {"B", Face::b}}, "face");
  command.choice("--faces", v.faces, {{"A", Face::a}, {"B", Face::b}}, "faces");
  command.parsed("--material", v.material, parse_material, "MATERIAL", "material");
  command.parsed("--segment", v.segments, parse_segment, "L,D,MATERIAL", "segments");
  command.text("--stiffness", v.stiffness, "STIFFNESS", "its unit depends").or_number();
  command.output(v.output);
  command.output_file("--second", v.second_output, "more");
}

const ToolPage page{"ir-test", "Tests the front end.", "", "ir-test --speed 5m/s"};

struct Parsed {
  Values values;
  Command command{page};

  explicit Parsed(std::vector<const char*> arguments, std::size_t most_files = 0) {
    declare(command, values);
    if (most_files > 0) command.files("FILE", values.files, 0, most_files, "files");
    arguments.insert(arguments.begin(), "ir-test");
    // No REQUIRE: it would turn the exception that a refusal is about into another.
    (void)command.parse(static_cast<int>(arguments.size()), arguments.data());
  }
};

std::string refusal(const std::vector<const char*>& arguments) {
  try {
    const Parsed parsed(arguments);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

/// Refusal of a configuration file called p.toml, from its name on.
std::string config_refusal(const std::string& toml) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("p.toml", toml);
  try {
    const Parsed parsed({"--speed=1", "--config", path.c_str()});
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("p.toml"));
  }
  return "no error";
}

}  // namespace

TEST_CASE("command: every kind of option is read from the command line") {
  const Parsed p({"--speed",   "5m/s",      "--gap=-1mm", "--diameters", "30mm,0.075", "--repeat",   "3",
                  "--modes=0", "--title",   "a b",        "--note",      "x,y",        "--note",     "z",
                  "--thin",    "--face",    "B",          "--faces",     "A,B",        "--material", "steel",
                  "--segment", "1,2,steel", "--segment",  "1,2,3,steel", "-o",         "out.csv"});
  CHECK(p.values.speed == 5);
  CHECK(p.values.gap == -1e-3);
  CHECK(p.values.diameters == std::vector<double>{0.03, 0.075});
  CHECK(p.values.repeat == 3);
  CHECK(p.values.modes == 0);
  CHECK(p.values.title == "a b");
  CHECK(p.values.notes == std::vector<std::string>{"x,y", "z"});
  CHECK(p.values.thin);
  CHECK(p.values.face == Face::b);
  CHECK(p.values.faces == std::vector<Face>{Face::a, Face::b});
  CHECK(p.values.material.name == "steel");
  REQUIRE(p.values.segments.size() == 2);
  CHECK(p.values.segments[1].diameter_b_m == 3);
  CHECK(p.values.output == "out.csv");
  CHECK(p.command.given("--gap"));
  CHECK_FALSE(p.command.given("--tolerance"));
}

TEST_CASE("command: what is not given keeps its default") {
  const Parsed p({"--speed", "5"});
  CHECK(p.values.tolerance == 0.25);
  CHECK_FALSE(p.values.gap.has_value());
  CHECK(p.values.repeat == 1);
  CHECK(p.values.faces == std::vector<Face>{Face::a});
  CHECK_FALSE(p.values.thin);
}

TEST_CASE("command: negative numbers are values, not options") {
  CHECK(Parsed({"--speed", "5", "--gap", "-.5"}).values.gap == -0.5);
  CHECK(refusal({"--speed", "-5"}) == "--speed: '-5' is not positive");
}

TEST_CASE("command: refusals name the flag") {
  CHECK(refusal({}) == "--speed: required, but not given");
  CHECK(refusal({"--speed", "5kg"}) == "--speed: '5kg': wrong dimension: expected a speed such as 5m/s");
  CHECK(refusal({"--speed"}) == "--speed: needs a value");
  CHECK(refusal({"--speed", "--gap", "1"}) == "--speed: needs a value");
  CHECK(refusal({"--speed", "1", "-o", ""}) == "--output: the name of the file is empty");
  CHECK(refusal({"--speed="}) == "--speed: needs a value");
  CHECK(refusal({"--speed", "1", "--speed", "2"}) == "--speed: given twice");
  CHECK(refusal({"--speed", "1", "--thin", "--thin"}) == "--thin: given twice");
  CHECK(refusal({"--speed", "1", "--thin=no"}) == "--thin: takes no value");
  CHECK(refusal({"--speed", "1", "--tolerance", "-1"}) == "--tolerance: '-1' is negative");
  CHECK(refusal({"--speed", "1", "--repeat", "0"}) == "--repeat: 0 is too small (at least 1)");
  CHECK(refusal({"--speed", "1", "--repeat", "1.5"}) == "--repeat: '1.5' is not a whole number");
  CHECK(refusal({"--speed", "1", "--repeat", "-1"}) == "--repeat: '-1' is not a whole number");
  CHECK(refusal({"--speed", "1", "--face", "C"}) == "--face: 'C' is none of A, B");
  CHECK(refusal({"--speed", "1", "--faces", "A,C"}) == "--faces: 'C' is none of A, B");
  CHECK(refusal({"--speed", "1", "--material", "wood"}).starts_with("--material: unknown material 'wood'; known are"));
  CHECK(refusal({"--speed", "1", "--diameters", "1,,2"}) == "--diameters: '': empty: expected a length such as 400mm");
  CHECK(refusal({"--sped=1"}) == "--sped: unknown option (--help lists those there are)");
  CHECK(refusal({"--speed", "1", "-x"}) == "-x: unknown option (--help lists those there are)");
  CHECK(refusal({"--speed", "1", "x.csv"}) == "unexpected argument 'x.csv'");
}

TEST_CASE("command: a file that cannot be written is refused before anything is computed") {
  const TemporaryDirectory directory;
  const std::string file = directory.write("a.csv", "kept");
  CHECK(refusal({"--speed", "1", "-o", "/nowhere/a.csv"}) ==
        "--output: cannot write /nowhere/a.csv: No such file or directory");
  CHECK(refusal({"--speed", "1", "-o", "/"}) == "--output: cannot write /: Is a directory");
  CHECK(refusal({"--speed", "1", "--second", (file + "/b.csv").c_str()}) ==
        "--second: cannot write " + file + "/b.csv: Not a directory");
  CHECK(refusal({"--speed", "1", "-o", "/dev/none"}) == "--output: cannot write /dev/none: No such file or directory");
  const Parsed p({"--speed", "1", "-o", file.c_str(), "--second", "-"});
  CHECK(p.values.output == file);
  CHECK(directory.read("a.csv") == "kept");
  CHECK(directory.file_count() == 1);
}

TEST_CASE("command: positional files") {
  CHECK(Parsed({"--speed", "1"}, 2).values.files == std::vector<std::string>{"-"});
  CHECK(Parsed({"a", "--speed", "1", "-"}, 2).values.files == std::vector<std::string>{"a", "-"});
  CHECK(Parsed({"--speed", "1", "--", "-a"}, 2).values.files == std::vector<std::string>{"-a"});
  CHECK_THROWS_WITH(Parsed({"--speed", "1", "a", "b", "c"}, 2), "unexpected argument 'c'");
  CHECK_THROWS_WITH(Parsed({"--speed", "1", "-", "-"}, 2), "standard input ('-') can be read only once");
  Command command(page);
  std::vector<std::string> files;
  command.files("RESPONSE", files, 2, 9, "responses");
  const char* arguments[] = {"ir-test", "a"};
  CHECK_THROWS_WITH_AS((void)command.parse(2, arguments), "needs RESPONSE..., at least 2 (see --help)",
                       std::invalid_argument);
  Command pair(page);
  pair.files("FIRST SECOND", files, 2, 2, "responses");
  CHECK_THROWS_WITH_AS((void)pair.parse(2, arguments), "needs FIRST SECOND (see --help)", std::invalid_argument);
}

TEST_CASE("command: help shows usage, units, defaults and ends with the example") {
  Command command(page);
  Values values;
  declare(command, values);
  command.files("FILE", values.files, 0, 9, "what to read");
  const std::string help = command.help_text();
  CHECK(help.starts_with("Usage: ir-test [OPTIONS]... [FILE...]\nTests the front end.\n"));
  CHECK(help.find("impact speed [m/s] (required)") != help.npos);
  CHECK(help.find("(default: 0.25)") != help.npos);
  CHECK(help.find("--face A|B") != help.npos);
  CHECK(help.find("faces (default: A)") != help.npos);
  CHECK(help.find("--config FILE") != help.npos);
  CHECK(help.ends_with("\nExample:\n  ir-test --speed 5m/s\n"));
}

TEST_CASE("command: every kind of option is read from TOML, and the command line wins") {
  const TemporaryDirectory directory;
  const std::string path = directory.write("p.toml",
                                           "body = \"cone\"\nspeed = \"5m/s\"\ntolerance = 1\ngap = 0.5\n"
                                           "diameters = [\"30mm\", 0.075]\nrepeat = 3\ntitle = \"t\"\nnote = \"n\"\n"
                                           "thin = true\nface = \"B\"\nfaces = [\"A\", \"B\"]\nmaterial = \"steel\"\n"
                                           "segment = [\"1,2,steel\",\n  \"1,2,3,steel\"]\n");
  const Parsed p({"--config", path.c_str(), "--tolerance", "0.5", "--note", "mine", "--note", "own"});
  CHECK(p.values.speed == 5);
  CHECK(p.values.tolerance == 0.5);
  CHECK(p.values.gap == 0.5);
  CHECK(p.values.diameters == std::vector<double>{0.03, 0.075});
  CHECK(p.values.repeat == 3);
  CHECK(p.values.title == "t");
  CHECK(p.values.notes == std::vector<std::string>{"mine", "own"});
  CHECK(p.values.thin);
  CHECK(p.values.face == Face::b);
  CHECK(p.values.faces == std::vector<Face>{Face::a, Face::b});
  CHECK(p.values.segments.size() == 2);
  CHECK(p.command.given("--gap"));
}

TEST_CASE("blamed_on: what a function refuses becomes the refusal of a flag, anything else goes on") {
  CHECK(blamed_on("--growth", [] { return 3; }) == 3);
  CHECK_THROWS_WITH_AS(blamed_on("--growth", []() -> int { throw std::invalid_argument("growth 0.9 is below 1"); }),
                       "--growth: growth 0.9 is below 1", UsageError);
  CHECK_THROWS_AS(blamed_on("--growth", []() -> int { throw ConvergenceError("no", 1e-9, 1e-3, 5); }),
                  ConvergenceError);
}

TEST_CASE("blamed_on: of a file, a flag is a key and what names its place already passes") {
  const TomlFile file{.name = "p.toml", .entries = {}};
  CHECK(blamed_on(file, [] { return 3; }) == 3);
  CHECK_THROWS_WITH_AS(blamed_on(file, []() -> int { throw UsageError("--growth", "is below 1"); }),
                       "p.toml: growth: is below 1", InputError);
  CHECK_THROWS_WITH_AS(blamed_on(file, []() -> int { throw InputError("q.msh", 3, 0, "no node"); }), "q.msh:3: no node",
                       InputError);
}

TEST_CASE("command: refusals of TOML name file, line, column and key") {
  CHECK(config_refusal("gap = 1\nspeeed = 2\n") == "p.toml:2:1: unknown key 'speeed'");
  CHECK(config_refusal("[table]\na = 1\n").starts_with("p.toml:1:"));
  CHECK(config_refusal("output = \"/nowhere/a\"\n") ==
        "p.toml:1:10: output: cannot write /nowhere/a: No such file or directory");
  CHECK(config_refusal("stiffness = true\n") ==
        "p.toml:1:13: stiffness: expected a number or a string with a unit, not a boolean");
  CHECK(config_refusal("gap = \"5kg\"\n") ==
        "p.toml:1:7: gap: '5kg': wrong dimension: expected a length such as 400mm");
  CHECK(config_refusal("gap = true\n") == "p.toml:1:7: gap: expected a number or a string with a unit, not a boolean");
  CHECK(config_refusal("gap = [1, 2]\n") == "p.toml:1:1: gap: takes one value, not an array");
  CHECK(config_refusal("note = []\n") == "p.toml:1:1: note: the array is empty");
  CHECK(config_refusal("note = [\"a\", 2]\n") == "p.toml:1:14: note: expected a string, not an integer");
  CHECK(config_refusal("note = [\"a\",\n \"b\"]\nsegment = [\"1m,1mm,steel\",\n  \"1m,1mm,stel\"]\n")
            .starts_with("p.toml:4:3: segment: unknown material"));
  CHECK(config_refusal("repeat = 1.5\n") == "p.toml:1:10: repeat: expected a whole number, not a number");
  CHECK(config_refusal("thin = \"yes\"\n") == "p.toml:1:8: thin: expected true or false, not a string");
  CHECK(config_refusal("title = 5\n") == "p.toml:1:9: title: expected a string, not an integer");
  CHECK(config_refusal("gap = inf\n") == "p.toml:1:7: gap: 'inf': not a number: expected a length such as 400mm");
  CHECK(config_refusal("help = true\n") == "p.toml:1:1: unknown key 'help'");
  CHECK(config_refusal("config = \"a\"\n") == "p.toml:1:1: unknown key 'config'");
  CHECK(config_refusal("body = \"beam\"\n") == "p.toml:1:8: is a beam, ir-test wants a cone");
  CHECK(config_refusal("body = 1\n") == "p.toml:1:1: body: expected a string such as \"cone\"");
  CHECK(refusal({"--speed", "1", "--config", "/nowhere/p.toml"}) == "/nowhere/p.toml: No such file or directory");
  CHECK(refusal({"--config", "a", "--config", "b"}) == "--config: given twice");
  CHECK(refusal({"--config", ""}) == "--config: the name of the file is empty");
}

TEST_CASE("command: what is not TOML is shown with the way to write it") {
  const std::string way =
      "; write one key = value a line, texts and quantities with a unit in quotes: length = \"400mm\"";
  for (const auto& [text, place, line] : std::vector<std::array<std::string, 3>>{
           {"gap = 1\nspeed = \n", "p.toml:2:9: ", "'speed = ' is not TOML ("},
           {"gap = 400mm\n", "p.toml:1:10: ", "'gap = 400mm' is not TOML ("},
           {"gap = 1\ngap = 2\n", "p.toml:2:7: ", "'gap = 2' is not TOML (cannot redefine existing"},
           {"title = \"a\n", "p.toml:1:", "'title = \"a' is not TOML ("},
           {"just a text\n", "p.toml:1:", "'just a text' is not TOML ("}}) {
    CAPTURE(text);
    const std::string message = config_refusal(text);
    CAPTURE(message);
    CHECK(message.starts_with(place));
    CHECK(message.find(line) != message.npos);
    CHECK(message.find("Error while parsing") == message.npos);
    CHECK(message.ends_with(way));
  }
  CHECK(config_refusal("title = \"\xff\"\n").ends_with(": is not a text in UTF-8, and so not TOML"));
  const std::string endless = config_refusal("gap = \"" + std::string(5000, 'x') + "\n");
  CHECK(endless.size() < 500);
}

TEST_CASE("command: a text may also be a bare number in TOML where it says so") {
  const TemporaryDirectory directory;
  for (const char* value : {"5e9", "5000000000", "\"5e9\""}) {
    const std::string path = directory.write("p.toml", std::string("stiffness = ") + value + "\n");
    const Parsed p({"--speed=1", "--config", path.c_str()});
    CHECK(std::stod(p.values.stiffness) == 5e9);
  }
}

TEST_CASE("command: what the command line overrides must still be of the right type") {
  const TemporaryDirectory directory;
  const std::string path = directory.write("p.toml", "speed = true\n");
  CHECK_THROWS_AS(Parsed({"--speed", "1", "--config", path.c_str()}), InputError);
}

TEST_CASE("a tool without a body refuses the key") {
  const TemporaryDirectory directory;
  const std::string path = directory.write("p.toml", "body = \"cone\"\n");
  Command command(page);
  const char* arguments[] = {"ir-test", "--config", path.c_str()};
  CHECK_THROWS_WITH_AS((void)command.parse(3, arguments), doctest::Contains("p.toml:1:1: unknown key 'body'"),
                       InputError);
}

TEST_CASE("read_config_file reads a body without a command line") {
  const TemporaryDirectory directory;
  Values values;
  const auto declare_values = [&](Command& command) { declare(command, values); };
  read_config_file(directory.write("p.toml", "body = \"cone\"\nspeed = 2\n"), declare_values);
  CHECK(values.speed == 2);
  CHECK_THROWS_WITH_AS(read_config_file(directory.write("q.toml", "body = \"cone\"\n"), declare_values),
                       doctest::Contains("q.toml: needs the key 'speed'"), InputError);
  CHECK_THROWS_WITH_AS(read_config_file(directory.write("q.toml", "body = \"shell\"\n"), declare_values),
                       doctest::Contains("q.toml:1:8: is a shell, not a cone"), InputError);
}

TEST_CASE("body_kind tells what a body file describes") {
  const TemporaryDirectory directory;
  CHECK(body_kind(read_toml(directory.write("p.toml", "length = 1\nbody = \"beam\"\n"))) == "beam");
  CHECK_THROWS_WITH_AS((void)body_kind(read_toml(directory.write("p.toml", "length = 1\n"))),
                       doctest::Contains("p.toml: no key 'body'"), InputError);
  CHECK_THROWS_WITH_AS((void)body_kind(read_toml(directory.write("p.toml", "body = 3\n"))),
                       doctest::Contains("p.toml:1:1: body:"), InputError);
}
