#include "flank/verify/stock/tool_solid.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/tool.h"

namespace flank::internal::verify {
namespace {

/// Joins stretches whose ends differ by rounding alone, mm.
constexpr double kJoin = 1e-9;
/// Squared sine of the angle to the axis up to which a line counts as parallel to it.
constexpr double kParallel = 1e-14;

/// Meridian and round ends as one curve of a parameter that rises with the height: the ends' angles, then s, then angles.
class Outline {
 public:
  explicit Outline(const RadialFunction& radial) : radial_(radial) {}
  [[nodiscard]] Vec2 flank(double s) const { return meridian_point(radial_, s); }
  /// On the sphere of an end: share 0 at the pole for the lower end and at the meridian for the upper one.
  [[nodiscard]] Vec2 end(bool upper, double share) const {
    const double s = upper ? radial_.axis_length() : 0.0;
    const RadialJet j = radial_.at(s);
    // The angle of the normal over the plane across the axis is asin(-r').
    const double slope = std::asin(std::clamp(-j.d1, -1.0, 1.0)), pole = std::acos(-1.0) / 2.0;
    const double angle = upper ? std::lerp(slope, pole, share) : std::lerp(-pole, slope, share);
    return {s + j.r * std::sin(angle), std::max(0.0, j.r * std::cos(angle))};
  }

 private:
  const RadialFunction& radial_;
};

/// Points of a curve over [from, to], without the first, as far apart as the chord allows.
template <class Curve>
void add_points(const Curve& curve, double from, double to, double chord, int depth, std::vector<Vec2>& out) {
  const Vec2 a = curve(from), b = curve(to);
  const Vec2 along = (b - a).norm() > 0.0 ? Vec2((b - a).normalized()) : Vec2(1.0, 0.0);
  double off = 0.0;
  for (const double share : {0.25, 0.5, 0.75}) {
    const Vec2 d = curve(std::lerp(from, to, share)) - a;
    off = std::max(off, std::abs(d.x() * along.y() - d.y() * along.x()));
  }
  if (off > chord && depth > 0) {
    const double middle = 0.5 * (from + to);
    add_points(curve, from, middle, chord, depth - 1, out);
    add_points(curve, middle, to, chord, depth - 1, out);
    return;
  }
  if (b.x() > out.back().x() + 1e-12)
    out.push_back(b);
  else
    out.back() = b;
}

/// Squared distances of a point to the axes of poses, mm^2.
FLANK_LANES void distances_to_axes(std::size_t count, const std::array<const double*, 6>& at, const Vec3& point,
                                   double* __restrict across) {
  const double* __restrict tip_x = at[0], * __restrict tip_y = at[1], * __restrict tip_z = at[2], * __restrict axis_x = at[3], * __restrict axis_y = at[4], * __restrict axis_z = at[5];
  const double px = point.x(), py = point.y(), pz = point.z();
  for (std::size_t k = 0; k < count; ++k) {
    const double x = px - tip_x[k], y = py - tip_y[k], z = pz - tip_z[k];
    const double along = x * axis_x[k] + y * axis_y[k] + z * axis_z[k];
    across[k] = x * x + y * y + z * z - along * along;
  }
}

}  // namespace

void LatePoses::clear() {
  for (std::vector<double>& lane : at) lane.clear();
}

void LatePoses::add(const Pose& pose) {
  for (std::size_t c = 0; c < 3; ++c) {
    at[c].push_back(pose.tip[static_cast<Eigen::Index>(c)]);
    at[c + 3].push_back(pose.axis[static_cast<Eigen::Index>(c)]);
  }
}

Pose LatePoses::operator[](std::size_t k) const {
  return {{at[0][k], at[1][k], at[2][k]}, {at[3][k], at[4][k], at[5][k]}};
}

void LineCuts::add(double low, double high) {
  if (count > 0 && (low <= cuts[static_cast<std::size_t>(count - 1)].high + kJoin || count == kMost)) {
    cuts[static_cast<std::size_t>(count - 1)].high = std::max(cuts[static_cast<std::size_t>(count - 1)].high, high);
    return;
  }
  cuts[static_cast<std::size_t>(count++)] = {low, high};
}

ToolSolid::ToolSolid(const RadialFunction& radial, double chord_mm) : chord_(chord_mm) {
  if (const Legitimacy legitimacy = check_legitimacy(radial); !legitimacy.legitimate)
    throw InputError("the tool's profile is not valid: " + legitimacy.reason);
  constexpr int kPieces = 16, kDepth = 12;
  const Outline outline(radial);
  const double length = radial.axis_length();
  nodes_.push_back(outline.end(false, 0.0));
  add_points([&](double x) { return outline.end(false, x); }, 0.0, 1.0, chord_mm, kDepth, nodes_);
  for (int k = 0; k < kPieces; ++k)
    add_points([&](double s) { return outline.flank(s); }, length * k / kPieces, length * (k + 1) / kPieces, chord_mm,
               kDepth, nodes_);
  add_points([&](double x) { return outline.end(true, x); }, 0.0, 1.0, chord_mm, kDepth, nodes_);
  for (const Vec2& node : nodes_) largest_ = std::max(largest_, node.y());
  for (std::size_t first = 0; first + kBlock < nodes_.size(); first += kBlock) {
    Block& block = blocks_.emplace_back();
    for (std::size_t k = first; k <= first + kBlock; ++k) {
      block.smallest = std::min(block.smallest, nodes_[k].y());
      block.largest = std::max(block.largest, nodes_[k].y());
    }
  }
  std::vector<double> radii;
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    radii.push_back(std::max(nodes_[k].y(), nodes_[k + 1].y()));
    slopes_.push_back((nodes_[k + 1].y() - nodes_[k].y()) / (nodes_[k + 1].x() - nodes_[k].x()));
  }
  radii_.emplace(std::move(radii));
  make_shelves();
  make_bands();
  const RadialJet tip = radial.at(0.0), end = radial.at(length);
  tip_ = {0.0, tip.r * tip.r, -tip.r * tip.d1};
  end_ = {length, end.r * end.r, length - end.r * end.d1};
}

