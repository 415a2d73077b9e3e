#include "flank/pipeline/program/followed_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace flank::internal {
namespace {

/// A program that has left its path is looked for on it so often, at most: each time all of what is ahead is asked.
constexpr int kMostSearches = 300;
/// Of a way along the path beside the chord of a block.
constexpr double kWayFactor = 1.2;
constexpr double kSameMm = 1e-9;

/// Both ends of the axis.
struct Ends {
  Vec3 tip, top;
  [[nodiscard]] double off(const Ends& other) const {
    return std::max((tip - other.tip).norm(), (top - other.top).norm());
  }
  [[nodiscard]] double way(const Ends& other) const { return (tip - other.tip).norm() + (top - other.top).norm(); }
};

/// The place of a segment that is nearest to some ends.
struct Nearest {
  double share = 0.0, off = 0.0;
};

Nearest nearest_on(const Ends& from, const Ends& to, const Ends& x) {
  const Vec3 tip = to.tip - from.tip, top = to.top - from.top;
  const double length = tip.squaredNorm() + top.squaredNorm();
  const double along = tip.dot(x.tip - from.tip) + top.dot(x.top - from.top);
  const double share = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  // The axis keeps its length where it turns: its upper end goes along an arc.
  const Vec3 axis = from.top - from.tip, there = axis + share * (top - tip);
  const Vec3 at = from.tip + share * tip;
  return {share, x.off({at, at + there * (axis.norm() / std::max(there.norm(), kSameMm))})};
}

/// Strips that go on into one another.
struct Chain {
  std::vector<Ends> ends;
  std::vector<double> ways;  ///< up to each of them
  std::vector<int> strip;    ///< that leads to each of them, by index
  int id = 0;                ///< of the first strip
  std::int32_t line = 0;     ///< of the program, where it was last on the strip, or came nearest to its beginning
  double nearest = 1e300;    ///< mm, from its beginning
  bool done = false;         ///< its end was reached
  bool told = false;         ///< it was left before, which is told once
  [[nodiscard]] double length() const { return ways.back(); }
};

std::vector<Chain> chains_of(const Path& path, double axis_length) {
  std::vector<Chain> chains;
  for (std::size_t s = 0; s < path.strips.size(); ++s) {
    bool first = true;
    for (const Pose& pose : path.strips[s].poses) {
      const Ends ends{pose.tip, pose.at(axis_length)};
      const bool goes_on = !first || (!chains.empty() && chains.back().ends.back().off(ends) <= kSameMm);
      if (!goes_on) chains.push_back({{ends}, {0.0}, {static_cast<int>(s)}, path.strips[s].id});
      first = false;
      if (!goes_on) continue;
      Chain& chain = chains.back();
      chain.ways.push_back(chain.ways.back() + chain.ends.back().way(ends));
      chain.ends.push_back(ends);
      chain.strip.push_back(static_cast<int>(s));
    }
  }
  return chains;
}

class Follower {
 public:
  Follower(const Path& path, const FollowOptions& options)
      : chains_(chains_of(path, options.axis_length)), options_(options) {}

  FollowedPath run(const Backplot& plot) {
    for (std::size_t s = 0; s < plot.path.strips.size(); ++s) {
      const std::vector<Pose>& poses = plot.path.strips[s].poses;
      out_.strips.emplace_back(poses.size(), -1);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const PoseMove& move = plot.moves[s][k];
        const Ends here{poses[k].tip, poses[k].at(options_.axis_length)};
        // The first pose is the last one of the strip before.
        if (k > 0 || move.from_afar || s == 0) go_to(here, move, s, k);
        before_ = here;
      }
    }
    for (const Chain& chain : chains_)
      if (!chain.done && !chain.told)
        add(chain.line, fmt::format("pass {} of the path is not run from its beginning to its end", chain.id));
    return std::move(out_);
  }

 private:
  /// Where the program is.
  struct Place {
    Chain* chain = nullptr;
    std::size_t to = 0;  ///< the place lies on the way to this pose, or is it
    double way = 0.0;
  };

  void add(std::int32_t line, std::string text) { out_.findings.push_back({line, std::move(text)}); }

