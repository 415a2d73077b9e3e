#include "flank/tour/tour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "flank/geom/trim.h"
#include "flank/tool/grown.h"
#include "flank/tour/legs.h"
#include "flank/tour/levels.h"
#include "flank/tour/walls_in_row.h"

namespace flank::internal {
namespace {

constexpr double kDeg = 180.0 / std::numbers::pi;

/// What a tour passes without a lift, at any height.
struct Run {
  std::vector<TourStretch> stretches;
  bool closed = false;
};

/// Faces without loops have none to share.
std::vector<Face> with_loops(std::vector<Face> faces) {
  for (Face& face : faces)
    if (face.loops.empty()) {
      const BSplineSurface& s = face.surface;
      face.loops = {rectangle_loop({s.u_first(), s.u_last(), s.v_first(), s.v_last()})};
    }
  return faces;
}

/// The middle line of every wall.
std::vector<WallLine> middle_lines(const WallsInRow& row) {
  std::vector<WallLine> lines;
  for (const Wall& wall : row.walls) lines.push_back(wall.between(wall.first({}), wall.last({}), 0.5));
  return lines;
}

double longest_line(const WallsInRow& row) {
  double longest = 0.0;
  for (const Wall& wall : row.walls) longest = std::max({longest, wall.first({}).length(), wall.last({}).length()});
  return longest;
}

/// How many of the walls leave the upper end of the tool free.
int free_heads(const WallsInRow& row, const StraightFlank& flank, const TourRequest& request) {
  int free = 0;
  for (const WallLine& line : middle_lines(row)) {
    const Pose pose = laid_against(line, flank, 0.0);
    const Vec3 above = pose.at(flank.axis_over(line.length()));
    free += !request.is_free_line || request.is_free_line(above, pose.axis) ? 1 : 0;
  }
  return free;
}

/// The row with its feet where the tip belongs, passed in the direction in which the tool climbs: its spindle turns to the right.
std::optional<WallsInRow> oriented_row(const std::vector<Face>& faces, const Chain& chain, const StraightFlank& flank,
                                       const TourRequest& request) {
  std::optional<WallsInRow> row = walls_in_row(faces, chain), other = walls_in_row(faces, chain.upside_down());
  if (!row || !other) return {};
  const int here = free_heads(*row, flank, request), there = free_heads(*other, flank, request);
  double rise = 0.0;
  for (const LateralEdge& edge : chain.edges) rise += edge.direction().z();
  // Where both ends are free, the holder is above.
  if (there > here || (there == here && rise < 0.0)) row = std::move(other);
  const WallLine first = row->walls[0].first({}), last = row->walls[0].last({});
  const Vec3 way = last.foot + last.head - first.foot - first.head;
  const WallLine middle = row->walls[0].between(first, last, 0.5);
  const Vec3 climbs = middle.foot_normal.cross(middle.direction());
  if (way.dot(climbs) >= 0.0) return row;
  return walls_in_row(faces, row->chain.reversed());
}

/// The largest s over the feet, mm, at which the tip enters nothing below; beyond the feet where nothing is there. None where
/// something is in the way however high the tool is held.
std::optional<double> lowest_foot(const WallsInRow& row, const StraightFlank& flank, const TourScene& scene) {
  constexpr double kBeyond = 0.02, kHighest = 0.9, kTipOff = 0.05;  // of the line; of the tolerance
  constexpr int kSteps = 24, kHalvings = 24;
  std::optional<double> lowest;
  for (std::size_t i = 0; i < row.walls.size(); ++i) {
    if (row.too_tight[i] != 0) continue;
    const Wall& wall = row.walls[i];
    // Lines that lean at the ends hold the tip lower; what stands beside the wall there is for the ends to keep clear of. A radius from
    // an inner corner, where they will be.
    const WallEnd back{flank.radius, flank.radius};
    const WallLine first = wall.first({}), last = wall.last({});
    const std::array<WallLine, 5> lines{wall.first(back), wall.between(first, last, 0.3),
                                        wall.between(first, last, 0.5), wall.between(first, last, 0.7),
                                        wall.last(back)};
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const WallLine& line = lines[k];
      const bool at_corner = k == 0 || k + 1 == lines.size();
      const double most = kBeyond * line.length(), least = -kHighest * line.length();
      const auto clear = [&](double foot_s) {
        const double length = at_corner ? 0.0 : std::max(0.0, foot_s + flank.axis_over(line.length()));
        return is_clear_of_others(laid_against(line, flank, foot_s), flank, length, kTipOff * scene.tolerance_mm,
                                  scene);
      };
      int step = 0;
      while (step <= kSteps && !clear(most + (least - most) * step / kSteps)) ++step;
      if (step > kSteps) continue;
      double free = most + (least - most) * step / kSteps, enters = most + (least - most) * (step - 1) / kSteps;
      for (int halving = 0; step > 0 && halving < kHalvings; ++halving) {
        const double middle = 0.5 * (free + enters);
        (clear(middle) ? free : enters) = middle;
      }
      lowest = std::min(lowest.value_or(free), free);
    }
  }
  return lowest;
}

/// About the edge between two walls, from the normals of the one to those of the other.
TourStretch roll(const WallLine& from, const WallLine& to, const StraightFlank& flank) {
  const auto turned = [](const Vec3& a, const Vec3& b, double share) {
    const Vec3 axis = a.cross(b);
    const double angle = std::atan2(axis.norm(), a.dot(b));
    return Vec3(Eigen::AngleAxisd(share * angle, axis.normalized()) * a);
  };
  return [=](double share, double foot_s) {
    WallLine line = from;
    line.foot_normal = turned(from.foot_normal, to.foot_normal, share);
    line.head_normal = turned(from.head_normal, to.head_normal, share);
    return laid_against(line, flank, foot_s);
  };
}

/// Wall i from end to end. False: it has no room.
bool add_wall(const WallsInRow& row, std::size_t i, const StraightFlank& flank, double foot_s, const TourScene& scene,
              Run& run) {
  const std::optional<WallEnd> begin = end_of_wall(row, i, false, flank, foot_s, scene);
  const std::optional<WallEnd> end = end_of_wall(row, i, true, flank, foot_s, scene);
  if (!begin || !end) return false;
  const Wall* wall = &row.walls[i];
  const std::vector<WallLine> keys = wall->keys(*begin, *end);
  const Vec3 way = keys.back().foot + keys.back().head - keys.front().foot - keys.front().head;
  const WallLine first = wall->first({}), last = wall->last({});
  if (way.dot(last.foot + last.head - first.foot - first.head) <= 0.0 && wall->flat()) return false;
  for (std::size_t k = 0; k + 1 < keys.size(); ++k)
    run.stretches.push_back([wall, a = keys[k], b = keys[k + 1], flank](double share, double s) {
      return laid_against(wall->between(a, b, share), flank, s);
    });
  return true;
}

/// The runs at one height; a run ends at every corner that is left.
std::vector<Run> runs_at(const WallsInRow& row, const StraightFlank& flank, double foot_s, const TourScene& scene,
                         std::vector<std::size_t>& without_room) {
  const std::size_t count = row.walls.size();
  std::size_t start = 0;
  while (start < count && row.before(start) != Corner::kNone && row.before(start) != Corner::kLeft) ++start;
  const bool closed = start == count;
  if (closed) start = 0;
  std::vector<Run> runs(1);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (start + k) % count;
    if (row.before(i) == Corner::kLeft && !runs.back().stretches.empty()) runs.emplace_back();
    if (row.too_tight[i] != 0) continue;
    if (!add_wall(row, i, flank, foot_s, scene, runs.back())) {
      without_room.push_back(i);
      continue;
    }
    if (row.corners[i] == Corner::kRoll)
      runs.back().stretches.push_back(roll(row.walls[i].last({}), row.walls[row.next(i)].first({}), flank));
  }
  if (runs.back().stretches.empty()) runs.pop_back();
  if (closed && runs.size() == 1 && without_room.empty()) runs[0].closed = true;
  return runs;
}

