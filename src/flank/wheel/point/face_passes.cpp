#include "flank/wheel/point/face_passes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/wheel/point/axis_field.h"
#include "flank/wheel/point/face_lines.h"
#include "flank/wheel/point/flank_joints.h"
#include "flank/wheel/point/pass_strips.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

constexpr double kStepMm = 0.5;       ///< between poses
constexpr double kNetMm = 2.5;        ///< of the net of directions, along
constexpr std::size_t kColumns = 18;  ///< and across, at most
constexpr double kLinkMm =
    20.0;  ///< of a pass, that takes no longer than a link from its end to the next one's beginning
constexpr double kLeastMm = 0.01;  ///< poses that are nearer to each other are one
constexpr int kHalvings = 8;       ///< of the search for the end of a pass's room

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

struct Work {
  const FaceLines& lines;
  const TipRoom& room;
  const AxisField& field;
  const Net& net;
  const FlankJoints& joints;
  double most_turn_rad;  ///< of the axis from one pose to the next one
  [[nodiscard]] bool goes_on(const Pose& a, const Pose& b) const {
    return a.axis.dot(b.axis) > std::cos(most_turn_rad);
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

/// A pose with room at a place; none beside the face, and where no direction has any. `beside`: a pose of the same pass, null: none.
std::optional<Pose> pose_at(const Work& work, std::size_t line, double place, const Pose* beside) {
  const std::optional<FaceLines::Place> here = work.lines.at(line, place);
  if (!here) return {};
  const FlankJoints::Shift joint = work.joints.at(line, place, *here);
  const Vec3 tip = here->point + work.room.lift_mm() * here->normal + joint.moved;
  if (!work.room.tip_is_free(tip, joint.deeper_mm)) return {};
  const double row = place / work.net.rows_apart, column = static_cast<double>(line) / work.net.columns_apart;
  const Pose smooth{tip, work.field.at(row, column)};
  if (work.room.is_free(smooth, joint.deeper_mm)) return smooth;
  for (const Vec3& axis : work.field.around(row, column))
    if (const Pose pose{tip, axis}; work.room.is_free(pose, joint.deeper_mm)) return pose;
  // A place smaller than the net's cells, as beside the foot of a post.
  if (beside != nullptr)
    if (const Pose pose{tip, beside->axis}; work.room.is_free(pose, joint.deeper_mm)) return pose;
  const Vec3& wish = beside != nullptr ? beside->axis : smooth.axis;
  const auto own = AxisField::nearest_free(work.room, {tip, here->normal, 0.0}, wish, joint.deeper_mm);
  return own ? std::optional(Pose{tip, *own}) : std::nullopt;
}

/// The last pose with room, and no other axis, from a place that has it to one that has none.
Pose last_with_room(const Work& work, std::size_t line, double good, double bad, Pose pose) {
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (good + bad);
    const std::optional<Pose> there = pose_at(work, line, middle, &pose);
    if (there && work.goes_on(pose, *there))
      good = middle, pose = *there;
    else
      bad = middle;
  }
  return pose;
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

/// A pass ends where its room does, and where its axis would have to jump.
PoseRow row_of(const Work& work, std::size_t line, const std::vector<char>& wanted) {
  const std::size_t steps = work.joints.steps(line);
  const double step = 1.0 / static_cast<double>(steps);
  const auto asked = [&](std::size_t k) { return wanted[k / steps] != 0 && wanted[(k + steps - 1) / steps] != 0; };
  PoseRow out;
  std::optional<Pose> last;
  const auto end_of = [&](const Pose& known, double good, double bad) {
    const Pose end = last_with_room(work, line, good, bad, known);
    if ((end.tip - known.tip).norm() > kLeastMm) out.emplace_back(end);
  };
  for (std::size_t k = 0; k < (wanted.size() - 1) * steps + 1; ++k) {
    const double place = static_cast<double>(k) * step;
    const std::optional<Pose> pose = asked(k) ? pose_at(work, line, place, last ? &*last : nullptr) : std::nullopt;
    const bool goes_on = last && pose && work.goes_on(*last, *pose);
    if (k > 0 && asked(k) && asked(k - 1) && !goes_on) {
      if (last) end_of(*last, place - step, place);
      if (last && pose) out.emplace_back();
      if (pose) end_of(*pose, place, place - step);
    }
    last = pose;
    out.push_back(last);
  }
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
  const Work work{lines, room, field, net, joints, options.most_turn_rad};
  std::vector<PoseRow> found(lines.lines());
  parallel_for(found.size(), [&](std::size_t line) { found[line] = row_of(work, line, wanted[line]); });
  std::vector<Strip> out;
  add_strips(std::move(found), room, radial, options, kind, name, out);
  return out;
}

}  // namespace flank::internal
