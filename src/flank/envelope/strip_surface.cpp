#include "flank/envelope/strip_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "flank/envelope.h"

namespace flank::internal {
namespace {

constexpr int kDegree = 5;
constexpr double kAim = 0.5;  ///< of what is allowed: a margin, because not every place is looked at
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
  /// Halves the intervals where `error` is above `aim` at one of their places. Were there any?
  bool refine(const std::function<double(double)>& error, double aim) {
    bool any = false;
    if (sites().size() > kMostStripPoints) return false;
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
      const std::vector<double> at = places(k);
      if (std::none_of(at.begin(), at.end(), [&](double x) { return error(x) > aim; })) continue;
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
Fitted fitted(const ExactSurface& exact, Direction along, Direction across, double aim) {
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
    const bool finer_u = along.refine(worst_u, aim), finer_v = across.refine(worst_v, aim);
    if (!finer_u && !finer_v) return out;
  }
}

/// The envelope over a stretch.
Fitted envelope_of(const ExactStrip& strip, const Stretch& stretch, double aim) {
  return fitted([&](double u, double v) { return strip.contact(stretch.u(u), stretch.v(v)).point; },
                Direction(breaks_of(strip.motion(), stretch.from_u, stretch.to_u), kDegree),
                Direction(breaks_of(strip.radial(), stretch.from_v, stretch.to_v), kDegree), aim);
}

/// The largest stretch whose surface is true, and that surface: what a fit does not bring near enough is cut off, and the rest fitted
/// again.
void add_envelope(const ExactStrip& strip, double limit, double aim, StripSurface& out) {
  constexpr int kRounds = 5;
  constexpr double kLeastShare = 0.02;  // of the strip: less is worth no surface
  std::optional<Fitted> fit;
  for (int round = 0; round < kRounds; ++round) {
    const Stretch before = out.stretch;
    const auto is_true = [&](double u, double v) {
      if (!strip.is_left(u, v, limit)) return false;
      if (!fit) return true;
      const double a = (u - before.from_u) / (before.to_u - before.from_u),
                   b = (v - before.from_v) / (before.to_v - before.from_v);
      return (fit->surface.value(a, b) - strip.contact(u, v).point).norm() <= limit;
    };
    out.stretch = largest_stretch(before, is_true);
    if (out.stretch.area() < kLeastShare) break;
    fit = envelope_of(strip, out.stretch, aim);
    if (fit->deviation_mm > limit) continue;
    out.envelope = std::move(fit->surface);
    out.envelope_deviation_mm = fit->deviation_mm;
    return;
  }
  out.stretch = {0.0, 0.0, 0.0, 0.0};
}

/// "12.5 to 100 % of its way, s 0 to 20.1 mm".
std::string stretch_text(const Stretch& stretch, double axis_length) {
  return fmt::format("{:.3g} to {:.3g} % of its length, s {:.4g} to {:.4g} mm", 100.0 * stretch.from_u,
                     100.0 * stretch.to_u, axis_length * stretch.from_v, axis_length * stretch.to_v);
}

bool is_whole(const StripSurface& strip) { return strip.stretch.area() >= 1.0; }

}  // namespace

double strip_surface_limit(double tolerance_mm) {
  constexpr double kShare = 0.1;
  return std::min(tolerance_mm, std::max(kStripSurfaceMm, kShare * tolerance_mm));
}

std::string StripSurface::title(double axis_length) const {
  return is_whole(*this) ? name : fmt::format("{}, {}", name, stretch_text(stretch, axis_length));
}

StripSurface strip_surface(const StripMotion& strip, const RadialFunction& radial, double tolerance_mm) {
  const double limit = strip_surface_limit(tolerance_mm), aim = kAim * std::min(kStripSurfaceMm, limit);
  const ExactStrip exact(strip, radial);
  StripSurface out;
  out.name = fmt::format("strip {}", strip.strip);
  add_envelope(exact, limit, aim, out);
  Fitted axis = fitted([&](double u, double v) { return exact.jet(u).at(radial.axis_length() * v); },
                       Direction(breaks_of(exact.motion(), 0.0, 1.0), kDegree), Direction({0.0, 1.0}, 1), aim);
  out.axis_deviation_mm = axis.deviation_mm;
  out.axis = std::move(axis.surface);
  if (!out.has_envelope()) return out;
  const SurfaceJet middle = out.envelope.jet(0.5, 0.5);
  // The normal of a contact point looks from the axis to the part.
  out.towards_tool = middle.du.cross(middle.dv).dot(exact.contact(out.stretch.u(0.5), out.stretch.v(0.5)).normal) < 0.0;
  return out;
}

void note_strip_surfaces(const std::vector<StripSurface>& strips, double axis_length, std::vector<std::string>& notes) {
  for (const StripSurface& strip : strips) {
    if (is_whole(strip)) continue;
    const std::string what =
        strip.has_envelope() ? "holds " + stretch_text(strip.stretch, axis_length) : std::string("is left out");
    notes.push_back(
        fmt::format("strips.step: {} {}; elsewhere the tool moves along its own axis, or another position of the tool "
                    "removes this surface",
                    strip.name, what));
  }
}

}  // namespace flank::internal
