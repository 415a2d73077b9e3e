#include "flank/verify/stock/front_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/verify/stock/front_circle.h"

namespace flank::internal::verify {
namespace {

/// Arcs, and gaps between them, that are narrower than this may be missed.
constexpr double kStep = 1.5 * std::numbers::pi / 180.0;

/// In a direction from the circle's centre.
bool is_engaged(const DexelStock& stock, const MovingTool& tool, const FrontCircle& circle, const Vec3& outwards) {
  // Where a front goes along a surface that was cut before, the stock has the ridges between its own cuts: what the tool meets must
  // reach farther into it. What was taken lately is asked on the front itself, since such poses leave next to nothing.
  const Vec3 inside = circle.centre + (circle.radius - tool.grain_mm) * outwards;
  if (!(tool.empty == nullptr ? stock.holds(inside, outwards) : stock.holds(inside, outwards, *tool.empty)))
    return false;
  return tool.lately == nullptr || !tool.solid->holds(*tool.lately, circle.centre + circle.radius * outwards);
}

/// Where the answer changes between two angles: by halving, as the depth has jumps at edges.
double crossing(const DexelStock& stock, const MovingTool& tool, const FrontCircle& circle, double out, double in) {
  constexpr int kHalvings = 9;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (out + in);
    (is_engaged(stock, tool, circle, circle.outwards(middle)) ? in : out) = middle;
  }
  return 0.5 * (out + in);
}

}  // namespace

FrontScan::FrontScan(const RadialFunction& radial, int count) : radial_(radial), count_(std::max(2, count)) {}

double FrontScan::add_arcs(const DexelStock& stock, const MovingTool& tool, int ring,
                           std::vector<EngagedArc>& arcs) const {
  const FrontCircle circle = front_circle(radial_, tool.pose, tool.velocity, height(ring));
  if (!(circle.half > 0.0)) return 0.0;
  const int steps = std::max(4, static_cast<int>(std::ceil(2.0 * circle.half / kStep)));
  const auto at = [&](int k) { return circle.half * (2.0 * (k + 0.5) / steps - 1.0); };
  const auto is_in = [&](const Vec2& u) {
    return is_engaged(stock, tool, circle, u.x() * circle.forward + u.y() * circle.side);
  };
  // From one angle to the next by a turn, without sine and cosine.
  const double step = 2.0 * circle.half / steps;
  const Vec2 turn(std::cos(step), std::sin(step));
  Vec2 direction(std::cos(at(0)), std::sin(at(0)));
  double sum = 0.0, from = -circle.half;
  const auto add = [&](double to) {
    sum += to - from;
    arcs.push_back({ring, from, to});
  };
  bool before = is_in(direction);
  for (int k = 1; k < steps; ++k) {
    direction =
        Vec2(turn.x() * direction.x() - turn.y() * direction.y(), turn.y() * direction.x() + turn.x() * direction.y());
    const bool in = is_in(direction);
    if (in == before) continue;
    const double place =
        in ? crossing(stock, tool, circle, at(k - 1), at(k)) : crossing(stock, tool, circle, at(k), at(k - 1));
    if (in)
      from = place;
    else
      add(place);
    before = in;
  }
  if (before) add(circle.half);
  return sum;
}

FrontScan::Seen FrontScan::look(const DexelStock& stock, const MovingTool& tool) const {
  Seen out;
  for (int k = 0; k < count_; ++k)
    if (const double angle = add_arcs(stock, tool, k, out.arcs); angle > out.angle_rad)
      out.angle_rad = angle, out.s = height(k);
  return out;
}

std::vector<double> FrontScan::heights() const {
  std::vector<double> out;
  for (int k = 0; k < count_; ++k) out.push_back(height(k));
  return out;
}

}  // namespace flank::internal::verify
