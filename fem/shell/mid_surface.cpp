#include "fem/shell/mid_surface.hpp"

#include "lib/contract/require.hpp"

#include <cmath>
#include <numbers>

namespace impulse {
namespace {

using Eigen::Vector3d;

/// A factor f(x) or g(y) of a product, with its derivative.
struct Factor {
  double value;
  double slope;
};

/// f(x) g(y) with its three derivatives.
Eigen::RowVector4d product(const Factor& f, const Factor& g) {
  return {f.value * g.value, f.slope * g.value, f.value * g.slope, f.slope * g.slope};
}

/// sin(s/R) and cos(s/R).
Factor sine(double s, double radius) { return {std::sin(s / radius), std::cos(s / radius) / radius}; }
Factor cosine(double s, double radius) { return {std::cos(s / radius), -std::sin(s / radius) / radius}; }

HermiteNode ideal_surface(const PanelShape& shape, double xi, double eta) {
  const double r = shape.radius_m;
  const Factor one{1, 0}, along_x{xi, 1}, along_y{eta, 1};
  HermiteNode node = HermiteNode::Zero();
  switch (shape.curvature) {
    case Curvature::flat:
      node.row(0) = product(along_x, one);
      node.row(1) = product(one, along_y);
      break;
    case Curvature::along_x:
      node.row(0) = r * product(sine(xi, r), one);
      node.row(1) = product(one, along_y);
      node.row(2) = -r * product(cosine(xi, r), one);
      break;
    case Curvature::along_y:
      node.row(0) = product(along_x, one);
      node.row(1) = r * product(one, sine(eta, r));
      node.row(2) = -r * product(one, cosine(eta, r));
      break;
    case Curvature::both:
      node.row(0) = r * product(sine(xi, r), one);
      node.row(1) = r * product(cosine(xi, r), sine(eta, r));
      node.row(2) = -r * product(cosine(xi, r), cosine(eta, r));
      break;
  }
  if (shape.curvature != Curvature::flat) node(2, 0) += r;
  return node;
}

Factor half_waves(double x, double length, int count) {
  const double k = count * std::numbers::pi / length;
  return {std::sin(k * x), k * std::cos(k * x)};
}

Factor squared(const Factor& f) { return {f.value * f.value, 2 * f.value * f.slope}; }

Factor power(double x, double length, int p) {
  const double t = x / length;
  return {std::pow(t, p), p == 0 ? 0 : p * std::pow(t, p - 1) / length};
}

/// Sizes that grow by one ratio from 1 to `grading`, scaled to fill `length`.
std::vector<double> growing_sizes(double length, std::size_t count, double grading) {
  std::vector<double> sizes(count);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sizes[i] = count == 1 ? 1 : std::pow(grading, static_cast<double>(i) / static_cast<double>(count - 1));
    sum += sizes[i];
  }
  for (double& size : sizes) size *= length / sum;
  return sizes;
}

}  // namespace

void require_valid(const PanelShape& shape) {
  require(shape.length_m > 0 && std::isfinite(shape.length_m), "a panel's length {} m is not positive", shape.length_m);
  require(shape.width_m > 0 && std::isfinite(shape.width_m), "a panel's width {} m is not positive", shape.width_m);
  if (shape.curvature == Curvature::flat) {
    require(shape.radius_m == 0, "a flat panel has a radius of curvature of {} m; say along which side it is curved",
            shape.radius_m);
    return;
  }
  const double r = std::abs(shape.radius_m);
  require(r > 0 && std::isfinite(r), "a curved panel's radius of curvature {} m is not a length", shape.radius_m);
  const double circle = 2 * std::numbers::pi * r;
  if (shape.curvature != Curvature::along_x)
    require(shape.width_m < circle, "the width {} m goes round the whole circle of radius {} m", shape.width_m, r);
  if (shape.curvature == Curvature::along_x)
    require(shape.length_m < circle, "the length {} m goes round the whole circle of radius {} m", shape.length_m, r);
  if (shape.curvature == Curvature::both)
    require(shape.length_m < circle / 2, "the length {} m goes over the poles of the sphere of radius {} m",
            shape.length_m, r);
}

HermiteNode mid_surface(const PanelShape& shape, double x, double y) {
  HermiteNode node = ideal_surface(shape, x - shape.length_m / 2, y - shape.width_m / 2);
  for (const Imperfection::Wave& wave : shape.imperfection.waves)
    node.row(2) +=
        wave.amplitude_m * product(half_waves(x, shape.length_m, wave.m), half_waves(y, shape.width_m, wave.n));
  for (const Imperfection::Wave& wave : shape.imperfection.squared_waves)
    node.row(2) += wave.amplitude_m * product(squared(half_waves(x, shape.length_m, wave.m)),
                                              squared(half_waves(y, shape.width_m, wave.n)));
  for (const Imperfection::Power& term : shape.imperfection.powers)
    node.row(2) += term.coefficient_m * product(power(x, shape.length_m, term.p), power(y, shape.width_m, term.q));
  return node;
}

std::vector<double> graded_lines(double length, std::size_t count, double towards, double grading) {
  require(length > 0 && std::isfinite(length), "a side of length {} m cannot be meshed", length);
  require(count > 0, "a side without elements cannot be meshed; use at least one");
  require(grading >= 1 && std::isfinite(grading), "a grading of {} is not a ratio of sizes ≥ 1", grading);
  require(towards >= 0 && towards <= length, "the mesh is graded towards {} m, outside the side of {} m", towards,
          length);
  const bool inside = grading > 1 && towards > 0 && towards < length;
  require(!inside || count >= 2, "one element cannot be graded towards an inner point; use at least two");
  double before_length = towards >= length ? length : inside ? towards : 0;
  if (grading == 1) before_length = 0;
  std::size_t before = static_cast<std::size_t>(std::lround(before_length / length * static_cast<double>(count)));
  if (inside) before = std::min(std::max<std::size_t>(before, 1), count - 1);
  const std::vector<double> left = growing_sizes(before_length, before, grading);
  const std::vector<double> right = growing_sizes(length - before_length, count - before, grading);
  std::vector<double> lines(count + 1, 0.0);
  for (std::size_t i = 0; i < before; ++i) lines[i + 1] = lines[i] + left[before - 1 - i];
  for (std::size_t i = before; i < count; ++i) lines[i + 1] = lines[i] + right[i - before];
  lines.back() = length;
  return lines;
}

}  // namespace impulse
