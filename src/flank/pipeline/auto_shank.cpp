#include "flank/pipeline/auto_shank.h"

#include <fmt/format.h>

#include "flank/part.h"
#include "flank/setup/read_setup.h"
#include "flank/setup/shank_reach.h"

namespace flank::internal {
namespace {

/// A path that takes the shank may need a longer one: looked at so often.
constexpr int kMostTimes = 3;

}  // namespace

template <class Job>
Result with_auto_shank(const Job& job, const Progress& progress,
                       const std::function<Result(const Job&, const Progress&)>& run) {
  // Each plan is a run of its own, with steps of its own.
  const auto part_of = [&](double from, double to) {
    Progress part = progress.part(from, to);
    part.journal.reset();
    return part;
  };
  Job plain = job;
  plain.obstacles.shank = "none";
  plain.obstacles.shank_radius_mm.reset();
  Result found = run(plain, part_of(0.0, 0.4));
  std::vector<std::string> none;
  const Box3 box = read_setup(machined(job), job.obstacles, found.verify.tolerance_mm, none).part.box;
  Job with = job;
  with.obstacles.shank = "given";
  for (int k = 0; k < kMostTimes && found.complete && !found.path.strips.empty(); ++k) {
    const std::optional<double> before = with.obstacles.shank_length_mm;
    choose_shank(found.tool, found.path, box, with.obstacles);
    if (before && *with.obstacles.shank_length_mm <= *before) break;
    found = run(with, part_of(0.4 + 0.2 * k, 0.6 + 0.2 * k));
  }
  if (with.obstacles.shank_length_mm)
    found.notes.push_back(fmt::format(
        "the shank was chosen: diameter {:.4g} mm, {:g} mm above the flank, where it is out of the part; "
        "`shank_length_mm` gives another one, `shank` none leaves it out",
        found.tool.shank.empty() ? 0.0 : 2.0 * found.tool.shank.back().y(), *with.obstacles.shank_length_mm));
  return found;
}

template Result with_auto_shank<FitJob>(const FitJob&, const Progress&,
                                        const std::function<Result(const FitJob&, const Progress&)>&);
template Result with_auto_shank<CoverJob>(const CoverJob&, const Progress&,
                                          const std::function<Result(const CoverJob&, const Progress&)>&);
template Result with_auto_shank<TrochoidJob>(const TrochoidJob&, const Progress&,
                                             const std::function<Result(const TrochoidJob&, const Progress&)>&);

}  // namespace flank::internal
