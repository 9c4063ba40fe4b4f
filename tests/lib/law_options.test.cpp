#include "lib/cli/law_options.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/hertz.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace impulse;
using impulse::test::TemporaryDirectory;

namespace {

doctest::Approx rounded(double value) { return doctest::Approx(value).epsilon(1e-13).scale(0); }

LawOptions options_of(const std::vector<std::string>& arguments) {
  Command command({"ir-test", "Tests the law.", "", "ir-test"});
  LawOptions options;
  options.declare(command);
  std::vector<const char*> argv{"ir-test"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  (void)command.parse(static_cast<int>(argv.size()), argv.data());
  return options;
}

ContactLaw law_of(const std::vector<std::string>& arguments) { return options_of(arguments).law(); }

std::string refusal(const std::vector<std::string>& arguments) {
  try {
    (void)law_of(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

const std::vector<std::string> tip{"--tip-radius",         "6.35mm",           "--tip-material",
                                   "210GPa:7960kg/m3:0.3", "--target-modulus", "7.9GPa"};
const std::vector<std::string> permanent{"--permanent-beta", "0.094", "--critical-indentation", "0.1667mm"};
constexpr double at = 4e-4;

}  // namespace

TEST_CASE("law options: rigid unless asked for something else") {
  CHECK(law_of({}).is_rigid());
  CHECK(law_of({"--law", "rigid"}).is_rigid());
}

TEST_CASE("law options: the stiffness has the unit of the law") {
  CHECK(law_of({"--law", "linear", "--stiffness", "2kN/mm"}).force(at, {}) == rounded(2e6 * at));
  CHECK(law_of({"--law", "linear", "--stiffness", "2e6"}).force(at, {}) == rounded(2e6 * at));
  CHECK(law_of({"--law", "hertz", "--stiffness", "1.413e6N/cm^1.5"}).force(at, {}) ==
        rounded(1.413e9 * std::pow(at, 1.5)));
  CHECK(refusal({"--law", "hertz", "--stiffness", "5N/m"}) ==
        "--stiffness: '5N/m': wrong dimension: expected a stiffness of a 3/2 law such as 1.4e6N/cm^1.5");
  CHECK(refusal({"--law", "linear", "--stiffness", "5N/m^1.5"}) ==
        "--stiffness: '5N/m^1.5': wrong dimension: expected a stiffness such as 2kN/mm");
}

TEST_CASE("law options: in a file the stiffness may be a bare number; a text keeps its dimension") {
  const TemporaryDirectory directory;
  const auto law_in = [&](const std::string& stiffness) {
    return law_of({"--config", directory.write("law.toml", "law = \"linear\"\nstiffness = " + stiffness + "\n")});
  };
  CHECK(law_in("5e9").force(at, {}) == rounded(5e9 * at));
  CHECK(law_in("5000000000").force(at, {}) == rounded(5e9 * at));
  CHECK(law_in("\"5GN/m\"").force(at, {}) == rounded(5e9 * at));
  CHECK_THROWS_WITH_AS(law_in("\"5kg\""), "--stiffness: '5kg': wrong dimension: expected a stiffness such as 2kN/mm",
                       UsageError);
}

TEST_CASE("law options: hertz and tan-sun take the stiffness of a tip on a target") {
  const double k = hertz_stiffness(6.35e-3, {"tip", 210e9, 7960, 0.3}, 7.9e9);
  CHECK(law_of(with({"--law", "hertz"}, tip)).force(at, {}) == rounded(k * std::pow(at, 1.5)));
  const ContactLaw tan_sun = law_of(with(with({"--law", "tan-sun"}, tip), permanent));
  const LawHistory history = tan_sun.advanced({}, at);
  CHECK(history.largest_force_N == rounded(k * std::pow(at, 1.5)));
  CHECK(tan_sun.permanent_indentation(history) == rounded(0.094 * (at - 1.667e-4)));
  CHECK(law_of(with({"--law", "tan-sun", "--stiffness", "1e9"}, permanent)).force(at, {}) ==
        rounded(1e9 * std::pow(at, 1.5)));
}

TEST_CASE("law options: constants may follow the name of the law") {
  CHECK(law_of({"--law", "rigid"}).is_rigid());
  CHECK(law_of({"--law", "linear:2kN/mm"}).force(at, {}) == rounded(2e6 * at));
  CHECK(law_of({"--law", "hertz:1.413e6N/cm^1.5"}).force(at, {}) == rounded(1.413e9 * std::pow(at, 1.5)));
  const ContactLaw tan_sun = law_of({"--law", "tan-sun:1e9:0.094:0.1667mm"});
  CHECK(tan_sun.permanent_indentation(tan_sun.advanced({}, at)) == rounded(0.094 * (at - 1.667e-4)));
  for (const auto& [flag, value] : std::vector<std::pair<std::string, std::string>>{{"--stiffness", "1e6"},
                                                                                    {"--tip-radius", "1mm"},
                                                                                    {"--tip-material", "steel:0.3"},
                                                                                    {"--target-modulus", "1GPa"},
                                                                                    {"--permanent-beta", "0.1"},
                                                                                    {"--critical-indentation", "1mm"}})
    CHECK(refusal({"--law", "hertz:1e9", flag, value}) == flag + ": 'hertz:1e9' has its constants already");
  CHECK(refusal({"--law", "rigid:1"}) == "--law: 'rigid:1': rigid takes no constants");
  CHECK(refusal({"--law", "linear:1:2"}) == "--law: 'linear:1:2': linear takes one constant, its stiffness");
  CHECK(refusal({"--law", "tan-sun:1:0.1:1mm:4"}) ==
        "--law: 'tan-sun:1:0.1:1mm:4': tan-sun takes three constants, STIFFNESS:BETA:INDENTATION");
  CHECK(refusal({"--law", "hertz:"}).starts_with("--law: 'hertz:': --stiffness: ''"));
  CHECK(refusal({"--law", "hertz:5N/m"}).starts_with("--law: 'hertz:5N/m': --stiffness: '5N/m': wrong dimension"));
  CHECK(refusal({"--law", "tan-sun:1e9"}) == "--law: 'tan-sun:1e9': --permanent-beta: --law tan-sun needs it");
  CHECK(refusal({"--law", "tan-sun:1e9:0.1kg:1mm"}).starts_with("--law: 'tan-sun:1e9:0.1kg:1mm': '0.1kg'"));
  CHECK(refusal({"--law", "herz:1e9"}) == "--law: 'herz:1e9' is neither rigid, linear, hertz or tan-sun nor a file");
}

TEST_CASE("law options: one law for all contacts, or one each with its constants") {
  const std::vector<ContactLaw> same = options_of({"--law", "hertz", "--stiffness", "1e9"}).laws(3);
  REQUIRE(same.size() == 3);
  CHECK(same[2].force(at, {}) == rounded(1e9 * std::pow(at, 1.5)));
  const TemporaryDirectory directory;
  const std::string path = directory.write("a:b.csv", "indentation_m,loading_force_N\n0,0\n1e-3,500\n");
  const std::vector<ContactLaw> own =
      options_of({"--law", "linear:2e6", "--law", "rigid", "--law", path, "--law", "hertz:1e9"}).laws(4);
  REQUIRE(own.size() == 4);
  CHECK(own[0].force(at, {}) == rounded(2e6 * at));
  CHECK(own[1].is_rigid());
  CHECK(own[2].force(at, {}) == rounded(200));
  CHECK(own[3].force(at, {}) == rounded(1e9 * std::pow(at, 1.5)));
  const auto refused = [](const std::vector<std::string>& arguments, std::size_t contacts) -> std::string {
    try {
      (void)options_of(arguments).laws(contacts);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  };
  CHECK(refused({"--law", "rigid", "--law", "linear:1"}, 3) ==
        "--law: given 2 times for 3 contacts; give it once, or once for each");
  CHECK(refused({"--law", "rigid", "--law", "rigid"}, 1) ==
        "--law: given 2 times for 1 contact; give it once, or once for each");
  CHECK(refused({"--law", "linear:1", "--law", "linear:2", "--stiffness", "3"}, 2) ==
        "--stiffness: each of several laws has its constants after colons, --law linear:1e8N/m");
  CHECK(refused({"--law", "linear:1", "--law", "linear"}, 2) ==
        "--law: 'linear': --stiffness: --law linear needs it, a stiffness such as 2kN/mm");
}

TEST_CASE("law options: any other word is the file of a table") {
  const TemporaryDirectory directory;
  const std::string path = directory.write("law.csv", "indentation_m,loading_force_N\n0,0\n1e-3,500\n");
  CHECK(law_of({"--law", path}).force(at, {}) == rounded(200));
  const std::string bad = directory.write("bad.csv", "indentation_m,loading_force_N\n0,0\n1e-3,500\n5e-4,600\n");
  CHECK_THROWS_WITH_AS((void)law_of({"--law", bad}),
                       doctest::Contains("bad.csv:4:1: indentation 0.0005 m does not increase"), InputError);
  CHECK(refusal({"--law", "herz"}) == "--law: 'herz' is neither rigid, linear, hertz or tan-sun nor a file");
  CHECK(refusal({"--law", path, "--stiffness", "1"}) == "--stiffness: means nothing to --law " + path);
}

TEST_CASE("law options: an option that means nothing to the law is refused by name") {
  const std::vector<std::pair<std::string, std::string>> values{
      {"--stiffness", "1e6"},       {"--tip-radius", "1mm"},     {"--tip-material", "steel:0.3"},
      {"--target-modulus", "1GPa"}, {"--permanent-beta", "0.1"}, {"--critical-indentation", "1mm"}};
  for (const auto& [flag, value] : values) {
    CAPTURE(flag);
    CHECK(refusal({"--law", "rigid", flag, value}) == flag + ": means nothing to --law rigid");
    if (flag == "--stiffness") continue;
    CHECK(refusal({"--law", "linear", "--stiffness", "1", flag, value}) == flag + ": means nothing to --law linear");
    if (flag == "--permanent-beta" || flag == "--critical-indentation")
      CHECK(refusal({"--law", "hertz", "--stiffness", "1", flag, value}) == flag + ": means nothing to --law hertz");
    else
      CHECK(refusal({"--law", "hertz", "--stiffness", "1", flag, value}) ==
            "--stiffness: given beside a tip or target, which determine it");
  }
}

TEST_CASE("law options: what is missing is said") {
  CHECK(refusal({"--law", "linear"}) == "--stiffness: --law linear needs it, a stiffness such as 2kN/mm");
  CHECK(refusal({"--law", "hertz"}) ==
        "--stiffness: --law hertz needs it, a stiffness of a 3/2 law such as 1.4e6N/cm^1.5, or --tip-radius, "
        "--tip-material "
        "and --target-modulus");
  const std::string together =
      ": the stiffness follows from --tip-radius, --tip-material and --target-modulus together";
  CHECK(refusal({"--law", "hertz", tip[2], tip[3], tip[4], tip[5]}) == "--tip-radius" + together);
  CHECK(refusal({"--law", "hertz", tip[0], tip[1], tip[4], tip[5]}) == "--tip-material" + together);
  CHECK(refusal({"--law", "hertz", tip[0], tip[1], tip[2], tip[3]}) == "--target-modulus" + together);
  CHECK(refusal({"--law", "tan-sun", "--stiffness", "1", permanent[0], permanent[1]}) ==
        "--critical-indentation: --law tan-sun needs it");
  CHECK(refusal({"--law", "tan-sun", "--stiffness", "1", permanent[2], permanent[3]}) ==
        "--permanent-beta: --law tan-sun needs it");
  CHECK(refusal({"--law", "hertz", tip[0], tip[1], "--tip-material", "steel", tip[4], tip[5]}) ==
        "--tip-material: 'steel' has no Poisson's ratio; add one, steel:0.3");
}

TEST_CASE("law options: values out of range are refused by name") {
  for (const char* bad : {"-1", "0"})
    CHECK(refusal({"--law", "linear", "--stiffness=" + std::string(bad)}) ==
          fmt::format("--stiffness: '{}' is not positive", bad));
  CHECK(refusal({"--law", "linear", "--stiffness", "nan"}).starts_with("--stiffness: 'nan': not a number"));
  CHECK(refusal({"--law", "linear", "--stiffness", "stiff"}).starts_with("--stiffness: 'stiff': not a number"));
  CHECK(refusal({"--law", "tan-sun", "--stiffness", "1", "--permanent-beta", "1", "--critical-indentation", "0"}) ==
        "--permanent-beta: 1 is not below 1");
  CHECK(refusal({"--law", "tan-sun", "--permanent-beta=-0.1"}).starts_with("--permanent-beta: "));
  CHECK(refusal({"--law", "tan-sun", "--critical-indentation=-1mm"}).starts_with("--critical-indentation: "));
  CHECK(refusal({"--law", "hertz", "--tip-radius", "0"}).starts_with("--tip-radius: "));
  CHECK(refusal({"--law", "hertz", "--target-modulus", "0"}).starts_with("--target-modulus: "));
}
