#include "flank/wheel/point/face_passes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/wheel/point/axis_field.h"
#include "flank/wheel/point/face_lines.h"
#include "flank/wheel/point/flank_joints.h"
#include "flank/wheel/point/line_pass.h"
#include "flank/wheel/point/pass_strips.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

constexpr double kStepMm = 0.5;         ///< between poses
constexpr double kNetMm = 2.5;          ///< of the net of directions, along
constexpr std::size_t kColumns = 18;    ///< and across, at most
constexpr double kSteadierShare = 0.6;  ///< of the turn that there may be, between places that stops lie between
constexpr double kLinkMm =
    20.0;  ///< of a pass, that takes no longer than a link from its end to the next one's beginning

/// Of each line, its places that need a pass.
using AskedPlaces = std::vector<std::vector<char>>;

/// Nodes of the field of directions among the places and lines.
struct Net {
  int rows = 2, columns = 1;
  double rows_apart = 1.0, columns_apart = 1.0;  ///< places and lines between nodes
  explicit Net(const FaceLines& lines)
      : rows(static_cast<int>(std::max(2.0, std::ceil(static_cast<double>(lines.places()) * kStepMm / kNetMm)))),
        columns(static_cast<int>(std::clamp<std::size_t>(lines.lines(), 1, kColumns))),
        rows_apart((static_cast<double>(lines.places()) - 1.0) / (rows - 1.0)) {
    if (columns > 1) columns_apart = (static_cast<double>(lines.lines()) - 1.0) / (columns - 1.0);
  }
};

/// Whether a place within a node's cells needs a pass: other nodes need no direction.
bool is_asked(const AskedPlaces& wanted, const Net& net, double place, double line) {
  const auto range = [](double middle, double half, std::size_t count) {
    return std::pair(
        static_cast<std::size_t>(std::max(0.0, std::floor(middle - half))),
        static_cast<std::size_t>(std::clamp(std::ceil(middle + half), 0.0, static_cast<double>(count) - 1.0)));
  };
  const auto [line0, line1] = range(line, net.columns_apart, wanted.size());
  for (std::size_t n = line0; n <= line1; ++n) {
    const auto [place0, place1] = range(place, net.rows_apart, wanted[n].size());
    for (std::size_t k = place0; k <= place1; ++k)
      if (wanted[n][k] != 0) return true;
  }
  return false;
}

AxisField field_of(const FaceLines& lines, const TipRoom& room, const Net& net, const AskedPlaces& wanted) {
  std::vector<std::optional<TipRoom::Rest>> places(static_cast<std::size_t>(net.rows * net.columns));
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double place = static_cast<double>(k / static_cast<std::size_t>(net.columns)) * net.rows_apart;
    const auto line = std::min(
        lines.lines() - 1, static_cast<std::size_t>(std::lround(
                               static_cast<double>(k % static_cast<std::size_t>(net.columns)) * net.columns_apart)));
    if (!is_asked(wanted, net, place, static_cast<double>(line))) continue;
    if (const auto here = lines.at(line, place))
      places[k] = TipRoom::Rest{here->point + room.lift_mm() * here->normal, here->normal, 0.0};
  }
  return {room, places, net.rows, net.columns};
}

/// Places of a line that need a pass: what is not finished, a neighbour on either side, and what lies between two of them that a link
/// would take longer to leave out.
std::vector<char> needed(const FaceLines& lines, const FlankJoints& joints, const PointOptions& options,
                         std::size_t line) {
  const std::size_t count = lines.places(), gap = static_cast<std::size_t>(kLinkMm / kStepMm);
  std::vector<char> out(count, 0);
  std::size_t after_last = 0;  // the place after the last one that is open; 0: none yet
  for (std::size_t k = 0; k < count; ++k) {
    const auto place = lines.at(line, static_cast<double>(k));
    const bool joins = options.joins_flank && joints.joins(line, k);
    if (!place || (!joins && options.is_finished && options.is_finished(place->point))) continue;
    const std::size_t from = after_last > 0 && k - after_last <= gap ? after_last : k - std::min<std::size_t>(k, 1);
    for (std::size_t i = from; i < std::min(count, k + 2); ++i) out[i] = 1;
    after_last = k + 1;
  }
  return out;
}

/// Each other line the other way round. Axes are made steady from place to place, and not from stop to stop, which may be as near as a
/// micrometre.
std::vector<Strip> strips_of(const LineWork& work, std::size_t line, const std::vector<char>& wanted,
                             const Strip& empty, const RadialFunction& radial, const PointOptions& options) {
  std::vector<Strip> out;
  std::vector<LineStretch> stretches = line_stretches(work, line, wanted);
  PointOptions steadier = options;
  if (work.joints.stops(line).size() > wanted.size()) steadier.most_turn_rad *= kSteadierShare;
  for (LineStretch& stretch : stretches) {
    Strip strip = empty;
    strip.poses.swap(stretch.poses);
    const auto is_free = [&](std::size_t k, const Pose& turned) {
      return has_room(work, line, stretch.places[k], turned);
    };
    steady(strip, is_free, radial, steadier);
    stretch.poses.swap(strip.poses);
    for (std::vector<Pose>& poses : with_stops(work, line, stretch)) {
      strip.poses = std::move(poses);
      if (line % 2 == 1) std::reverse(strip.poses.begin(), strip.poses.end());
      add_strip(strip, radial, options, out);
    }
  }
  if (line % 2 == 1) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace

std::vector<Strip> face_passes(const Face& face, const FloorChannel& around, const RadialFunction& radial,
                               const PointOptions& options, const std::string& kind, const std::string& name) {
  const TipRoom room(around, radial, options);
  const FaceLines lines(face, room.tip_mm(), options.scallop_share * options.tolerance_mm, kStepMm);
  const FlankJoints joints(lines, room, options.left_by_flank);
  AskedPlaces wanted(lines.lines());
  parallel_for(wanted.size(), [&](std::size_t line) { wanted[line] = needed(lines, joints, options, line); });
  const Net net(lines);
  const AxisField field = field_of(lines, room, net, wanted);
  const LineWork work{lines, room, field, net.rows_apart, net.columns_apart, joints, options.most_turn_rad};
  const Strip empty{.id = 1, .kind = kind, .face = name, .poses = {}};
  std::vector<std::vector<Strip>> found(lines.lines());
  parallel_for(found.size(),
               [&](std::size_t line) { found[line] = strips_of(work, line, wanted[line], empty, radial, options); });
  std::vector<Strip> out;
  for (std::vector<Strip>& row : found)
    for (Strip& strip : row) out.push_back(std::move(strip));
  return out;
}

}  // namespace flank::internal
