#include "flank/wheel/point/floor_passes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

constexpr double kMostStretch = 3.0;  ///< more poses than their places ask for, at most so many times
constexpr double kStepMm = 0.6;       ///< between poses of a pass, at most
constexpr int kHeights = 12;          ///< places of the axis that are held against the sides
constexpr int kDrops = 12, kHalvings = 12;
constexpr int kMostPasses = 400, kMostSteps = 4000;
constexpr double kHeightShare = 0.1;  ///< of the tolerance: so far above the floor the sphere stays

/// A path by the length of the way of its places.
struct Rail {
  std::vector<Pose> poses;
  std::vector<Vec3> places;
  std::vector<double> at;

  Rail(std::vector<Pose> all, const std::function<Vec3(const Vec3&)>& place) : poses(std::move(all)) {
    for (std::size_t k = 0; k < poses.size(); ++k) {
      places.push_back(place ? place(poses[k].tip) : poses[k].tip);
      at.push_back(k == 0 ? 0.0 : at.back() + (places[k] - places[k - 1]).norm());
    }
  }
  [[nodiscard]] Vec3 place(double way) const {
    const auto next = std::upper_bound(at.begin(), at.end(), way);
    if (next == at.begin()) return places.front();
    if (next == at.end()) return places.back();
    const auto k = static_cast<std::size_t>(next - at.begin());
    return places[k - 1] + (way - at[k - 1]) / std::max(at[k] - at[k - 1], 1e-12) * (places[k] - places[k - 1]);
  }
  [[nodiscard]] Pose pose(double way) const {
    const auto next = std::upper_bound(at.begin(), at.end(), way);
    if (next == at.begin()) return poses.front();
    if (next == at.end()) return poses.back();
    const auto k = static_cast<std::size_t>(next - at.begin());
    const double x = (way - at[k - 1]) / std::max(at[k] - at[k - 1], 1e-12);
    return {poses[k - 1].tip + x * (poses[k].tip - poses[k - 1].tip),
            (poses[k - 1].axis + x * (poses[k].axis - poses[k - 1].axis)).normalized()};
  }
  /// The way at which its place is nearest to p.
  [[nodiscard]] double nearest(const Vec3& p) const {
    double best = std::numeric_limits<double>::infinity(), way = 0.0;
    for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
      const Vec3 along = places[k + 1] - places[k];
      const double length2 = along.squaredNorm();
      const double x = length2 > 0.0 ? std::clamp((p - places[k]).dot(along) / length2, 0.0, 1.0) : 0.0;
      const double off = (places[k] + x * along - p).squaredNorm();
      if (off < best) best = off, way = at[k] + x * (at[k + 1] - at[k]);
    }
    return way;
  }
};

/// The most that tips go a step of their places' way: around an axis the way is longer than that of the places.
double stretch_of(const Rail& rail) {
  double most = 1.0;
  for (std::size_t k = 0; k + 1 < rail.poses.size(); ++k) {
    const double step = rail.at[k + 1] - rail.at[k];
    if (step > 0.0) most = std::max(most, (rail.poses[k + 1].tip - rail.poses[k].tip).norm() / step);
  }
  return std::min(most, kMostStretch);
}

/// Two poses across from each other.
struct Across {
  Pose first, second;
};

/// Across the first rail, where the second one has its nearest place: pairs whose places on both rise together.
std::vector<Across> pair_rails(const FloorChannel& channel) {
  if (channel.first.size() < 2 || channel.second.size() < 2) return {};
  const Rail first(channel.first, channel.place);
  Rail second(channel.second, channel.place);
  if (first.nearest(second.places.front()) > first.nearest(second.places.back()))
    second = Rail({channel.second.rbegin(), channel.second.rend()}, channel.place);
  // Ends that run out are paired with each other, so that the pass is as long as the shorter side.
  const double from = first.nearest(second.places.front()), to = first.nearest(second.places.back());
  const double back_from = second.nearest(first.place(from)), back_to = second.nearest(first.place(to));
  if (!(to - from > kStepMm) || !(back_to - back_from > kStepMm)) return {};
  const double stretch = std::max(stretch_of(first), stretch_of(second));
  const int steps =
      std::min(kMostSteps,
               std::max(2, static_cast<int>(std::ceil(stretch * std::max(to - from, back_to - back_from) / kStepMm))));
  std::vector<Across> out;
  double last = back_from;
  for (int k = 0; k <= steps; ++k) {
    const double way = from + (to - from) * k / steps;
    last = std::clamp(second.nearest(first.place(way)), last, back_to);
    out.push_back({first.pose(way), second.pose(last)});
  }
  return out;
}