  void go_to(const Ends& here, const PoseMove& move, std::size_t s, std::size_t k) {
    const bool cuts = !move.rapid && !move.from_afar;
    if (at_) {
      const auto next = cuts ? next_place(here) : std::nullopt;
      if (next) return arrive(*next, move, s, k);
      leave(move);
      if (at_ && cuts && searches_++ < kMostSearches)
        if (const auto again = ahead(here, 1e300, 0.0)) return arrive(*again, move, s, k);
    }
    // A rapid, or a way from afar, may end where a strip begins, though it should not: that is another question.
    enter(here, move, s, k);
  }

  /// Where the program is on the path after a block: on the strip that it is on, or, where it has just begun one, on another one that
  /// begins at the same place.
  [[nodiscard]] std::optional<Place> next_place(const Ends& here) {
    const double way = before_.way(here);
    const auto along = [&]() -> std::optional<Place> {
      const auto next = ahead(here, kWayFactor * way + 4.0 * options_.room, way);
      return next && keeps_between(*next, here) ? next : std::nullopt;
    };
    if (const auto next = along()) return next;
    if (at_->to > 0) return {};
    const Place begun = *at_;
    for (Chain& chain : chains_) {
      if (chain.done || chain.told || chain.ends.front().off(before_) > options_.room) continue;
      at_ = Place{&chain, 0, 0.0};
      if (const auto next = along()) return next;
    }
    at_ = begun;
    return {};
  }

  /// The place ahead that is near enough, and whose way is nearest to `way`.
  [[nodiscard]] std::optional<Place> ahead(const Ends& here, double reach, double way) const {
    const Chain& chain = *at_->chain;
    std::optional<Place> best;
    for (std::size_t i = std::max<std::size_t>(at_->to, 1); i < chain.ends.size(); ++i) {
      if (chain.ways[i - 1] - at_->way > reach) break;
      const Nearest found = nearest_on(chain.ends[i - 1], chain.ends[i], here);
      if (found.off > options_.room) continue;
      const double to = std::lerp(chain.ways[i - 1], chain.ways[i], found.share);
      if (to < at_->way - options_.room) continue;
      const Place place{at_->chain, i, std::max(to, at_->way)};
      if (!best || std::abs(place.way - at_->way - way) < std::abs(best->way - at_->way - way)) best = place;
    }
    return best;
  }

  /// Whether the path between two places is as near to the block as it must be.
  [[nodiscard]] bool keeps_between(const Place& next, const Ends& here) const {
    for (std::size_t i = at_->to; i < next.to; ++i)
      if (nearest_on(before_, here, next.chain->ends[i]).off > options_.room) return false;
    return true;
  }

  void arrive(const Place& place, const PoseMove& move, std::size_t s, std::size_t k) {
    at_ = place;
    place.chain->line = move.line;
    out_.strips[s][k] = place.chain->strip[place.to];
    if (place.chain->length() - place.way <= 4.0 * options_.room) place.chain->done = true;
  }

  /// The program is beside the strip, or beyond its end.
  void leave(const PoseMove& move) {
    Chain& chain = *at_->chain;
    if (chain.done) {
      at_.reset();
      return;
    }
    if (!chain.told)
      add(move.line,
          fmt::format("{} pass {} of the path after {:.1f} of {:.1f} mm", move.rapid ? "a rapid move leaves" : "leaves",
                      chain.id, 0.5 * at_->way, 0.5 * chain.length()));
    chain.told = true;
  }

  void enter(const Ends& here, const PoseMove& move, std::size_t s, std::size_t k) {
    for (Chain& chain : chains_) {
      if (chain.done || chain.told) continue;
      const double off = chain.ends.front().off(here);
      if (off < chain.nearest) chain.nearest = off, chain.line = move.line;
      if (off > options_.room) continue;
      at_ = Place{&chain, 0, 0.0};
      searches_ = 0;
      out_.strips[s][k] = chain.strip.front();
      if (chain.length() <= 4.0 * options_.room) chain.done = true;
      return;
    }
  }

  std::vector<Chain> chains_;
  const FollowOptions& options_;
  FollowedPath out_;
  std::optional<Place> at_;
  Ends before_;
  int searches_ = 0;
};

}  // namespace

FollowedPath follow_path(const Path& path, const Backplot& plot, const FollowOptions& options) {
  return Follower(path, options).run(plot);
}

}  // namespace flank::internal
