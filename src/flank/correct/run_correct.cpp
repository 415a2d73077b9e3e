#include "flank/correct/run_correct.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <variant>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/correct/aimed_result.h"
#include "flank/correct/measure/read_points.h"
#include "flank/correct/motion/path_motions.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/error.h"
#include "flank/io/cad/write_step.h"
#include "flank/io/text/json_input.h"
#include "flank/job/correct_fields.h"
#include "flank/job/input_files.h"
#include "flank/manifest/kept_inputs.h"
#include "flank/manifest/result_folder.h"
#include "flank/path_file.h"
#include "flank/pipeline/folder/folder_job.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/targets.h"
#include "flank/tool_file.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr double kLimitTolerances = 20.0;
constexpr std::size_t kGuideLines = 40;

/// What a folder of results holds, read once.
struct Earlier {
  PlanJob job;
  Tool tool;
  Path path;
};

std::string in(const std::string& folder, const char* name) {
  return fs::absolute(fs::path(folder) / name).lexically_normal().string();
}

Earlier read_earlier(const std::string& name) {
  const ResultFolder folder(name, ResultFolder::Use::kRead);
  VerifyJob request;
  request.folder = name;
  Earlier earlier{read_folder_job(request, folder).job, read_tool(in(name, "tool.json")),
                  read_path(in(name, "path.json"))};
  folder.require_whole({"verify.json", "view.json"});
  if (std::holds_alternative<TrochoidJob>(earlier.job))
    throw UsageError("folder", name, "holds the program of a cavity; expected the result of flank fit or flank cover");
  return earlier;
}

template <class Use>
void with_plan(PlanJob& job, const Use& use) {
  if (auto* fit = std::get_if<FitJob>(&job)) use(*fit);
  if (auto* cover = std::get_if<CoverJob>(&job)) use(*cover);
}

Setup read_nominal(PlanJob& job, std::vector<std::string>& notes) {
  Setup setup;
  with_plan(job, [&](auto& plan) {
    setup = read_setup(plan.part, plan.obstacles, plan.tolerance_mm, notes);
    plan.tolerance_mm = setup.tolerance_mm;
  });
  return setup;
}

VerifyReport judge(const Setup& setup, PlanJob& job, const Tool& tool, const Path& path) {
  VerifyReport report;
  with_plan(job, [&](auto& plan) { report = judge_job(setup, plan.judge, tool, path); });
  return report;
}

/// The axes of a strip as a start for the new motion.
std::string guide_text(const Strip& strip, double length) {
  std::string text;
  const std::size_t count = std::min(kGuideLines, strip.poses.size());
  for (std::size_t k = 0; k < count; ++k) {
    const Pose& pose = strip.poses[k * (strip.poses.size() - 1) / (count - 1)];
    for (const Vec3& p : {pose.tip, pose.at(length)})
      for (int i = 0; i < 3; ++i) text += exact_number(p[i]) + " ";
    text += "\n";
  }
  return text;
}

/// The job again, with a given tool.
void plan_again(const Earlier& earlier, const std::string& tool_file, PlanJob& job) {
  with_plan(job, [&](auto& plan) {
    plan.tool.spec = tool_file;
    plan.tool.axis_length_mm.reset();
  });
  auto* fit = std::get_if<FitJob>(&job);
  if (fit == nullptr) return;
  fit->start.reset();
  fit->guide.reset();
  fit->stiffness_curve = false;
  fit->strips = static_cast<int>(earlier.path.strips.size());
}

/// Where the result has one strip, the job begins where that was.
void start_from(const Earlier& earlier, const std::string& output, PlanJob& job) {
  auto* fit = std::get_if<FitJob>(&job);
  const Strip& first = earlier.path.strips.front();
  if (fit == nullptr || fit->strips != 1 || first.poses.size() < 2) return;
  fit->guide = in(output, "guide.txt");
  write_file(*fit->guide, guide_text(first, earlier.tool.radial.axis_length()));
}

Result run_plan(const PlanJob& job, const Progress& progress) {
  if (const auto* fit = std::get_if<FitJob>(&job)) return run_fit(*fit, progress);
  return run_cover(std::get<CoverJob>(job), progress);
}

