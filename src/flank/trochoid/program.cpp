#include "flank/trochoid/program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/tolerance_budget.h"
#include "flank/trochoid/blank.h"
#include "flank/trochoid/retract.h"
#include "flank/trochoid/run_out.h"

namespace flank::internal {
namespace {

constexpr int kSideRows = 201, kSideRings = 21;
/// Way before and behind the sides, in the tool's radii: there the tool is out of the blank.
constexpr double kRunOut = 1.5;
constexpr double kLargestTurn = 4.5 * std::numbers::pi / 180.0;

/// Of the radius: run-outs that enter a face deeper than this end at a wall.
constexpr double kWall = 0.2;

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

/// All layers, fed from the open end to the other, which may end at a wall.
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
  if (depth.end > wall && depth.start <= wall)
    for (LayerSides& layer : layers)
      for (SidePath* path : {&layer.from, &layer.to}) path->stop_at_end();
  return layers;
}

Pose pose_of(const AxisPlace& place) { return {place.tip, place.u}; }

/// Poses from one to the other, turning evenly, both included.
std::vector<Pose> between(const Pose& from, const Pose& to, double axis_length) {
  const double middle = 0.5 * axis_length, turn = std::acos(std::clamp(from.axis.dot(to.axis), -1.0, 1.0));
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / kLargestTurn)));
  std::vector<Pose> poses;
  for (int k = 0; k <= steps; ++k) {
    const double x = static_cast<double>(k) / steps;
    const Vec3 u = ((1.0 - x) * from.axis + x * to.axis).normalized();
    const Vec3 at = (1.0 - x) * from.at(middle) + x * to.at(middle);
    poses.push_back({at - middle * u, u});
  }
  return poses;
}

double way_of(const std::vector<Pose>& poses, double s) {
  double way = 0.0;
  for (std::size_t k = 1; k < poses.size(); ++k) way += (poses[k].at(s) - poses[k - 1].at(s)).norm();
  return way;
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
  void add(const std::string& kind, const RuledMotion& motion) {
    SamplingOptions sampling;
    sampling.chord_tolerance_mm =
        std::max(options_.chord_mm, kToleranceBudget.cavity.half_chord * options_.cycles.tolerance_mm);
    sampling.largest_turn_rad = kLargestTurn;
    SampledMotion sampled = sample_motion(motion, sampling);
    out_.chord_bound_mm = std::max(out_.chord_bound_mm, sampled.chord_bound_mm);
    add(kind, both(), std::move(sampled.poses));
  }
  void layer(const LayerSides& sides, const LayerCycles& cycles, PlannedLayer& planned);
  /// Out of the layer above, over, and in to where this one's first cycle begins.
  void link(const LayerSides& above, const LayerSides& sides, const ClearPlane& clear, PlannedLayer& planned);
  [[nodiscard]] std::string both() const { return options_.left + "," + options_.right; }

 private:
  /// Before the place of the first cycle, out of the blank.
  [[nodiscard]] Pose beginning(const LayerSides& sides, const LayerCycles& cycles) const {
    const AxisPlace first = sides.from.at(cycles.cycles.front().from_x);
    return {first.tip - kRunOut * radial_.largest() * first.tip_dx, first.u};
  }

  const RadialFunction& radial_;
  const HalfGuard& guard_;
  const ProgramOptions& options_;
  CavityProgram& out_;
};

void ProgramWriter::layer(const LayerSides& sides, const LayerCycles& cycles, PlannedLayer& planned) {
  const double length = radial_.axis_length(), run = kRunOut * radial_.largest();
  if (cycles.cycles.empty()) return;
  add("entry", both(), {beginning(sides, cycles), pose_of(sides.from.at(cycles.cycles.front().from_x))});
  for (const Cycle& cycle : cycles.cycles) {
    if (cycle.back) add("back", cycle.back->motion);
    add("front", cycle.front.motion);
  }
  // Back along the side where the last front ended, across before the start, and on along the other side: both as far as
  // the cycles got.
  const Cycle& end = cycles.cycles.back();
  const bool done = cycles.status == CycleStatus::kDone;
  const double over = sides.to.stops_at_end() ? 0.0 : run;
  const double to_x = done ? std::max(over > 0.0 ? end.to_x : 0.0, sides.to.length() + over) : end.to_x;
  const double from_x = done ? sides.from.length() + over : end.from_x;
  if (to_x <= 0.0 || from_x <= 0.0) return;
  std::vector<Pose> returning = sides.to.poses(-run, to_x, options_.chord_mm);
  std::reverse(returning.begin(), returning.end());
  planned.sides_mm += way_of(returning, 0.5 * length);
  add("side", both(), std::move(returning));
  const AxisPlace from = sides.from.at(-run);
  const double gap = (from.at(0.5 * length) - sides.to.at(-run).at(0.5 * length)).norm();
  add("link", half_path(length, sides.to.at(-run).reversed(), from, {0.12 * gap, 0.12 * gap, 0.0, 0.0}));
  planned.links_mm += way_of(out_.path.strips.back().poses, 0.5 * length);
  std::vector<Pose> onwards = sides.from.poses(-run, from_x, options_.chord_mm);
  planned.sides_mm += way_of(onwards, 0.5 * length);
  add("side", both(), std::move(onwards));
}

