#include "flank/pipeline/judge/judge_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "flank/base/stopping.h"
#include "flank/error.h"
#include "flank/io/face_names.h"
#include "flank/limit/least_left.h"
#include "flank/path/turning.h"
#include "flank/pipeline/judge/find_buried.h"
#include "flank/setup/target_reach.h"
#include "flank/setup/targets.h"
#include "flank/tool/grown.h"
#include "flank/verify/judge_faces.h"
#include "flank/verify/sample_face.h"
#include "flank/verify/sample_mesh.h"

namespace flank::internal {
namespace {

bool holds(const std::vector<int>& faces, int face) {
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

/// Samples that a spacing may give on all faces together, which takes minutes, and that it has to give on a target.
constexpr double kMostSamples = 1e8, kFewestSamples = 300.0;
constexpr double kReachSpacings = 2.0;         ///< usual ones, of the samples that tell where a target is
constexpr std::size_t kTileSamples = 1 << 16;  ///< held at once, about 300 bytes each with all that is asked of them

/// How many samples a target may get.
struct SampleRange {
  double least = 0.0, most = 1e300;
};
/// Where no spacing is asked for. Proofs are made from the samples' cells, and a rib of millimetres on a part of half a metre would
/// have a few dozen; what fits into one tile is measured once, however often its coverage is looked at.
constexpr SampleRange kUsualSamples{2000.0, 0.9 * kTileSamples};

/// Refuses a spacing that is out of all proportion to the faces.
void require_sensible(const std::vector<std::unique_ptr<verify::Sampler>>& samplers, const std::vector<int>& faces,
                      const Setup& setup, double spacing) {
  double all = 0.0;
  for (std::size_t k = 0; k < samplers.size(); ++k) {
    const double here = samplers[k]->count();
    all += here;
    if (holds(setup.targets, faces[k]) && here < kFewestSamples)
      throw UsageError(fmt::format(
          "a sample spacing of {} mm gives about {:.0f} samples on {}; at least {:.0f} are required: {:.3g} mm",
          spacing, here, setup.part.face_id(faces[k]), kFewestSamples, spacing * std::sqrt(here / kFewestSamples)));
  }
  if (all > kMostSamples)
    throw UsageError(
        fmt::format("a sample spacing of {} mm gives about {:.3g} samples; at most {:.3g} are allowed: {:.3g} mm",
                    spacing, all, kMostSamples, spacing * std::sqrt(all / kMostSamples)));
}

/// Targets and check faces, in the order in which they are judged.
std::vector<int> judged_faces(const Setup& setup) {
  std::vector<int> judged = setup.targets;
  judged.insert(judged.end(), setup.checks.begin(), setup.checks.end());
  std::sort(judged.begin(), judged.end());
  return judged;
}

/// The judged faces as the judge asks for them.
class JudgedShapes {
 public:
  /// A target gets another spacing where its samples would be fewer or more than the range says.
  JudgedShapes(const Setup& setup, double spacing, const SampleRange& range) : faces_(judged_faces(setup)) {
    const Part& part = setup.part;
    meshes_.reserve(faces_.size());
    for (int face : faces_) {
      const bool target = holds(setup.targets, face);
      const double here = target ? spacing : 2.0 * spacing;
      const SampleRange wanted = target ? range : SampleRange();
      if (!part.is_mesh()) {
        const Face& value = part.faces[static_cast<std::size_t>(face)];
        shapes_.emplace_back(&value);
        add([&](double mm) { return verify::make_sampler(value, mm, target, kTileSamples); }, here, wanted);
        continue;
      }
      meshes_.push_back(verify::with_slivers_sliced(extract_mesh(part, {face}), here));
      shapes_.emplace_back(&meshes_.back());
      const auto make = [&](double mm) {
        return verify::make_sampler(part.face_id(face), meshes_.back(), mm, target, kTileSamples);
      };
      add(make, here, wanted);
    }
  }

  [[nodiscard]] const std::vector<int>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<std::unique_ptr<verify::Sampler>>& samplers() const { return samplers_; }
  /// With reachable shares, and with what proofs need, if they are asked for. The shapes, and the reach, must outlive
  /// what is returned.
  [[nodiscard]] std::vector<verify::JudgedFace> judged(const Setup& setup, const TargetReach* reach, bool proofs) const;

 private:
  template <class Make>
  void add(const Make& make, double spacing, const SampleRange& range) {
    std::unique_ptr<verify::Sampler> sampler = make(spacing);
    const double count = sampler->count(), wanted = std::clamp(count, range.least, range.most);
    // Their number goes with the square of the spacing.
    if (count > 0.0 && count != wanted) sampler = make(spacing * std::sqrt(count / wanted));
    samplers_.push_back(std::move(sampler));
  }

  std::vector<int> faces_;
  std::vector<TriangleMesh> meshes_;
  std::vector<FaceShape> shapes_;
  std::vector<std::unique_ptr<verify::Sampler>> samplers_;
};

std::vector<verify::JudgedFace> JudgedShapes::judged(const Setup& setup, const TargetReach* reach, bool proofs) const {
  std::vector<verify::JudgedFace> out;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const int face = faces_[k];
    const bool target = holds(setup.targets, face);
    const verify::Sampler* sampler = samplers_[k].get();
    const auto samples = [=](std::size_t tile, bool fine, const std::function<void(const FaceSamples&)>& use) {
      FaceSamples here = sampler->tile(tile);
      if (target && reach != nullptr) reach->fill(face, here);
      use(fine && target && reach != nullptr ? with_fine_border(*sampler, *reach, face, here) : here);
    };
    out.push_back({setup.part.face_id(face), target, sampler->size_mm(), sampler->tiles(), samples,
                   proofs ? &shapes_[k] : nullptr, setup.copies_of(face)});
  }
  return out;
}

/// Of the part, and all of the fixtures.
std::vector<UnjudgedFace> unread_faces(const Setup& setup) {
  std::vector<UnjudgedFace> all;
  for (const int face : setup.unread) all.push_back({setup.part.face_id(face), setup.part.left_out.at(face)});
  for (const Part& fixture : setup.fixtures)
    for (const auto& [face, why] : fixture.left_out) all.push_back({fixture.face_id(face), why});
  return all;
}

/// The largest of the faces that a strip says it machines, also where that is a copy of a target; of all targets where it names none.
double size_beside(const Strip& strip, const std::vector<verify::JudgedFace>& faces) {
  double named = 0.0, any = 0.0;
  const std::vector<std::string> items = face_list_items(strip.face);
  for (const verify::JudgedFace& face : faces) {
    if (face.target) any = std::max(any, face.size_mm);
    // A piece turns no more sharply than its face.
    if (std::any_of(items.begin(), items.end(), [number = parse_face_name(face.face).number](const std::string& item) {
          return parse_face_name(item).number == number;
        }))
      named = std::max(named, face.size_mm);
  }
  return named > 0.0 ? named : any;
}

/// How sharply the path turns, each strip beside what it machines.
std::optional<TurnFigure> turn_of(const Tool& tool, const Path& path, const std::vector<verify::JudgedFace>& faces) {
  if (path.pose_count() == 0 || !(size_beside({}, faces) > 0.0)) return {};
  std::map<std::string, double> windows;
  const Turning turn = sharpest_turn(path, tool.radial.axis_length(), [&](const Strip& strip) {
    const auto [known, is_new] = windows.try_emplace(strip.face);
    if (is_new) known->second = turn_window(size_beside(strip, faces));
    return known->second;
  });
  return TurnFigure{turn.angle_rad * 180.0 / std::numbers::pi, turn.strip,
                    path.strips[turn.strip].poses[turn.pose].tip};
}

/// Where the wanted face is. Of a sheet that is only checked nobody knows the side.
void move_out(double allowance_mm, FaceSamples& face) {
  if (!(allowance_mm > 0.0) || !(face.target || face.of_solid) || face.normals.size() != face.points.size()) return;
  for (std::size_t k = 0; k < face.points.size(); ++k) face.points[k] += allowance_mm * face.normals[k];
}

/// Which tool would reach what is left of the whole, and what is proved of tools like this one. Seldom asked: the samples are made again,
/// not kept beside the judge's own.
void say_what_is_left(const Setup& setup, const TargetReach& reach, double spacing, const Tool& tool, double wanted,
                      VerifyReport& report) {
  report.finer_reach = finer_reach(setup, reach, target_samples(setup, spacing), wanted);
  // A ball in the middle of the tool reaches that much less than the same of the tool that is judged.
  report.finer_reach->radius_mm = std::max(0.0, report.finer_reach->radius_mm - setup.allowance_mm);
  // A tool that is nowhere as thin as the ball of the request would leave more: what is proved is about tools like it.
  report.least_left = least_left(setup, report, std::max(report.reach_radius_mm, smallest_radius(tool)));
}

}  // namespace

Tool judged_tool(const Setup& setup, const Tool& tool) {
  return setup.allowance_mm > 0.0 ? grown(tool, setup.allowance_mm) : tool;
}

double default_spacing(double diagonal_mm) {
  // Half a millimetre is fine enough for blades of a hand's size; a metre of fan blade would be a million samples. A part of a
  // few millimetres takes as many as one of a hundred: what is proved is proved from the samples.
  return std::min(diagonal_mm / 300.0, std::max(0.5, diagonal_mm / 1000.0));
}

double coarse_spacing(const Setup& setup, double most_samples) {
  const double usual = default_spacing(setup.part.box.diagonal());
  const JudgedShapes shapes(setup, usual, {});
  double all = 0.0, fewest = 1e300;
  for (std::size_t k = 0; k < shapes.faces().size(); ++k) {
    const double here = shapes.samplers()[k]->count();
    all += here;
    if (holds(setup.targets, shapes.faces()[k])) fewest = std::min(fewest, here);
  }
  // Their number goes with the square of the spacing. Twice what is needed: it is an estimate. A small target in a large part
  // has too few at the usual spacing.
  const double times = std::min(std::max(1.0, all / most_samples), fewest / (2.0 * kFewestSamples));
  return usual * std::sqrt(times);
}

VerifyReport judge_job(const Setup& setup, const JudgeRequest& request, const Tool& tool, const Path& path,
                       DepthProof depth) {
  const Tool thick = judged_tool(setup, tool);
  const double usual = default_spacing(setup.part.box.diagonal());
  const JudgedShapes shapes(setup, request.sample_mm.value_or(usual),
                            request.sample_mm ? SampleRange() : kUsualSamples);
  if (request.sample_mm) require_sensible(shapes.samplers(), shapes.faces(), setup, *request.sample_mm);
  const double radius = request.reach_radius_mm.value_or(smallest_radius(tool));
  // A tool that is none (a fit that failed) has nothing to reach with.
  std::optional<TargetReach> reach;
  std::vector<BuriedStrip> buried;
  if (radius > 0.0) {
    const std::vector<FaceSamples> samples = target_samples(setup, kReachSpacings * usual);
    reach.emplace(setup, ReachBall{radius + setup.allowance_mm, request.reach_radius_mm.has_value()}, samples);
    buried = find_buried(setup, thick, path, samples);
  }
  stop_here();
  JudgeOptions options;
  options.tolerance_mm = setup.tolerance_mm;
  options.depth = request.sample_mm ? DepthProof::kSampled : depth;
  const std::vector<verify::JudgedFace> judged =
      shapes.judged(setup, reach ? &*reach : nullptr, depth == DepthProof::kProved);
  VerifyReport report =
      verify::judge_faces(thick, path, judged, options, {request.least_coverage, request.least_whole.value_or(0.0)});
  report.reach_radius_mm = radius;
  report.allowance_mm = setup.allowance_mm;
  const double wanted = request.least_whole.value_or(request.least_coverage);
  // Of a draft nobody asks.
  if (reach && depth == DepthProof::kProved && report.coverage < wanted)
    say_what_is_left(setup, *reach, kReachSpacings * usual, tool, wanted, report);
  if (request.most_turn_deg > 0.0) report.turn = turn_of(tool, path, judged);
  report.buried = std::move(buried);
  report.sheet_sides = setup.sides;
  if (!report.buried.empty()) report.verdict = Verdict::kOvercut;
  report.unread_faces = unread_faces(setup);
  if (!report.unread_faces.empty() && report.verdict == Verdict::kPass) report.verdict = Verdict::kUnproved;
  return report;
}

VerifyReport judge_cuts(const Setup& setup, const Tool& tool, const Path& path) {
  const Tool thick = judged_tool(setup, tool);
  const double usual = default_spacing(setup.part.box.diagonal());
  std::vector<BuriedStrip> buried = find_buried(setup, thick, path, target_samples(setup, kReachSpacings * usual));
  Setup checked = setup;
  checked.checks = judged_faces(setup);
  checked.targets.clear();
  const JudgedShapes shapes(checked, usual, {});
  JudgeOptions options;
  options.tolerance_mm = setup.tolerance_mm;
  VerifyReport report = verify::judge_faces(thick, path, shapes.judged(checked, nullptr, true), options);
  report.allowance_mm = setup.allowance_mm;
  report.buried = std::move(buried);
  if (!report.buried.empty()) report.verdict = Verdict::kGouge;
  return report;
}

ProgramStock judge_stock(const Setup& setup, const TrochoidJob& job, const Tool& tool, const Path& path,
                         const std::vector<HalfSpace>& blank, double most_triangles) {
  const double spacing = default_spacing(setup.part.box.diagonal());
  ProgramStockOptions options;
  options.cell_mm = job.cycles.stock_cell_mm;
  options.most_engagement_deg = job.cycles.most_engagement_deg;
  options.tolerance_mm = setup.tolerance_mm;
  options.most_triangles = most_triangles;
  std::vector<FaceSamples> samples = judge_samples(setup, spacing, 2.0 * spacing);
  for (FaceSamples& face : samples) move_out(setup.allowance_mm, face);
  return replay_program(tool, path, blank, std::move(samples), options);
}

}  // namespace flank::internal
