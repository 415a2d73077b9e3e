#include "flank/wheel/operations.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/tool_file.h"
#include "flank/version.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/point/floor_passes.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

std::string in_folder(const WheelWork& work, const std::string& name) {
  return (fs::path(work.job.folder) / name).string();
}

std::string tool_file(const WheelWork& work) {
  return fs::absolute(in_folder(work, "tools/T1.json")).lexically_normal().string();
}

PartRequest part_request(const WheelWork& work, const std::vector<std::string>& faces) {
  PartRequest out;
  out.file = work.job.part;
  out.unit = work.job.unit;
  out.faces = face_list(faces);
  return out;
}

/// Makes the operation's result, unless a finished one of the same key lies in its folder. `make` throws, or gives a result.
WheelOperation perform(WheelWork& work, WheelOperation operation, const std::string& decides,
                       const std::function<Result()>& make) {
  operation.folder = "ops/" + operation.id + "-" + operation.kind;
  operation.key = sha256(work.part.sha256 + kVersion + decides);
  const auto known = work.finished.find(operation.id);
  if (known != work.finished.end() && known->second.done && known->second.key == operation.key &&
      fs::exists(in_folder(work, operation.folder + "/path.json"))) {
    operation = known->second;
    operation.kept = true;
    return operation;
  }
  const auto begun = std::chrono::steady_clock::now();
  try {
    const Result result = make();
    if (result.path.pose_count() == 0) throw InputError("nothing was found that machines anything");
    write_result(result, in_folder(work, operation.folder));
    const Acceptance acceptance = result.acceptance();
    operation.done = result.complete;
    operation.pass = acceptance.pass();
    if (!result.complete)
      operation.problem = "it was stopped";
    else if (!acceptance.pass())
      operation.problem = acceptance.reasons.front().text;
  } catch (const Error& error) {
    operation.problem = error.what();
  }
  operation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return operation;
}

/// Strips of an operation that is done go into the finishing path.
void take(WheelWork& work, const WheelOperation& operation) {
  if (!operation.done) return;
  const Path path = read_path(in_folder(work, operation.folder + "/path.json"));
  work.finish.strips.insert(work.finish.strips.end(), path.strips.begin(), path.strips.end());
}

std::vector<std::unique_ptr<Target>> targets_of(const WheelWork& work, const std::vector<std::string>& faces) {
  std::vector<std::unique_ptr<Target>> out;
  Part part = work.part;
  if (!part.is_mesh()) split_faces(part, face_list(faces));
  for (const int face : parse_face_list(part, face_list(faces)))
    out.push_back(part.is_mesh() ? make_target(extract_mesh(part, {face}))
                                 : make_target({part.faces[static_cast<std::size_t>(face)]}, +1));
  return out;
}

void add_all(const std::vector<std::unique_ptr<Target>>& from, std::vector<const Target*>& to) {
  for (const auto& target : from) to.push_back(target.get());
}

/// A pose of a side's path by its place along the blade, and how high its tip is over the hub, mm.
struct LowPose {
  Pose pose;
  double along = 0.0, height = 0.0;
};

double height_over(const std::vector<const Target*>& hub, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Target* target : hub) least = std::min(least, std::abs(target->closest(p).distance));
  return least;
}

/// The lowest poses of a side's strips from one end of the blade to the other: each strip is the lower one on a stretch of its own. The
/// axes are means over a few millimetres, so that they do not jump where another strip takes over. Empty where the tool's other end is
/// at the hub.
std::vector<Pose> lowest(const std::vector<Strip>& strips, const std::vector<const Target*>& hub, const WheelAxis& axis,
                         double length_mm) {
  constexpr double kCellMm = 1.0;
  constexpr int kMeanCells = 3;
  // Along the blade, from an axial inlet to a radial outlet: both coordinates together rise all the way.
  const auto place = [&](const Pose& pose) { return Vec2(axis.along(pose.tip), axis.radius(pose.tip)); };
  std::vector<Vec2> ends;
  for (const Strip& strip : strips) ends.push_back(place(strip.poses.back()) - place(strip.poses.front()));
  if (ends.empty()) return {};
  const double sign = ends.front().x() * ends.front().y() < 0.0 ? -1.0 : 1.0;
  std::map<int, LowPose> cells;
  for (const Strip& strip : strips)
    for (const Pose& pose : strip.poses) {
      const Vec2 q = place(pose);
      const LowPose here{pose, q.y() + sign * q.x(), height_over(hub, pose.tip)};
      if (here.height > height_over(hub, pose.at(length_mm))) continue;
      const auto [cell, fresh] = cells.try_emplace(static_cast<int>(std::floor(here.along / kCellMm)), here);
      if (!fresh && here.height < cell->second.height) cell->second = here;
    }
  std::vector<Pose> poses, out;
  for (const auto& [cell, here] : cells) poses.push_back(here.pose);
  out = poses;
  const int count = static_cast<int>(poses.size());
  for (int k = 0; k < count; ++k) {
    Vec3 sum = Vec3::Zero();
    for (int n = std::max(0, k - kMeanCells); n <= std::min(count - 1, k + kMeanCells); ++n)
      sum += poses[static_cast<std::size_t>(n)].axis;
    out[static_cast<std::size_t>(k)].axis = sum.normalized();
  }
  return out;
}