void ToolSolid::make_shelves() {
  constexpr std::size_t kShelves = 4;  // a cone
  const std::size_t shelves = kShelves * nodes_.size();
  shelves_per_mm_ = static_cast<double>(shelves) / (high() - low());
  std::size_t cone = 0;
  for (std::size_t k = 0; k <= shelves; ++k) {
    const double z = low() + static_cast<double>(k) / shelves_per_mm_;
    while (cone + 2 < nodes_.size() && nodes_[cone + 1].x() <= z) ++cone;
    shelves_.push_back(cone > 0 ? cone - 1 : 0);  // one below: rounding
  }
}

void ToolSolid::make_bands() {
  constexpr double kSpare = 1e-9;  // what rounding may put into the next one, bands
  bands_per_mm_ = kBands / (high() - low());
  const auto radius = [&](double z) {
    const std::size_t cone = cone_at(z);
    return nodes_[cone].y() + slopes_[cone] * (std::clamp(z, low(), high()) - nodes_[cone].x());
  };
  std::vector<double> most;
  for (int k = 0; k < kBands; ++k) {
    const double from = low() + (k - kSpare) / bands_per_mm_, to = low() + (k + 1 + kSpare) / bands_per_mm_;
    double narrow = std::min(radius(from), radius(to)), wide = std::max(radius(from), radius(to));
    for (std::size_t n = cone_at(from); n < nodes_.size() && nodes_[n].x() <= to; ++n) {
      if (nodes_[n].x() < from) continue;
      narrow = std::min(narrow, nodes_[n].y()), wide = std::max(wide, nodes_[n].y());
    }
    narrow = std::max(0.0, narrow - chord_ - kClear), wide += kClear;
    bands_.push_back({narrow * narrow, wide * wide});
    most.push_back(wide * wide);
  }
  squares_.emplace(std::move(most));
}

bool ToolSolid::misses(const ToolLine& line, double from, double to) const {
  const double at_from = line.z0 + from * line.dz, at_to = line.z0 + to * line.dz;
  const bool rising = at_from < at_to;
  double bottom = rising ? at_from : at_to, top = rising ? at_to : at_from;
  if (top < low() - kClear || bottom > high() + kClear) return true;
  // What lies below the tip, or above the other end, does not count.
  if (bottom < low()) (rising ? from : to) = (low() - line.z0) / line.dz, bottom = low();
  if (top > high()) (rising ? to : from) = (high() - line.z0) / line.dz, top = high();
  const double square = squares_->over(band_of(bottom), band_of(top));
  if (passes_by(line, square, from, to)) return true;
  // Of a line that is nearly parallel to the axis rounding says where it is nearest.
  constexpr double kSlanted = 1e-2;
  if (line.a > kSlanted && line.a * (line.c - square - kClear) > line.b * line.b) return true;
  if (top > tip_.flank && bottom < end_.flank) return false;
  const RoundEnd& end = top <= tip_.flank ? tip_ : end_;
  const double up = line.z0 - end.centre;
  return passes_by({0.0, 0.0, line.a + line.dz * line.dz, line.b + line.dz * up, line.c + up * up}, end.radius2, from,
                   to);
}

