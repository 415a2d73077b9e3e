#include "flank/io/tool/tool_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/error.h"
#include "flank/tool/meridian.h"

namespace flank::internal {
namespace {

constexpr double kChordMm = 1e-4;
constexpr double kSameMm = 1e-6;  ///< of one line or circle: files keep six decimals
constexpr int kHalvings = 80;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A radial function in the outline's own z: spheres of radius at(z - shift).
struct Placed {
  RadialFunction radial;
  double shift = 0.0;  ///< z of s = 0, mm
};

/// Centre and radius of an arc's circle.
struct Circle {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;
};
Circle circle_of(const ProfileArc& arc) {
  const Vec2 chord = arc.to - arc.from;
  const double length = chord.norm(), b = arc.bulge;
  const Vec2 left(-chord.y() / length, chord.x() / length);
  return {0.5 * (arc.from + arc.to) + length * (1.0 - b * b) / (4.0 * b) * left,
          length * (1.0 + b * b) / (4.0 * std::abs(b))};
}

Vec2 middle_of(const ProfileArc& arc) {
  const Vec2 chord = arc.to - arc.from;
  return 0.5 * (arc.from + arc.to) + 0.5 * arc.bulge * Vec2(chord.y(), -chord.x());
}

bool one_line(const std::vector<ProfileArc>& flank) {
  const Vec2 from = flank.front().from, along = (flank.back().to - from).normalized();
  return std::all_of(flank.begin(), flank.end(), [&](const ProfileArc& piece) {
    return std::abs(cross(along, piece.to - from)) <= kSameMm &&
           std::abs(cross(along, middle_of(piece) - from)) <= kSameMm;
  });
}

bool one_circle(const std::vector<ProfileArc>& flank) {
  if (std::any_of(flank.begin(), flank.end(), [](const ProfileArc& piece) { return piece.bulge == 0.0; })) return false;
  const Circle first = circle_of(flank.front());
  return std::all_of(flank.begin(), flank.end(), [&](const ProfileArc& piece) {
    return piece.bulge * flank.front().bulge > 0.0 &&
           std::abs((piece.to - first.centre).norm() - first.radius) <= kSameMm &&
           std::abs((middle_of(piece) - first.centre).norm() - first.radius) <= kSameMm;
  });
}

/// Cylinder or cone from the sphere at z = `from` on.
RadialFunction straight(const std::vector<ProfileArc>& flank, double from, double length) {
  const Vec2 p = flank.front().from, along = (flank.back().to - p).normalized();
  const double angle = std::atan2(along.y(), along.x());
  // The sphere at z touches the line (p, angle): its radius is the distance of (z, 0) from the line.
  const double radius = cross(along, p - Vec2(from, 0.0));
  if (std::abs(angle) < 1e-9) return {ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, radius)};
  return {ToolFamily::kCone, length, Eigen::Vector2d(radius, angle)};
}

/// A barrel's arc. It bulges outwards where it turns right, with its centre on the other side of the axis.
RadialFunction round(const std::vector<ProfileArc>& flank, double from, double length, const std::string& file) {
  const Circle circle = circle_of(flank.front());
  const double depth = std::abs(circle.centre.y()), middle = circle.centre.x() - from;
  if (flank.front().bulge > 0.0)
    return {ToolFamily::kBarrel, length, Eigen::Vector3d(-circle.radius, depth - circle.radius, middle)};
  if (circle.centre.y() > -kSameMm)
    throw InputError(fmt::format(
        "{}: the flank is an arc of R {:.4g}, too small: R must exceed the distance of the arc from the axis", file,
        circle.radius));
  return {ToolFamily::kBarrel, length, Eigen::Vector3d(circle.radius, circle.radius - depth, middle)};
}

/// z where the normal of the first or last point of a line or circle meets the axis.
double foot_of(const std::vector<ProfileArc>& flank, const Vec2& p) {
  if (one_line(flank)) {
    const Vec2 along = (flank.back().to - flank.front().from).normalized();
    return p.x() + p.y() * along.y() / along.x();
  }
  const Vec2 centre = circle_of(flank.front()).centre;
  return p.x() + p.y() / (p.y() - centre.y()) * (centre.x() - p.x());
}

/// Points of a flank of several lines and arcs. Lines of a length that a drawing means as such get points inside; the chords
/// of a polygon have none on the curve but their ends.
std::vector<Vec2> points_on(const std::vector<ProfileArc>& flank) {
  constexpr double kRealLine = 0.05;  // of the whole length
  constexpr int kInside = 60;
  const double length = (flank.back().to - flank.front().from).norm();
  std::vector<Vec2> points;
  for (const ProfileArc& piece : flank) {
    const double size = (piece.to - piece.from).norm();
    if (piece.bulge != 0.0) {
      const std::vector<Vec2> arc = points_of(piece, std::min(1e-5, 1e-3 * size));
      points.insert(points.end(), arc.begin(), arc.end());
      continue;
    }
    const int count = size > kRealLine * length ? kInside : 1;
    for (int k = 0; k < count; ++k) points.emplace_back(piece.from + (piece.to - piece.from) * k / count);
  }
  points.push_back(flank.back().to);
  return points;
}

/// Farthest of the points from the enveloped profile, mm.
double farthest(const Placed& tool, const std::vector<Vec2>& points) {
  const double low = meridian_point(tool.radial, 0.0).x(),
               high = meridian_point(tool.radial, tool.radial.axis_length()).x();
  double most = 0.0;
  for (const Vec2& p : points) {
    const double z = p.x() - tool.shift;
    if (z >= low && z <= high) most = std::max(most, std::abs(radius_at_height(tool.radial, z) - p.y()));
  }
  return most;
}

/// A spline through the points: more coefficients until it is near enough, four points to each.
Placed curved(const std::vector<Vec2>& points, std::optional<double> axis_length, const std::string& file) {
  constexpr int kFirst = 48, kMost = 400;
  const auto make = [&](int coefficients) -> Placed {
    try {
      const RadialFunction radial = radial_from_meridian(points, axis_length, coefficients);
      // Its z is the drawing's where a length was given; else s = 0 is where the first normal meets the axis.
      if (axis_length) return {radial, 0.0};
      return {radial, points.front().x() - meridian_point(radial, 0.0).x()};
    } catch (const InputError& e) {
      throw InputError(file + ": " + e.what());
    }
  };
  const int most = std::clamp(static_cast<int>(points.size()) / 4, 4, kMost);
  Placed best = make(std::min(kFirst, most));
  double error = farthest(best, points);
  for (int count = 2 * kFirst; error > kOutlineErrorMm && count <= most; count *= 2) {
    Placed next = make(count);
    const double smaller = farthest(next, points);
    if (!(smaller < error) || !check_legitimacy(next.radial).legitimate) break;
    best = std::move(next);
    error = smaller;
  }
  return best;
}

/// z of the lowest sphere whose lower end is not below `bottom`: z - r(z) grows, because |r'| < 1.
double first_sphere(const Placed& tool, double bottom) {
  const auto below = [&](double s) { return tool.shift + s - tool.radial.at(s).r - bottom; };
  double low = 0.0, high = tool.radial.axis_length();
  if (below(low) >= -kSameMm) return tool.shift;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (below(middle) < 0.0 ? low : high) = middle;
  }
  return tool.shift + high;
}