void make_folder(const std::string& output) {
  std::error_code error;
  fs::create_directories(output, error);
  if (!fs::is_directory(output)) throw InputError(output + ": is not a folder and cannot be created");
}

void as_ground(Earlier& earlier, const std::string& output, const Progress& progress, Correction& correction) {
  const std::string& file = *correction.job.profile;
  correction.ground = fit_ground(earlier.tool.radial, read_profile_points(file), file);
  Tool tool = earlier.tool;
  tool.radial = correction.ground->radial;
  tool.name = earlier.tool.name.empty() ? "as ground" : earlier.tool.name + ", as ground";
  std::vector<std::string> notes;
  const Setup setup = read_nominal(earlier.job, notes);
  correction.tolerance_mm = setup.tolerance_mm;
  progress.step("judge", 0.02);
  correction.other = judge(setup, earlier.job, tool, earlier.path);
  make_folder(output);
  write_tool(tool, in(output, "ground.json"));
  PlanJob job = earlier.job;
  plan_again(earlier, in(output, "ground.json"), job);
  start_from(earlier, output, job);
  correction.result = run_plan(job, progress.part(0.1, 1.0));
}

/// The one face that is machined; its error is a function of its parameters.
int single_face(const Setup& setup, const std::string& folder) {
  const bool plain = !setup.part.is_mesh() && setup.targets.size() == 1;
  if (!plain || setup.part.face_id(setup.targets.front()) != "F" + std::to_string(setup.targets.front() + 1))
    throw UsageError("measured", folder,
                     "points are compared with one whole face of a CAD file; this result has other faces");
  const Face& face = setup.part.faces[static_cast<std::size_t>(setup.targets.front())];
  if (!face.surface.weights.empty())
    throw UsageError("measured", folder,
                     "the face has weights (a rational surface); export it as a B-spline without weights");
  return setup.targets.front();
}

/// The motions of the old path, and what each of them leaves at a point.
struct Planned {
  std::vector<RuledMotion> motions;
  std::vector<SweptEstimate> swept;
  [[nodiscard]] std::vector<double> left_at(const Vec3& p) const {
    std::vector<double> left;
    for (const SweptEstimate& pass : swept) left.push_back(pass.refine(p, pass.nearest(p)).f);
    return left;
  }
};

Planned planned(const Earlier& earlier, double tolerance_mm) {
  constexpr double kNear = 0.02;  // of the tolerance: the poses themselves are joined by chords that are farther off
  constexpr int kDenser = 4;      // poses of its table, for each control point of a rail
  const RadialFunction& radial = earlier.tool.radial;
  Planned out;
  out.motions = motions_through(earlier.path, radial.axis_length(), kNear * tolerance_mm);
  for (const RuledMotion& motion : out.motions)
    out.swept.emplace_back(std::vector<RuledMotion>{motion}, radial, kDenser * motion.tip.count());
  return out;
}

/// The part with the mirrored face in the place of its own. Sheets: the machined side is where their normals point.
void write_mirrored(const Setup& setup, int face, const FaceError& error, const Planned& old, const std::string& file) {
  std::vector<Face> faces;
  for (const Face& other : setup.part.faces) faces.push_back(other);
  Face& mirrored = faces[static_cast<std::size_t>(face)];
  mirrored =
      mirrored_face(mirrored, error, mirrored.reversed ? -1 : 1, [&old](const Vec3& p) { return old.left_at(p); });
  write_step(file, faces);
}

FaceError measured_error(const Setup& setup, const TargetGroup& group, const CorrectJob& job, const Planned& old) {
  FaceErrorOptions options;
  options.fit_datum = job.datum == "fit";
  options.limit_mm = job.limit_mm.value_or(kLimitTolerances * setup.tolerance_mm);
  options.planned_mm = [&old](const Vec3& p) { return old.left_at(p); };
  options.file = *job.measured;
  return face_error(*group.target, setup.part.faces[static_cast<std::size_t>(group.indices.front())],
                    read_measured_points(*job.measured), options);
}

