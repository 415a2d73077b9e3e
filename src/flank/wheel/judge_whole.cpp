#include "flank/wheel/judge_whole.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <variant>

#include "flank/io/face_names.h"
#include "flank/io/text/json_input.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/pipeline/run_journal.h"
#include "flank/results/verify_json.h"
#include "flank/results/view.h"
#include "flank/setup/clearance_scene.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/tool_body.h"
#include "flank/wheel/perform.h"
#include "flank/wheel/sector.h"

namespace flank::internal {
namespace {

constexpr double kDraftSamples = 3e4;  ///< of a draft, on all faces together

/// The hub and all blades; of equal ones those of one sector, which count for all: each target more costs memory for what is open of it.
/// The others are still among the faces that must not be cut.
std::vector<std::string> flow_faces(const WheelWork& work) {
  std::vector<std::string> out = work.roles.hub;
  for (const WheelBlade& blade : work.equal() ? work.sector.blades : work.roles.blades) {
    const std::vector<std::string> own = blade.flow();
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

/// All of a result but its verdict.
void describe(const CoverJob& job, const Setup& setup, Tool tool, Path path, Result& result) {
  result.job = job;
  result.inputs = input_stamps(job);
  result.part_sha256 = setup.part.sha256;
  result.tool = std::move(tool);
  result.path = std::move(path);
  result.plan = CoverSummary{};
  result.diagonal_mm = setup.part.box.diagonal();
}

/// What the verdict says of the tool's shank and holder, and the drawings.
void measure_bodies_of(const Setup& setup, Result& result) {
  const ClearanceScene scene =
      make_clearance_scene(setup, std::get<CoverJob>(result.job).obstacles, has_body(result.tool), result.notes);
  measure_bodies(scene, result.tool, result.path, result.verify);
  add_caveats(result.verify, result.notes);
  auto drawings = std::make_shared<Result::Drawings>();
  drawings->view = make_view(result.job, setup, result.tool, result.path, result.verify);
  result.drawings = std::move(drawings);
}

}  // namespace

PartRequest part_request(const WheelWork& work, const std::vector<std::string>& faces) {
  PartRequest out;
  out.file = work.job.part;
  out.unit = work.job.unit;
  out.faces = face_list(faces);
  return out;
}

ObstacleRequest obstacle_request(const WheelWork& work) {
  ObstacleRequest out;
  if (!work.roles.debris.empty()) out.ignore_faces = face_list(work.roles.debris);
  return out;
}

Result judged_path(const WheelWork& work, const std::vector<std::string>& faces, Path path, double least, Care care,
                   const std::string& tool) {
  Result result;
  CoverJob job;
  job.part = part_request(work, faces);
  job.tool.spec = tool_file(work, tool);
  job.tolerance_mm = work.job.tolerance_mm;
  job.judge.least_coverage = least;
  job.judge.reach_radius_mm = kOpenBall * work.job.tolerance_mm;
  job.obstacles = obstacle_request(work);
  Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, result.notes);
  if (care == Care::kFull) stand_whole(*read_wheel_plan(work.job.folder), setup);
  if (care == Care::kDraft) job.judge.sample_mm = coarse_spacing(setup, kDraftSamples);
  describe(job, setup, tool == "T2" ? *work.rough_tool : *work.tool, std::move(path), result);
  // Small faces beside large ones: each has samples enough only where no spacing is given for all.
  const DepthProof depth = work.job.sample_mm || care == Care::kDraft ? DepthProof::kSampled : DepthProof::kProved;
  result.verify = judge_job(setup, job.judge, result.tool, result.path, depth);
  measure_bodies_of(setup, result);
  return result;
}

Result with_tool(const std::string& folder, const Tool& tool) {
  const auto file = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  const auto job = std::get<CoverJob>(job_from_json(read_file(file("job.json")), file("job.json")));
  Result result;
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, result.notes);
  describe(job, setup, tool, read_path(file("path.json")), result);
  result.verify = verify_from_json(read_file(file("verify.json")), file("verify.json"));
  measure_bodies_of(setup, result);
  return result;
}

Result judge_whole(const WheelWork& work) {
  Path path = copied(work.finish, work.roles.axis, work.sector.pitch_rad, work.copies());
  return judged_path(work, flow_faces(work), std::move(path), work.job.least_coverage, Care::kFull);
}

std::vector<RoleFigures> role_figures(const WheelRoles& roles, const VerifyReport& report) {
  std::vector<RoleFigures> out{{"side"}, {"edge"}, {"fillet"}, {"hub"}, {"other"}};
  // A piece of a face has the role of the face, where that is named.
  const auto has = [](const std::vector<std::string>& faces, const std::string& face) {
    return std::any_of(faces.begin(), faces.end(), [&](const std::string& name) {
      return name == face ||
             (parse_face_name(name).piece.empty() && parse_face_name(name).number == parse_face_name(face).number);
    });
  };
  const auto role_of = [&](const std::string& face) -> std::size_t {
    if (has(roles.hub, face)) return 3;
    for (const WheelBlade& blade : roles.blades) {
      if (has(blade.sides(), face)) return 0;
      if (has(blade.edges, face)) return 1;
      for (const RootFillet& fillet : blade.fillets)
        if (has({fillet.face}, face)) return 2;
    }
    return 4;
  };
  for (const FaceVerdict& face : report.faces) {
    RoleFigures& sum = out[role_of(face.face)];
    sum.cut_mm = std::max(sum.cut_mm, face.overcut_mm);
    sum.area_mm2 += face.area_mm2;
    if (!face.target) continue;
    const double open = face.copies * face.reachable_share * face.area_mm2;
    sum.open_mm2 += open;
    sum.within_mm2 += face.coverage_reachable * open;
    sum.left_mm = std::max(sum.left_mm, face.undercut_mm);
  }
  out.erase(std::remove_if(out.begin(), out.end(), [](const RoleFigures& f) { return !(f.area_mm2 > 0.0); }),
            out.end());
  return out;
}

}  // namespace flank::internal
