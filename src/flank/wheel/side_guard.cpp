#include "flank/wheel/side_guard.h"

#include <algorithm>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/io/face_names.h"
#include "flank/wheel/point/pass_strips.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

constexpr double kEnterShare = 0.8;  ///< of the tolerance

using Names = std::vector<std::string>;

bool holds(const Names& faces, const std::string& face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

Names all_but(const WheelWork& work, const Names& own) {
  Names out;
  for (const WheelFace& face : work.faces)
    if (!holds(own, face.id) && !holds(work.roles.debris, face.id)) out.push_back(face.id);
  for (const WheelBlade& blade : work.roles.blades)
    out.erase(std::remove_if(out.begin(), out.end(), [&](const auto& face) { return holds(blade.buried, face); }),
              out.end());
  return out;
}

}  // namespace

Path kept_free(WheelWork& work, const Path& path) {
  Path out;
  PointOptions options;
  options.tolerance_mm = work.job.tolerance_mm, options.enter_share = kEnterShare;
  options.turn_window_mm = work.turn_window();
  for (const Strip& strip : path.strips) {
    FloorChannel around;
    around.axis = work.roles.axis;
    around.walls = work.targets.of(all_but(work, face_list_items(strip.face)));
    const TipRoom room(around, work.tool->radial, options);
    PoseRow row(strip.poses.size());
    parallel_for(row.size(), [&](std::size_t k) {
      if (room.flank_is_free(strip.poses[k])) row[k] = strip.poses[k];
    });
    add_strips({std::move(row)}, work.tool->radial, options, strip.kind, strip.face, out.strips);
  }
  return out;
}

}  // namespace flank::internal