/// The same spheres from z = `from` on.
Placed shortened(const Placed& tool, double from) {
  const double cut = from - tool.shift, length = tool.radial.axis_length() - cut;
  constexpr int kSamples = 1601;
  std::vector<Vec2> samples(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    const double s = length * k / (kSamples - 1);
    samples[static_cast<std::size_t>(k)] = {s, tool.radial.at(cut + s).r};
  }
  return {RadialFunction::spline_through(length, samples, std::max(4, tool.radial.parameter_count())), from};
}

/// What the corner of a tip without a ball stands out of the ball that is taken for it; empty: nothing.
std::string corner_note(const ToolOutline& outline, const Placed& tool) {
  if (!outline.bottom || outline.ball) return "";
  const double r = tool.radial.at(0.0).r, c = outline.corner_mm;
  const Vec2 corner(*outline.bottom + c, outline.flank.front().from.y() - c);
  const double out = (corner - Vec2(tool.shift, 0.0)).norm() + c - r;
  if (!(out > 1e-3)) return "";
  return fmt::format(
      "the tip is not a ball: planned and checked with the ball of R {:.4g} mm inside its end; its corner stands out "
      "of "
      "that by up "
      "to {:.3g} mm and must be kept clear of floors",
      r, out);
}

Placed exact_or_curved(const ToolOutline& outline, const std::string& file, std::optional<double> axis_length) {
  const std::vector<ProfileArc>& flank = outline.flank;
  const bool line = one_line(flank);
  if (axis_length || !(line || one_circle(flank))) {
    Placed tool = curved(points_on(flank), axis_length, file);
    if (outline.bottom && !axis_length) {
      const double from = first_sphere(tool, *outline.bottom);
      if (from > tool.shift) tool = shortened(tool, from);
    }
    return tool;
  }
  const auto make = [&](double from, double to) -> RadialFunction {
    if (!(to > from)) throw InputError(file + ": the flank is too short for the sphere at its tip");
    return line ? straight(flank, from, to - from) : round(flank, from, to - from, file);
  };
  const double from = foot_of(flank, flank.front().from), to = foot_of(flank, flank.back().to);
  const Placed whole{make(from, to), from};
  const double begin = outline.bottom ? first_sphere(whole, *outline.bottom) : from;
  return {make(begin, to), begin};
}

