#include "flank/redesign/run_redesign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/fit/lengthen.h"
#include "flank/io/cad/write_step.h"
#include "flank/io/text/json_input.h"
#include "flank/job/input_files.h"
#include "flank/job/redesign_fields.h"
#include "flank/manifest/kept_inputs.h"
#include "flank/pipeline/finish.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/pipeline/run_fit.h"
#include "flank/pipeline/run_journal.h"
#include "flank/pipeline/search/fit_search.h"
#include "flank/redesign/nearest_envelope.h"
#include "flank/setup/read_setup.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

/// Of the size: how near the spline is to the exact envelope, and how far the joined poses of the exactness check may be off the
/// motion. Both are well below what counts as exact.
constexpr double kSplineShare = 5e-8, kChordShare = 2e-8;
constexpr int kExtensions = 3;
constexpr double kExtensionShare = 0.03, kRunOnShare = 0.02;
constexpr std::size_t kGuideLines = 60;
constexpr double kGuideOverrun = 0.02;  ///< of the way that the face needs: so much more of the motion is run

std::vector<double> parse_heights(const std::string& text) {
  std::vector<double> heights;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    std::size_t used = 0;
    double value = -1.0;
    try {
      value = std::stod(word, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != word.size() || !(value >= 0.0 && value <= 100.0))
      throw UsageError("heights", text, "expected percentages from 0 to 100, as 10,50,90");
    heights.push_back(value);
  }
  return heights;
}

FitJob fit_job(const RedesignJob& job) {
  FitJob fit;
  fit.part = job.part;
  fit.tool = job.tool;
  fit.radius = job.radius;
  fit.obstacles.check_faces = job.check_faces;
  fit.obstacles.ignore_faces = job.ignore_faces;
  fit.tolerance_mm = job.tolerance_mm;
  fit.strips = 1;
  fit.effort = job.effort;
  return fit;
}

/// Whole faces of a CAD file can be given another surface.
void require_whole_faces(const Setup& setup, const RedesignJob& job) {
  if (setup.part.is_mesh())
    throw InputError(job.part.file +
                     ": is a mesh; expected a CAD file (STEP, IGES or BREP), whose faces can be replaced");
  for (const int face : setup.targets)
    if (setup.part.face_id(face) != "F" + std::to_string(face + 1))
      throw UsageError("faces", job.part.target_text(),
                       "expected whole faces, as F1,F3; a piece of a face cannot be replaced");
  if (!setup.part.left_out.empty())
    throw InputError(job.part.file + ": faces of it could not be read, so the part cannot be written with another one");
}

/// One motion for each face, each face apart from the others.
void require_one_motion_each(const FitSearch& search, const RedesignJob& job) {
  if (search.fit.motions.empty() || !search.wound.empty())
    throw InputError(job.part.file + ": no motion of one pass was found on " + job.part.target_text());
  for (const TargetGroup& group : search.targets)
    if (group.indices.size() != 1)
      throw UsageError("faces", group.faces,
                       "these faces share borders; expected faces apart, each with a pass of its own");
  std::vector<int> motions(search.targets.size(), 0);
  for (const std::size_t g : search.group_of_motion) ++motions[g];
  for (std::size_t g = 0; g < motions.size(); ++g)
    if (motions[g] != 1) throw InputError(search.targets[g].faces + ": no motion of one pass was found on this face");
}

/// What is found on the way, in the order of the motions.
struct Search {
  FitSearch fit;
  std::vector<const TargetGroup*> groups;  ///< of each motion
  std::vector<FaceBorders> borders;
};

Search search_start(const RedesignJob& job, const FitJob& fit, const Setup& setup, const Progress& progress) {
  Search search;
  const ToolSpec spec = parse_tool_spec(job.tool.spec);
  search.fit = search_fit(fit, setup, spec, progress);
  stop_here();
  require_one_motion_each(search.fit, job);
  for (std::size_t m = 0; m < search.fit.fit.motions.size(); ++m) {
    search.groups.push_back(&search.fit.targets[search.fit.group_of_motion[m]]);
    const TargetGroup& group = *search.groups.back();
    search.borders.push_back(
        find_borders(setup.part, group.indices.front(), *group.target, search.fit.fit.motions[m], search.fit.fit.tool));
  }
  return search;
}

