#include "flank/verify/stock/replay.h"

#include <algorithm>
#include <cmath>

#include "flank/verify/stock/front_scan.h"

namespace flank::internal::verify {
namespace {

Pose between(const Pose& a, const Pose& b, double x) {
  return {a.tip + x * (b.tip - a.tip), (a.axis + x * (b.axis - a.axis)).normalized()};
}

/// How far any point of the axis goes, mm.
double way_between(const Pose& a, const Pose& b, double length) {
  return std::max((b.tip - a.tip).norm(), (b.at(length) - a.at(length)).norm());
}

class Replayer {
 public:
  Replayer(DexelStock& stock, const RadialFunction& radial, const ReplayOptions& options)
      : stock_(stock),
        solid_(radial, 0.01 * stock.cell()),
        scan_(radial, options.circles),
        length_(radial.axis_length()),
        measured_(options.circles > 0),
        // Two balls `step` apart leave a scallop of step^2 / (8 r) between them.
        step_(std::sqrt(8.0 * radial.smallest() * options.scallop_cells * stock.cell())) {}

  StripReplay run(const Strip& strip);

 private:
  double cut_between(const Pose& from, const Pose& to);
  [[nodiscard]] PoseVelocity velocity(const std::vector<Pose>& poses, std::size_t k) const;
  DexelStock& stock_;
  ToolSolid solid_;
  FrontScan scan_;
  double length_;
  bool measured_;
  double step_;
};

/// Mean of both sides' directions: of a smooth motion that was joined straight it is the tangent, to second order.
PoseVelocity Replayer::velocity(const std::vector<Pose>& poses, std::size_t k) const {
  PoseVelocity out;
  for (std::size_t n = std::max<std::size_t>(k, 1); n <= std::min(k + 1, poses.size() - 1); ++n) {
    const double way = way_between(poses[n - 1], poses[n], length_);
    if (!(way > 0.0)) continue;
    // The shorter way tells more of the direction here.
    const double weight = 1.0 / (way * way);
    out.tip += weight * (poses[n].tip - poses[n - 1].tip);
    out.axis += weight * (poses[n].axis - poses[n - 1].axis);
  }
  return out;
}

StripReplay Replayer::run(const Strip& strip) {
  StripReplay out;
  out.kind = strip.kind;
  const std::vector<Pose>& poses = strip.poses;
  std::size_t cut = 0;  // the last pose that was cut
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (k > 0) out.way_mm += (poses[k].at(0.5 * length_) - poses[k - 1].at(0.5 * length_)).norm();
    PoseReplay pose;
    // Poses that lie nearer to each other than cuts need to be: one for all of them.
    const bool pass = k > 0 && k + 1 < poses.size() && way_between(poses[cut], poses[k + 1], length_) <= step_;
    if (!pass) {
      pose.volume_mm3 = k == 0 ? stock_.cut(solid_, poses[0]) : cut_between(poses[k - 1], poses[k]);
      cut = k;
      // Where nothing was removed on the way nothing was engaged.
      if (measured_ && poses.size() > 1 && (k == 0 || pose.volume_mm3 > 0.0)) {
        const FrontScan::Largest largest = scan_.largest(stock_, poses[k], velocity(poses, k));
        pose.angle_rad = largest.angle_rad;
        pose.s = largest.s;
      }
    }
    out.volume_mm3 += pose.volume_mm3;
    if (pose.angle_rad > out.angle_rad) out.angle_rad = pose.angle_rad, out.pose = k;
    out.poses.push_back(pose);
  }
  return out;
}

double Replayer::cut_between(const Pose& from, const Pose& to) {
  double volume = 0.0;
  const int steps = std::max(1, static_cast<int>(std::ceil(way_between(from, to, length_) / step_)));
  for (int n = 1; n <= steps; ++n) volume += stock_.cut(solid_, between(from, to, static_cast<double>(n) / steps));
  return volume;
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
  for (const Strip& strip : path.strips) out.strips.push_back(replayer.run(strip));
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
