#include "flank/envelope/strip_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "flank/envelope.h"
#include "flank/envelope/fitted_surface.h"

namespace flank::internal {
namespace {

constexpr double kAim = 0.5;  ///< of what is allowed: a margin, because not every place is looked at

/// The envelope over a stretch.
FittedSurface envelope_of(const ExactStrip& strip, const Stretch& stretch, double aim) {
  return fitted_surface([&](double u, double v) { return strip.contact(stretch.u(u), stretch.v(v)).point; },
                        SurfaceDirection(breaks_of(strip.motion(), stretch.from_u, stretch.to_u), kFittedDegree),
                        SurfaceDirection(breaks_of(strip.radial(), stretch.from_v, stretch.to_v), kFittedDegree), aim);
}

/// The largest stretch whose surface is true, and that surface: what a fit does not bring near enough is cut off, and the rest fitted
/// again.
void add_envelope(const ExactStrip& strip, double limit, double aim, StripSurface& out) {
  constexpr int kRounds = 5;
  constexpr double kLeastShare = 0.02;  // of the strip: less is worth no surface
  std::optional<FittedSurface> fit;
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
  return fmt::format("{:.3g} to {:.3g} % of its length, {:.4g} to {:.4g} mm along the tool", 100.0 * stretch.from_u,
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
  FittedSurface axis = fitted_surface([&](double u, double v) { return exact.jet(u).at(radial.axis_length() * v); },
                                      SurfaceDirection(breaks_of(exact.motion(), 0.0, 1.0), kFittedDegree),
                                      SurfaceDirection({0.0, 1.0}, 1), aim);
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
        strip.has_envelope() ? "contains only " + stretch_text(strip.stretch, axis_length) : std::string("is left out");
    notes.push_back(fmt::format(
        "strips.step: {} {}; elsewhere the tool moves along its own axis, or cuts away from another position what it "
        "leaves here",
        strip.name, what));
  }
}

}  // namespace flank::internal