void ProgramWriter::link(const LayerSides& above, const LayerSides& sides, const ClearPlane& clear,
                         PlannedLayer& planned) {
  const double length = radial_.axis_length(), allowed = kToleranceBudget.cavity.aim * options_.cycles.tolerance_mm;
  const Pose last = out_.path.strips.back().poses.back(), next = beginning(sides, planned.cycles);
  // Where the cycles above got stuck, or at a wall, material is in front.
  const bool through = out_.layers.back().cycles.status == CycleStatus::kDone && !above.from.stops_at_end();
  const Vec3 onwards = through ? above.from.at(above.from.length()).tip_dx : Vec3::Zero();
  std::vector<Pose> poses = retract(last, onwards, clear, radial_, guard_, allowed);
  std::vector<Pose> in = retract(next, -sides.from.at(0.0).tip_dx, clear, radial_, guard_, allowed);
  const std::vector<Pose> over = between(poses.back(), in.back(), length);
  poses.insert(poses.end(), over.begin() + 1, over.end());
  poses.insert(poses.end(), in.rbegin() + 1, in.rend());
  planned.links_mm += way_of(poses, 0.5 * length);
  add("link", both(), std::move(poses));
}

RuledMotion backwards_of(const RuledMotion& motion) { return SidePath(motion, true).motion(); }

/// Largest engagement and volume of a finishing sweep, which is then swept.
double sweep_side(const RuledMotion& motion, SweptStock& stock, double& volume) {
  EngagementMeter meter(stock);
  const Engagement e = meter.measure(motion, tool_rings(stock.radial(), kSideRings, 5), kSideRows);
  volume += e.volume_mm3;
  const double largest = meter.refine(motion, e, kSideRings).angle_rad;
  stock.add(Sweep::of(motion, 6 * kHalfIntervals));
  return largest;
}

/// Both finishing sweeps, as far as the cycles got.
void sweep_sides(const LayerSides& sides, SweptStock& stock, PlannedLayer& planned) {
  if (planned.cycles.cycles.empty()) {
    planned.share = 0.0;
    return;
  }
  const Cycle& end = planned.cycles.cycles.back();
  const bool done = planned.cycles.status == CycleStatus::kDone;
  planned.share = done ? 1.0 : std::clamp(end.from_x / sides.from.length(), 0.0, 1.0);
  if (!done && (end.to_x <= 0.0 || end.from_x <= 0.0)) return;
  const RuledMotion first = done ? sides.to.motion() : sides.to.motion_to(end.to_x);
  const RuledMotion second = done ? sides.from.motion() : sides.from.motion_to(end.from_x);
  planned.first_side_rad = sweep_side(backwards_of(first), stock, planned.side_volume_mm3);
  planned.second_side_rad = sweep_side(second, stock, planned.side_volume_mm3);
}

}  // namespace

bool CavityProgram::done() const {
  return !layers.empty() && std::all_of(layers.begin(), layers.end(), [](const PlannedLayer& layer) {
    return layer.cycles.status == CycleStatus::kDone;
  });
}

double CavityProgram::entered_mm() const {
  double deepest = 0.0;
  for (const PlannedLayer& layer : layers) deepest = std::max(deepest, layer.cycles.entered_mm());
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
  out.walled = layers.front().from.stops_at_end();
  out.blank = cavity_blank(layers, left, right);
  const ClearPlane clear{out.blank.back().normal, out.blank.back().offset + 2.0 * radial.largest()};
  SweptStock stock(radial, out.blank);
  CycleOptions cycles = options.cycles;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const LayerSides& layer = layers[k];
    PlannedLayer planned;
    planned.cycles = plan_cycles(layer, guard, stock, cycles, progress);
    if (!out.path.strips.empty() && !planned.cycles.cycles.empty()) writer.link(layers[k - 1], layer, clear, planned);
    writer.layer(layer, planned.cycles, planned);
    sweep_sides(layer, stock, planned);
    // What is left above is in the way of the holder: a layer goes no farther than the one before, less a radius.
    if (planned.share < 1.0)
      cycles.most_share = std::min(cycles.most_share, planned.share - radial.largest() / layer.from.length());
    const bool on = planned.cycles.status != CycleStatus::kCancelled && cycles.most_share > 0.0;
    out.layers.push_back(std::move(planned));
    if (!on) break;
  }
  return out;
}

}  // namespace flank::internal