/// What a shop must know of the corners.
void note_corners(const WallsInRow& row, const std::vector<Face>& faces, const StraightFlank& flank, double foot_s,
                  const TourScene& scene, const std::vector<std::size_t>& without_room,
                  std::vector<std::string>& notes) {
  const auto name = [&](std::size_t i) { return faces[row.chain.order[i]].id; };
  for (std::size_t i = 0; i < row.walls.size(); ++i) {
    if (row.too_tight[i] != 0)
      notes.push_back(
          fmt::format("{} is not machined: its radius is smaller than the tool's; its neighbours are machined up to "
                      "where the tool would gouge it",
                      name(i)));
    const bool round = row.too_tight[i] != 0 || row.too_tight[row.next(i)] != 0;
    if (row.corners[i] != Corner::kLeft || round) continue;
    const double radius = std::max(flank.at(std::max(0.0, foot_s)), flank.radius) - scene.allowance_mm;
    notes.push_back(fmt::format(
        "the inner corner of {:.0f} degrees between {} and {} is left: no tool of radius {:.4g} mm reaches it, and "
        "{:.3g} mm of material stay in it; each wall ends where the tool touches the other",
        180.0 - row.turns[i] * kDeg, name(i), name(row.next(i)), radius,
        radius * (1.0 / std::cos(0.5 * row.turns[i]) - 1.0)));
  }
  for (const std::size_t i : without_room)
    notes.push_back(fmt::format("{} is not machined: the tool has no room there", name(i)));
}

