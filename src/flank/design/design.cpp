#include "flank/design/design.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/base/sha256.h"
#include "flank/design/candidates.h"
#include "flank/design/design_tables.h"
#include "flank/design/pairs.h"
#include "flank/error.h"
#include "flank/inspect.h"
#include "flank/job/design_fields.h"
#include "flank/job/input_files.h"
#include "flank/tool_request/catalogue.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Faces whose surfaces differ by less than this share of the tolerance are equal.
constexpr double kEqualShare = 0.1;

/// Everything that would be refused later, as far as it can be told before.
void check(const DesignJob& job) {
  check_fields(job);
  const ToolSpec spec = parse_tool_spec(job.shape, "shape");
  if (job.source != "catalogue" && !spec.free && !has_open_parameters(spec))
    throw UsageError("shape", job.shape, "is a complete tool; expected free, or a family with open parameters");
  if (job.source != "fit") (void)read_catalogue(catalogue_folder(job.choice.catalogue));
}

/// The radius of the ball that says what is reachable: what a cylinder across the smallest face needs to be stiff enough.
double usual_reach(const Part& part, const std::vector<int>& faces, const DesignJob& job) {
  const InspectReport report = inspect(part);
  double least = std::numeric_limits<double>::infinity();
  for (const InspectRow& row : report.rows)
    for (const int face : faces)
      if (row.id == part.face_id(face)) least = std::min(least, row.area_mm2);
  if (!std::isfinite(least) || !(least > 0.0))
    throw UsageError("reach_radius_mm", "must be given: the faces have no area to derive it from");
  // In steps that people can read, and repeat.
  const double radius = 0.5 * std::sqrt(least) / job.radius.slenderness_max;
  const double step = std::pow(10.0, std::floor(std::log10(radius)) - 1.0);
  return std::max(1.0, std::round(radius / step)) * step;
}

void read_faces(DesignResult& result) {
  const DesignJob& job = result.job;
  Part part = read_part(job.part.file, job.part.unit);
  result.part_sha256 = part.sha256;
  split_faces(part, job.part.faces);
  const std::vector<int> faces = parse_face_list(part, job.part.faces);
  for (const int face : faces) result.faces.push_back(part.face_id(face));
  result.equal = equal_faces(part, faces, kEqualShare * job.tolerance_mm);
  result.reach_radius_mm = job.judge.reach_radius_mm ? *job.judge.reach_radius_mm : usual_reach(part, faces, job);
}

/// Of all that is read beside the part; the catalogue, too, where it is not named.
std::string stamp_of_files(const DesignJob& job) {
  std::string all;
  for_each_input(job, [&](const FieldInfo& info, const std::string& word) {
    if (info.key != "part") all += hash_of_input(word);
  });
  if (job.source != "fit" && !job.choice.catalogue) all += hash_of_input(catalogue_folder({}));
  return all.empty() ? all : sha256(all);
}

ToolSet choice_of(const DesignResult& result) {
  SetProblem problem;
  problem.tools = static_cast<int>(result.tools.size());
  problem.faces = static_cast<int>(result.faces.size());
  problem.tool_minutes = result.job.tool_change_min;
  for (const DesignPair& pair : result.pairs)
    problem.minutes.push_back(pair.finishes() ? pair.minutes : kNeverFinishes);
  return result.job.tools > 0 ? choose_tools(problem, result.job.tools) : choose_fewest(problem);
}

}  // namespace

DesignResult run_design(const DesignJob& job, const BatchRun& run, const Progress& progress) {
  check(job);
  const ReadFiles inputs = read_files(job);
  const Unwritten unwritten(inputs);
  for (const char* table : {"design.json", "design.csv", "design.html"})
    inputs.require_not_written((fs::path(run.folder) / table).string());
  DesignResult result;
  result.job = job;
  result.job.part.file = fs::absolute(job.part.file).lexically_normal().string();
  read_faces(result);
  std::error_code error;
  fs::create_directories(run.folder, error);
  if (!fs::is_directory(run.folder)) throw InputError(run.folder + ": is not a folder and cannot be created");
  const std::string root = fs::absolute(run.folder).lexically_normal().string();
  BatchOptions batch{.run = run,
                     .from = fs::current_path().string(),
                     .part_sha256 = result.part_sha256,
                     .retries = 0,
                     .timeout_s = 0.0};
  batch.run.folder = root;
  const DesignFolder folder{root, stamp_of_files(job),
                            [&](const std::vector<BatchTask>& tasks) { return run_batch(tasks, batch, progress); }};
  find_candidates(result, folder);
  judge_pairs(result, folder, 0);
  result.choice = choice_of(result);
  if (result.choice.unfinished > 0 && !progress.stop()) {
    const std::size_t first_tool = result.tools.size();
    add_refitted(result, folder);
    judge_pairs(result, folder, first_tool);
    result.choice = choice_of(result);
  }
  result.complete = !progress.stop();
  write_file((fs::path(root) / "design.json").string(), design_json(result));
  write_file((fs::path(root) / "design.csv").string(), design_csv(result));
  write_file((fs::path(root) / "design.html").string(), design_html(result));
  return result;
}

}  // namespace flank::internal