Footpoint closest_of(const std::vector<const Target*>& targets, const Vec3& p) {
  Footpoint best;
  double least = std::numeric_limits<double>::infinity();
  for (const Target* target : targets) {
    if (target->box().squared_distance(p) >= least * least) continue;
    const Footpoint foot = target->closest(p);
    if (std::abs(foot.distance) < least) least = std::abs(foot.distance), best = foot;
  }
  return best;
}

/// Beside the border of a face a footpoint has no side: the distance alone counts there.
double height_of(const Footpoint& foot) {
  if (foot.patch < 0) return std::numeric_limits<double>::infinity();
  return foot.location == Location::kInside ? foot.distance : std::abs(foot.distance);
}

class Passes {
 public:
  Passes(const FloorChannel& channel, const RadialFunction& radial, const FloorOptions& options)
      : channel_(channel), radial_(radial), options_(options), tip_mm_(radial.at(0.0).r) {}

  /// u from 0, the first side, to 1: on the floor, with the axis between.
  [[nodiscard]] std::optional<Pose> pose(const Across& at, double u) const {
    Pose out{at.first.tip + u * (at.second.tip - at.first.tip), between(at.first.axis, at.second.axis, u)};
    const double wanted = tip_mm_ + kHeightShare * options_.tolerance_mm;
    for (int k = 0; k < kDrops; ++k) {
      const Footpoint foot = closest_of(channel_.floor, out.tip);
      const double slope = foot.normal.dot(out.axis);
      if (foot.patch < 0 || slope < 0.1) return {};
      const double more = (wanted - foot.distance) / slope;
      out.tip += std::clamp(more, -2.0 * tip_mm_, 2.0 * tip_mm_) * out.axis;
      if (std::abs(more) < 1e-4 * options_.tolerance_mm)
        return foot.location == Location::kInside ? std::optional(out) : std::nullopt;
    }
    return {};
  }

  /// How far the flank is from the sides, and above its tip from the floor, mm; < 0 inside one. An axis that lies low over a floor cuts
  /// it with its flank.
  [[nodiscard]] double room(const Pose& pose) const {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kHeights; ++k) {
      const double s = radial_.axis_length() * k / (kHeights - 1.0), r = radial_.at(s).r;
      const Footpoint foot = closest_of(channel_.sides, pose.at(s));
      least = std::min(least, height_of(foot) - r);
      if (k > 0) least = std::min(least, height_of(closest_of(channel_.floor, pose.at(s))) - r);
    }
    return least;
  }

  /// Places across from `low` to `high` whose tips are evenly apart: what the floor and the axes make of even steps is not even.
  [[nodiscard]] std::vector<double> even(const Across& at, double low, double high, int count) const {
    constexpr int kFine = 24;
    std::vector<double> ways{0.0};
    std::optional<Pose> last = pose(at, low);
    for (int k = 1; k <= kFine; ++k) {
      const std::optional<Pose> here = pose(at, low + (high - low) * k / kFine);
      ways.push_back(ways.back() + (last && here ? (here->tip - last->tip).norm() : 0.0));
      if (here) last = here;
    }
    std::vector<double> out;
    std::size_t k = 1;
    for (int j = 0; j < count; ++j) {
      const double way = count > 1 ? ways.back() * j / (count - 1.0) : 0.5 * ways.back();
      while (k < kFine && ways[k] < way) ++k;
      const double x = (way - ways[k - 1]) / std::max(ways[k] - ways[k - 1], 1e-12);
      out.push_back(low + (high - low) * (static_cast<double>(k) - 1.0 + std::clamp(x, 0.0, 1.0)) / kFine);
    }
    return out;
  }
  /// The way across between two places, along the floor, mm.
  [[nodiscard]] double across(const Across& at, double low, double high) const {
    constexpr int kCoarse = 6;
    double way = 0.0;
    std::optional<Pose> last = pose(at, low);
    for (int k = 1; k <= kCoarse; ++k) {
      const std::optional<Pose> here = pose(at, low + (high - low) * k / kCoarse);
      if (last && here) way += (here->tip - last->tip).norm();
      if (here) last = here;
    }
    return way;
  }

  /// The outermost free place between `from`, the side's, and `to`, nearer to the middle; none if that is not free either.
  [[nodiscard]] std::optional<double> free_from(const Across& at, double from, double to) const {
    const auto is_free = [&](double u) {
      const std::optional<Pose> here = pose(at, u);
      return here && room(*here) >= options_.clearance_mm;
    };
    if (is_free(from)) return from;
    if (!is_free(to)) return {};
    double bad = from, good = to;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (bad + good);
      (is_free(middle) ? good : bad) = middle;
    }
    return good;
  }

  /// Between passes on a floor that bends like this across, mm.
  [[nodiscard]] double spacing(double bend) const {
    const double scallop = options_.scallop_share * options_.tolerance_mm,
                 open = std::max(1.0 / tip_mm_ - bend, 0.1 / tip_mm_);
    return std::sqrt(8.0 * scallop / open);
  }
  [[nodiscard]] const FloorChannel& channel() const { return channel_; }

 private:
  [[nodiscard]] static Vec3 between(const Vec3& a, const Vec3& b, double u) {
    const double angle = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
    if (angle < 1e-6) return (a + u * (b - a)).normalized();
    return (std::sin((1.0 - u) * angle) * a + std::sin(u * angle) * b).normalized();
  }
  const FloorChannel& channel_;
  const RadialFunction& radial_;
  const FloorOptions& options_;
  double tip_mm_;
};

