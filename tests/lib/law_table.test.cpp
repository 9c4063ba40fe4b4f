#include "lib/law/law_table.hpp"

#include "lib/contract/errors.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <vector>

using namespace impulse;
using namespace impulse::laws;
using impulse::test::TemporaryDirectory;

namespace {

std::string table_refusal(const std::string& csv) {
  const TemporaryDirectory directory;
  try {
    (void)read_law_table(directory.write("law.csv", csv));
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("law.csv"));
  }
  return "no error";
}

}  // namespace

TEST_CASE("law table: one of a linear law is that law") {
  const ContactLaw linear = ContactLaw::linear(2e6);
  for (const std::vector<double>& unloading : std::vector<std::vector<double>>{{}, {0, 400, 1400}}) {
    const ContactLaw table = ContactLaw::table({{0, 2e-4, 7e-4}, {0, 400, 1400}, unloading});
    for (const std::vector<double>& path : std::vector<std::vector<double>>{{}, {5e-4}, {5e-4, -1e-4}}) {
      for (const double at : {-1e-4, 0.0, 1e-4, 2e-4, 3e-4, 7e-4}) {
        CAPTURE(at);
        const LawHistory history = after(table, path);
        CHECK(table.force(at, history) == rounded(linear.force(at, history)));
        CHECK(table.tangent(at, history) == rounded(linear.tangent(at, history)));
        CHECK(table.stored_energy(at, history) == rounded(linear.stored_energy(at, history)));
      }
    }
  }
}

TEST_CASE("law table: one that unloads as it loads is elastic, which its scaled curve would not be") {
  const ContactLaw law = ContactLaw::table({{0, 1e-3, 2e-3}, {0, 6, 8}, {0, 6, 8}});
  const LawHistory turned = after(law, {1e-3});
  CHECK(turned.dissipated_J == 0);
  CHECK(law.force(0.5e-3, turned) == rounded(3));
  CHECK(law.stored_energy(1.5e-3, after(law, {2e-3})) == rounded(0.003 + 0.5e-3 * 6.5));
}

TEST_CASE("law table: unloading keeps its shape") {
  const ContactLaw law = ContactLaw::table(lossy);
  const LawHistory full = after(law, {6e-4});
  CHECK(law.force(2e-4, full) == rounded(40));
  CHECK(law.force(3e-4, full) == rounded(220));
  CHECK(law.permanent_indentation(full) == rounded(1e-4));
  const LawHistory half = after(law, {3e-4});  // loading there: 525 N
  CHECK(half.largest_force_N == rounded(525));
  CHECK(law.force(1.5e-4, half) == rounded(220 * 525 / 1500.0));
  CHECK(law.permanent_indentation(half) == rounded(0.5e-4));
  // Stored at αm: c αm Fm with c = (2e-3 + 44e-3 + 190e-3)/0.9.
  CHECK(law.stored_energy(3e-4, half) == rounded(0.236 / 0.9 * 3e-4 * 525));
  CHECK(law.stored_energy(3e-4, {}) == rounded(0.236 / 0.9 * 3e-4 * 525));
  // A table has no reloading curve of its own.
  CHECK(law.force(3e-4, after(law, {6e-4, 0})) == rounded(220));
}

TEST_CASE("law table: it is read from its columns, in any order, with or without unloading") {
  const TemporaryDirectory directory;
  const LawTable both = read_law_table(directory.write(
      "both.csv", "note,unloading_force_N,loading_force_N,indentation_m\na,0,0,0\nb,10,20,1e-4\nc,50,50,2e-4\n"));
  CHECK(both.indentation_m == std::vector<double>{0, 1e-4, 2e-4});
  CHECK(both.loading_force_N == std::vector<double>{0, 20, 50});
  CHECK(both.unloading_force_N == std::vector<double>{0, 10, 50});
  const LawTable elastic = read_law_table(directory.write("e.csv", "indentation_m,loading_force_N\n0,0\n1e-3,5\n"));
  CHECK(elastic.unloading_force_N.empty());
}

TEST_CASE("law table: tables that are none are refused with file:line:column") {
  const std::string head = "indentation_m,loading_force_N,unloading_force_N\n";
  const std::array<std::array<std::string, 2>, 14> cases{{
      {"0,0,0\n1e-3,5,5\n1e-3,6,6\n", "law.csv:4:1: indentation 0.001 m does not increase (before: 0.001 m)"},
      {"0,0,0\n# note\n1e-3,5,4\n2e-3,5,5\n", "law.csv:5:2: loading force 5 N does not increase (before: 5 N)"},
      {"0,0,0\n1e-3,5,4\n2e-3,7,3\n3e-3,9,9\n",
       "law.csv:4:3: unloading force 3 N is less than at the indentation before, 4 N"},
      {"0,0,0\n1e-3,5,6\n2e-3,7,7\n", "law.csv:3:3: unloading force 6 N is above the loading force 5 N"},
      {"0,0,0\n1e-3,5,4\n2e-3,7,6\n", "law.csv:4:3: unloading starts at 6 N, but loading ends at 7 N"},
      {"1e-4,0,0\n1e-3,5,5\n", "law.csv:2:1: the first indentation is 0.0001 m; the table must start at 0"},
      {"0,1,0\n1e-3,5,5\n", "law.csv:2:2: the force at indentation 0 is 1 N, not 0"},
      {"0,0,-1\n1e-3,5,5\n", "law.csv:2:3: the force at indentation 0 is -1 N, not 0"},
      {"0,0,0\n", "law.csv:2:1: a table of 1 point(s); two or more are needed"},
      {"0,0,0\n1e-3,nan,5\n", "law.csv:3:2: "},
      {"0,0,0\n1e-3,,5\n", "law.csv:3:2: "},
      {"0,0,0\n-1e-3,5,5\n", "law.csv:3:1: indentation -0.001 m does not increase"},
      // Concave and all but elastic: scaled to a small indentation, where loading is straight, it would create energy.
      {"0,0,0\n1e-3,6,5\n2e-3,8,8\n", "law.csv:3:3: unloading from 0.001 m gives back 0.0033"},
      // The loss is negative within the second interval only, not at its ends.
      {"0,0,0\n1,1,0\n2,3,3\n6,34,34\n", "law.csv:5:3: unloading from 3.91"},
  }};
  for (const auto& [rows, message] : cases) {
    CAPTURE(rows);
    CHECK_MESSAGE(table_refusal(head + rows).starts_with(message), table_refusal(head + rows));
  }
  CHECK(table_refusal("indentation_m,force_N\n0,0\n").find("loading_force_N") != std::string::npos);
}