/// How low each face's surface may lie, if a thickness is asked for.
std::vector<AtPoint> thickness_limits(const Setup& setup, const Search& search, const RedesignJob& job,
                                      const std::shared_ptr<const Opposite>& opposite) {
  std::vector<AtPoint> limits;
  if (!job.thickness_min_mm) return limits;
  bool any = false;
  for (const TargetGroup* group : search.groups) {
    const int face = group->indices.front();
    const Target* target = group->target.get();
    // Where both sides change, each has half of what there is to lose.
    const double share = search.groups.size() > 1 ? 0.5 : 1.0;
    limits.push_back([=, least = *job.thickness_min_mm](const Vec3& p) {
      const double thickness = opposite->thickness(face, p, target->closest(p).normal, false);
      if (thickness <= 0.0) return -std::numeric_limits<double>::max();
      return -share * std::max(0.0, thickness - least);
    });
    for (const SurfaceSample& sample : target->samples(0.1 * target->diagonal()))
      any = any || limits.back()(sample.point) > -std::numeric_limits<double>::max();
  }
  if (!any)
    throw UsageError("thickness_min_mm", fmt::format("{}", *job.thickness_min_mm),
                     "nothing lies opposite of " + job.part.target_text() + " in " + setup.part.file);
  return limits;
}

NearestProblem problem_of(const RedesignJob& job, const Setup& setup, const Search& search) {
  NearestProblem problem;
  const FlankFitResult& fit = search.fit.fit;
  for (const TargetGroup* group : search.groups) {
    problem.start.targets.push_back(group->target.get());
    problem.start.obstacles.push_back(group->obstacles.get());
  }
  problem.start.motions = fit.motions;
  problem.start.tool = fit.tool;
  problem.start.free_tool = search.fit.tool.free();
  problem.start = evenly_run(problem.start, {.motion = kExtensionShare, .top = kExtensionShare});
  problem.bounds = search.fit.options.bounds;
  problem.reach = reach_of(search.fit.options);
  problem.tolerance_mm = setup.tolerance_mm;
  problem.largest = job.nearest == "largest";
  const std::vector<WeightRequest> requests = job.weight ? parse_weights(*job.weight) : std::vector<WeightRequest>{};
  for (std::size_t k = 0; k < search.groups.size(); ++k) {
    const auto weights =
        std::make_shared<FaceWeights>(requests, search.borders[k], std::sqrt(search.groups[k]->target->area()));
    problem.weight.push_back([weights](const Vec3& p) { return weights->at(p); });
  }
  problem.least =
      thickness_limits(setup, search, job, std::make_shared<Opposite>(setup.part, std::vector<ChangedFace>{}));
  return problem;
}

/// The surfaces that these motions leave, or none with the reason: the first face that is not reached.
std::vector<ChangedFace> surfaces_of(const NearestEnvelope& nearest, const Setup& setup, const Search& search,
                                     std::string& why) {
  std::vector<ChangedFace> changed;
  for (std::size_t k = 0; k < search.groups.size(); ++k) {
    const TargetGroup& group = *search.groups[k];
    const RuledMotion& motion = nearest.draft.motions[k];
    std::optional<MillableSurface> surface =
        millable_surface(motion, nearest.draft.tool, *group.target, kSplineShare * group.target->diagonal(), why);
    if (!surface) {
      why = group.faces + ": cannot be redesigned: " + why;
      return {};
    }
    const int face = group.indices.front();
    changed.push_back({face, setup.part.face_id(face), make_target({setup.part.faces[static_cast<std::size_t>(face)]}),
                       std::move(*surface), search.borders[k], motion.pose(0.5).axis});
  }
  return changed;
}

PlacesAtEnds places_at_ends(const std::vector<ChangedFace>& changed) {
  PlacesAtEnds all;
  for (const ChangedFace& face : changed) all.add(face.surface.at_ends);
  return all;
}

/// An envelope and the surfaces that it leaves.
struct Reached {
  NearestEnvelope nearest;
  std::vector<ChangedFace> changed;  ///< empty: a face is not reached
  PlacesAtEnds ends;
};

/// The motions as they were found, or run on at both ends where fewer places are left to these then.
Reached reached_by(const NearestEnvelope& found, const Setup& setup, const Search& search, std::string& why) {
  Reached best;
  for (const double share : {0.0, kRunOnShare, 2.0 * kRunOnShare}) {
    Reached next{found, {}, {}};
    if (share > 0.0) next.nearest.draft = run_on(found.draft, share);
    next.changed = surfaces_of(next.nearest, setup, search, why);
    next.ends = places_at_ends(next.changed);
    const bool better = best.changed.empty() || next.ends.count() < best.ends.count();
    if (better && !next.changed.empty()) best = std::move(next);
    if (!best.changed.empty() && best.ends.count() == 0) break;
  }
  return best;
}

