#include "flank/wheel/rough/layer.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/wheel/rough/lean.h"

namespace flank::internal {

Pose pose_between(const Pose& a, const Pose& b, double t) {
  return {a.tip + t * (b.tip - a.tip), (a.axis + t * (b.axis - a.axis)).normalized()};
}

namespace {

using Row = ChannelLayer::Row;

constexpr int kColumns = 17;         ///< of places that are asked across a channel
constexpr int kHalvings = 5;         ///< of the search for the outermost ones
constexpr double kLineMm = 0.5;      ///< between lines square across
constexpr double kOffShare = 0.8;    ///< of the width, from the middle to a place of a line
constexpr double kGapShare = 0.2;    ///< of it, between places of a line
constexpr double kEndShare = 0.3;    ///< of the width, that an end may move by from line to line
constexpr int kAround = 3;           ///< rows, by which the way of the channel is known
constexpr std::size_t kBridged = 2;  ///< rows without room, over which a stretch goes on

Pose on_row(const Row& row, double share) {
  const double x = std::clamp(share, 0.0, 1.0) * static_cast<double>(row.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(x), row.size() - 2);
  return pose_between(row[k], row[k + 1], x - static_cast<double>(k));
}

/// The share farthest from one that has room towards one that has none, by halving.
double outermost(const ChannelPoses& poses, std::size_t row, double good, double bad) {
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (good + bad);
    (poses.at(row, middle) ? good : bad) = middle;
  }
  return good;
}

/// The first and the last share of a row that all have room between them: the longest run of places, and on to where there is none.
std::optional<std::pair<double, double>> room_of(const ChannelPoses& poses, std::size_t row) {
  constexpr double kStep = 1.0 / (kColumns - 1);
  int length = 0, first = 0, run = 0;
  for (int c = 0; c < kColumns; ++c) {
    run = poses.at(row, c * kStep) ? run + 1 : 0;
    if (run > length) length = run, first = c + 1 - run;
  }
  if (length < 2) return {};
  const int last = first + length - 1;
  return std::pair(first == 0 ? 0.0 : outermost(poses, row, first * kStep, (first - 1) * kStep),
                   last == kColumns - 1 ? 1.0 : outermost(poses, row, last * kStep, (last + 1) * kStep));
}

/// Evenly over the longest run of places that have room; empty: there is none.
Row row_of(const ChannelPoses& poses, std::size_t row) {
  const auto room = room_of(poses, row);
  if (!room) return {};
  auto [low, high] = *room;
  const double least = (high - low) / kColumns;
  while (high - low > least) {
    Row out;
    std::optional<double> none;
    for (int c = 0; c < kColumns && !none; ++c) {
      const double share = std::lerp(low, high, c / (kColumns - 1.0));
      const std::optional<Pose> pose = poses.at(row, share);
      if (pose)
        out.push_back(*pose);
      else
        none = share;
    }
    if (!none) return out;
    // A place between those that were asked first: the longer side of it.
    (*none - low > high - *none ? high : low) = *none + (*none - low > high - *none ? -least : least);
  }
  return {};
}

/// A net of rows, whose columns go on straight beyond its ends by so much.
struct Net {
  const std::vector<Row>& rows;
  double before, behind;
  double wide = 0.0;  ///< across, of a row, at most
  Net(const std::vector<Row>& all, double more_before, double more_behind)
      : rows(all), before(more_before), behind(more_behind) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto middle = [&](std::size_t row) { return on_row(rows[row], 0.5).tip; };
      const Vec3 way = (middle(std::min(k + kAround, rows.size() - 1)) - middle(k - std::min<std::size_t>(k, kAround)))
                           .normalized(),
                 across = rows[k].back().tip - rows[k].front().tip;
      wide = std::max(wide, across.cross(way).norm());
    }
  }
  /// Where a column crosses a plane nearest to the plane's point; none: it has ended there.
  [[nodiscard]] std::optional<Pose> crossing(std::size_t column, const Vec3& point, const Vec3& normal) const {
    const auto height = [&](std::size_t k) { return (rows[k][column].tip - point).dot(normal); };
    // What a plane crosses farther off is another part of a channel that winds.
    double least = kOffShare * kOffShare * wide * wide;
    std::optional<Pose> out;
    const auto take = [&](const Pose& pose) {
      const double off = (pose.tip - point).squaredNorm();
      if (off < least) least = off, out = pose;
    };
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      const double a = height(k), b = height(k + 1);
      if (a <= 0.0 && b > 0.0) take(pose_between(rows[k][column], rows[k + 1][column], a / (a - b)));
    }
    const auto beyond = [&](std::size_t at, std::size_t inner, double most) {
      const Vec3 way = (rows[at][column].tip - rows[inner][column].tip).normalized();
      const double slope = way.dot(normal), more = -height(at) / slope;
      if (more >= 0.0 && more <= most) take({rows[at][column].tip + more * way, rows[at][column].axis});
    };
    beyond(0, kAround, before), beyond(rows.size() - 1, rows.size() - 1 - kAround, behind);
    return out;
  }
  /// Of the columns that cross a plane, evenly, the run that comes nearest to the plane's point; empty: fewer than two do.
  [[nodiscard]] Row line(const Vec3& point, const Vec3& normal) const {
    Row run, nearest;
    double off = 1e300, least = 1e300;
    const auto take = [&] {
      if (run.size() > 1 && off < least) least = off, nearest = run;
      run.clear(), off = 1e300;
    };
    for (std::size_t c = 0; c < rows.front().size(); ++c) {
      const std::optional<Pose> pose = crossing(c, point, normal);
      if (!pose || (!run.empty() && (pose->tip - run.back().tip).norm() > kGapShare * wide)) take();
      if (!pose) continue;
      run.push_back(*pose), off = std::min(off, (pose->tip - point).squaredNorm());
    }
    take();
    return nearest;
  }
};

