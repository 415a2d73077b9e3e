#include "flank/wheel/floor_operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "flank/error.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "flank/wheel/finished_places.h"
#include "flank/wheel/guarded.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/perform.h"
#include "flank/wheel/point/floor_passes.h"

namespace flank::internal {
namespace {

using Names = std::vector<std::string>;

/// A side with the fillets at its foot: those of its blade that are nearer to it than to the other side.
Names with_fillets(const WheelWork& work, const Names& side, FaceTargets& targets) {
  Names out = side;
  for (const WheelBlade& blade : work.roles.blades) {
    const bool ahead = blade.ahead == side;
    if (!ahead && blade.behind != side) continue;
    if (blade.round()) {
      for (const RootFillet& fillet : blade.fillets) out.push_back(fillet.face);
      continue;
    }
    const std::vector<const Target*> own = targets.of(side), other = targets.of(ahead ? blade.behind : blade.ahead);
    for (const RootFillet& fillet : blade.fillets) {
      const Target* face = targets.of({fillet.face}).front();
      const std::vector<SurfaceSample> samples = face->samples(std::max(0.3, 0.1 * face->diagonal()));
      if (samples.empty()) continue;
      const auto least = [&](const std::vector<const Target*>& all) {
        double mm = 1e300;
        for (const Target* one : all)
          mm = std::min(mm, std::abs(one->closest(samples[samples.size() / 2].point).distance));
        return mm;
      };
      if (least(own) < least(other)) out.push_back(fillet.face);
    }
  }
  return out;
}

/// The strips of the sides that bound a channel, where they are.
std::vector<Strip> side_strips(const WheelWork& work, const SectorChannel& channel) {
  std::vector<Strip> out = strips_of(work.finish, channel.first);
  std::vector<Strip> second = strips_of(work.finish, work.equal() ? channel.second_path : channel.second);
  // The path of the sector's own main blade is a pitch behind that of the next one.
  if (channel.turned && work.equal())
    for (Strip& strip : second) strip.poses = turned(strip.poses, work.roles.axis, work.sector.pitch_rad);
  out.insert(out.end(), second.begin(), second.end());
  return out;
}

Path floor_path(WheelWork& work) {
  Path out;
  std::vector<WheelSector> sectors = {work.sector};
  if (!work.equal()) sectors = all_sectors(work.roles);
  for (const WheelSector& sector : sectors)
    for (const SectorChannel& channel : sector.channels) {
      const FloorChannel place = floor_channel(work, channel);
      PointOptions options = work.point_options(work.roles.hub);
      const auto finished = std::make_shared<const FinishedPlaces>(side_strips(work, channel), work.tool->radial,
                                                                   0.9 * work.job.tolerance_mm);
      options.is_finished = [finished](const Vec3& x) { return (*finished)(x); };
      for (Strip& strip :
           point_passes(place, work.tool->radial, options, face_list(work.roles.hub), face_list(channel.first),
                        face_list(work.equal() ? channel.second_path : channel.second)))
        out.strips.push_back(std::move(strip));
    }
  for (std::size_t k = 0; k < out.strips.size(); ++k) out.strips[k].id = static_cast<int>(k) + 1;
  return out;
}

}  // namespace

FloorChannel floor_channel(WheelWork& work, const SectorChannel& channel) {
  FloorChannel out;
  out.axis = work.roles.axis;
  out.floor = work.floor();
  out.first = work.targets.of(with_fillets(work, channel.first, work.targets));
  out.second = work.targets.of(with_fillets(work, channel.second, work.targets));
  out.walls = work.walls();
  out.coarse = &work.coarse_triangles();
  out.distances = &work.distances();
  out.wheel = &work.wheel_triangles(), out.wheel_distances = &work.wheel_distances(), out.reach_mm = work.reach_mm();
  for (const WheelBlade& blade : work.sector.blades) {
    double foot = blade.thickness_mm;
    for (const RootFillet& fillet : blade.fillets) foot = std::max(foot, blade.thickness_mm + 2.0 * fillet.high_mm);
    out.blade_mm = std::max(out.blade_mm, foot);
  }
  return out;
}

WheelOperation floor_operation(WheelWork& work, const Progress&) {
  WheelOperation operation{.id = "30", .kind = "floor", .folder = "", .faces = work.roles.hub};
  if (!work.tool) {
    operation.problem = "no tool: none was found for the sides of the blades";
    return operation;
  }
  const std::string decides =
      path_to_json(work.finish) + tool_to_json(*work.tool) + fmt::format("{}", work.job.tolerance_mm);
  operation = perform(work, operation, decides, [&] {
    Path path = guarded(work, floor_path(work));
    if (path.strips.empty()) throw InputError("no gouge-free pass on the hub was found between the blades");
    // The folder is about one sector: of a hub that goes all round it finishes its share.
    const double share = work.equal() ? 1.0 / work.sectors_of_hub() : 1.0;
    return judged_path(work, operation.faces, std::move(path), 0.9 * share * work.job.least_coverage, Care::kDraft);
  });
  take(work, operation);
  return operation;
}

}  // namespace flank::internal
