#include "flank/trochoid/program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/tolerance_budget.h"
#include "flank/motion/written_path.h"
#include "flank/trochoid/blank.h"
#include "flank/trochoid/engagement/engagement.h"
#include "flank/trochoid/retract.h"
#include "flank/trochoid/run_out.h"

namespace flank::internal {
namespace {

/// Way before and behind the sides, in the tool's radii: there the tool is out of the blank.
constexpr double kRunOut = 1.5;

/// Of the radius: run-outs that enter a face deeper than this end at a wall.
constexpr double kWall = 0.2;
/// Of the way to the other side: so far off a side a tool is drawn out beside it.
constexpr double kAside = 0.2;
/// Radii that a finishing sweep keeps off the place where an entry's first front begins or ends.
constexpr double kOffCorner = 0.02;

/// More than run-outs are bent and raised for, so that what they keep to by coarse samples is not cut off; the judge allows more.
double allowed_at_run_outs(const ProgramOptions& options) {
  return kToleranceBudget.cavity.halves * options.cycles.tolerance_mm;
}

/// Left and right side path of a layer, in the order in which fronts use them, and how deep their run-outs enter faces.
/// Milling is climb where a front goes to the left seen along the feed with the holder up.
LayerSides order_sides(const RuledMotion& left, const RuledMotion& right, bool backwards, const ProgramOptions& options,
                       double radius, const HalfGuard& guard, RunOutDepth& depth) {
  SidePath a(left, backwards), b(right, backwards);
  const RunOutDepth here =
      join_run_outs(a, b, radius, guard, kToleranceBudget.cavity.aim * options.cycles.tolerance_mm);
  depth.start = std::max(depth.start, here.start);
  depth.end = std::max(depth.end, here.end);
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
  for (LayerSides& layer : layers)
    for (SidePath* path : {&layer.from, &layer.to}) {
      if (both) path->stop_at(false);
      if (both || (depth.end > wall && depth.start <= wall)) path->stop_at(true);
    }
  return layers;
}

Pose pose_of(const AxisPlace& place) { return {place.tip, place.u}; }

double way_of(const std::vector<Pose>& poses, double s) {
  double way = 0.0;
  for (std::size_t k = 1; k < poses.size(); ++k) way += (poses[k].at(s) - poses[k - 1].at(s)).norm();
  return way;
}

/// From where to where the finishing sweeps go on both sides, mm: as far as the cycles got. Out of the blank where an end is
/// open.
struct SideRange {
  double from_start = 0.0, from_end = 0.0, to_start = 0.0, to_end = 0.0;
  /// Whether anything of the sides is in it.
  [[nodiscard]] bool some() const { return from_end > std::max(0.0, from_start) && to_end > std::max(0.0, to_start); }
};

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
    const double over_from = open ? free(sides.from, true) : 0.0, over_to = open ? free(sides.to, true) : 0.0;
    range.from_end = sides.from.length() + over_from;
    range.to_end = std::max(over_to == run_mm ? end.to_x : 0.0, sides.to.length() + over_to);
  }
  // Before the first front that an entry has opened there is material. That front finishes its ends itself: a sweep that ended
  // just there would end in a corner, where the tool touches material all around.
  if (planned.entry) {
    range.from_start = planned.entry->front.from_x + off_corner_mm;
    range.to_start = planned.entry->front.to_x + off_corner_mm;
    range.from_end = sides.from.stops_at_end() ? std::min(end.from_x, sides.from.length()) : end.from_x;
    range.to_end = sides.to.stops_at_end() ? std::min(end.to_x, sides.to.length()) : end.to_x;
  }
  return range;
}

std::vector<Pose> backwards_of(std::vector<Pose> poses) {
  std::reverse(poses.begin(), poses.end());
  return poses;
}

class ProgramWriter {
 public:
  ProgramWriter(const RadialFunction& radial, const HalfGuard& guard, const ProgramOptions& options, CavityProgram& out)
      : radial_(radial), guard_(guard), options_(options), out_(out) {}

