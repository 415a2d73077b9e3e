#include "flank/redesign/blade_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr double kSampleShare = 1.0 / 60.0;  ///< of the square root of the area
constexpr double kFacing = -0.3;             ///< cosine between two normals that look at each other, at most
constexpr double kFarShare = 1.0;            ///< of the part's size: nothing farther is opposite
constexpr int kStations = 80, kScan = 60, kHalvings = 50;
constexpr double kOnFaceShare = 1e-7;  ///< of the size: a point of the surface that is so near to the face is on it
constexpr double kNeighbourShare = 5e-3;

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

/// Lowest and highest point of a face along its span, mm.
std::pair<double, double> span_of(const ChangedFace& face) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : face.old->border_points(face.old->diagonal() / 200.0))
    low = std::min(low, p.dot(face.span)), high = std::max(high, p.dot(face.span));
  return {low, high};
}

/// The place of one iso-line of a surface at this height; none: it does not come so high, or not on the face.
std::optional<Vec3> at_height(const BSplineSurface& surface, bool along_v, double station, const Vec3& span,
                              double height, const Target& face) {
  const double low = along_v ? surface.v_first() : surface.u_first(),
               high = along_v ? surface.v_last() : surface.u_last();
  const auto point = [&](double x) { return along_v ? surface.value(station, x) : surface.value(x, station); };
  const auto above = [&](double x) { return point(x).dot(span) - height; };
  for (int k = 0; k < kScan; ++k) {
    double a = low + (high - low) * k / kScan, b = low + (high - low) * (k + 1) / kScan;
    const bool begins = above(a) > 0.0;
    if (begins == (above(b) > 0.0)) continue;
    for (int n = 0; n < kHalvings; ++n) {
      const double middle = 0.5 * (a + b);
      ((above(middle) > 0.0) == begins ? a : b) = middle;
    }
    const Vec3 p = point(a);
    const Footpoint foot = face.closest(p);
    if ((p - foot.point).norm() <= kOnFaceShare * face.diagonal() + 1e-9) return p;
  }
  return {};
}

/// Neighbours at one end of a section.
void tell_end(const ChangedFace& face, const Opposite& opposite, const BorderSide& side, const Vec3& end,
              double& radius_mm, double& kink_before, double& kink_after) {
  const double near = kNeighbourShare * face.old->diagonal();
  for (const std::string& id : side.faces) {
    const Footpoint foot = opposite.neighbour(id, end, near);
    if (foot.patch < 0) continue;
    const double bend = std::max(std::abs(foot.k1), std::abs(foot.k2));
    radius_mm = bend > 1e-9 ? 1.0 / bend : 0.0;
    kink_before = degrees_between(face.old->closest(end).normal, foot.normal);
    kink_after = degrees_between(face.surface.target->closest(end).normal, foot.normal);
    return;
  }
}

double distance_to(const std::vector<Vec3>& points, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& q : points) least = std::min(least, (p - q).norm());
  return least;
}

Section section_at(const Part& part, const ChangedFace& face, const Opposite& opposite, double percent) {
  const BSplineSurface& surface = part.faces[static_cast<std::size_t>(face.index)].surface;
  const auto [low, high] = span_of(face);
  Section out;
  out.height_percent = percent;
  out.height_mm = low + 0.01 * percent * (high - low);
  const SurfaceJet middle =
      surface.jet(0.5 * (surface.u_first() + surface.u_last()), 0.5 * (surface.v_first() + surface.v_last()));
  const bool along_v =
      std::abs(middle.dv.normalized().dot(face.span)) > std::abs(middle.du.normalized().dot(face.span));
  const double from = along_v ? surface.u_first() : surface.v_first(),
               to = along_v ? surface.u_last() : surface.v_last();
  double squares = 0.0;
  for (int k = 0; k <= kStations; ++k) {
    const std::optional<Vec3> p =
        at_height(surface, along_v, from + (to - from) * k / kStations, face.span, out.height_mm, *face.old);
    if (!p) continue;
    const Footpoint old = face.old->closest(*p), next = face.surface.target->closest(*p);
    SectionPoint point{*p, next.point, -next.distance};
    out.points.push_back(point);
    squares += point.deviation_mm * point.deviation_mm;
    out.largest_mm = std::max(out.largest_mm, std::abs(point.deviation_mm));
    out.thickest_before_mm = std::max(out.thickest_before_mm, opposite.thickness(face.index, *p, old.normal, false));
    out.thickest_after_mm =
        std::max(out.thickest_after_mm, opposite.thickness(face.index, next.point, next.normal, true));
  }
  if (out.points.size() < 2) return out;
  out.rms_mm = std::sqrt(squares / static_cast<double>(out.points.size()));
  const Vec3 &first = out.points.front().before, &last = out.points.back().before;
  out.chord_mm = (last - first).norm();
  const bool leads = distance_to(face.borders.leading.points, first) <= distance_to(face.borders.leading.points, last);
  tell_end(face, opposite, face.borders.leading, leads ? first : last, out.leading_radius_mm,
           out.leading_kink_before_deg, out.leading_kink_after_deg);
  tell_end(face, opposite, face.borders.trailing, leads ? last : first, out.trailing_radius_mm,
           out.trailing_kink_before_deg, out.trailing_kink_after_deg);
  return out;
}