/// One motion a run and level; of a closed run one for all levels.
std::vector<RuledMotion> motions_of(const std::vector<Run>& runs, const std::vector<double>& levels, double length,
                                    double off_mm) {
  std::vector<RuledMotion> motions;
  for (const Run& run : runs) {
    if (!run.closed) continue;
    motions.push_back(motion_through(round_in_levels(run.stretches, levels, length), length, off_mm));
  }
  for (const double foot_s : levels)
    for (const Run& run : runs) {
      if (run.closed) continue;
      std::vector<Leg> legs;
      for (const TourStretch& stretch : run.stretches)
        legs.push_back([stretch, foot_s](double share) { return stretch(share, foot_s); });
      motions.push_back(motion_through(legs, length, off_mm));
    }
  return motions;
}

void note_tour(const WallsInRow& row, const std::vector<Face>& faces, Tour& tour) {
  std::string names;
  for (const std::size_t f : row.chain.order) names += (names.empty() ? "" : ", ") + faces[f].id;
  tour.notes.insert(
      tour.notes.begin(),
      fmt::format("{} adjacent walls ({}) are machined in a row, {}{}; climb milling", row.walls.size(), names,
                  tour.closed ? "all round, in one motion"
                              : fmt::format("in {} motion{}", tour.motions.size(), tour.motions.size() == 1 ? "" : "s"),
                  tour.levels > 1 ? fmt::format(", at {} levels", tour.levels) : ""));
}

}  // namespace

std::optional<Tour> make_tour(const TourRequest& request) {
  constexpr double kOff = 0.02;  // of the tolerance: what cubics may be off
  const std::vector<Face> faces = with_loops(request.walls);
  const std::optional<Chain> chain = find_chain(faces);
  if (!chain) return {};
  constexpr double kAnyLength = 1.0;
  // Thicker by what is left: the tool itself keeps so far off.
  const std::optional<StraightFlank> flank =
      straight_flank(grown(request.tool(request.axis_length_mm.value_or(kAnyLength)), request.allowance_mm));
  if (!flank) return {};
  std::optional<WallsInRow> row = oriented_row(faces, *chain, *flank, request);
  if (!row) return {};
  const TourScene scene{request.obstacles, request.tolerance_mm, request.allowance_mm};
  look_at_corners(*flank, 0.0, request.tolerance_mm, *row);
  const std::optional<double> lowest = lowest_foot(*row, *flank, scene);
  if (!lowest) return {};
  look_at_corners(*flank, *lowest, request.tolerance_mm, *row);

  Tour tour;
  const Heights heights = heights_of(*lowest, flank->axis_over(longest_line(*row)), request.axis_length_mm);
  tour.tool = request.tool(heights.axis_length_mm);
  tour.levels = static_cast<int>(heights.foot_s.size());
  std::vector<std::size_t> without_room;
  const std::vector<Run> runs = runs_at(*row, *flank, *lowest, scene, without_room);
  if (runs.empty()) return {};
  tour.closed = runs.front().closed;
  tour.motions = motions_of(runs, heights.foot_s, heights.axis_length_mm, kOff * request.tolerance_mm);
  for (const Wall& wall : row->walls) tour.twist_rad = std::max(tour.twist_rad, wall.twist());
  note_corners(*row, faces, *flank, *lowest, scene, without_room, tour.notes);
  note_tour(*row, faces, tour);
  return tour;
}

}  // namespace flank::internal
