#include "flank/verify/stock/replay.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "flank/base/stopping.h"
#include "flank/verify/stock/front_scan.h"

namespace flank::internal::verify {
namespace {

Pose between(const Pose& a, const Pose& b, double x) {
  return {a.tip + x * (b.tip - a.tip), (a.axis + x * (b.axis - a.axis)).normalized()};
}

PoseVelocity between(const PoseVelocity& a, const PoseVelocity& b, double x) {
  return {a.tip + x * (b.tip - a.tip), a.axis + x * (b.axis - a.axis)};
}

/// How far the tool must have come, in cells, before what it took is cut from the stock, and at most on its way.
constexpr double kLagCells = 4.0, kLongestLag = 3.0;
/// Of what a late pose is to leave beside the next one, cells.
constexpr double kLateScallop = 5e-4;

/// Places that are measured are no farther apart than this share of the way to the end of their strip, as far as cuts are, and need not
/// be nearer than this share of the way between late poses.
constexpr double kOfWayToEnd = 0.3, kNearest = 0.15;

/// A stretch of the way that is not cut yet.
struct Stretch {
  Pose from, to;
  std::size_t strip = 0, pose = 0;
  double way = 0.0;
  bool passed = false;  ///< so near to the next one that one cut is enough for both
};

class Replayer {
 public:
  Replayer(DexelStock& stock, const RadialFunction& radial, const ReplayOptions& options)
      : stock_(stock),
        solid_(radial, 0.01 * stock.cell()),
        scan_(radial, options.circles),
        length_(radial.axis_length()),
        measured_(options.circles > 0),
        step_(step_for(radial, options.scallop_cells)),
        late_step_(step_for(radial, kLateScallop)),
        grain_(options.scallop_cells * stock.cell()),
        lag_(measured_ ? kLagCells * stock.cell() : 0.0),
        empty_(stock.empty_blocks()) {}

  void run(const std::vector<Strip>& strips, std::vector<StripReplay>& out);
  [[nodiscard]] std::vector<double> heights() const { return measured_ ? scan_.heights() : std::vector<double>(); }