/// Least and mean over points of equal rank; 0 is "nothing opposite".
void add(DistanceFigure& figure, double& area, const DeviationPoint& point, double before, double after) {
  if (before <= 0.0 || after <= 0.0) return;
  if (!figure.known || after < figure.least_after) figure.least_after = after, figure.at = point.point;
  figure.least_before = figure.known ? std::min(figure.least_before, before) : before;
  figure.known = true;
  figure.mean_before += point.area_mm2 * before;
  figure.mean_after += point.area_mm2 * after;
  area += point.area_mm2;
}

void finish(DistanceFigure& figure, double area) {
  if (area > 0.0) figure.mean_before /= area, figure.mean_after /= area;
}

}  // namespace

Opposite::Opposite(const Part& part, const std::vector<ChangedFace>& changed) : size_mm_(part.box.diagonal()) {
  for (int k = 0; k < part.face_count(); ++k) {
    if (part.is_left_out(k)) continue;
    const Face& face = part.faces[static_cast<std::size_t>(k)];
    Wall wall{k, face.solid, face.id, make_target({face}), nullptr};
    for (const ChangedFace& next : changed)
      if (next.index == k) wall.changed = next.surface.target.get();
    walls_.push_back(std::move(wall));
  }
}

double Opposite::nearest(int face, const Vec3& p, const Vec3& normal, bool after, double side) const {
  double least = kFarShare * size_mm_;
  int solid = -1;
  for (const Wall& wall : walls_)
    if (wall.index == face) solid = wall.solid;
  bool found = false;
  for (const Wall& wall : walls_) {
    if (wall.index == face || (side < 0.0 && wall.solid != solid)) continue;
    const Target& target = after && wall.changed != nullptr ? *wall.changed : *wall.target;
    const Footpoint foot = target.closest_within(p, least);
    if (foot.patch < 0 || side * normal.dot(foot.point - p) <= 0.0 || normal.dot(foot.normal) > kFacing) continue;
    least = (foot.point - p).norm();
    found = true;
  }
  return found ? least : 0.0;
}

double Opposite::thickness(int face, const Vec3& p, const Vec3& normal, bool after) const {
  return nearest(face, p, normal, after, -1.0);
}

double Opposite::gap(int face, const Vec3& p, const Vec3& normal, bool after) const {
  return nearest(face, p, normal, after, 1.0);
}

Footpoint Opposite::neighbour(const std::string& id, const Vec3& p, double near_mm) const {
  for (const Wall& wall : walls_)
    if (wall.id == id) return wall.target->closest_within(p, near_mm);
  return {};
}

FaceTables face_tables(const Part& part, const ChangedFace& face, const Opposite& opposite,
                       const std::vector<double>& heights) {
  FaceTables out;
  out.id = face.id;
  const std::vector<SurfaceSample> samples = face.old->samples(kSampleShare * std::sqrt(face.old->area()));
  out.points.resize(samples.size());
  std::vector<std::pair<double, double>> gaps(samples.size());
  parallel_for(samples.size(), [&](std::size_t k) {
    const SurfaceSample& sample = samples[k];
    const Footpoint next = face.surface.target->closest(sample.point);
    out.points[k] = {sample.point,
                     sample.normal,
                     sample.area,
                     -next.distance,
                     opposite.thickness(face.index, sample.point, sample.normal, false),
                     opposite.thickness(face.index, next.point, next.normal, true)};
    gaps[k] = {opposite.gap(face.index, sample.point, sample.normal, false),
               opposite.gap(face.index, next.point, next.normal, true)};
  });
  double squares = 0.0, thick = 0.0, wide = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const DeviationPoint& point = out.points[k];
    out.area_mm2 += point.area_mm2;
    squares += point.area_mm2 * point.deviation_mm * point.deviation_mm;
    out.highest_mm = std::max(out.highest_mm, point.deviation_mm);
    out.lowest_mm = std::min(out.lowest_mm, point.deviation_mm);
    add(out.thickness, thick, point, point.thickness_before_mm, point.thickness_after_mm);
    add(out.gap, wide, point, gaps[k].first, gaps[k].second);
  }
  out.rms_mm = std::sqrt(squares / out.area_mm2);
  finish(out.thickness, thick);
  finish(out.gap, wide);
  for (const double percent : heights) out.sections.push_back(section_at(part, face, opposite, percent));
  return out;
}

}  // namespace flank::internal