  void add(const std::string& kind, const std::string& face, std::vector<Pose> poses) {
    if (poses.size() < 2) return;
    Strip strip;
    strip.id = static_cast<int>(out_.path.strips.size()) + 1;
    strip.kind = kind;
    strip.face = face;
    strip.poses = std::move(poses);
    out_.path.strips.push_back(std::move(strip));
  }
  void add(const std::string& kind, const RuledMotion& motion) { add(kind, both(), poses_of(motion, 2)); }
  /// All moves of an entry as one strip.
  void add(const Entry& entry);
  void layer(const LayerSides& sides, const SideRange& range, PlannedLayer& planned);
  /// Both finishing sweeps of a layer that began before the blank, or inside.
  void finish_open(const LayerSides& sides, const SideRange& range, PlannedLayer& planned);
  void finish_inside(const LayerSides& sides, const SideRange& range, PlannedLayer& planned);
  /// Out of the layer above, over, and in to where this one's first cycle begins.
  void link(const LayerSides& above, const LayerSides& sides, const ClearPlane& clear, PlannedLayer& planned);
  [[nodiscard]] std::string both() const { return options_.left + "," + options_.right; }

 private:
  void add_side(std::vector<Pose> poses, PlannedLayer& planned);
  void add_link(std::vector<Pose> poses, PlannedLayer& planned);
  void add_link(const RuledMotion& motion, PlannedLayer& planned);
  [[nodiscard]] bool enters(const std::vector<Pose>& poses) const;
  /// From the start of one finishing sweep to that of the other, back on what the first front has cut.
  [[nodiscard]] std::vector<Pose> way_of_first_front(const LayerSides& sides, const SideRange& range,
                                                     const Cycle& first);
  [[nodiscard]] std::vector<Pose> poses_of(const RuledMotion& motion, int least) {
    SamplingOptions sampling;
    sampling.chord_tolerance_mm =
        std::max(options_.chord_mm, kToleranceBudget.cavity.half_chord * options_.cycles.tolerance_mm);
    sampling.largest_turn_rad = kLargestTurn;
    sampling.minimum_poses = least;
    SampledMotion sampled = sample_motion(motion, sampling);
    out_.chord_bound_mm = std::max(out_.chord_bound_mm, sampled.chord_bound_mm);
    return std::move(sampled.poses);
  }
  /// Where the layer begins: over the material, or before the place of the first cycle, out of the blank.
  [[nodiscard]] Pose beginning(const LayerSides& sides, const PlannedLayer& planned) const {
    if (planned.entry) return planned.entry->moves.front().pose(0.0);
    const AxisPlace first = sides.from.at(planned.cycles.cycles.front().from_x);
    return {first.tip - kRunOut * radial_.largest() * first.tip_dx, first.u};
  }

  const RadialFunction& radial_;
  const HalfGuard& guard_;
  const ProgramOptions& options_;
  CavityProgram& out_;
};

void ProgramWriter::add(const Entry& entry) {
  // The judge measures at poses: straight moves need some between their ends.
  constexpr int kLeast = 9;
  std::vector<Pose> poses;
  for (const RuledMotion& move : entry.moves) {
    const std::vector<Pose> more = poses_of(move, kLeast);
    poses.insert(poses.end(), more.begin() + (poses.empty() ? 0 : 1), more.end());
  }
  add(entry.method == EntryMethod::kPlunge ? "plunge" : "ramp", both(), std::move(poses));
}

void ProgramWriter::layer(const LayerSides& sides, const SideRange& range, PlannedLayer& planned) {
  const LayerCycles& cycles = planned.cycles;
  if (cycles.cycles.empty()) return;
  if (planned.entry)
    add(*planned.entry);
  else
    add("entry", both(), {beginning(sides, planned), pose_of(sides.from.at(cycles.cycles.front().from_x))});
  for (const Cycle& cycle : cycles.cycles) {
    if (cycle.back) add("back", cycle.back->motion);
    // The first front is the end of an entry that opens it.
    if (cycle.back || !planned.entry) add("front", cycle.front.motion);
  }
  if (!range.some()) return;
  if (planned.entry)
    finish_inside(sides, range, planned);
  else
    finish_open(sides, range, planned);
}

void ProgramWriter::add_side(std::vector<Pose> poses, PlannedLayer& planned) {
  planned.sides_mm += way_of(poses, 0.5 * radial_.axis_length());
  add("side", both(), std::move(poses));
}

