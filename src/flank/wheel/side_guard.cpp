#include "flank/wheel/side_guard.h"

#include <algorithm>

#include "flank/base/parallel.h"
#include "flank/io/face_names.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {
namespace {

constexpr double kEnterShare = 0.8;  ///< of the tolerance
constexpr std::size_t kFewestPoses = 3;

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

void add_free(const Strip& strip, const std::vector<char>& is_free, Path& out) {
  Strip piece = strip;
  piece.poses.clear();
  for (std::size_t k = 0; k <= strip.poses.size(); ++k) {
    if (k < strip.poses.size() && is_free[k] != 0) {
      piece.poses.push_back(strip.poses[k]);
      continue;
    }
    if (piece.poses.size() >= kFewestPoses) out.strips.push_back(piece);
    piece.poses.clear();
  }
}

}  // namespace

Path kept_free(WheelWork& work, const Path& path) {
  Path out;
  PointOptions options;
  options.tolerance_mm = work.job.tolerance_mm, options.enter_share = kEnterShare;
  for (const Strip& strip : path.strips) {
    FloorChannel around;
    around.axis = work.roles.axis;
    around.walls = work.targets.of(all_but(work, face_list_items(strip.face)));
    const TipRoom room(around, work.tool->radial, options);
    std::vector<char> is_free(strip.poses.size());
    parallel_for(strip.poses.size(), [&](std::size_t k) { is_free[k] = room.flank_is_free(strip.poses[k]) ? 1 : 0; });
    add_free(strip, is_free, out);
  }
  return out;
}

}  // namespace flank::internal
