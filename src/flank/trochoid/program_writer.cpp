#include "flank/trochoid/program_writer.h"

#include <cmath>
#include <utility>

#include "flank/base/tolerance_budget.h"
#include "flank/motion/written_path.h"
#include "flank/trochoid/engagement/engagement.h"

namespace flank::internal {
namespace {

/// Of the way to the other side: so far off a side a tool is drawn out beside it.
constexpr double kAside = 0.2;

Pose pose_of(const AxisPlace& place) { return {place.tip, place.u}; }

double way_of(const std::vector<Pose>& poses, double s) {
  double way = 0.0;
  for (std::size_t k = 1; k < poses.size(); ++k) way += (poses[k].at(s) - poses[k - 1].at(s)).norm();
  return way;
}

std::vector<Pose> backwards_of(std::vector<Pose> poses) {
  std::reverse(poses.begin(), poses.end());
  return poses;
}

}  // namespace

double allowed_at_run_outs(const ProgramOptions& options) {
  return kToleranceBudget.cavity.halves * options.cycles.tolerance_mm;
}

void ProgramWriter::add(const std::string& kind, std::vector<Pose> poses) {
  if (poses.size() < 2) return;
  Strip strip;
  strip.id = static_cast<int>(out_.path.strips.size()) + 1;
  strip.kind = kind;
  strip.face = options_.left + "," + options_.right;
  strip.poses = std::move(poses);
  strip.layer = static_cast<int>(out_.layers.size()) + 1;  // those that are done, and this one
  out_.path.strips.push_back(std::move(strip));
}

std::vector<Pose> ProgramWriter::poses_of(const RuledMotion& motion, int least) {
  SamplingOptions sampling;
  sampling.chord_tolerance_mm =
      std::max(options_.chord_mm, kToleranceBudget.cavity.half_chord * options_.cycles.tolerance_mm);
  sampling.largest_turn_rad = kLargestTurn;
  sampling.minimum_poses = least;
  SampledMotion sampled = sample_motion(motion, sampling);
  out_.chord_bound_mm = std::max(out_.chord_bound_mm, sampled.chord_bound_mm);
  return std::move(sampled.poses);
}

Pose ProgramWriter::beginning(const LayerSides& sides, const PlannedLayer& planned) const {
  if (planned.entry) return planned.entry->moves.front().pose(0.0);
  const AxisPlace first = sides.from.at(planned.cycles.cycles.front().from_x);
  return {first.tip - kRunOut * radial_.largest() * first.tip_dx, first.u};
}

void ProgramWriter::add(const Entry& entry) {
  // The judge measures at poses: straight moves need some between their ends.
  constexpr int kLeast = 9;
  std::vector<Pose> poses;
  for (const RuledMotion& move : entry.moves) {
    const std::vector<Pose> more = poses_of(move, kLeast);
    poses.insert(poses.end(), more.begin() + (poses.empty() ? 0 : 1), more.end());
  }
  add(entry.method == EntryMethod::kPlunge ? "plunge" : "ramp", std::move(poses));
}

void ProgramWriter::layer(const LayerSides& sides, const SideRange& range, PlannedLayer& planned) {
  const LayerCycles& cycles = planned.cycles;
  if (cycles.cycles.empty()) return;
  if (planned.entry)
    add(*planned.entry);
  else
    add("entry", {beginning(sides, planned), pose_of(sides.from.at(cycles.cycles.front().from_x))});
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
  add("side", std::move(poses));
}

void ProgramWriter::add_link(std::vector<Pose> poses, PlannedLayer& planned) {
  planned.links_mm += way_of(poses, 0.5 * radial_.axis_length());
  add("link", std::move(poses));
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

bool ProgramWriter::cuts(const std::vector<Pose>& poses) const {
  return largest_engagement(poses, stock_) > options_.cycles.largest_rad;
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

std::vector<Pose> ProgramWriter::over(const Pose& last, const WayOut& out, const Pose& next, const WayOut& in) const {
  const double allowed = kToleranceBudget.cavity.aim * options_.cycles.tolerance_mm;
  std::vector<Pose> poses = retract(last, out, clear_, radial_, guard_, allowed);
  const std::vector<Pose> down = retract(next, in, clear_, radial_, guard_, allowed);
  const std::vector<Pose> above = poses_between(poses.back(), down.back(), radial_.axis_length(), kLargestTurn);
  poses.insert(poses.end(), above.begin() + 1, above.end());
  poses.insert(poses.end(), down.rbegin() + 1, down.rend());
  return poses;
}

std::vector<Pose> ProgramWriter::across_start(const LayerSides& sides, const SideRange& range, const Cycle& first) {
  const double length = radial_.axis_length();
  const AxisPlace from = sides.from.at(range.from_start), to = sides.to.at(range.to_start);
  const double gap = (from.at(0.5 * length) - to.at(0.5 * length)).norm();
  std::vector<Pose> across = poses_of(half_path(length, to.reversed(), from, {0.12 * gap, 0.12 * gap, 0.0, 0.0}), 2);
  if (!enters(across) && !cuts(across)) return across;
  // One side may begin far behind the other (a splitter): then the way of the first front is known to be free, where it need
  // not be drawn up.
  across = off_floor(way_of_first_front(sides, range, first), radial_, guard_, allowed_at_run_outs(options_));
  if (!enters(across) && !cuts(across)) return across;
  const std::vector<Pose> outside =
      over(pose_of(to), {.outward = -to.tip_dx}, pose_of(from), {.outward = -from.tip_dx});
  return enters(outside) || cuts(outside) ? across : outside;
}

void ProgramWriter::finish_open(const LayerSides& sides, const SideRange& range, PlannedLayer& planned) {
  // Back along the side where the last front ended, across before the start, and on along the other side: both as far as the
  // cycles got.
  add_side(backwards_of(sides.to.poses(range.to_start, range.to_end, options_.chord_mm)), planned);
  add_link(across_start(sides, range, planned.cycles.cycles.front()), planned);
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

void ProgramWriter::link(const LayerSides& above, const LayerSides& sides, PlannedLayer& planned) {
  const double middle = 0.5 * radial_.axis_length();
  const Pose last = out_.path.strips.back().poses.back();
  // Where the cycles above got stuck, or at a wall, material is in front.
  const bool through = out_.layers.back().cycles.status == CycleStatus::kDone && !above.from.stops_at_end();
  WayOut out, in;
  if (through && !out_.layers.back().entry) out.outward = above.from.at(above.from.length()).tip_dx;
  // Off the side, into what the last front has cleared.
  if (above.from.stops_at_end())
    out.aside = kAside * (above.to.at(out_.layers.back().cycles.cycles.back().to_x).at(middle) - last.at(middle));
  if (!planned.entry) in.outward = -sides.from.at(0.0).tip_dx;
  add_link(over(last, out, beginning(sides, planned), in), planned);
}

}  // namespace flank::internal