 private:
  /// Two balls `step` apart leave a scallop of step^2 / (8 r) between them.
  [[nodiscard]] double step_for(const RadialFunction& radial, double scallop_cells) const {
    return std::sqrt(8.0 * radial.smallest() * scallop_cells * stock_.cell());
  }
  void run(const Strip& strip, std::size_t index, std::vector<StripReplay>& out);
  /// Whether one cut is enough for a pose and the next one. Where a motion turns back, the pose there is not between.
  [[nodiscard]] bool is_between(const Pose& last, const Pose& pose, const Pose& next) const {
    const double whole = way_between(last, next, length_);
    return whole <= step_ && way_between(last, pose, length_) <= whole && way_between(pose, next, length_) <= whole;
  }
  /// From the pose before to pose k of a strip: measured on its way.
  void go_to(const std::vector<Pose>& poses, std::size_t k, bool passed, std::size_t index,
             std::vector<StripReplay>& out);
  /// How far from a place on the way to pose k the next one that is measured may be.
  [[nodiscard]] double apart(const std::vector<Pose>& poses, std::size_t k, const Pose& here) const;
  void measure(const Pose& pose, const PoseVelocity& velocity, std::size_t k, StripReplay& replay);
  /// Cuts what lies far enough behind a pose; all of it if there is none.
  void cut_behind(const Pose* pose, std::vector<StripReplay>& out);
  double cut(const Stretch& stretch);
  void add_lately(const Stretch& stretch);
  DexelStock& stock_;
  ToolSolid solid_;
  FrontScan scan_;
  double length_;
  bool measured_;
  double step_, late_step_, grain_, lag_;
  std::deque<Stretch> waiting_;
  double waiting_way_ = 0.0;
  double unmeasured_ = 0.0;  ///< way since the last place that was measured
  LatePoses lately_;
  std::vector<EmptyBlocks> empty_;  ///< of the stock as it was at some time
};

/// Of every ring the larger of what was and what is seen.
void keep_larger(const std::vector<EngagedArc>& seen, std::vector<EngagedArc>& kept) {
  const auto angle = [](const std::vector<EngagedArc>& arcs, int ring) {
    double sum = 0.0;
    for (const EngagedArc& arc : arcs)
      if (arc.ring == ring) sum += arc.angle();
    return sum;
  };
  std::vector<EngagedArc> out;
  const int last = std::max(seen.empty() ? -1 : seen.back().ring, kept.empty() ? -1 : kept.back().ring);
  for (int ring = 0; ring <= last; ++ring)
    for (const EngagedArc& arc : angle(seen, ring) > angle(kept, ring) ? seen : kept)
      if (arc.ring == ring) out.push_back(arc);
  kept = std::move(out);
}

void Replayer::run(const std::vector<Strip>& strips, std::vector<StripReplay>& out) {
  out.resize(strips.size());
  for (std::size_t k = 0; k < strips.size(); ++k) run(strips[k], k, out);
  cut_behind(nullptr, out);
  for (StripReplay& strip : out)
    for (const PoseReplay& pose : strip.poses) strip.volume_mm3 += pose.volume_mm3;
}

void Replayer::run(const Strip& strip, std::size_t index, std::vector<StripReplay>& out) {
  StripReplay& replay = out[index];
  replay.kind = strip.kind;
  const std::vector<Pose>& poses = strip.poses;
  replay.poses.resize(poses.size());
  std::size_t last = 0;  // the last pose that is not passed
  for (std::size_t k = 0; k < poses.size(); ++k) {
    stop_here();
    if (k > 0) replay.way_mm += (poses[k].at(0.5 * length_) - poses[k - 1].at(0.5 * length_)).norm();
    const bool passed = k > 0 && k + 1 < poses.size() && is_between(poses[last], poses[k], poses[k + 1]);
    go_to(poses, k, passed, index, out);
    if (!passed) last = k;
  }
}

// Poses are as near as joining them straight asks for. Wherever a cut is, it is measured, too, and ever nearer towards the ends: on the last
// tenth of a millimetre what a half engages rises and falls by degrees.
double Replayer::apart(const std::vector<Pose>& poses, std::size_t k, const Pose& here) const {
  const double to_end =
      std::min(way_between(poses.front(), poses[k], length_), way_between(here, poses.back(), length_));
  return std::clamp(kOfWayToEnd * to_end, kNearest * late_step_, step_);
}

void Replayer::go_to(const std::vector<Pose>& poses, std::size_t k, bool passed, std::size_t index,
                     std::vector<StripReplay>& out) {
  Pose from = poses[k == 0 ? 0 : k - 1];
  const Pose first = from;
  const double way = way_between(first, poses[k], length_);
  unmeasured_ += way;
  const bool measured = measured_ && poses.size() > 1 && (!passed || unmeasured_ >= apart(poses, k, poses[k]));
  if (measured) unmeasured_ = 0.0;
  const PoseVelocity before = velocity_at(poses, k == 0 ? 0 : k - 1, length_), after = velocity_at(poses, k, length_);
  for (double x = 0.0; x < 1.0;) {
    const double steps = measured ? std::ceil((1.0 - x) * way / apart(poses, k, from)) : 1.0;
    x = steps > 1.0 ? x + (1.0 - x) / steps : 1.0;
    const Pose to = x < 1.0 ? between(first, poses[k], x) : poses[k];
    cut_behind(&to, out);
    waiting_.push_back({from, to, index, k, way_between(from, to, length_), passed});
    waiting_way_ += waiting_.back().way;
    if (measured) measure(to, between(before, after, x), k, out[index]);
    from = to;
  }
}

void Replayer::measure(const Pose& pose, const PoseVelocity& velocity, std::size_t k, StripReplay& replay) {
  lately_.clear();
  for (const Stretch& stretch : waiting_) add_lately(stretch);
  const FrontScan::Seen largest = scan_.look(stock_, {&solid_, pose, velocity, &lately_, grain_, &empty_});
  PoseReplay& here = replay.poses[k];
  here.measured = true;
  ++replay.places;
  if (largest.angle_rad > here.angle_rad) here.angle_rad = largest.angle_rad, here.s = largest.s;
  keep_larger(largest.arcs, here.arcs);
  if (largest.angle_rad > replay.angle_rad) replay.angle_rad = largest.angle_rad, replay.pose = k;
}

void Replayer::cut_behind(const Pose* pose, std::vector<StripReplay>& out) {
  while (!waiting_.empty()) {
    const Stretch& next = waiting_.front();
    const auto near = [&](double s) { return (next.to.at(s) - pose->at(s)).norm() < lag_; };
    if (pose != nullptr && waiting_way_ - next.way < kLongestLag * lag_ && (near(0.0) || near(length_))) return;
    out[next.strip].poses[next.pose].volume_mm3 += cut(next);
    waiting_way_ -= next.way;
    waiting_.pop_front();
  }
  waiting_way_ = 0.0;
}

double Replayer::cut(const Stretch& stretch) {
  if (stretch.passed) return 0.0;
  if (!(stretch.way > 0.0)) return stock_.cut(solid_, stretch.to);
  double volume = 0.0;
  const int steps = std::max(1, static_cast<int>(std::ceil(stretch.way / step_)));
  for (int n = 1; n <= steps; ++n)
    volume += stock_.cut(solid_, between(stretch.from, stretch.to, static_cast<double>(n) / steps));
  return volume;
}

void Replayer::add_lately(const Stretch& stretch) {
  const int steps = std::max(1, static_cast<int>(std::ceil(stretch.way / late_step_)));
  for (int n = 1; n <= steps; ++n) lately_.add(between(stretch.from, stretch.to, static_cast<double>(n) / steps));
}

}  // namespace

double StockReplay::largest(const std::string& kind) const {
  double out = 0.0;
  for (const StripReplay& strip : strips)
    if (kind.empty() || strip.kind == kind) out = std::max(out, strip.angle_rad);
  return out;
}

StockReplay replay(DexelStock& stock, const RadialFunction& radial, const Path& path, const ReplayOptions& options) {
  StockReplay out;
  out.cell_mm = stock.cell();
  out.before_mm3 = stock.volume();
  Replayer replayer(stock, radial, options);
  replayer.run(path.strips, out.strips);
  out.heights = replayer.heights();
  out.after_mm3 = stock.volume();
  return out;
}

RayLeft left_along(const DexelStock& stock, const Vec3& point, const Vec3& normal, double reach_mm) {
  RayLeft out;
  const double step = 0.5 * stock.cell();
  double run = 0.0;
  for (double h = 2.0 * step; h <= reach_mm; h += step) {
    run = stock.depth(point + h * normal) > 0.0 ? run + step : 0.0;
    out.over_mm = std::max(out.over_mm, run);
  }
  // A point in the air is as far from the material as the stock begins inside.
  const std::optional<double> distance = stock.distance(point);
  if (distance && *distance < 0.0) out.entered_mm = -*distance;
  return out;
}

}  // namespace flank::internal::verify
