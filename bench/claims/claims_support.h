// What the cases share: a scratch folder, a job from the file, the real error of a fit.
#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "claims/claims.h"
#include "flank/base/random.h"
#include "flank/envelope.h"
#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_perturb.h"
#include "flank/fit.h"
#include "flank/fit/coverage.h"
#include "flank/judge.h"
#include "flank/ruled_motion.h"
#include "flank/run.h"
#include "flank/target.h"
#include "part_file.h"

namespace flank::internal::bench {

inline std::string scratch(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / "flank_claims";
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

/// File of one of the real parts.
inline std::string real_part(const std::string& name) {
  return part_file(name, std::filesystem::path(scratch(name)).parent_path());
}

inline double seconds_of(const std::function<void()>& f) {
  const auto begin = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The fit as for a part of which nothing is known: radii open, tolerance 5e-5 of the diagonal.
inline FlankFitOptions open_options(double diagonal) {
  FlankFitOptions options;
  options.tolerance_mm = 5e-5 * diagonal;
  options.bounds.smallest = 0.01 * diagonal;
  options.bounds.largest = 0.15 * diagonal;
  return options;
}

/// The true motion of an example, off by 1e-2 of the diagonal.
inline RuledMotion start_off(const Example& example) {
  Random random(5);
  return perturb(example.truth->motions.front(), 0.01, example.diagonal_mm, random);
}

/// Largest error on a grid 3 times denser than the fit's, with fresh cold footpoints on `truth`.
inline double largest_error(const Target& truth, const FlankFitResult& fit) {
  std::vector<FitTask> tasks;
  for (const RuledMotion& motion : fit.motions) tasks.push_back({&truth, motion});
  return validate(tasks, fit.tool, 300, 90).largest_mm;
}

/// The judge over faces, from the motions sampled within `chord_mm`.
inline VerifyReport judge_fit(const std::vector<Face>& faces, const FlankFitResult& fit, double tolerance_mm,
                              double spacing_mm) {
  Tool tool;
  tool.radial = fit.tool;
  Path path;
  SamplingOptions sampling;
  sampling.chord_tolerance_mm = 0.002 * tolerance_mm;
  for (const RuledMotion& motion : fit.motions) {
    Strip strip;
    strip.id = static_cast<int>(path.strips.size()) + 1;
    strip.poses = sample_motion(motion, sampling).poses;
    path.strips.push_back(std::move(strip));
  }
  std::vector<FaceSamples> samples;
  for (const Face& face : faces) samples.push_back(sample_face(face, spacing_mm, true));
  JudgeOptions options;
  options.tolerance_mm = tolerance_mm;
  return judge(tool, path, samples, options);
}

}  // namespace flank::internal::bench