ToolLine ToolSolid::line(const Pose& pose, const Vec3& point, const Vec3& direction) {
  const Vec3 p = point - pose.tip;
  ToolLine out;
  out.z0 = p.dot(pose.axis);
  out.dz = direction.dot(pose.axis);
  const Vec3 p_across = p - out.z0 * pose.axis, d_across = direction - out.dz * pose.axis;
  out.a = d_across.squaredNorm();
  out.b = p_across.dot(d_across);
  out.c = p_across.squaredNorm();
  return out;
}

double ToolSolid::largest(double from, double to) const {
  return to <= low() || from >= high() ? 0.0 : radii_->over(cone_at(from), cone_at(to));
}

bool ToolSolid::reach(const ToolLine& line, double radius, LineCut& within) const {
  const double excess = line.c - radius * radius;
  within = {-1e30, 1e30};
  if (line.a > kParallel) {
    const double root = line.b * line.b - line.a * excess;
    if (root <= 0.0) return false;
    const double half = std::sqrt(root);
    within = {(-line.b - half) / line.a, (-line.b + half) / line.a};
  } else if (excess >= 0.0) {
    return false;
  }
  const double z = line.z0 + within.low * line.dz, end = line.z0 + within.high * line.dz;
  if (std::min(z, end) > low() + kClear && std::max(z, end) < high() - kClear) return within.low < within.high;
  if (std::abs(line.dz) > kParallel) {
    double first = (low() - line.z0) / line.dz, last = (high() - line.z0) / line.dz;
    if (first > last) std::swap(first, last);
    within = {std::max(within.low, first), std::min(within.high, last)};
  } else if (line.z0 <= low() || line.z0 >= high()) {
    return false;
  }
  return within.low < within.high;
}

std::size_t ToolSolid::cone_at(double z) const {
  const double shelf = std::clamp((z - low()) * shelves_per_mm_, 0.0, static_cast<double>(shelves_.size() - 1));
  std::size_t cone = shelves_[static_cast<std::size_t>(shelf)];
  while (cone + 2 < nodes_.size() && nodes_[cone + 1].x() <= z) ++cone;
  return cone;
}

std::size_t ToolSolid::cone_near(std::size_t cone, double z) const {
  while (cone > 0 && nodes_[cone].x() > z) --cone;
  while (cone + 2 < nodes_.size() && nodes_[cone + 1].x() <= z) ++cone;
  return cone;
}

LineCut ToolSolid::narrowed(const ToolLine& line, const LineCut& within, std::size_t first, std::size_t last) const {
  const double radius = radii_->over(std::min(first, last), std::max(first, last));
  const double root = line.b * line.b - line.a * (line.c - radius * radius);
  if (!(line.a > kParallel)) return within;
  if (root <= 0.0) return {};
  const double half = std::sqrt(root);
  return {std::max(within.low, (-line.b - half) / line.a), std::min(within.high, (-line.b + half) / line.a)};
}

void ToolSolid::add_cone(const ToolLine& line, std::size_t cone, double from, double to, LineCuts& out) const {
  if (!(from < to)) return;
  const Vec2& low = nodes_[cone];
  const double slope = slopes_[cone];
  const double alpha = low.y() + slope * (line.z0 - low.x()), beta = slope * line.dz;
  const double a = line.a - beta * beta, b = line.b - alpha * beta, c = line.c - alpha * alpha;
  const auto outside = [&](double k) { return (a * k + 2.0 * b) * k + c; };
  std::array<double, 4> ends{from, to, to, to};
  int count = 1;
  const double root = b * b - a * c;
  if (root > 0.0) {
    // Without cancellation: one root by the larger sum, the other from the product.
    const double q = -(b + std::copysign(std::sqrt(root), b));
    double first = a != 0.0 ? q / a : to, second = q != 0.0 ? c / q : to;
    if (first > second) std::swap(first, second);
    for (const double x : {first, second})
      if (x > from && x < to) ends[static_cast<std::size_t>(count++)] = x;
  }
  ends[static_cast<std::size_t>(count)] = to;
  for (int k = 0; k < count; ++k) {
    const double x = ends[static_cast<std::size_t>(k)], y = ends[static_cast<std::size_t>(k + 1)];
    if (outside(0.5 * (x + y)) < 0.0) out.add(x, y);
  }
}

