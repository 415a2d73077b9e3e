#include "flank/pipeline/load/path_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/path/pose_velocity.h"
#include "flank/tool/compliance.h"

namespace flank::internal {
namespace {

/// Two directions across a tool's axis, the second one a quarter of a turn on the way that a right-hand spindle turns.
struct SpindleFrame {
  Vec3 x, y, z;
  explicit SpindleFrame(const Vec3& axis) : x(axis.unitOrthogonal()), y(x.cross(axis)), z(axis) {}
  [[nodiscard]] Vec3 of(const Vec3& v) const { return {v.dot(x), v.dot(y), v.dot(z)}; }
};

/// What one pose asks and gets.
struct PoseLoad {
  bool engaged = false;
  FeedBound bound;
  CutterLoad load;
};

PoseLoad load_of(const Tool& tool, const CuttingRequest& request, const PathArcs& arcs, const std::vector<Pose>& poses,
                 const std::vector<EngagedArc>& engaged, std::size_t k) {
  PoseLoad out;
  out.bound = {request.most_feed, LoadKind::kNone};
  if (engaged.empty()) return out;
  const PoseCutter here = cutter_at(tool, request, arcs.heights, engaged, poses, k);
  if (here.per_mm.velocity.isZero() && here.per_mm.velocity_by_z.isZero()) return out;
  out.engaged = true;
  const FeedLoad load(here.cutter, here.per_mm, force_coefficients(request.material, request.expected_chip_mm),
                      compliances(tool, here.cutter, 0.0));
  out.bound = load.fastest(request.limits, request.most_feed);
  if (!(out.bound.feed > 0.0)) out.bound.feed = 0.0;
  out.load = load.at(std::max(out.bound.feed, kCrawlShare * request.feed));
  return out;
}

/// The largest, and what no more than a twentieth of the time is above.
LoadFigure figure_of(std::vector<std::pair<double, double>> values) {
  LoadFigure figure;
  std::sort(values.begin(), values.end());
  double time = 0.0, all = 0.0;
  for (const auto& [value, seconds] : values) all += seconds;
  constexpr double kShare = 0.95;
  for (const auto& [value, seconds] : values) {
    if (time <= kShare * all) figure.p95 = value;
    time += seconds;
    figure.peak = value;
  }
  return figure;
}

std::string_view name_of(LoadKind kind) {
  switch (kind) {
    case LoadKind::kChip:
      return "the chip";
    case LoadKind::kForce:
      return "the force";
    case LoadKind::kPower:
      return "the power";
    case LoadKind::kDeflection:
      return "the deflection";
    case LoadKind::kNone:
      break;
  }
  return "the largest feed";
}

}  // namespace

double largest_diameter(const Tool& tool) { return 2.0 * tool.radial.largest(); }

CuttingRequest usual_cutting(const Material& material, int flutes, double helix_rad, double diameter_mm) {
  const CuttingData data = cutting_data(material, diameter_mm, flutes, 0.0);
  CuttingRequest out{.material = material, .flutes = flutes, .helix_rad = helix_rad};
  out.spindle_rpm = data.spindle_rpm;
  out.expected_chip_mm = out.limits.chip_mm = data.chip_mm;
  out.feed = data.feed_mm_min / 60.0;
  out.most_feed = kMostFeedFactor * out.feed;
  return out;
}

PoseCutter cutter_at(const Tool& tool, const CuttingRequest& request, const std::vector<double>& heights,
                     const std::vector<EngagedArc>& arcs, const std::vector<Pose>& poses, std::size_t k) {
  const double length = tool.radial.axis_length();
  const SpindleFrame frame(poses[k].axis);
  const PoseVelocity velocity = velocity_at(poses, k, length);
  PoseCutter out{{{}, request.flutes, request.helix_rad, request.spindle_rpm / 60.0},
                 {frame.of(velocity.tip), frame.of(velocity.axis)}};
  const int count = static_cast<int>(heights.size());
  const auto border = [&](int ring) {
    if (ring == 0) return heights.front();
    if (ring == count) return heights.back();
    return 0.5 * (heights[static_cast<std::size_t>(ring - 1)] + heights[static_cast<std::size_t>(ring)]);
  };
  auto arc = arcs.begin();
  for (int ring = 0; ring < count; ++ring) {
    CutterRing here{meridian_point(tool.radial, border(ring)), meridian_point(tool.radial, border(ring + 1))};
    // Rings that meet nothing count for how far the edges have turned back above them.
    if (arc == arcs.end() || arc->ring != ring) out.cutter.rings.push_back(here);
    const Vec3 way = frame.of(velocity.at(heights[static_cast<std::size_t>(ring)]));
    const double forward = std::atan2(way.y(), way.x());
    for (; arc != arcs.end() && arc->ring == ring; ++arc) {
      here.entry = forward - arc->to, here.exit = forward - arc->from;
      out.cutter.rings.push_back(here);
    }
  }
  return out;
}

std::vector<double> compliances(const Tool& tool, const RotatingCutter& cutter, double moved_at) {
  std::vector<double> out;
  for (const CutterRing& ring : cutter.rings) {
    const double z = std::max(0.0, 0.5 * (ring.low.x() + ring.high.x()));
    out.push_back(ring.exit > ring.entry ? influence_mm(tool, z, moved_at) : 0.0);
  }
  return out;
}

PathLoads path_loads(const Tool& tool, const Path& path, const PathArcs& arcs, const CuttingRequest& request) {
  if (arcs.strips.size() != path.strips.size()) throw InternalError("the engagement belongs to another path");
  const double length = tool.radial.axis_length();
  PathLoads out;
  out.slowest.feed = 1e300;
  std::vector<std::pair<double, double>> chip, force, power, deflection;  // and the time of each
  double time = 0.0, way = 0.0;
  for (std::size_t s = 0; s < path.strips.size(); ++s) {
    const std::vector<Pose>& poses = path.strips[s].poses;
    std::vector<PoseLoad> loads(poses.size());
    parallel_for(poses.size(),
                 [&](std::size_t k) { loads[k] = load_of(tool, request, arcs, poses, arcs.strips[s][k], k); });
    std::vector<double>& slowness = out.slowness.emplace_back();
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const PoseLoad& here = loads[k];
      const double feed = std::max(here.bound.feed, kCrawlShare * request.feed),
                   step = k > 0 ? way_between(poses[k - 1], poses[k], length) : 0.0;
      slowness.push_back(1.0 / feed);
      time += step / feed, way += step;
      if (here.bound.feed < out.slowest.feed) out.slowest = here.bound, out.slowest_at = {s, k};
      if (!here.engaged) continue;
      ++out.engaged;
      if (here.bound.feed < kCrawlShare * request.feed) ++out.too_much;
      chip.emplace_back(here.load.chip_mm, step / feed), force.emplace_back(here.load.force_n, step / feed);
      power.emplace_back(here.load.power_w, step / feed), deflection.emplace_back(here.load.deflection_mm, step / feed);
    }
  }
  out.chip_mm = figure_of(chip), out.force_n = figure_of(force);
  out.power_w = figure_of(power), out.deflection_mm = figure_of(deflection);
  const double slowest = std::max(out.slowest.feed, kCrawlShare * request.feed);
  if (way > 0.0) out.share_of_constant = time * slowest / way;
  return out;
}