/// Motions that leave less where the machine leaves more.
AimedMotions aimed_against(const FaceError& error, const Setup& setup, const TargetGroup& group, const Earlier& earlier,
                           std::vector<RuledMotion> motions) {
  AimProblem problem;
  problem.target = group.target.get();
  problem.motions = std::move(motions);
  problem.tool = earlier.tool.radial;
  problem.tolerance_mm = setup.tolerance_mm;
  const BSplineSurface& s = setup.part.faces[static_cast<std::size_t>(group.indices.front())].surface;
  problem.added_mm = [&](const Vec3& p, std::size_t pass) {
    const Footpoint foot = problem.target->closest(p);
    return error.of_pass(pass, (foot.u - s.u_first()) / (s.u_last() - s.u_first()),
                         (foot.v - s.v_first()) / (s.v_last() - s.v_first()));
  };
  return aimed_motions(problem);
}

/// The job on the part with the mirrored face, with the old tool.
PlanJob mirrored_job(const Earlier& earlier, const Setup& setup, const std::string& folder, const std::string& file) {
  PlanJob job = earlier.job;
  with_plan(job, [&](auto& plan) {
    plan.part.file = file;
    plan.part.unit.reset();
    plan.part.side = 1;
    plan.obstacles.check_faces.reset();
    plan.obstacles.ignore_faces = faces_not_checked(setup);
  });
  plan_again(earlier, in(folder, "tool.json"), job);
  return job;
}

void as_cut(Earlier& earlier, const std::string& output, const Progress& progress, Correction& correction) {
  std::vector<std::string> notes;
  const Setup setup = read_nominal(earlier.job, notes);
  correction.tolerance_mm = setup.tolerance_mm;
  const int face = single_face(setup, correction.job.folder);
  if (!setup.part.left_out.empty())
    throw UsageError("measured", correction.job.folder,
                     "faces of the part could not be read, so it cannot be written with a mirrored one");
  const std::vector<TargetGroup> groups = make_targets(setup);
  const Planned old = planned(earlier, setup.tolerance_mm);
  progress.step("measure", 0.1);
  correction.error = measured_error(setup, groups.front(), correction.job, old);
  make_folder(output);
  const std::string mirrored = in(output, "mirrored.step");
  write_mirrored(setup, face, *correction.error, old, mirrored);
  progress.step("correct", 0.3);
  AimedMotions aimed = aimed_against(*correction.error, setup, groups.front(), earlier, old.motions);
  progress.step("verify", 0.6);
  correction.result =
      aimed_result(mirrored_job(earlier, setup, correction.job.folder, mirrored), earlier.tool, std::move(aimed));
  correction.other = judge(setup, earlier.job, correction.result.tool, correction.result.path);
}

}  // namespace

std::optional<std::string> faces_not_checked(const Setup& setup) {
  const auto is_among = [](const std::vector<int>& faces, int k) {
    return std::find(faces.begin(), faces.end(), k) != faces.end();
  };
  std::string text;
  for (int k = 0; k < setup.part.face_count(); ++k)
    if (!is_among(setup.targets, k) && !is_among(setup.checks, k))
      text += (text.empty() ? "F" : ",F") + std::to_string(k + 1);
  return text.empty() ? std::nullopt : std::optional(text);
}

Correction run_correct(const CorrectJob& job, const std::string& output, const Progress& progress) {
  check_fields(job);
  if (job.profile.has_value() == job.measured.has_value())
    throw UsageError("profile", "", "give a profile of the tool, or measured points of the face");
  if (is_same_file(job.folder, output)) throw UsageError("folder", output, "give another folder for the new result");
  ReadFiles inputs = read_files(job);
  const Unwritten unwritten(inputs);
  progress.step("read", 0.0);
  Earlier earlier = read_earlier(job.folder);
  inputs.add(read_files(earlier.job));
  require_inputs_kept(inputs, output, {"ground.json", "mirrored.step", "guide.txt", "correct.json", "correct.txt"});
  Correction correction;
  correction.job = job;
  if (job.profile)
    as_ground(earlier, output, progress, correction);
  else
    as_cut(earlier, output, progress, correction);
  return correction;
}

void write_correction(const Correction& correction, const std::string& output) {
  const ReadFiles inputs = read_files(correction.job);
  const Unwritten unwritten(inputs);
  write_result(correction.result, output);
  write_file(in(output, "correct.json"), correction_json(correction));
  write_file(in(output, "correct.txt"), correction_text(correction));
}

}  // namespace flank::internal
