#include "flank/wheel/face_operations.h"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "flank/error.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "flank/wheel/finished_places.h"
#include "flank/wheel/guarded.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/perform.h"
#include "flank/wheel/point/face_passes.h"

namespace flank::internal {
namespace {

using Names = std::vector<std::string>;
using FacesOfBlade = std::function<Names(const WheelBlade&)>;
using IsFinished = std::function<bool(const Vec3&)>;

constexpr double kFinishedShare = 0.92;  ///< of the tolerance: what is left so much more counts as not finished
constexpr double kDraftShare = 0.9;  ///< of the coverage that is asked for, that an operation's own folder is held to

Names faces_of(const std::vector<WheelBlade>& blades, const FacesOfBlade& which) {
  Names out;
  for (const WheelBlade& blade : blades) {
    const Names own = which(blade);
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

/// Everything counts as a wall, the hub and the face itself among it.
FloorChannel around(WheelWork& work) {
  FloorChannel out;
  out.axis = work.roles.axis;
  out.walls = work.walls();
  for (const Target* floor : work.floor()) out.walls.push_back(floor);
  out.coarse = &work.coarse_triangles();
  out.distances = &work.distances();
  out.wheel = &work.wheel_triangles(), out.wheel_distances = &work.wheel_distances(), out.reach_mm = work.reach_mm();
  return out;
}

IsFinished finished_by(const WheelWork& work, const std::vector<Strip>& strips) {
  const auto finished =
      std::make_shared<const FinishedPlaces>(strips, work.tool->radial, kFinishedShare * work.job.tolerance_mm);
  return [finished](const Vec3& x) { return (*finished)(x); };
}

/// What the flank has left of the sides. Passes of the tip leave scallops, which nothing can go on from smoothly.
std::function<std::optional<SurfaceLeft>(const Vec3&)> left_by_flank(const WheelWork& work) {
  std::vector<Strip> strips;
  for (const Strip& strip : work.finish.strips)
    if (strip.kind == "flank") strips.push_back(strip);
  const auto places = std::make_shared<const FinishedPlaces>(strips, work.tool->radial, work.job.tolerance_mm);
  return [places](const Vec3& x) { return places->left(x); };
}

/// Everywhere, or only where operations before have left something.
Path passes_along(WheelWork& work, const std::string& kind, const Names& faces, const IsFinished& is_finished) {
  const FloorChannel place = around(work);
  const auto left = left_by_flank(work);
  Path out;
  for (const std::string& name : faces) {
    const std::optional<Face> face = work.targets.face(name);
    if (!face) throw InputError(name + ": passes along a face need its surface, and a mesh has none");
    PointOptions options = work.point_options({name});
    options.is_finished = is_finished;
    options.left_by_flank = left;
    options.joins_flank = kind == "fillet";
    for (Strip& strip : face_passes(*face, place, work.tool->radial, options, kind, name))
      out.strips.push_back(std::move(strip));
  }
  return out;
}

Path passes_on_rest(WheelWork& work, const std::string& kind, const Names& faces) {
  return passes_along(work, kind, faces, finished_by(work, work.finish.strips));
}

/// Along what is left of the hub a half pitch to either side of the sector's first blade, as copies do the rest of it; along all that is
/// left where the blades differ. Passes along a channel are short and many where it ends soon behind a blade, and these are not.
Path passes_on_hub(WheelWork& work) {
  std::vector<Strip> strips = work.finish.strips;
  const WheelAxis& axis = work.roles.axis;
  const double pitch = work.sector.pitch_rad, middle = work.sector.blades.front().angle_deg * std::numbers::pi / 180.0;
  if (work.equal())
    for (const double turns : {-pitch, pitch})
      for (Strip strip : work.finish.strips) {
        strip.poses = turned(strip.poses, axis, turns);
        strips.push_back(std::move(strip));
      }
  const IsFinished is_finished = [finished = finished_by(work, strips), axis, middle, all = !work.equal(),
                                  pitch](const Vec3& x) {
    return (!all && !is_within_pitch(x, axis, middle, pitch)) || finished(x);
  };
  // Of a mesh there is no hub that passes could follow.
  Names hub = work.roles.hub;
  std::erase_if(hub, [&](const std::string& name) { return !work.targets.face(name); });
  return passes_along(work, "rest", hub, is_finished);
}

constexpr const char* kNoPass = "no pass has room";

WheelOperation on_faces(WheelWork& work, const std::string& id, const std::string& kind, const FacesOfBlade& which,
                        const std::function<Path(const Names&)>& passes) {
  WheelOperation operation{.id = id, .kind = kind, .folder = "", .faces = faces_of(work.sector.blades, which)};
  if (!work.tool || operation.faces.empty()) {
    operation.problem = work.tool ? "no blade has such a face" : "no tool: none was found for the sides of the blades";
    return operation;
  }
  std::vector<WheelBlade> blades = work.sector.blades;
  if (!work.equal()) {
    blades.clear();
    for (const WheelSector& sector : all_sectors(work.roles))
      blades.insert(blades.end(), sector.blades.begin(), sector.blades.end());
  }
  const std::string decides = kind + path_to_json(work.finish) + tool_to_json(*work.tool) +
                              fmt::format("{} {}", work.job.tolerance_mm, work.job.least_coverage);
  operation = perform(work, operation, decides, [&] {
    Path path = guarded(work, passes(faces_of(blades, which)));
    if (path.strips.empty()) throw InputError(kNoPass);
    return judged_path(work, operation.faces, std::move(path), kDraftShare * work.job.least_coverage, Care::kDraft);
  });
  take(work, operation);
  return operation;
}

/// What is left is told by place; an operation that has nothing to do lacks nothing.
std::optional<WheelOperation> unless_nothing(WheelOperation operation) {
  if (!operation.done && operation.problem == kNoPass) return {};
  return operation;
}

Names fillets_of(const WheelBlade& blade) {
  Names out;
  for (const RootFillet& fillet : blade.fillets) out.push_back(fillet.face);
  return out;
}

}  // namespace

std::optional<WheelOperation> fillet_operation(WheelWork& work) {
  return unless_nothing(on_faces(work, "40", "fillet", fillets_of,
                                 [&](const Names& faces) { return passes_on_rest(work, "fillet", faces); }));
}

WheelOperation edge_operation(WheelWork& work) {
  return on_faces(
      work, "50", "edge", [](const WheelBlade& blade) { return blade.edges; },
      [&](const Names& faces) { return passes_along(work, "edge", faces, {}); });
}

std::optional<WheelOperation> rest_operation(WheelWork& work) {
  return unless_nothing(on_faces(
      work, "60", "rest", [](const WheelBlade& blade) { return blade.sides(); },
      [&](const Names& faces) {
        Path path = passes_on_rest(work, "rest", faces);
        for (Strip& strip : passes_on_hub(work).strips) path.strips.push_back(std::move(strip));
        return path;
      }));
}

}  // namespace flank::internal