/// The nearest envelope that reaches past the borders of all faces. Where it does not at first, or where an end of a motion or of the tool
/// leaves a place, motions and tool are lengthened, and fitted again; the best of these.
Reached reaching(NearestProblem problem, const Setup& setup, const Search& search, const Progress& progress) {
  std::string why;
  Reached best;
  for (int round = 0; round <= kExtensions && (best.changed.empty() || best.ends.count() > 0); ++round) {
    const NearestEnvelope nearest = nearest_envelope(problem, progress);
    stop_here();
    Reached next = reached_by(nearest, setup, search, why);
    // A tip is lengthened where it is at fault alone: beside a wall there is seldom room. After a step that was too short, twice as much.
    const double tip = next.ends.at_tip > 0 ? std::ldexp(kExtensionShare, round) : 0.0;
    problem.start = evenly_run(nearest.draft, {.motion = kExtensionShare, .top = kExtensionShare, .tip = tip});
    const bool better = best.changed.empty() || next.ends.count() < best.ends.count();
    if (!next.changed.empty() && better) best = std::move(next);
  }
  if (best.changed.empty()) throw InputError(why);
  return best;
}

/// Tool and motions as a result of a fit, judged against the faces as they were.
void add_result(const Setup& setup, const FitJob& job, const Search& search, const NearestEnvelope& nearest,
                Redesign& out) {
  Result& result = out.result;
  result.job = job;
  result.inputs = input_stamps(job);
  result.part_sha256 = setup.part.sha256;
  result.tool = found_tool(parse_tool_spec(job.tool.spec), nearest.draft.tool, job.obstacles);
  result.motions = nearest.draft.motions;
  result.plan = fit_summary(search.fit.fit);
  result.diagonal_mm = search.groups.front()->target->diagonal();
  Stopwatch watch(result);
  const ClearanceScene scene = make_clearance_scene(setup, job.obstacles, false, result.notes);
  std::vector<StripSurface> surfaces = add_strips(setup.tolerance_mm, search.groups, result);
  judge_result(setup, scene, std::move(surfaces), result, watch);
  result.notes.emplace_back(
      "the verdict compares with the face as it was; this tool and motion machine the redesigned one on purpose");
}

/// The new faces into the part; the texts of the files.
void join(const Setup& setup, const std::vector<ChangedFace>& changed, Redesign& out) {
  std::vector<NewSurface> surfaces;
  std::vector<Face> alone;
  for (const ChangedFace& face : changed) {
    const MillableSurface* surface = &face.surface;
    surfaces.push_back({face.index, surface->surface, [surface](const Vec3& p) { return surface->nearest(p); }});
    Face whole;
    whole.id = face.id;
    whole.surface = surface->surface;
    whole.reversed = surface->reversed;
    alone.push_back(std::move(whole));
  }
  ReplacedFaces replaced = replace_faces(setup.part.file, setup.part.format, out.job.part.unit, surfaces);
  out.not_joined = replaced.why;
  if (replaced.why.empty()) {
    out.step = std::move(replaced.step);
    out.gap_mm = std::move(replaced.gap_mm);
    out.moved_mm = std::move(replaced.moved_mm);
    for (const Face& face : replaced.faces) out.new_ids.push_back(face.id);
    alone = std::move(replaced.faces);
  }
  out.faces_step = faces_to_step("face", {{"face", alone}});
}

/// The judge on the part as it was written, with the tool and the whole motions, at a millionth of the size.
Exactness exactness(const Redesign& redesign, const std::vector<ChangedFace>& changed, const std::string& file) {
  Exactness exact;
  exact.tolerance_mm = kExactOfSize * changed.front().old->diagonal();
  FitJob job = fit_job(redesign.job);
  job.part = {};
  job.part.file = file;
  job.part.faces.clear();
  for (const std::string& id : redesign.new_ids) job.part.faces += (job.part.faces.empty() ? "" : ",") + id;
  std::vector<std::string> ignored;
  ObstacleRequest none;
  const Setup setup = read_setup(job.part, none, exact.tolerance_mm, ignored);
  Path path;
  for (const RuledMotion& motion : redesign.result.motions) {
    SamplingOptions options;
    options.chord_tolerance_mm = kChordShare * changed.front().old->diagonal();
    path.strips.push_back({});
    path.strips.back().id = static_cast<int>(path.strips.size());
    path.strips.back().poses = sample_motion(motion, options).poses;
  }
  const VerifyReport report = judge_job(setup, job.judge, redesign.result.tool, path, DepthProof::kSampled);
  exact.share = report.coverage;
  exact.overcut_mm = report.overcut_mm;
  exact.left_mm = report.undercut_mm;
  return exact;
}