struct Range {
  double low = 0.0, high = 1.0;
  bool open = false;
};

/// Where across the channel the tool has room, of each pair.
std::vector<Range> ranges_of(const Passes& passes, const std::vector<Across>& pairs) {
  std::vector<Range> out(pairs.size());
  parallel_for(pairs.size(), [&](std::size_t k) {
    const std::optional<double> low = passes.free_from(pairs[k], 0.0, 0.5), high = passes.free_from(pairs[k], 1.0, 0.5);
    if (low && high && *low <= *high) out[k] = {*low, *high, true};
  });
  return out;
}

int count_of(const Passes& passes, const std::vector<Across>& pairs, const std::vector<Range>& ranges) {
  double most = 1.0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!ranges[k].open) continue;
    const Range& range = ranges[k];
    const std::optional<Pose> middle = passes.pose(pairs[k], 0.5 * (range.low + range.high));
    if (!middle) continue;
    // The floor bends away from the tool across the passes, or towards it: the less favourable of its two bends counts.
    const Footpoint foot = closest_of(passes.channel().floor, middle->tip);
    most = std::max(most, passes.across(pairs[k], range.low, range.high) / passes.spacing(foot.k1) + 1.0);
  }
  return std::min(kMostPasses, static_cast<int>(std::ceil(most)));
}

using PoseRow = std::vector<std::optional<Pose>>;

/// Stretches of poses that are there, each other row the other way round.
std::vector<Strip> strips_from(std::vector<PoseRow> rows, const std::string& face) {
  std::vector<Strip> out;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    if (j % 2 == 1) std::reverse(rows[j].begin(), rows[j].end());
    Strip strip{.id = 1, .kind = "floor", .face = face, .poses = {}};
    const auto close = [&] {
      if (strip.poses.size() > 1) out.push_back(strip);
      strip.poses.clear();
    };
    for (const std::optional<Pose>& pose : rows[j])
      if (pose)
        strip.poses.push_back(*pose);
      else
        close();
    close();
  }
  return out;
}

}  // namespace

std::vector<Strip> floor_passes(const FloorChannel& channel, const RadialFunction& radial, const FloorOptions& options,
                                const std::string& face) {
  const std::vector<Across> pairs = pair_rails(channel);
  if (pairs.empty()) return {};
  const Passes passes(channel, radial, options);
  const std::vector<Range> ranges = ranges_of(passes, pairs);
  const int count = count_of(passes, pairs, ranges);
  std::vector<PoseRow> found(static_cast<std::size_t>(count), PoseRow(pairs.size()));
  parallel_for(pairs.size(), [&](std::size_t k) {
    if (!ranges[k].open) return;
    const std::vector<double> places = passes.even(pairs[k], ranges[k].low, ranges[k].high, count);
    for (std::size_t j = 0; j < found.size(); ++j) {
      const std::optional<Pose> here = passes.pose(pairs[k], places[j]);
      if (here && passes.room(*here) >= options.clearance_mm - 0.1 * options.tolerance_mm) found[j][k] = here;
    }
  });
  return strips_from(std::move(found), face);
}

}  // namespace flank::internal