void ProgramWriter::add_link(std::vector<Pose> poses, PlannedLayer& planned) {
  planned.links_mm += way_of(poses, 0.5 * radial_.axis_length());
  add("link", both(), std::move(poses));
}

void ProgramWriter::add_link(const RuledMotion& motion, PlannedLayer& planned) {
  add_link(poses_of(motion, 2), planned);
}

bool ProgramWriter::enters(const std::vector<Pose>& poses) const {
  constexpr int kPlaces = 13;
  GuardDepth depth;
  for (const Pose& pose : poses) guard_.look(pose, kPlaces, depth);
  return depth.deepest() > allowed_at_run_outs(options_);
}

std::vector<Pose> ProgramWriter::way_of_first_front(const LayerSides& sides, const SideRange& range,
                                                    const Cycle& first) {
  const auto along = [&](const SidePath& side, double from, double to) {
    return from <= to ? side.poses(from, to, options_.chord_mm) : backwards_of(side.poses(to, from, options_.chord_mm));
  };
  std::vector<Pose> poses = along(sides.to, range.to_start, first.to_x);
  for (const std::vector<Pose>& more :
       {backwards_of(poses_of(first.front.motion, 2)), along(sides.from, first.from_x, range.from_start)})
    poses.insert(poses.end(), more.begin() + (poses.empty() || more.empty() ? 0 : 1), more.end());
  return poses;
}

void ProgramWriter::finish_open(const LayerSides& sides, const SideRange& range, PlannedLayer& planned) {
  // Back along the side where the last front ended, across before the start, and on along the other side: both as far as the
  // cycles got.
  const double length = radial_.axis_length();
  add_side(backwards_of(sides.to.poses(range.to_start, range.to_end, options_.chord_mm)), planned);
  const AxisPlace from = sides.from.at(range.from_start), to = sides.to.at(range.to_start);
  const double gap = (from.at(0.5 * length) - to.at(0.5 * length)).norm();
  std::vector<Pose> across = poses_of(half_path(length, to.reversed(), from, {0.12 * gap, 0.12 * gap, 0.0, 0.0}), 2);
  // One side may begin far behind the other (a splitter): then the way of the first front is known to be free.
  if (enters(across)) across = way_of_first_front(sides, range, planned.cycles.cycles.front());
  add_link(off_floor(std::move(across), radial_, guard_, allowed_at_run_outs(options_)), planned);
  add_side(sides.from.poses(range.from_start, range.from_end, options_.chord_mm), planned);
}

void ProgramWriter::finish_inside(const LayerSides& sides, const SideRange& range, PlannedLayer& planned) {
  // At the start there is material before the first front, and who comes there from the side cuts a corner. So both sides are
  // swept towards it, and the way across is that of the last front. The first side is run forwards once more, which is the cut of
  // the other.
  const RuledMotion& front = planned.cycles.cycles.back().front.motion;
  const std::vector<Pose> onwards = sides.from.poses(range.from_start, range.from_end, options_.chord_mm);
  add_link(SidePath(front, true).motion(), planned);
  add_side(backwards_of(onwards), planned);
  add_side(onwards, planned);
  add_link(front, planned);
  add_side(backwards_of(sides.to.poses(range.to_start, range.to_end, options_.chord_mm)), planned);
}

