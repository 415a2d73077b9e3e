#include "flank/envelope/fitted_surface.h"

#include <algorithm>
#include <limits>

namespace flank::internal {
namespace {

/// Contact points follow the velocity of cubic rails and the slope of a cubic radial function: between their knots they
/// are smooth, across them once differentiable. A surface that is no smoother there needs few points elsewhere.
constexpr int kBreakMultiplicity = kFittedDegree - 1;

/// Sorted, from 0 to 1, without those that lie so close together that they are one.
std::vector<double> breaks_of(std::vector<double> inner) {
  constexpr double kOne = 1e-6;
  std::sort(inner.begin(), inner.end());
  std::vector<double> breaks{0.0};
  for (const double x : inner)
    if (x > breaks.back() + kOne && x < 1.0 - kOne) breaks.push_back(x);
  breaks.push_back(1.0);
  return breaks;
}

}  // namespace

std::vector<double> breaks_of(const RuledMotion& motion, double from, double to) {
  std::vector<double> inner;
  for (const BSplineCurve3* rail : {&motion.tip, &motion.direction})
    for (const double knot : rail->knots) inner.push_back((knot - from) / (to - from));
  return breaks_of(std::move(inner));
}

/// A spline of n coefficients has n - 3 equal intervals; all other families are smooth.
std::vector<double> breaks_of(const RadialFunction& radial, double from, double to) {
  std::vector<double> inner;
  const int pieces = radial.family() == ToolFamily::kSpline ? radial.parameter_count() - 3 : 1;
  for (int i = 1; i < pieces; ++i) inner.push_back((static_cast<double>(i) / pieces - from) / (to - from));
  return breaks_of(std::move(inner));
}

std::vector<double> SurfaceDirection::knots() const {
  std::vector<double> knots(static_cast<std::size_t>(degree_ + 1), 0.0);
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    if (k > 0) knots.insert(knots.end(), static_cast<std::size_t>(kBreakMultiplicity), breaks_[k]);
    for (int i = 1; i < cuts_[k]; ++i) knots.push_back(inside(k, static_cast<double>(i) / cuts_[k]));
  }
  knots.insert(knots.end(), static_cast<std::size_t>(degree_ + 1), 1.0);
  return knots;
}

std::vector<double> SurfaceDirection::places(std::size_t k) const {
  std::vector<double> places;
  const int count = cuts_[k] * kFittedPlaces;
  for (int i = 0; i < count; ++i) places.push_back(inside(k, (i + 0.5) / count));
  return places;
}

std::vector<double> SurfaceDirection::places() const {
  std::vector<double> all;
  for (std::size_t k = 0; k < cuts_.size(); ++k)
    for (const double x : places(k)) all.push_back(x);
  return all;
}

bool SurfaceDirection::refine(const std::function<double(double)>& error, double aim) {
  bool any = false;
  if (static_cast<int>(sites().size()) > kMostFittedPoints) return false;
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    const std::vector<double> at = places(k);
    if (std::none_of(at.begin(), at.end(), [&](double x) { return error(x) > aim; })) continue;
    cuts_[k] *= 2;
    any = true;
  }
  return any;
}

FittedSurface fitted_surface(const ExactSurface& exact, SurfaceDirection along, SurfaceDirection across, double aim) {
  // Where an envelope folds, halving does not help: rounds that do not halve the deviation are the end of it.
  constexpr int kIdleRounds = 2;
  int idle = 0;
  for (double before = std::numeric_limits<double>::infinity();;) {
    const std::vector<double> u = along.sites(), v = across.sites();
    std::vector<Vec3> points;
    for (const double a : u)
      for (const double b : v) points.push_back(exact(a, b));
    FittedSurface out{interpolate_grid(points, along.knots(), across.knots(), along.degree(), across.degree()), 0.0};
    const auto error = [&](double a, double b) { return (out.surface.value(a, b) - exact(a, b)).norm(); };
    for (const double a : along.places())
      for (const double b : across.places()) out.deviation_mm = std::max(out.deviation_mm, error(a, b));
    idle = out.deviation_mm > 0.5 * before ? idle + 1 : 0;
    before = out.deviation_mm;
    if (idle == kIdleRounds) return out;
    // On a line through its points only the interpolation along it shows.
    const auto worst_u = [&](double a) {
      double worst = 0.0;
      for (const double b : v) worst = std::max(worst, error(a, b));
      return worst;
    };
    const auto worst_v = [&](double b) {
      double worst = 0.0;
      for (const double a : u) worst = std::max(worst, error(a, b));
      return worst;
    };
    const bool finer_u = along.refine(worst_u, aim), finer_v = across.refine(worst_v, aim);
    if (!finer_u && !finer_v) return out;
  }
}

}  // namespace flank::internal