/// Axes of a motion, from where the face begins to where it ends, as a start for a fit of the answer.
std::string guide_text(const RuledMotion& motion, const MillableSurface& surface) {
  std::string text;
  const double more = kGuideOverrun * (surface.used_to_t - surface.used_from_t);
  const double from = std::max(0.0, surface.used_from_t - more), to = std::min(1.0, surface.used_to_t + more);
  for (std::size_t k = 0; k < kGuideLines; ++k) {
    const Pose pose = motion.pose(from + (to - from) * static_cast<double>(k) / (kGuideLines - 1));
    for (const Vec3& p : {pose.tip, pose.at(motion.axis_length)})
      for (int i = 0; i < 3; ++i) text += exact_number(p[i]) + " ";
    text += "\n";
  }
  return text;
}

void tell_thickness(const RedesignJob& job, Redesign& out) {
  if (!job.thickness_min_mm) return;
  for (const FaceTables& face : out.faces)
    for (const DeviationPoint& p : face.points) {
      if (p.thickness_before_mm <= 0.0 || p.thickness_after_mm <= 0.0) continue;
      const double least = std::min(*job.thickness_min_mm, p.thickness_before_mm);
      out.thickness_missed_mm = std::max(out.thickness_missed_mm, least - p.thickness_after_mm);
    }
}

void write_and_check(const std::vector<ChangedFace>& changed, const Setup& setup, const std::string& output,
                     Redesign& out) {
  std::error_code error;
  fs::create_directories(output, error);
  if (!fs::is_directory(output)) throw InputError(output + ": is not a folder and cannot be created");
  out.solids_before = check_solids(setup.part.file, setup.part.format, out.job.part.unit).valid;
  if (out.step.empty()) return;
  const std::string file = fs::absolute(fs::path(output) / "redesigned.step").lexically_normal().string();
  write_file(file, out.step);
  out.checked = check_solids(file, "STEP", {});
  out.exact = exactness(out, changed, file);
}

}  // namespace

Redesign run_redesign(const RedesignJob& job, const std::string& output, const Progress& progress) {
  check_fields(job);
  check_radius(job.radius);
  const std::vector<double> heights = parse_heights(job.heights);
  if (job.weight) (void)parse_weights(*job.weight);
  const ReadFiles inputs = read_files(job);
  const Unwritten unwritten(inputs);
  require_inputs_kept(
      inputs, output,
      {"redesigned.step", "face.step", "guide.txt", "deviation.csv", "sections.csv", "redesign.json", "redesign.txt"});
  Redesign out;
  out.job = job;
  FitJob fit = fit_job(job);
  progress.step("read", 0.0);
  const Setup setup = read_setup(job.part, fit.obstacles, job.tolerance_mm, out.notes);
  require_whole_faces(setup, job);
  fit.tolerance_mm = out.tolerance_mm = setup.tolerance_mm;
  out.part_sha256 = setup.part.sha256;
  const Search search = search_start(job, fit, setup, progress.part(0.02, 0.6));
  progress.step("redesign", 0.6);
  const auto [nearest, changed, ends] =
      reaching(problem_of(job, setup, search), setup, search, progress.part(0.6, 0.8));
  for (const ChangedFace& face : changed) {
    out.largest_c = std::max(out.largest_c, face.surface.largest_c);
    out.surface_error_mm.push_back(face.surface.deviation_mm);
  }
  progress.step("verify", 0.8);
  add_result(setup, fit, search, nearest, out);
  const Opposite opposite(setup.part, changed);
  for (const ChangedFace& face : changed) out.faces.push_back(face_tables(setup.part, face, opposite, heights));
  tell_thickness(job, out);
  join(setup, changed, out);
  if (changed.size() == 1) out.guide = guide_text(nearest.draft.motions.front(), changed.front().surface);
  write_and_check(changed, setup, output, out);
  return out;
}

void write_redesign(const Redesign& redesign, const std::string& output) {
  write_result(redesign.result, output);
  const auto in = [&](const char* name) { return (fs::path(output) / name).string(); };
  write_file(in("face.step"), redesign.faces_step);
  if (!redesign.guide.empty()) write_file(in("guide.txt"), redesign.guide);
  write_file(in("deviation.csv"), deviation_csv(redesign));
  write_file(in("sections.csv"), sections_csv(redesign));
  write_file(in("redesign.json"), redesign_json(redesign));
  write_file(in("redesign.txt"), redesign_text(redesign));
}

}  // namespace flank::internal
