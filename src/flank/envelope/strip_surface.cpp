#include "flank/envelope/strip_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "flank/envelope.h"

namespace flank::internal {
namespace {

constexpr int kDegree = 5;
constexpr double kAimMm = 0.5 * kStripSurfaceMm;  ///< a margin, because not every place is looked at
/// Contact points follow the velocity of cubic rails and the slope of a cubic radial function: between their knots they
/// are smooth, across them once differentiable. A surface that is no smoother there needs few points elsewhere.
constexpr int kBreakMultiplicity = kDegree - 1;

/// A point of the exact surface at (u, v) in [0, 1] x [0, 1].
using ExactSurface = std::function<Vec3(double u, double v)>;

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

std::vector<double> breaks_of(const StripMotion& strip) {
  std::vector<double> inner;
  for (const BSplineCurve3* rail : {&strip.motion.tip, &strip.motion.direction})
    for (const double knot : rail->knots) inner.push_back((knot - strip.from_t) / (strip.to_t - strip.from_t));
  return breaks_of(std::move(inner));
}

/// A spline of n coefficients has n - 3 equal intervals; all other families are smooth.
std::vector<double> breaks_of(const RadialFunction& radial) {
  std::vector<double> inner;
  const int pieces = radial.family() == ToolFamily::kSpline ? radial.parameter_count() - 3 : 1;
  for (int i = 1; i < pieces; ++i) inner.push_back(static_cast<double>(i) / pieces);
  return breaks_of(std::move(inner));
}

/// Knots of one direction: every interval between breaks is cut into equal ones, as many as it needs.
class Direction {
 public:
  Direction(std::vector<double> breaks, int degree)
      : breaks_(std::move(breaks)), cuts_(breaks_.size() - 1, 1), degree_(degree) {}

  [[nodiscard]] int degree() const { return degree_; }
  /// Clamped.
  [[nodiscard]] std::vector<double> knots() const {
    std::vector<double> knots(static_cast<std::size_t>(degree_ + 1), 0.0);
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      if (k > 0) knots.insert(knots.end(), static_cast<std::size_t>(kBreakMultiplicity), breaks_[k]);
      for (int i = 1; i < cuts_[k]; ++i) knots.push_back(inside(k, static_cast<double>(i) / cuts_[k]));
    }
    knots.insert(knots.end(), static_cast<std::size_t>(degree_ + 1), 1.0);
    return knots;
  }
  [[nodiscard]] std::vector<double> sites() const { return greville_sites(knots(), degree_); }
  /// kStripPlaces places in every knot interval that is inside interval k between breaks.
  [[nodiscard]] std::vector<double> places(std::size_t k) const {
    std::vector<double> places;
    const int count = cuts_[k] * kStripPlaces;
    for (int i = 0; i < count; ++i) places.push_back(inside(k, (i + 0.5) / count));
    return places;
  }
  [[nodiscard]] std::vector<double> places() const {
    std::vector<double> all;
    for (std::size_t k = 0; k < cuts_.size(); ++k)
      for (const double x : places(k)) all.push_back(x);
    return all;
  }
  /// Halves the intervals that `error` says are too far off at one of their places. Were there any?
  bool refine(const std::function<double(double)>& error) {
    bool any = false;
    if (sites().size() > kMostStripPoints) return false;
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      const std::vector<double> at = places(k);
      if (std::none_of(at.begin(), at.end(), [&](double x) { return error(x) > kAimMm; })) continue;
      cuts_[k] *= 2;
      any = true;
    }
    return any;
  }

 private:
  [[nodiscard]] double inside(std::size_t k, double share) const {
    return breaks_[k] + (breaks_[k + 1] - breaks_[k]) * share;
  }
  std::vector<double> breaks_;
  std::vector<int> cuts_;
  int degree_;
};

struct Fitted {
  BSplineSurface surface;
  double deviation_mm = 0.0;
};

/// Interpolates, and halves intervals where the surface is too far off between its points until it is near enough.
Fitted fitted(const ExactSurface& exact, Direction along, Direction across) {
  // Where an envelope folds, halving does not help: rounds that do not halve the deviation are the end of it.
  constexpr int kIdleRounds = 2;
  int idle = 0;
  for (double before = std::numeric_limits<double>::infinity();;) {
    const std::vector<double> u = along.sites(), v = across.sites();
    std::vector<Vec3> points;
    for (const double a : u)
      for (const double b : v) points.push_back(exact(a, b));
    Fitted out{interpolate_grid(points, along.knots(), across.knots(), along.degree(), across.degree()), 0.0};
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
    const bool finer_u = along.refine(worst_u), finer_v = across.refine(worst_v);
    if (!finer_u && !finer_v) return out;
  }
}

}  // namespace

StripSurface strip_surface(const StripMotion& strip, const RadialFunction& radial) {
  const auto jet = [&](double u) { return strip.motion.jet(strip.from_t + (strip.to_t - strip.from_t) * u); };
  const auto contact = [&](double u, double v) {
    const double s = radial.axis_length() * v;
    return contact_point(jet(u), radial.at(s), s, strip.side);
  };
  StripSurface out;
  out.name = fmt::format("strip {}", strip.strip);
  const Direction along(breaks_of(strip), kDegree);
  Fitted envelope =
      fitted([&](double u, double v) { return contact(u, v).point; }, along, Direction(breaks_of(radial), kDegree));
  Fitted axis =
      fitted([&](double u, double v) { return jet(u).at(radial.axis_length() * v); }, along, Direction({0.0, 1.0}, 1));
  out.envelope_deviation_mm = envelope.deviation_mm;
  out.axis_deviation_mm = axis.deviation_mm;
  const SurfaceJet middle = envelope.surface.jet(0.5, 0.5);
  // The normal of a contact point looks from the axis to the part.
  out.towards_tool = middle.du.cross(middle.dv).dot(contact(0.5, 0.5).normal) < 0.0;
  for (const double u : greville_sites(envelope.surface.knots_u, kDegree))
    for (const double v : greville_sites(envelope.surface.knots_v, kDegree))
      out.plunging += contact(u, v).exists ? 0 : 1;
  out.envelope = std::move(envelope.surface);
  out.axis = std::move(axis.surface);
  return out;
}

void note_strip_surfaces(const std::vector<StripSurface>& strips, std::vector<std::string>& notes) {
  for (const StripSurface& strip : strips) {
    if (strip.plunging > 0)
      notes.push_back(fmt::format("strips.step: {} plunges at {} of {} points, where there is no envelope", strip.name,
                                  strip.plunging, strip.envelope.poles.size()));
    const double deviation = std::max(strip.envelope_deviation_mm, strip.axis_deviation_mm);
    if (deviation > kStripSurfaceMm)
      notes.push_back(fmt::format("strips.step: {} is up to {:.2g} mm off", strip.name, deviation));
  }
}

}  // namespace flank::internal