bool ToolSolid::holds(const Pose& pose, const Vec3& point) const {
  const Vec3 p = point - pose.tip;
  const double z = p.dot(pose.axis), across = p.squaredNorm() - z * z;
  if (z <= low() || z >= high()) return false;
  const Band& band = bands_[band_of(z)];
  if (across >= band.most || across < band.least) return across < band.least;
  const std::size_t cone = cone_at(z);
  const Vec2 &a = nodes_[cone], &b = nodes_[cone + 1];
  const double radius = std::lerp(a.y(), b.y(), (z - a.x()) / (b.x() - a.x())) - chord_;
  return radius > 0.0 && across < radius * radius;
}

bool ToolSolid::holds(const LatePoses& poses, const Vec3& point) const {
  constexpr std::size_t kPoses = 32;
  std::array<double, kPoses> across;  // not set
  std::array<const double*, 6> at{};
  for (std::size_t first = 0; first < poses.count(); first += kPoses) {
    const std::size_t count = std::min(kPoses, poses.count() - first);
    for (std::size_t c = 0; c < at.size(); ++c) at[c] = poses.at[c].data() + first;
    distances_to_axes(count, at, point, across.data());
    for (std::size_t k = 0; k < count; ++k)
      if (across[k] < largest_ * largest_ && holds(poses[first + k], point)) return true;
  }
  return false;
}

ToolSolid::Side ToolSolid::side_of(const ToolLine& line, const Block& block, double from, double to) {
  const auto distance2 = [&](double k) { return (line.a * k + 2.0 * line.b) * k + line.c; };
  const double at_from = distance2(from), at_to = distance2(to);
  // The squared distance is convex along the line: its largest value is at an end.
  if (std::max(at_from, at_to) < block.smallest * block.smallest) return Side::kInside;
  const double nearest = line.a > 0.0 ? std::clamp(-line.b / line.a, from, to) : from;
  return distance2(nearest) > block.largest * block.largest ? Side::kOutside : Side::kBoth;
}

LineCuts ToolSolid::cut(const ToolLine& line, const LineCut& reached) const {
  LineCuts out;
  const auto cone_of = [&](double k) { return cone_at(line.z0 + k * line.dz); };
  std::size_t first = cone_of(reached.low), last = cone_of(reached.high);
  LineCut within = reached;
  if (first != last) {
    within = narrowed(line, reached, first, last);
    if (!(within.low < within.high)) return out;
    first = cone_near(first, line.z0 + within.low * line.dz), last = cone_near(last, line.z0 + within.high * line.dz);
  }
  if (first == last) {
    add_cone(line, first, within.low, within.high, out);
    return out;
  }
  const bool rising = line.dz > 0.0;
  double from = within.low;
  // Where the line leaves a cone upwards (`rising`) or downwards.
  const auto leaves = [&](std::size_t cone) {
    const double end = (nodes_[rising ? cone + 1 : cone].x() - line.z0) / line.dz;
    return cone == last ? within.high : std::clamp(end, from, within.high);
  };
  for (std::size_t cone = first;;) {
    // A block of cones that the line passes on one side of all of them is done at once.
    const std::size_t block = cone / kBlock, begin = block * kBlock, exit = rising ? begin + kBlock - 1 : begin;
    const bool enters = cone == (rising ? begin : begin + kBlock - 1) && block < blocks_.size();
    const bool whole = enters && (rising ? exit <= last : exit >= last);
    const double end = whole ? leaves(exit) : from;
    const Side side = whole ? side_of(line, blocks_[block], from, end) : Side::kBoth;
    double to = end;
    if (side == Side::kBoth) {
      to = leaves(cone);
      add_cone(line, cone, from, to, out);
    } else {
      if (side == Side::kInside && from < to) out.add(from, to);
      cone = exit;
    }
    if (cone == last) return out;
    from = to;
    cone = rising ? cone + 1 : cone - 1;
  }
}

}  // namespace flank::internal::verify