/// Whether one end of a line is another place than that of the line before.
bool jumps(const Row& before, const Row& line, double most) {
  return (line.front().tip - before.front().tip).norm() > most || (line.back().tip - before.back().tip).norm() > most;
}

/// The middle of a stretch, even, and on beyond its ends as far as any column has not ended, and a way more where that is asked.
struct MiddleLine {
  std::vector<Vec3> points, ways;
  MiddleLine(const std::vector<Row>& rows, double before, double behind) {
    const auto middle = [](const Row& row) { return on_row(row, 0.5).tip; };
    const auto leading = [&](const Row& row, const Vec3& way) {
      double most = 0.0;
      for (const Pose& pose : row) most = std::max(most, (pose.tip - middle(row)).dot(way));
      return most;
    };
    std::vector<Vec3> line;
    for (const Row& row : rows) line.push_back(middle(row));
    const Vec3 first = (line[0] - line[kAround]).normalized(),
               last = (line.back() - line[line.size() - 1 - kAround]).normalized();
    line.insert(line.begin(), line.front() + (before + leading(rows.front(), first)) * first);
    line.push_back(line.back() + (behind + leading(rows.back(), last)) * last);
    double rest = 0.0;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec3 side = line[k + 1] - line[k];
      for (; rest < side.norm(); rest += kLineMm) points.emplace_back(line[k] + rest * side.normalized());
      rest -= side.norm();
    }
    const int count = static_cast<int>(points.size());
    for (int k = 0; k < count; ++k) {
      const auto at = [&](int n) { return points[static_cast<std::size_t>(std::clamp(n, 0, count - 1))]; };
      ways.emplace_back((at(k + kAround) - at(k - kAround)).normalized());
    }
  }
};

}  // namespace

std::vector<ChannelLayer> ChannelLayer::stretches(const std::vector<Row>& rows, bool open_before, bool open_behind,
                                                  double over_mm) {
  const Net net{rows, open_before ? over_mm : 0.0, open_behind ? over_mm : 0.0};
  const MiddleLine middle(rows, net.before, net.behind);
  std::vector<Row> found(middle.points.size());
  parallel_for(found.size(), [&](std::size_t k) { found[k] = net.line(middle.points[k], middle.ways[k]); });
  std::vector<ChannelLayer> out;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k].empty()) continue;
    if (k == 0 || found[k - 1].empty() || jumps(found[k - 1], found[k], kEndShare * net.wide)) out.emplace_back();
    std::vector<Line>& lines = out.back().lines_;
    lines.push_back(
        {kLineMm * static_cast<double>(lines.size()), (found[k].back().tip - found[k].front().tip).norm(), found[k]});
  }
  if (out.empty()) return out;
  out.front().open_before_ = open_before, out.back().open_behind_ = open_behind;
  out.erase(std::remove_if(out.begin(), out.end(), [](const ChannelLayer& one) { return one.lines_.size() < 2; }),
            out.end());
  return out;
}

std::pair<std::size_t, double> ChannelLayer::place(double along) const {
  const double x = std::clamp(along / kLineMm, 0.0, static_cast<double>(lines_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(x), lines_.size() - 2);
  return {k, x - static_cast<double>(k)};
}

double ChannelLayer::width(double along) const {
  const auto [k, t] = place(along);
  return std::lerp(lines_[k].width, lines_[k + 1].width, t);
}

Pose ChannelLayer::at(double along, double share) const {
  const auto [k, t] = place(along);
  return pose_between(on_row(lines_[k].poses, share), on_row(lines_[k + 1].poses, share), t);
}

bool ChannelLayer::climbs_from_first() const {
  const double middle = 0.5 * length();
  const Vec3 across = at(middle, 1.0).tip - at(middle, 0.0).tip,
             on = at(middle + kLineMm, 0.5).tip - at(middle - kLineMm, 0.5).tip;
  // The material is to the right of a tool that climbs.
  return across.cross(on).dot(at(middle, 0.5).axis) < 0.0;
}

std::vector<Row> ChannelLayer::lines() const {
  std::vector<Row> out;
  for (const Line& line : lines_) out.push_back(line.poses);
  return out;
}

std::vector<ChannelLayer> layers_of(const ChannelPoses& poses, double over_mm) {
  std::vector<Row> rows(poses.rows().size());
  parallel_for(rows.size(), [&](std::size_t k) { rows[k] = row_of(poses, k); });
  lean_to_sides(rows, poses.room());
  std::vector<ChannelLayer> out;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<Row> run;
    std::size_t end = k;
    for (std::size_t n = k; n < rows.size() && n <= end + kBridged; ++n)
      if (!rows[n].empty()) run.push_back(rows[n]), end = n + 1;
    if (run.size() > 2 * kAround)
      for (ChannelLayer& one : ChannelLayer::stretches(run, k == 0, end == rows.size(), over_mm))
        out.push_back(std::move(one));
    k = std::max(k, end);
  }
  return out;
}

}  // namespace flank::internal