std::vector<std::string> load_notes(const PathLoads& loads, const Path& path, const CuttingRequest& request) {
  if (loads.engaged == 0) return {"nothing of the path is engaged: the feed is the same everywhere"};
  std::vector<std::string> notes{fmt::format(
      "the feed follows the load, at most {:.4g} mm/min; largest values (in brackets, those exceeded 5 % of the time): "
      "chip {:.4f} mm ({:.4f}), force {:.4g} N ({:.4g}), power {:.4g} W ({:.4g}), deflection of the tip {:.2f} um "
      "({:.2f})",
      60.0 * request.most_feed, loads.chip_mm.peak, loads.chip_mm.p95, loads.force_n.peak, loads.force_n.p95,
      loads.power_w.peak, loads.power_w.p95, 1e3 * loads.deflection_mm.peak, 1e3 * loads.deflection_mm.p95)};
  const std::string where =
      fmt::format("pass {}, CL point {}", path.strips[loads.slowest_at.strip].id, loads.slowest_at.pose + 1);
  if (loads.too_much > 0)
    notes.push_back(
        fmt::format("at {} of the CL points {} exceeds its limit at any feed, as at {}: they are run at {:.4g} mm/min",
                    loads.too_much, name_of(loads.slowest.by), where, 60.0 * kCrawlShare * request.feed));
  else
    notes.push_back(
        fmt::format("slowest at {}: {:.4g} mm/min, limited by {}; the whole path takes {:.0f} % of the time "
                    "that it would take at this slowest feed",
                    where, 60.0 * loads.slowest.feed, name_of(loads.slowest.by), 100.0 * loads.share_of_constant));
  return notes;
}

}  // namespace flank::internal
