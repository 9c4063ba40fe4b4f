#include "lib/plot/gnuplot.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

using namespace impulse;

namespace {

Picture two_curves() {
  return {"It's a_title", "time (µs)", "force (N)", {{"a_b.csv", {0, 1, 2}, {0, 1, 0}}, {"c.csv", {0, 2}, {1, -1}}}};
}

}  // namespace

TEST_CASE("gnuplot_script quotes texts and holds the data") {
  const std::string script = gnuplot_script(two_curves(), PictureFormat::svg);
  CHECK(script.find("set title 'It''s a_title'\n") != script.npos);
  CHECK(script.find("$curve1 << END\n0 1\n2 -1\nEND\n") != script.npos);
  CHECK(script.find("title 'a_b.csv'") != script.npos);
  Picture one = two_curves();
  one.curves.pop_back();
  CHECK(gnuplot_script(one, PictureFormat::svg).find("set key off\n") != std::string::npos);
}

TEST_CASE("gnuplot_script refuses curves that are none") {
  CHECK_THROWS_AS((void)gnuplot_script({}, PictureFormat::svg), std::invalid_argument);
  CHECK_THROWS_AS((void)gnuplot_script({"", "", "", {{"", {1}, {1}}}}, PictureFormat::svg), std::invalid_argument);
  CHECK_THROWS_AS((void)gnuplot_script({"", "", "", {{"", {1, 2}, {1}}}}, PictureFormat::svg), std::invalid_argument);
}

TEST_CASE("gnuplot_output draws every format, and the same twice") {
  struct Row {
    PictureFormat format;
    const char* begin;
  };
  for (const Row& row :
       {Row{PictureFormat::svg, "<?xml"}, {PictureFormat::png, "\x89PNG"}, {PictureFormat::pdf, "%PDF"}}) {
    const std::string script = gnuplot_script(two_curves(), row.format);
    const std::string output = gnuplot_output(script);
    CHECK(output.starts_with(row.begin));
    CHECK((gnuplot_output(script) == output));
  }
  const std::string svg = gnuplot_output(gnuplot_script(two_curves(), PictureFormat::svg));
  for (const char* text : {"It's a_title", "time (µs)", "force (N)", "a_b.csv", "</svg>"}) {
    CAPTURE(text);
    CHECK(svg.find(text) != svg.npos);
  }
  CHECK(gnuplot_output(gnuplot_script(two_curves(), PictureFormat::text)).find("time (µs)") != std::string::npos);
}

TEST_CASE("gnuplot_output dates a PDF at the epoch") {
  const std::string pdf = gnuplot_output(gnuplot_script(two_curves(), PictureFormat::pdf));
  CHECK((pdf.find("/CreationDate (D:19700101000000") != pdf.npos));
}

TEST_CASE("gnuplot_output draws constants") {
  const Picture flat{"", "x", "y", {{"", {1, 1}, {0, 0}}}};
  CHECK(gnuplot_output(gnuplot_script(flat, PictureFormat::svg)).starts_with("<?xml"));
}

TEST_CASE("gnuplot_output reports what gnuplot says, and its absence") {
  CHECK_THROWS_WITH_AS((void)gnuplot_output("set terminal svg\nplot nonsense\n"),
                       "gnuplot failed: undefined variable: nonsense", std::runtime_error);
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  CHECK_THROWS_WITH_AS((void)gnuplot_output("plot x\n"), doctest::Contains("gnuplot is not installed"),
                       std::runtime_error);
  setenv("PATH", path.c_str(), 1);
}
