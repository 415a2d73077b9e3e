#include "flank/machine/links.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// Largest turn between two poses of a link.
constexpr double kStep = 5.0 * std::numbers::pi / 180.0;
/// By how much chords of that step would cut a sphere short.
constexpr double kChordRoom = 1.002;

/// The unit vector at t in [0, 1] of the shorter great circle between two.
Vec3 on_circle(const Vec3& from, const Vec3& to, double t) {
  // By atan2: the arc cosine of a product loses half its digits at small angles.
  const double angle = 2.0 * std::atan2((to - from).norm(), (to + from).norm());
  // The circle's plane is rounding here, and the sines below would divide it by nothing.
  if (angle < 1e-9) return (from + t * (to - from)).normalized();
  if (angle > std::numbers::pi - 1e-6) {
    // Opposite: any way round will do.
    const Vec3 side = from.unitOrthogonal();
    return t < 0.5 ? on_circle(from, side, 2.0 * t) : on_circle(side, to, 2.0 * t - 1.0);
  }
  return (std::sin((1.0 - t) * angle) * from + std::sin(t * angle) * to).normalized();
}

/// Between two unit vectors, radians, exact at both ends of its range.
double angle_of(const Vec3& a, const Vec3& b) { return 2.0 * std::atan2((a - b).norm(), (a + b).norm()); }

/// A place on the sphere: outward normal, and the tool there.
struct Safe {
  Vec3 outward = Vec3::UnitZ(), axis = Vec3::UnitZ();
};

/// The sphere round all that must not be touched, and the ways from and to it.
class Linker {
 public:
  explicit Linker(const LinkOptions& options)
      : center_(options.keep_out.center()),
        radius_(kChordRoom * (0.5 * options.keep_out.diagonal() + options.tool_radius + options.clearance)) {}

  /// From a pose of contact by its lead, then out of the part to the sphere.
  std::vector<Pose> way_out(const Pose& contact, const Lead& lead, Safe& safe) const {
    std::vector<Pose> way = lead_out(contact, lead);
    const std::vector<Pose> rest = to_sphere(way.back(), lead.out, safe);
    way.insert(way.end(), rest.begin() + 1, rest.end());
    return way;
  }

  /// That pose first. Zero: along the axis.
  std::vector<Pose> to_sphere(const Pose& from, const Vec3& out, Safe& safe) const {
    std::vector<Pose> way{from};
    Pose p = from;
    const bool along_axis = out.isZero();
    const double run = along_axis ? run_along_axis(p) : run_across(p, out);
    if (run > 0.0) {
      p.tip += run * (along_axis ? p.axis : out);
      way.push_back(p);
    }
    safe.outward = (p.tip - center_).normalized();
    safe.axis = p.axis;
    // Beside the sphere and pointing past it: turned outward where it is, away from the part, before it comes near.
    if (!along_axis && safe.outward.dot(safe.axis) < 0.0) {
      const int steps = static_cast<int>(std::ceil(angle_of(p.axis, safe.outward) / kStep));
      for (int k = 1; k <= steps; ++k)
        way.push_back({p.tip, on_circle(p.axis, safe.outward, static_cast<double>(k) / steps)});
      safe.axis = safe.outward;
    }
    const Pose there = at(safe);
    // Where the line misses the sphere, or begins beyond it, the tool goes straight to the sphere from here.
    if ((there.tip - p.tip).norm() > 1e-9) way.push_back(there);
    return way;
  }

  [[nodiscard]] Safe place(const Pose& p) const { return {(p.tip - center_).normalized(), p.axis}; }

  [[nodiscard]] Pose at(const Safe& s) const { return {center_ + radius_ * s.outward, s.axis}; }

  /// Round the sphere: both turn at once where the tool points outward all the way, else the tool is first turned outward.
  void round(const Safe& from, const Safe& to, std::vector<Pose>& way) const {
    if (points_outward(from, to)) {
      turn(from, to, way);
      return;
    }
    const Safe a{from.outward, from.outward}, b{to.outward, to.outward};
    turn(from, a, way);
    turn(a, b, way);
    turn(b, to, way);
  }

 private:
  static constexpr int kLooks = 64;

  /// Where the line leaves the sphere; where it misses it, its nearest point: the rest of the tool is clear from there.
  [[nodiscard]] double run_along_axis(const Pose& p) const {
    const Vec3 d = p.tip - center_;
    const double along = d.dot(p.axis), inside = radius_ * radius_ - d.squaredNorm() + along * along;
    return std::max(0.0, -along + (inside > 0.0 ? std::sqrt(inside) : 0.0));
  }