Path floor_path(const WheelWork& work) {
  const auto hub = targets_of(work, work.roles.hub);
  Path out;
  for (const SectorChannel& channel : work.sector.channels) {
    const auto first = targets_of(work, channel.first), second = targets_of(work, channel.second);
    FloorChannel place;
    add_all(hub, place.floor);
    add_all(first, place.sides);
    add_all(second, place.sides);
    const double length = work.tool->radial.axis_length();
    place.first = lowest(strips_of(work.finish, channel.first), place.floor, work.roles.axis, length);
    place.second = lowest(strips_of(work.finish, channel.second_path), place.floor, work.roles.axis, length);
    // The path of the sector's own main blade is a pitch behind that of the next one.
    if (channel.turned) place.second = turned(place.second, work.roles.axis, work.sector.pitch_rad);
    const WheelAxis& axis = work.roles.axis;
    place.place = [&axis](const Vec3& p) { return Vec3(axis.along(p), axis.radius(p), 0.0); };
    FloorOptions options;
    options.tolerance_mm = work.job.tolerance_mm;
    options.clearance_mm = -0.3 * work.job.tolerance_mm;
    for (Strip& strip : floor_passes(place, work.tool->radial, options, face_list(work.roles.hub)))
      out.strips.push_back(std::move(strip));
  }
  for (std::size_t k = 0; k < out.strips.size(); ++k) out.strips[k].id = static_cast<int>(k) + 1;
  return out;
}

}  // namespace

WheelOperation side_operation(WheelWork& work, const Progress& progress) {
  WheelOperation operation{.id = "20", .kind = "side", .folder = "", .faces = work.sector.sides()};
  FitJob job;
  job.part = part_request(work, operation.faces);
  job.tolerance_mm = work.job.tolerance_mm;
  job.effort = work.job.effort;
  if (work.job.tool) job.tool.spec = *work.job.tool;
  job.judge.sample_mm = work.job.sample_mm;
  operation = perform(work, operation, job_to_json(job), [&] { return run_fit(job, progress); });
  if (!operation.done) return operation;
  work.tool = read_tool(in_folder(work, operation.folder + "/tool.json"));
  write_tool(*work.tool, in_folder(work, "tools/T1.json"));
  take(work, operation);
  return operation;
}

WheelOperation floor_operation(WheelWork& work, const Progress&) {
  WheelOperation operation{.id = "30", .kind = "floor", .folder = "", .faces = work.roles.hub};
  if (!work.tool) {
    operation.problem = "there is no tool: the sides have none";
    return operation;
  }
  const std::string decides =
      path_to_json(work.finish) + tool_to_json(*work.tool) + fmt::format("{}", work.job.tolerance_mm);
  operation = perform(work, operation, decides, [&] {
    Path path = floor_path(work);
    if (path.strips.empty()) throw InputError("no pass on the hub is free between the blades' sides");
    // The folder is about one sector: of a hub that goes all round it finishes its share.
    return judged_path(work, operation.faces, std::move(path), work.job.least_coverage / work.roles.count * 0.5);
  });
  take(work, operation);
  return operation;
}

WheelOperation edge_operation(WheelWork& work, const Progress& progress) {
  WheelOperation operation{.id = "40", .kind = "edge", .folder = ""};
  for (const WheelBlade& blade : work.sector.blades)
    operation.faces.insert(operation.faces.end(), blade.edges.begin(), blade.edges.end());
  if (!work.tool || operation.faces.empty()) {
    operation.problem = work.tool ? "no blade has a face that is an edge" : "there is no tool: the sides have none";
    return operation;
  }
  CoverJob job;
  job.part = part_request(work, operation.faces);
  job.tool.spec = tool_file(work);
  job.tolerance_mm = work.job.tolerance_mm;
  job.judge.sample_mm = work.job.sample_mm;
  const std::string decides = job_to_json(job) + tool_to_json(*work.tool);
  operation = perform(work, operation, decides, [&] { return run_cover(job, progress); });
  take(work, operation);
  return operation;
}

WheelOperation rough_operation(WheelWork& work, const Progress& progress) {
  const SectorChannel& channel = work.sector.channels.front();
  WheelOperation operation{.id = "10", .kind = "rough", .folder = ""};
  operation.faces = channel.first;
  operation.faces.insert(operation.faces.end(), channel.second.begin(), channel.second.end());
  if (!work.tool) {
    operation.problem = "there is no tool: the sides have none";
    return operation;
  }
  TrochoidJob job;
  job.part.file = work.job.part;
  job.part.unit = work.job.unit;
  job.left = face_list(channel.first);
  job.right = face_list(channel.second);
  job.floor = work.roles.hub.front();
  job.tool.spec = tool_file(work);
  job.tolerance_mm = work.job.tolerance_mm;
  job.judge.sample_mm = work.job.sample_mm;
  const std::string decides = job_to_json(job) + tool_to_json(*work.tool);
  operation = perform(work, operation, decides, [&] { return run_trochoid(job, progress); });
  if (work.sector.channels.size() > 1 && operation.problem.empty())
    operation.problem =
        fmt::format("only the first of {} channels of a sector is roughed", work.sector.channels.size());
  return operation;
}

}  // namespace flank::internal