void ProgramWriter::link(const LayerSides& above, const LayerSides& sides, const ClearPlane& clear,
                         PlannedLayer& planned) {
  const double length = radial_.axis_length(), allowed = kToleranceBudget.cavity.aim * options_.cycles.tolerance_mm;
  const Pose last = out_.path.strips.back().poses.back(), next = beginning(sides, planned);
  // Where the cycles above got stuck, or at a wall, material is in front.
  const bool through = out_.layers.back().cycles.status == CycleStatus::kDone && !above.from.stops_at_end();
  WayOut out;
  if (through && !out_.layers.back().entry) out.outward = above.from.at(above.from.length()).tip_dx;
  // Off the side, into what the last front has cleared.
  if (above.from.stops_at_end())
    out.aside =
        kAside * (above.to.at(out_.layers.back().cycles.cycles.back().to_x).at(0.5 * length) - last.at(0.5 * length));
  std::vector<Pose> poses = retract(last, out, clear, radial_, guard_, allowed);
  WayOut from;
  if (!planned.entry) from.outward = -sides.from.at(0.0).tip_dx;
  std::vector<Pose> in = retract(next, from, clear, radial_, guard_, allowed);
  const std::vector<Pose> over = poses_between(poses.back(), in.back(), length, kLargestTurn);
  poses.insert(poses.end(), over.begin() + 1, over.end());
  poses.insert(poses.end(), in.rbegin() + 1, in.rend());
  add_link(std::move(poses), planned);
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
  if (clear != nullptr) {
    planned.entry = plan_entry(sides, guard, stock, *clear, options.entry, options.cycles);
    planned.no_way_in = !planned.entry;
    if (planned.no_way_in) {
      planned.cycles.status = CycleStatus::kStuck;
      return planned;
    }
    first = planned.entry->front;
  }
  planned.cycles = plan_cycles(sides, guard, stock, options.cycles, first, progress);
  return planned;
}

}  // namespace

double PlannedLayer::entered_mm() const { return std::max(cycles.entered_mm(), entry ? entry->entered_mm : 0.0); }

bool PlannedLayer::stuck_along_axis() const {
  constexpr double kHalfAcross = std::numbers::pi / 6.0;
  return cycles.status == CycleStatus::kStuck && !cycles.cycles.empty() && off_axis_rad < kHalfAcross;
}

bool CavityProgram::stuck_along_axis() const {
  return std::any_of(layers.begin(), layers.end(), [](const PlannedLayer& layer) { return layer.stuck_along_axis(); });
}

bool CavityProgram::done() const {
  return !layers.empty() && std::all_of(layers.begin(), layers.end(), [](const PlannedLayer& layer) {
    return layer.cycles.status == CycleStatus::kDone;
  });
}

double CavityProgram::entered_mm() const {
  double deepest = 0.0;
  for (const PlannedLayer& layer : layers) deepest = std::max(deepest, layer.entered_mm());
  return deepest;
}

CavityProgram plan_program(const std::vector<RuledMotion>& sides, const RadialFunction& radial, const Target& left,
                           const Target& right, const GuardedFaces& faces, const ProgramOptions& options,
                           const Progress& progress) {
  CavityProgram out;
  const HalfGuard guard(faces, radial);
  ProgramWriter writer(radial, guard, options, out);
  const std::vector<LayerSides> layers = order_layers(sides, options, radial.largest(), guard);
  if (layers.empty()) return out;
  out.walled_start = layers.front().from.stops_at_start();
  out.walled_end = layers.front().from.stops_at_end();
  const bool inside =
      out.walled_start || options.entry.method == EntryMethod::kRamp || options.entry.method == EntryMethod::kPlunge;
  out.blank = cavity_blank(layers, left, right);
  const ClearPlane clear{out.blank.back().normal, out.blank.back().offset + 2.0 * radial.largest()};
  SweptStock stock(radial, out.blank);
  ProgramOptions here = options;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const LayerSides& layer = layers[k];
    PlannedLayer planned = plan_layer(layer, guard, stock, inside ? &clear : nullptr, here, progress);
    if (!out.path.strips.empty() && !planned.cycles.cycles.empty()) writer.link(layers[k - 1], layer, clear, planned);
    const SideRange range = range_of(layer, planned, radial.largest(), guard, allowed_at_run_outs(options));
    writer.layer(layer, range, planned);
    sweep_sides(layer, range, stock, planned);
    // What is left above is in the way of the holder: a layer goes no farther than the one before, less a radius.
    if (planned.share < 1.0) {
      const double less = planned.cycles.before_wall_mm > 0.0 ? 0.0 : radial.largest() / layer.from.length();
      here.cycles.most_share = std::min(here.cycles.most_share, planned.share - less);
    }
    const bool on = planned.cycles.status != CycleStatus::kCancelled && here.cycles.most_share > 0.0;
    out.layers.push_back(std::move(planned));
    if (!on) break;
  }
  return out;
}

}  // namespace flank::internal
