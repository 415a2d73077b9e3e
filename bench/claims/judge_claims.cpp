// The judge on a real part: two blades on a sector of a hub, every other face a check surface.
#include "claims/claims_support.h"
#include "flank/pipeline/folder/target_reach.h"
#include "flank/setup/check_faces.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/targets.h"
#include "flank/threads.h"

namespace flank::internal::bench {
namespace {

constexpr double kSpacingMm = 0.25, kBoundSeconds = 5.0;
constexpr std::size_t kPoses = 1000;
constexpr int kThreads = 2;

/// The same way with steps halved, from the first one on, until there are `count` poses.
Strip with_poses(const Strip& strip, std::size_t count) {
  Strip out = strip;
  out.poses.clear();
  std::size_t missing = count - std::min(count, strip.poses.size());
  for (std::size_t i = 0; i < strip.poses.size(); ++i) {
    const Pose& here = strip.poses[i];
    out.poses.push_back(here);
    if (i + 1 == strip.poses.size() || missing == 0) continue;
    const Pose& next = strip.poses[i + 1];
    out.poses.push_back({0.5 * (here.tip + next.tip), (here.axis + next.axis).normalized()});
    --missing;
  }
  return out;
}

std::vector<Figure> sector() {
  FitJob job;
  job.strips = 1;
  job.part.file = real_part("r37_blisk_sector_2blades.step");
  job.part.faces = "F9";
  job.tolerance_mm = 0.1;
  job.avoid = false;
  Result outcome = run_fit(job, {});
  for (Strip& strip : outcome.path.strips) strip = with_poses(strip, kPoses);
  std::vector<std::string> notes;
  const Setup setup = read_setup(job.part, job.obstacles, job.tolerance_mm, notes);
  const int threads = thread_count();
  set_thread_count(kThreads);
  std::vector<FaceSamples> samples;
  VerifyReport report;
  const double sampling = seconds_of([&] { samples = judge_samples(setup, kSpacingMm, 2 * kSpacingMm); });
  const double judging =
      seconds_of([&] { report = judge(outcome.tool, outcome.path, samples, {.tolerance_mm = 0.1}); });
  const double reaching = seconds_of([&] {
    std::vector<FaceSamples> targets = target_samples(setup, kSpacingMm);
    const TargetReach reach(setup, {.radius_mm = 5.0}, targets);
    for (std::size_t k = 0; k < targets.size(); ++k) reach.fill(setup.targets[k], targets[k]);
  });
  set_thread_count(threads);
  std::size_t points = 0;
  for (const FaceSamples& face : samples) points += face.points.size();
  return {at_most("seconds, samples and judge, 2 threads", sampling + judging, kBoundSeconds),
          shown("of which the samples", sampling),
          shown("seconds, reachable share besides", reaching),
          shown("poses", static_cast<double>(outcome.path.pose_count())),
          shown("samples", static_cast<double>(points)),
          shown("deepest cut into other faces, mm", report.gouge_mm)};
}

}  // namespace

void add_judge_claims(std::vector<Claim>& claims) {
  claims.push_back({"judge/r37 blisk sector F9, 1000 poses", sector});
}

}  // namespace flank::internal::bench
