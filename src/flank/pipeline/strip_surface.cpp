#include "flank/pipeline/strip_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "flank/envelope/envelope.h"
#include "flank/io/write_step.h"

namespace flank {
namespace {

constexpr int kDegree = 3;
constexpr int kFirstPoses = 25, kFirstPoints = 13;

/// A point of the exact surface at (u, v) in [0, 1] x [0, 1].
using ExactSurface = std::function<Vec3(double u, double v)>;

std::vector<double> equal_steps(int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(static_cast<double>(i) / (count - 1));
  return values;
}

BSplineSurface through_grid(const ExactSurface& exact, int count_u, int count_v) {
  const std::vector<double> u = equal_steps(count_u), v = equal_steps(count_v);
  std::vector<Vec3> points;
  points.reserve(u.size() * v.size());
  for (const double a : u)
    for (const double b : v) points.push_back(exact(a, b));
  return interpolate_grid(points, u, v, kDegree);
}

/// Largest distance between points of the same parameters, which is never less than that of the surfaces: `u` and `v`
/// say by which share of a step the places lie off the grid.
double distance(const ExactSurface& exact, const BSplineSurface& surface, double u, double v) {
  const int count_u = surface.count_u - (u > 0.0 ? 1 : 0), count_v = surface.count_v - (v > 0.0 ? 1 : 0);
  double largest = 0.0;
  for (int i = 0; i < count_u; ++i) {
    for (int j = 0; j < count_v; ++j) {
      const double a = (i + u) / (surface.count_u - 1), b = (j + v) / (surface.count_v - 1);
      largest = std::max(largest, (surface.value(a, b) - exact(a, b)).norm());
    }
  }
  return largest;
}

struct Fitted {
  BSplineSurface surface;
  double deviation_mm = 0.0;
};

/// Halves the steps of the direction that is worse until the surface is near enough everywhere between its points.
Fitted fitted(const ExactSurface& exact, int count_u, int count_v) {
  for (;;) {
    Fitted out{through_grid(exact, count_u, count_v), 0.0};
    const double along = distance(exact, out.surface, 0.5, 0.0), across = distance(exact, out.surface, 0.0, 0.5);
    out.deviation_mm = std::max({along, across, distance(exact, out.surface, 0.5, 0.5)});
    const bool finer_u = 2 * count_u - 1 <= kMostStripPoses, finer_v = 2 * count_v - 1 <= kMostStripPoints;
    // A margin, because only the middles are looked at.
    if (out.deviation_mm <= 0.5 * kStripSurfaceMm || (!finer_u && !finer_v)) return out;
    if (finer_u && (along >= across || !finer_v))
      count_u = 2 * count_u - 1;
    else
      count_v = 2 * count_v - 1;
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
  Fitted envelope = fitted([&](double u, double v) { return contact(u, v).point; }, kFirstPoses, kFirstPoints);
  Fitted axis =
      fitted([&](double u, double v) { return jet(u).at(radial.axis_length() * v); }, kFirstPoses, kDegree + 1);
  out.envelope_deviation_mm = envelope.deviation_mm;
  out.axis_deviation_mm = axis.deviation_mm;
  const SurfaceJet middle = envelope.surface.jet(0.5, 0.5);
  // The normal of a contact point looks from the axis to the part.
  out.towards_tool = middle.du.cross(middle.dv).dot(contact(0.5, 0.5).normal) < 0.0;
  for (const double u : equal_steps(envelope.surface.count_u))
    for (const double v : equal_steps(envelope.surface.count_v)) out.plunging += contact(u, v).exists ? 0 : 1;
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

std::string strips_to_step(const std::vector<StripSurface>& strips) {
  std::vector<NamedFaces> objects;
  const auto add = [&](const std::string& name, const BSplineSurface& surface, bool reversed) {
    Face face;
    face.id = name;
    face.surface = surface;
    face.reversed = reversed;
    objects.push_back({name, {face}});
  };
  for (const StripSurface& strip : strips) add(strip.name, strip.envelope, !strip.towards_tool);
  for (const StripSurface& strip : strips) add(strip.name + " axis", strip.axis, false);
  return faces_to_step("strips", objects);
}

}  // namespace flank