  /// The tip and all that is above it, without an end, is outside.
  [[nodiscard]] bool clear(const Pose& p) const {
    const Vec3 d = p.tip - center_;
    return (d + std::max(0.0, -d.dot(p.axis)) * p.axis).norm() >= radius_;
  }

  /// So far along a direction that the tool is outside from there on.
  [[nodiscard]] double run_across(const Pose& p, const Vec3& out) const {
    constexpr int kSteps = 256, kHalvings = 40;
    const auto clear_at = [&](double run) { return clear({p.tip + run * out, p.axis}); };
    const double far = 2.0 * radius_ + (p.tip - center_).norm();
    double low = 0.0, high = far;
    for (int k = kSteps; k-- > 0;)
      if (!clear_at(far * k / kSteps)) {
        low = far * k / kSteps;
        high = far * (k + 1) / kSteps;
        break;
      } else if (k == 0) {
        return 0.0;
      }
    for (int k = 0; k < kHalvings; ++k) (clear_at(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    return high;
  }

  static Safe between(const Safe& from, const Safe& to, double t) {
    return {on_circle(from.outward, to.outward, t), on_circle(from.axis, to.axis, t)};
  }
  static bool points_outward(const Safe& from, const Safe& to) {
    for (int k = 0; k <= kLooks; ++k) {
      const Safe s = between(from, to, static_cast<double>(k) / kLooks);
      if (s.outward.dot(s.axis) < 0.0) return false;
    }
    return true;
  }
  void turn(const Safe& from, const Safe& to, std::vector<Pose>& way) const {
    const double angle = std::max(angle_of(from.outward, to.outward), angle_of(from.axis, to.axis));
    const int steps = static_cast<int>(std::ceil(angle / kStep));
    for (int k = 1; k <= steps; ++k) way.push_back(at(between(from, to, static_cast<double>(k) / steps)));
  }

  Vec3 center_;
  double radius_;
};

}  // namespace

// A cavity's cycles follow each other in the same pose: with links between them the tool would leave the cavity each
// time.
std::vector<Pose> lead_out(const Pose& first, const Lead& lead) {
  std::vector<Pose> way{first};
  way.insert(way.end(), lead.back.begin(), lead.back.end());
  const Pose contact = way.back();
  const double lift = lead.off.norm();
  if (!(lift > 0.0)) return way;
  if (!lead.is_arc()) {
    way.push_back({contact.tip + lead.off, contact.axis});
    return way;
  }
  constexpr double kArc = std::numbers::pi / 3.0;
  constexpr int kSteps = 12;
  const double radius = lift / (1.0 - std::cos(kArc));
  for (int k = 1; k <= kSteps; ++k) {
    const double angle = kArc * k / kSteps;
    const double on = radius * std::sin(angle), away = radius * (1.0 - std::cos(angle)) / lift;
    way.push_back(
        {contact.tip + on * lead.along.tip + away * lead.off, (contact.axis + on * lead.along.axis).normalized()});
  }
  return way;
}

namespace {

/// What a way round the box from the end of one strip to the beginning of another costs: the larger turn.
double way_between(const Pose& end, const Pose& begin, const Vec3& center) {
  const auto outward = [&](const Pose& p) {
    const Vec3 d = p.tip - center;
    return d.norm() > 0.0 ? Vec3(d.normalized()) : p.axis;
  };
  return std::max(angle_of(outward(end), outward(begin)), angle_of(end.axis, begin.axis));
}

/// From the end of strip a to the beginning of strip b: ways[a * count + b].
std::vector<double> ways_of(const Path& path, const Vec3& center) {
  std::vector<double> ways;
  for (const Strip& a : path.strips)
    for (const Strip& b : path.strips) ways.push_back(way_between(a.poses.back(), b.poses.front(), center));
  return ways;
}

/// From the first strip on always to the nearest that is left.
std::vector<std::size_t> nearest_first(const std::vector<double>& ways, std::size_t count) {
  std::vector<std::size_t> order, left(count);
  std::iota(left.begin(), left.end(), std::size_t{0});
  while (!left.empty()) {
    auto next = left.begin();
    if (!order.empty())
      next = std::min_element(left.begin(), left.end(), [&, from = order.back() * count](std::size_t a, std::size_t b) {
        return ways[from + a] < ways[from + b];
      });
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

}  // namespace

std::vector<std::size_t> short_order(const Path& path, const Box3& box) {
  const std::size_t count = path.strips.size();
  const std::vector<double> ways = ways_of(path, box.center());
  const auto length = [&](const std::vector<std::size_t>& order) {
    double sum = 0.0;
    for (std::size_t k = 1; k < order.size(); ++k) sum += ways[order[k - 1] * count + order[k]];
    return sum;
  };
  std::vector<std::size_t> order = nearest_first(ways, count);
  // A strip put elsewhere: with directions that stay, turning a part of the order round is no exchange.
  constexpr double kShorter = 1e-9;  // rad: less is rounding, and would go round in circles
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (std::size_t from = 1; from < count; ++from)
      for (std::size_t to = 1; to < count; ++to) {
        std::vector<std::size_t> other = order;
        const std::size_t strip = other[from];
        other.erase(other.begin() + static_cast<std::ptrdiff_t>(from));
        other.insert(other.begin() + static_cast<std::ptrdiff_t>(to), strip);
        if (length(other) < length(order) - kShorter) {
          order = std::move(other);
          shorter = true;
        }
      }
  }
  return order;
}

namespace {

/// The values of two strips that share a pose; none if one of them has none.
void append_known(std::vector<double>& known, const std::vector<double>& next) {
  if (known.empty() || next.empty()) {
    known.clear();
    return;
  }
  known.back() = std::max(known.back(), next.front());
  known.insert(known.end(), next.begin() + 1, next.end());
}

}  // namespace

KnownPath joined(const KnownPath& given) {
  constexpr double kSame = 1e-9;
  if (given.known.size() != given.path.strips.size()) throw InternalError("the known figures belong to other passes");
  KnownPath chains;
  for (std::size_t k = 0; k < given.path.strips.size(); ++k) {
    const Strip& strip = given.path.strips[k];
    const Pose& begin = strip.poses.front();
    if (!chains.path.strips.empty()) {
      std::vector<Pose>& poses = chains.path.strips.back().poses;
      if ((poses.back().tip - begin.tip).norm() <= kSame && (poses.back().axis - begin.axis).norm() <= kSame) {
        poses.insert(poses.end(), strip.poses.begin() + 1, strip.poses.end());
        append_known(chains.known.back(), given.known[k]);
        continue;
      }
    }
    chains.path.strips.push_back(strip);
    chains.known.push_back(given.known[k]);
  }
  return chains;
}

Path with_links(const Path& path, const LinkOptions& options) {
  const std::size_t count = path.strips.size();
  if (options.keep_out.empty() || !(options.clearance > 0.0) || options.lead_at_start.size() != count ||
      options.lead_at_end.size() != count)
    throw InternalError("links need a box, a clearance, and a lead-in and lead-out for each pass");
  const Linker linker(options);
  int id = 0;
  for (const Strip& strip : path.strips) id = std::max(id, strip.id);
  Path result;
  std::vector<Pose> way;
  Safe here;  // where the tool waits on the sphere after the strip before
  for (std::size_t k = 0; k < count; ++k) {
    const Strip& strip = path.strips[k];
    Safe there;
    std::vector<Pose> in = linker.way_out(strip.poses.front(), options.lead_at_start[k], there);
    if (k > 0) linker.round(here, there, way);
    // The way in is the way out backwards; on the sphere the two meet in the same pose.
    std::reverse(in.begin(), in.end());
    // The first link begins on the sphere; of the others that pose is the end of the way round.
    way.insert(way.end(), in.begin() + (k > 0 ? 1 : 0), in.end());
    result.strips.push_back({++id, kLinkKind, "", way});
    result.strips.push_back(strip);
    way = linker.way_out(strip.poses.back(), options.lead_at_end[k], here);
  }
  if (count > 0) result.strips.push_back({++id, kLinkKind, "", way});
  return result;
}

std::vector<Pose> way_to_sphere(const Pose& from, const Lead& lead, const LinkOptions& options) {
  Safe safe;
  return Linker(options).to_sphere(from, lead.out, safe);
}

Pose above(const LinkOptions& options, const Vec3& up) { return Linker(options).at({up, up}); }

Path upright(Path linked, const LinkOptions& options, const Vec3& up) {
  if (linked.strips.empty()) return linked;
  const Linker linker(options);
  const Safe top{up, up};
  std::vector<Pose>&first = linked.strips.front().poses, &last = linked.strips.back().poses;
  std::vector<Pose> begin{linker.at(top)};
  linker.round(top, linker.place(first.front()), begin);
  // The last of them is the pose with which the link has begun, but for rounding.
  if (begin.size() > 1) begin.pop_back();
  first.insert(first.begin(), begin.begin(), begin.end());
  linker.round(linker.place(last.back()), top, last);
  return linked;
}

}  // namespace flank::internal
