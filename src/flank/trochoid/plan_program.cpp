#include "flank/trochoid/plan_program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/tolerance_budget.h"
#include "flank/trochoid/blank.h"
#include "flank/trochoid/engagement/engagement.h"
#include "flank/trochoid/paths/run_out.h"
#include "flank/trochoid/program_writer.h"

namespace flank::internal {
namespace {

/// Radii: a wall that is nearer to the end of the sides than this stands right there.
constexpr double kNearWall = 1.0;
/// Radii that a finishing sweep keeps off the place where an entry's first front begins or ends.
constexpr double kOffCorner = 0.02;

/// Left and right side path of a layer, in the order in which fronts use them, and how deep their run-outs enter faces.
/// Milling is climb where a front goes to the left seen along the feed with the holder up.
LayerSides order_sides(const RuledMotion& left, const RuledMotion& right, bool backwards, const ProgramOptions& options,
                       double radius, const HalfGuard& guard, RunOutDepth& depth) {
  SidePath a(left, backwards), b(right, backwards);
  const RunOutDepth here =
      join_run_outs(a, b, radius, guard, kToleranceBudget.cavity.aim * options.cycles.tolerance_mm);
  depth.start = std::max(depth.start, here.start);
  depth.end = std::max(depth.end, here.end);
  depth.free_start = std::min(depth.free_start, here.free_start);
  depth.free_end = std::min(depth.free_end, here.free_end);
  const double middle = 0.5 * a.axis_length();
  const AxisPlace p = a.at(0.5 * a.length()), q = b.at(0.5 * b.length());
  const Vec3 forward = p.velocity(middle) + q.velocity(middle);
  const bool a_to_b = (p.u + q.u).cross(forward).dot(q.at(middle) - p.at(middle)) > 0.0;
  return a_to_b == options.climb ? LayerSides{a, b} : LayerSides{b, a};
}

/// All layers, fed from the open end to the other, which may end at a wall; there may be one at both.
std::vector<LayerSides> order_layers(const std::vector<RuledMotion>& sides, const ProgramOptions& options,
                                     double radius, const HalfGuard& guard) {
  const auto ordered = [&](bool backwards, RunOutDepth& depth) {
    std::vector<LayerSides> layers;
    for (std::size_t k = 0; k + 1 < sides.size(); k += 2)
      layers.push_back(order_sides(sides[k], sides[k + 1], backwards, options, radius, guard, depth));
    return layers;
  };
  RunOutDepth depth;
  std::vector<LayerSides> layers = ordered(false, depth);
  const double wall = kWall * radius;
  if (depth.start > wall && depth.end <= wall) layers = ordered(true, depth = {});
  // Who asks for an open entry has an open start.
  const bool both = depth.start > wall && depth.end > wall && options.entry.method != EntryMethod::kOpen;
  const auto before_wall = [&](double free_mm) { return free_mm < kNearWall * radius ? 0.0 : free_mm; };
  const WallDepths allowed{kToleranceBudget.cavity.aim * options.cycles.tolerance_mm, allowed_at_run_outs(options)};
  for (LayerSides& layer : layers)
    for (SidePath* path : {&layer.from, &layer.to}) {
      if (both) path->stop_at(false, before_wall(depth.free_start));
      // Cycles leave before a wall what its place is off: it is found more closely.
      if (both || (depth.end > wall && depth.start <= wall))
        path->stop_at(true, way_to_wall(*path, before_wall(depth.free_end), radius, guard, allowed));
    }
  return layers;
}

/// Where a run-out enters a face, however it bends and rises, a sweep ends before that: only the side needs it.
SideRange range_of(const LayerSides& sides, const PlannedLayer& planned, double radius_mm, const HalfGuard& guard,
                   double allowed_mm) {
  if (planned.cycles.cycles.empty()) return {};
  const double run_mm = kRunOut * radius_mm, off_corner_mm = kOffCorner * radius_mm;
  const auto free = [&](const SidePath& side, bool end) { return free_run_out(side, end, run_mm, guard, allowed_mm); };
  const Cycle& end = planned.cycles.cycles.back();
  const bool done = planned.cycles.status == CycleStatus::kDone && planned.cycles.before_wall_mm == 0.0;
  SideRange range{-free(sides.from, false), end.from_x, -free(sides.to, false), end.to_x};
  if (done) {
    const bool open = !sides.to.stops_at_end();
    // Before a wall there may be material in front of the last front.
    const auto over = [&](const SidePath& side, double front_x) {
      return open ? free(side, true) : std::clamp(front_x - side.length(), 0.0, free(side, true));
    };
    const double over_from = over(sides.from, end.from_x), over_to = over(sides.to, end.to_x);
    range.from_end = sides.from.length() + over_from;
    range.to_end = std::max(open && over_to == run_mm ? end.to_x : 0.0, sides.to.length() + over_to);
  }
  // Before the first front that an entry has opened there is material. That front finishes its ends itself: a sweep that ended
  // just there would end in a corner, where the tool touches material all around.
  if (planned.entry) {
    range.from_start = planned.entry->front.from_x + off_corner_mm;
    range.to_start = planned.entry->front.to_x + off_corner_mm;
    range.from_end = sides.from.stops_at_end() ? std::min(end.from_x, sides.from.last()) : end.from_x;
    range.to_end = sides.to.stops_at_end() ? std::min(end.to_x, sides.to.last()) : end.to_x;
  }
  return range;
}

/// Largest engagement of a finishing sweep, with its run-outs, which is then swept.
double sweep_side(std::vector<RuledMotion> motions, bool backwards, SweptStock& stock, PlannedLayer& planned) {
  if (backwards) std::reverse(motions.begin(), motions.end());
  for (RuledMotion& motion : motions)
    if (backwards) motion = SidePath(motion, true).motion();
  const PassMeasure measure = measure_pass(motions, 6 * kHalfIntervals, stock);
  planned.side_volume_mm3 += measure.volume_mm3;
  return measure.largest_rad;
}

/// Angle between the way of a side and its axis, at most 90 degrees.
double off_axis(const SidePath& side, double x) {
  const AxisPlace place = side.at(x);
  const Vec3 way = place.velocity(0.5 * side.axis_length());
  return std::atan2(way.cross(place.u).norm(), std::abs(way.dot(place.u)));
}

/// Both finishing sweeps, as far as the cycles got.
void sweep_sides(const LayerSides& sides, const SideRange& range, SweptStock& stock, PlannedLayer& planned) {
  if (planned.cycles.cycles.empty()) {
    planned.share = 0.0;
    return;
  }
  const Cycle& end = planned.cycles.cycles.back();
  const bool done = planned.cycles.status == CycleStatus::kDone && planned.cycles.before_wall_mm == 0.0;
  planned.share = done ? 1.0 : std::clamp(end.from_x / sides.from.length(), 0.0, 1.0);
  planned.off_axis_rad = std::min(off_axis(sides.from, end.from_x), off_axis(sides.to, end.to_x));
  if (!range.some()) return;
  // Inside the material both are swept towards the start.
  const bool inside = planned.entry.has_value();
  planned.first_side_rad = sweep_side(sides.to.motions_between(range.to_start, range.to_end), true, stock, planned);
  planned.second_side_rad =
      sweep_side(sides.from.motions_between(range.from_start, range.from_end), inside, stock, planned);
}

/// Entry and cycles of a layer. `clear`: it begins inside the material, under that plane; else before the blank.
PlannedLayer plan_layer(const LayerSides& sides, const HalfGuard& guard, SweptStock& stock, const ClearPlane* clear,
                        const ProgramOptions& options, const Progress& progress) {
  PlannedLayer planned;
  std::optional<FirstFront> first;
  if (clear != nullptr && sides.from.first() < 0.0 && options.entry.method == EntryMethod::kAuto) {
    // The wall is so far off that there may be room for a front before the blank, and for all that lead in.
    const std::size_t before = stock.sweeps().size();
    planned.cycles = plan_cycles(sides, guard, stock, options.cycles, first, progress);
    const bool stuck = planned.cycles.status == CycleStatus::kStuck;
    const bool inside = !planned.cycles.cycles.empty() && planned.cycles.cycles.back().from_x > 0.0;
    if (!stuck || inside || progress.stop()) return planned;
    while (stock.sweeps().size() > before) stock.remove_last();
    planned.cycles = {};
  }
  if (clear != nullptr) {
    planned.entry = plan_entry(sides, guard, stock, *clear, options.entry, options.cycles, progress);
    planned.no_way_in = !planned.entry && !progress.stop();
    if (!planned.entry) {
      planned.cycles.status = planned.no_way_in ? CycleStatus::kStuck : CycleStatus::kCancelled;
      return planned;
    }
    first = planned.entry->front;
  }
  planned.cycles = plan_cycles(sides, guard, stock, options.cycles, first, progress);
  return planned;
}

}  // namespace

CavityProgram plan_program(const std::vector<RuledMotion>& sides, const RadialFunction& radial, const Target& left,
                           const Target& right, const GuardedFaces& faces, const ProgramOptions& options,
                           const Progress& progress) {
  CavityProgram out;
  const HalfGuard guard(faces, radial);
  const std::vector<LayerSides> layers = order_layers(sides, options, radial.largest(), guard);
  if (layers.empty()) return out;
  out.walled_start = layers.front().from.stops_at_start();
  out.walled_end = layers.front().from.stops_at_end();
  const bool inside =
      out.walled_start || options.entry.method == EntryMethod::kRamp || options.entry.method == EntryMethod::kPlunge;
  out.blank = cavity_blank(layers, left, right);
  const ClearPlane clear{out.blank.back().normal, out.blank.back().offset + 2.0 * radial.largest()};
  SweptStock stock(radial, out.blank);
  ProgramWriter writer(guard, stock, clear, options, out);
  ProgramOptions here = options;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const LayerSides& layer = layers[k];
    PlannedLayer planned = plan_layer(layer, guard, stock, inside ? &clear : nullptr, here, progress);
    if (!out.path.strips.empty() && !planned.cycles.cycles.empty()) writer.link(layers[k - 1], layer, planned);
    const SideRange range = range_of(layer, planned, radial.largest(), guard, allowed_at_run_outs(options));
    writer.layer(layer, range, planned);
    sweep_sides(layer, range, stock, planned);
    // What is left above is in the way of the holder: a layer goes no farther than the one before, less a radius.
    if (planned.share < 1.0) {
      const double less = planned.cycles.before_wall_mm > 0.0 ? 0.0 : radial.largest() / layer.from.length();
      here.cycles.most_share = std::min(here.cycles.most_share, planned.share - less);
    }
    const bool ends = !options.below_stuck && planned.cycles.status == CycleStatus::kStuck;
    const bool on = !ends && planned.cycles.status != CycleStatus::kCancelled && here.cycles.most_share > 0.0;
    out.layers.push_back(std::move(planned));
    if (!on) break;
  }
  // Where a front has room before the blank, a wall farther on closes nothing.
  if (!out.layers.empty() && !out.layers.front().entry && !out.layers.front().no_way_in) out.walled_start = false;
  return out;
}

}  // namespace flank::internal
