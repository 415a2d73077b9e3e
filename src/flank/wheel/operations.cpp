#include "flank/wheel/operations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "flank/base/atomic_file.h"
#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/text/json_input.h"
#include "flank/job/job_json.h"
#include "flank/path_file.h"
#include "flank/results/acceptance.h"
#include "flank/tool_file.h"
#include "flank/wheel/blade_copies.h"
#include "flank/wheel/guarded.h"
#include "flank/wheel/judge_whole.h"
#include "flank/wheel/perform.h"
#include "flank/wheel/shanks.h"

namespace flank::internal {
namespace {

using Names = std::vector<std::string>;

constexpr double kFitSampleMm = 1.0;    ///< of the judge of one side: the whole is judged closely at the end
constexpr double kFitSamples = 1000.0;  ///< that a small side has all the same
constexpr double kTaperDeg = 12.0;      ///< of the tool that is made for a wheel
constexpr double kCornerShare = 0.5;    ///< of what may be left, that the corners at the hub may take
constexpr double kShankHeights = 2.0;   ///< of the tallest blade: the shank that a side's fit keeps clear of the wheel
constexpr double kFilletShare = 0.97;   ///< of a root fillet's radius, that the tip has

/// The tip that a root fillet lets in; without fillets the largest one that leaves no more in the corners between sides and hub than a
/// share of what may be left: a ball of radius r leaves r - sqrt(2 r tolerance) on either side, about.
double tip_radius(WheelWork& work) {
  double fillet = 1e300, corners = 0.0, area = 0.0, height = 1e300;
  for (const WheelBlade& blade : work.sector.blades) {
    for (const RootFillet& one : blade.fillets) fillet = std::min(fillet, one.low_mm);
    corners += blade.area_mm2 / blade.height_mm;
    area += blade.area_mm2;
    height = std::min(height, blade.height_mm);
  }
  if (fillet < 1e300) return kFilletShare * fillet;
  for (const Target* hub : work.targets.of(work.roles.hub)) area += hub->area() / work.sectors_of_hub();
  const double band = kCornerShare * (1.0 - work.job.least_coverage) * area / (2.0 * corners),
               root = std::sqrt(2.0 * work.job.tolerance_mm), q = 0.5 * (root + std::sqrt(root * root + 4.0 * band));
  return std::clamp(q * q, 4.0 * work.job.tolerance_mm, 0.2 * height);
}

std::string tool_spec(WheelWork& work) {
  if (work.job.tool) return *work.job.tool;
  return fmt::format("cone:radius={:.2f},angle={}", std::floor(tip_radius(work) * 20.0) / 20.0, kTaperDeg);
}

/// A shank that nobody has given is as thick as the flank ends in the fits, and gets its length when all passes are known (give_shanks).
Tool without_chosen_shank(const std::string& spec, Tool tool) {
  if (!brings_body(spec)) tool.shank.clear(), tool.holder.clear();
  return tool;
}

double tallest_blade(const WheelWork& work) {
  double height = 0.0;
  for (const WheelBlade& blade : work.sector.blades) height = std::max(height, blade.height_mm);
  return height;
}

/// Of the judge of a fit. A side of which a few samples would tell is judged more closely.
double fit_spacing(WheelWork& work, const Names& side) {
  double spacing = std::max(kFitSampleMm, work.job.sample_mm.value_or(0.0));
  for (const Target* face : work.targets.of(side)) spacing = std::min(spacing, std::sqrt(face->area() / kFitSamples));
  return spacing;
}

FitJob side_job(WheelWork& work, const Names& side, const std::string& tool) {
  FitJob job;
  job.part = part_request(work, side);
  job.obstacles = obstacle_request(work);
  job.tolerance_mm = work.job.tolerance_mm;
  job.effort = work.job.effort;
  job.tool.spec = tool;
  if (!brings_body(tool)) job.obstacles.shank_length_mm = kShankHeights * tallest_blade(work);
  job.judge.reach_radius_mm = kOpenBall * work.job.tolerance_mm;
  job.judge.sample_mm = fit_spacing(work, side);
  return job;
}

/// What one side's fit found.
struct SideFit {
  Tool tool;
  Path path;
};

/// The share of what is open that a result finishes; half as much where it has another fault, for which passes are left out later. Nothing is
/// proved yet.
double worth(const Result& result) {
  const auto is_of_coverage = [](const Shortfall& reason) {
    return is_proof(reason) || reason.figure == figure_name(Figure::kCoverage);
  };
  const std::vector<Shortfall> reasons = result.acceptance().reasons;
  const bool sound = std::all_of(reasons.begin(), reasons.end(), is_of_coverage);
  return (sound ? 1.0 : 0.5) * result.verify.coverage_reachable;
}

/// The passes of a cover by the tool that a fit has found: it takes as many as the side needs, and a fit a few.
Result side_cover(const FitJob& fit, const std::string& tool, const Progress& progress) {
  CoverJob job;
  job.part = fit.part;
  job.obstacles = fit.obstacles;
  job.judge = fit.judge;
  job.tolerance_mm = fit.tolerance_mm;
  job.tool.spec = tool;
  return run_cover(job, progress);
}

/// By a fit, and by a cover where that leaves too much and a cover less. `tool`: a file for the tool in between.
Result side_result(const WheelWork& work, const FitJob& job, const std::string& tool, const Progress& progress) {
  constexpr double kFit = 0.6;    // of the progress
  constexpr double kGain = 0.02;  // of the side: more passes have more links
  Result found = run_fit(job, progress.part(0.0, kFit));
  if (!found.complete || found.path.pose_count() == 0 || worth(found) >= work.job.least_coverage) return found;
  write_tool(without_chosen_shank(job.tool.spec, found.tool), tool);
  Result cover = side_cover(job, tool, progress.part(kFit, 1.0));
  return !cover.complete || worth(cover) > worth(found) + kGain ? cover : found;
}

/// A fit takes minutes: what it found lies in a folder of its own, and is taken from there where the same is asked again.
SideFit side_fit(WheelWork& work, const Names& side, const std::string& spec, const Progress& progress) {
  namespace fs = std::filesystem;
  const FitJob job = side_job(work, side, spec);
  const fs::path folder = in_folder(work, "fits/" + face_list(side));
  const std::string key = sha256(work.part.sha256 + work.program + job_to_json(job) +
                                 (work.tool ? tool_to_json(*work.tool) : std::string()));
  const std::string mark = (folder / "key.txt").string(), tool = (folder / "tool.json").string(),
                    path = (folder / "path.json").string();
  if (fs::exists(mark) && fs::exists(tool) && fs::exists(path) && read_file(mark) == key)
    return {read_tool(tool), read_path(path)};
  fs::create_directories(folder);
  const Result result = side_result(work, job, tool, progress);
  if (!result.complete) throw InputError("stopped");
  if (result.path.pose_count() == 0) return {};
  write_tool(result.tool, tool);
  write_path(result.path, path);
  write_file(mark, key);
  // As a run that goes on from here has them.
  return {read_tool(tool), read_path(path)};
}

/// A side of the sector, and the equal one whose fit it takes, turned.
struct SideToFit {
  Names side, fitted;
  double turn_rad = 0.0;
};

/// A piece of a wheel lacks what stands behind its first blade, so the fit would not see it: the next main blade has that side, too, with
/// the whole channel before it.
std::vector<SideToFit> sides_to_fit(const WheelWork& work) {
  std::vector<SideToFit> out;
  std::size_t first_behind = 0;
  for (const WheelBlade& blade : work.sector.blades) {
    out.push_back({blade.ahead, blade.ahead});
    if (!blade.round()) out.push_back({blade.behind, blade.behind});
    if (&blade == &work.sector.blades.front()) first_behind = out.size() - 1;
  }
  const SectorChannel& last = work.sector.channels.back();
  if (!work.roles.whole) out[first_behind] = {last.second_path, last.second, -work.sector.pitch_rad};
  return out;
}

/// Each side of the sector by a fit of its own; all with the tool of the first one.
Path fitted_sides(WheelWork& work, const std::string& spec, const Progress& progress) {
  Path path;
  const std::vector<SideToFit> sides = sides_to_fit(work);
  const double count = static_cast<double>(sides.size());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    SideFit fit = side_fit(work, sides[k].fitted, work.tool ? tool_file(work) : spec,
                           progress.part(static_cast<double>(k) / count, (static_cast<double>(k) + 1.0) / count));
    if (fit.path.strips.empty()) {
      work.notes.push_back(face_list(sides[k].side) + ": no pass was found");
      continue;
    }
    if (!work.tool) {
      work.tool = without_chosen_shank(spec, fit.tool);
      write_tool(*work.tool, tool_file(work));
    }
    for (Strip& strip : fit.path.strips) {
      strip.face = face_list(sides[k].side);
      strip.poses = turned(strip.poses, work.roles.axis, sides[k].turn_rad);
      path.strips.push_back(std::move(strip));
    }
  }
  return path;
}

/// How far other blades are from turned copies of the sector's.
double difference_of(WheelWork& work, const std::vector<WheelSector>& sectors) {
  double most = 0.0;
  for (std::size_t k = 1; k < sectors.size(); ++k)
    for (std::size_t b = 0; b < std::min(sectors[k].blades.size(), work.sector.blades.size()); ++b) {
      const WheelBlade &own = work.sector.blades[b], &other = sectors[k].blades[b];
      const double turn = static_cast<double>(k) * work.sector.pitch_rad;
      most = std::max(
          {most, side_difference(work.targets.of(own.ahead), work.targets.of(other.ahead), work.roles.axis, turn),
           side_difference(work.targets.of(own.behind), work.targets.of(other.behind), work.roles.axis, turn)});
    }
  return most;
}

/// The sector's strips led onto the sides of the blades of another one.
void carry_over(WheelWork& work, const Path& path, const WheelSector& to, double turn, Path& out) {
  for (std::size_t b = 0; b < std::min(to.blades.size(), work.sector.blades.size()); ++b) {
    const WheelBlade &own = work.sector.blades[b], &other = to.blades[b];
    for (const bool ahead : {true, false}) {
      if (!ahead && own.round()) continue;
      const Names &from = ahead ? own.ahead : own.behind, &onto = ahead ? other.ahead : other.behind;
      for (const Strip& strip : strips_of(path, from)) {
        out.strips.push_back(carried_over(strip, work.tool->radial, work.targets.of(from), work.targets.of(onto),
                                          work.targets.of(work.roles.hub), work.roles.axis, turn));
        out.strips.back().face = face_list(onto);
      }
    }
  }
}

Path side_path(WheelWork& work, const std::string& spec, const Progress& progress) {
  Path path = fitted_sides(work, spec, progress);
  if (!work.tool || path.strips.empty()) return {};
  if (!work.equal()) {
    const std::vector<WheelSector> sectors = all_sectors(work.roles);
    const Path own = path;
    for (std::size_t k = 1; k < sectors.size(); ++k)
      carry_over(work, own, sectors[k], static_cast<double>(k) * work.sector.pitch_rad, path);
  }
  return guarded(work, lifted(work, path));
}

}  // namespace

WheelOperation side_operation(WheelWork& work, const Progress& progress) {
  WheelOperation operation{.id = "20", .kind = "side", .folder = "", .faces = work.sector.sides()};
  if (work.roles.whole) work.difference_mm = difference_of(work, all_sectors(work.roles));
  if (!work.equal())
    work.notes.push_back(
        fmt::format("the blades are not equal: rotated copies of the first differ by up to {:.3f} mm, so "
                    "each sector is planned separately",
                    work.difference_mm));
  const std::string spec = tool_spec(work);
  operation = perform(work, operation, job_to_json(side_job(work, operation.faces, spec)), [&] {
    Path path = side_path(work, spec, progress);
    if (path.strips.empty()) throw InputError("no pass was found on any side");
    return judged_path(work, operation.faces, std::move(path), work.job.least_coverage, Care::kDraft);
  });
  if (!operation.done) return operation;
  work.tool = without_chosen_shank(spec, read_tool(in_folder(work, operation.folder + "/tool.json")));
  write_tool(*work.tool, in_folder(work, "tools/T1.json"));
  take(work, operation);
  return operation;
}

}  // namespace flank::internal
