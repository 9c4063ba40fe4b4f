#include "lib/plot/gnuplot.hpp"
#include "lib/plot/picture.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

using namespace impulse;

namespace {

Curve curve(const std::string& label, const std::vector<double>& x, const std::vector<double>& y) {
  return {label, x, y, Mark::line, {}};
}

Picture picture_of(const std::vector<Curve>& curves) {
  Picture picture{{}, curves};
  picture.frame.x.label = "abscissa";
  picture.frame.y.label = "ordinate";
  return picture;
}

Picture two_curves() {
  Picture picture = picture_of({curve("a_b.csv", {0, 1, 2}, {0, 1, 0}), curve("c.csv", {0, 2}, {1, -1})});
  picture.frame.title = "It's a_title";
  picture.frame.x.label = "time (µs)";
  picture.frame.y.label = "force (N)";
  return picture;
}

FieldMap field(double corner) {
  FieldMap map;
  map.frame.x.label = "x (m)";
  map.z_label = "w (m)";
  map.scans = {{{0, 0, 0}, {1, 0, 1}}, {{0.5, 1, 0}, {1.5, 1, corner}}};
  return map;
}

bool has(const std::string& script, const std::string& part) { return script.find(part) != script.npos; }

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
  const auto script = [](const Picture& picture) { return gnuplot_script(picture, PictureFormat::svg); };
  CHECK_THROWS_AS((void)script({}), std::invalid_argument);
  CHECK_THROWS_AS((void)script(picture_of({curve("", {1}, {1})})), std::invalid_argument);
  CHECK_THROWS_AS((void)script(picture_of({curve("", {1, 2}, {1})})), std::invalid_argument);
  Picture logarithmic = picture_of({curve("", {1, 2}, {0, 1})});
  logarithmic.frame.y.logarithmic = true;
  CHECK_THROWS_WITH_AS((void)script(logarithmic), doctest::Contains("which a logarithmic axis has no place for"),
                       std::invalid_argument);
}

TEST_CASE("gnuplot_script: ranges, size, scales, points, interrupted lines") {
  Picture picture = two_curves();
  picture.curves[0].mark = Mark::points;
  picture.curves[0].pen_lifts = {2};
  picture.frame.x.range = AxisRange{0.5, 1.5};
  picture.frame.width_px = 400;
  picture.frame.equal_scales = true;
  const std::string script = gnuplot_script(picture, PictureFormat::svg);
  for (const char* part : {"size 400,500 ", "set xrange [0.5:1.5]\n", "set size ratio -1\n", "with points pt 6",
                           "0 0\n1 1\n\n2 0\nEND\n"}) {
    CAPTURE(part);
    CHECK(has(script, part));
  }
  CHECK(!has(script, "set yrange"));
  picture.frame.x.range.reset();
  picture.frame.x.logarithmic = true;
  CHECK_THROWS_AS((void)gnuplot_script(picture, PictureFormat::svg), std::invalid_argument);
  picture.curves[0].x = {1, 2, 3};
  picture.curves[1].x = {1, 2};
  CHECK(has(gnuplot_script(picture, PictureFormat::svg), "set logscale x\n"));
}

TEST_CASE("gnuplot_script: a field has diverging colours about 0 if it has both signs") {
  CHECK(has(gnuplot_script(field(-3), PictureFormat::svg), "set cbrange [-3:3]\n"));
  CHECK(!has(gnuplot_script(field(3), PictureFormat::svg), "cbrange"));
  CHECK(has(gnuplot_script(field(3), PictureFormat::svg), "0 0 0\n1 0 1\n\n0.5 1 0\n1.5 1 3\n\n"));
  FieldMap surface = field(-3);
  surface.view = MapView::surface;
  for (const FieldMap& map : {field(-3), surface})
    CHECK(has(gnuplot_output(gnuplot_script(map, PictureFormat::svg)), "x (m)"));
  CHECK_THROWS_WITH_AS((void)gnuplot_script(field(1), PictureFormat::text),
                       doctest::Contains("can't be drawn in characters"), std::invalid_argument);
  FieldMap ragged = field(1);
  ragged.scans[1].pop_back();
  CHECK_THROWS_WITH_AS((void)gnuplot_script(ragged, PictureFormat::svg), doctest::Contains("line 2 of the field has 1"),
                       std::invalid_argument);
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
  const Picture flat = picture_of({curve("", {1, 1}, {0, 0})});
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