void check_flank(const ToolOutline& outline, const std::string& file) {
  if (outline.flank.empty()) throw InputError(file + ": the outline has no flank");
  for (const ProfileArc& piece : outline.flank)
    if (!(piece.to.x() > piece.from.x()))
      throw InputError(
          fmt::format("{}: the flank does not rise from z {:.4g}, radius {:.4g}; z must increase from the tip "
                      "towards the holder",
                      file, piece.from.x(), piece.from.y()));
}

}  // namespace

double radius_at_height(const RadialFunction& radial, double z) {
  double low = 0.0, high = radial.axis_length();
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (meridian_point(radial, middle).x() < z ? low : high) = middle;
  }
  return meridian_point(radial, 0.5 * (low + high)).y();
}

std::vector<Vec2> profile_points(const std::vector<ProfileArc>& pieces) {
  std::vector<Vec2> points;
  for (const ProfileArc& piece : pieces) {
    const std::vector<Vec2> part = points_of(piece, kChordMm);
    points.insert(points.end(), part.begin(), part.end());
  }
  if (!pieces.empty()) points.push_back(pieces.back().to);
  return points;
}

ToolReading tool_from_outline(const ToolOutline& outline, const std::string& file, std::optional<double> axis_length) {
  check_flank(outline, file);
  const Placed placed = exact_or_curved(outline, file, axis_length);
  if (const Legitimacy verdict = check_legitimacy(placed.radial); !verdict.legitimate)
    throw InputError(file + ": not a tool, " + verdict.reason);
  ToolReading reading;
  reading.tool.radial = placed.radial;
  reading.tool.name = outline.name;
  const auto moved = [&](std::vector<Vec2> profile) {
    for (Vec2& p : profile) p.x() -= placed.shift;
    return profile;
  };
  reading.tool.shank = moved(outline.shank);
  reading.tool.holder = moved(outline.holder);
  if (std::string note = corner_note(outline, placed); !note.empty()) reading.notes.push_back(file + ": " + note);
  return reading;
}

}  // namespace flank::internal
