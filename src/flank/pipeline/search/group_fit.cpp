#include "flank/pipeline/search/group_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "flank/base/journal.h"
#include "flank/fit/fit_record.h"
#include "flank/fit/rank.h"
#include "flank/fit/rejected.h"
#include "flank/pipeline/search/out_of_reach.h"
#include "flank/pipeline/search/stiff_fit.h"
#include "flank/pipeline/search/strip_gain.h"

namespace flank::internal {
namespace {

/// Keeps the better of two results, and what was tried for both; one without a motion is none.
void keep_better(FlankFitResult& best, FlankFitResult&& other, const FlankFitOptions& options) {
  if (other.motions.empty()) return;
  if (best.motions.empty() || is_better(other.after, best.after, options)) std::swap(best, other);
  add_rejected(best, other, options.bounds);
}

/// Of the face, before the last passes, which rarely gain more than a tenth: a strip more is tried instead.
constexpr double kPromising = 0.85;

/// What covers less than this is beaten without a last look, which hardly makes it cover more.
double least_to_look_at(const FlankFitResult& best, const FlankFitOptions& options) {
  constexpr double kLookGains = 0.01;  // of the face
  const bool sound = best.closely_measured && is_clean(best.after, options.tolerance_mm) && is_steady(best.after);
  return sound ? std::max(kPromising, best.after.at_tolerance - kLookGains) : kPromising;
}

/// The last look at a result that went without and was not beaten.
FlankFitResult closely_measured(FlankFitResult best, const Target& target, const ToolModel& tool,
                                const FlankFitOptions& options, const Progress& progress) {
  if (best.closely_measured || best.motions.empty() || progress.stop()) return best;
  std::vector<FitTask> tasks;
  for (const RuledMotion& motion : best.motions) tasks.push_back({&target, motion, options.obstacles});
  return journaled(
      progress, "close check", [&] { return with_close_look(tasks, best, tool, options); }, best);
}

/// One row of the schedule of a search that may take as many strips as it needs.
struct Trial {
  int strips = 1;
  bool soft =
      false;  ///< with a tool that is more slender than the bounds allow, and all that one strip can do within them before
};

/// Cheap trials first: a softer tool costs several times as much as a few strips more.
constexpr std::array kSchedule = {Trial{1}, Trial{2}, Trial{3},  Trial{4},          Trial{1, true},
                                  Trial{6}, Trial{8}, Trial{10}, Trial{kMostStrips}};

/// All that is asked but the bound on slenderness, which is no demand.
bool meets_softly(const FlankFitResult& fit, double wanted, FlankFitOptions options) {
  options.bounds.slenderest = 1e300;
  return meets(fit.after, wanted, options);
}

/// One group with as many strips as its tolerance needs: the trials of the schedule, as long as what was found does not do, and strips gain
/// something or promise to.
class StripSearch {
 public:
  StripSearch(const Target& target, const ToolModel& tool, const FlankFitOptions& options, const GroupDemand& demand,
              double wanted)
      : target_(target),
        tool_(tool),
        options_(options),
        demand_(demand),
        wanted_(wanted),
        gain_(options.tolerance_mm, wanted, !options.search_without_obstacles) {}

  FlankFitResult run(const Progress& progress) {
    for (const Trial& trial : kSchedule) {
      if (trial.strips > demand_.most_strips || !is_worth(trial)) continue;
      const double here = 1.0 - rest_;  // nobody knows how many follow: each gets a half of what is left
      const Progress part = progress.part(here, 1.0 - (rest_ *= 0.5));
      trial.soft ? try_softly(part) : try_strips(trial, part);
      if (meets(best_.after, wanted_, options_) || (trial.soft && meets_softly(best_, wanted_, options_)) ||
          !goes_on_ || progress.stop())
        break;
    }
    last_try(progress);
    best_ = closely_measured(std::move(best_), target_, tool_, options_, progress);
    if (best_.motions.size() > 1)
      best_.notes.push_back(fmt::format("{} passes finish {:.1f} % (estimate), one pass {:.1f} %", best_.motions.size(),
                                        100.0 * best_.after.at_tolerance, 100.0 * one_covers_));
    return std::move(best_);
  }

 private:
  /// One strip that is far from doing it is not worth its last passes.
  [[nodiscard]] bool is_worth(const Trial& trial) const {
    constexpr double kFar = 0.5;  // of the face
    if (!trial.soft) return true;
    return best_.after.unheld <= 0.0 && options_.search_without_obstacles && one_covers_ >= kFar && demand_.soften;
  }

  void try_strips(const Trial& trial, const Progress& progress) {
    FlankFitOptions options = options_;
    options.strips = trial.strips;
    // Other ways cost as much as all before, and a strip more: with several strips they come last.
    options.search_without_obstacles = options_.search_without_obstacles && trial.strips == 1;
    options.least_coverage_for_last_passes = trial.strips < demand_.most_strips ? kPromising : 0.0;
    options.least_coverage_for_close_look = least_to_look_at(best_, options);
    FlankFitResult result = fit_automatic(target_, tool_, options, progress);
    if (trial.strips == 1) one_covers_ = result.after.at_tolerance;
    keep_better(best_, std::move(result), options_);
    goes_on_ = gain_.goes_on(best_);
  }

  void try_softly(const Progress& progress) {
    FlankFitOptions options = options_;
    options.strips = 1;
    FlankFitResult one = fit_automatic(target_, tool_, options, progress.part(0.0, 0.5));
    one_covers_ = std::max(one_covers_, one.after.at_tolerance);
    if (!meets(one.after, wanted_, options_) && !progress.stop())
      one = relax_stiffness_bounds(target_, tool_, options, std::move(one), progress.part(0.5, 1.0));
    keep_better(best_, std::move(one), options_);
  }

  /// The other ways that were left out on the way.
  void last_try(const Progress& progress) {
    if (!options_.search_without_obstacles || best_.motions.size() < 2 || best_.after.unheld > 0.0 ||
        covers(best_.after, wanted_, options_) || progress.stop())
      return;
    FlankFitOptions options = options_;
    options.strips = static_cast<int>(best_.motions.size());
    keep_better(best_, fit_automatic(target_, tool_, options, progress.part(1.0 - rest_, 1.0)), options_);
  }

  const Target& target_;
  const ToolModel& tool_;
  const FlankFitOptions& options_;
  const GroupDemand& demand_;
  double wanted_ = 1.0, one_covers_ = 0.0, rest_ = 1.0;
  StripGain gain_;
  bool goes_on_ = true;
  FlankFitResult best_;
};

/// One group: with the strips that were asked for, or with those that the tolerance needs (0). A strip more must not make
/// it worse: where several do not give what was asked, one is tried, too. Last, the bounds on stiffness give way.
FlankFitResult fit_group(const Target& target, const ToolModel& tool, FlankFitOptions options,
                         const GroupDemand& demand, double wanted, const Progress& progress) {
  const int strips = demand.strips;
  const auto done = [&](const FlankFitResult& result) {
    return meets(result.after, wanted, options) || progress.stop();
  };
  const double reached = reachable_share(target, options), held = holdable_share(target, options);
  if (std::min(reached, held) < kHardlyAny) {
    FlankFitResult hidden = fit_automatic(target, tool, scouting_options(options), progress);
    hidden.notes.push_back(reached < kHardlyAny ? out_of_reach_note(reached, options) : not_holdable_note(held));
    return hidden;
  }
  options.strips = std::max(1, strips);
  /// Of the progress: where one strip and where the lifted bounds begin.
  constexpr double kFirst = 0.6, kSoften = 0.7;
  const Progress first = progress.part(0.0, kFirst);
  FlankFitResult best = strips > 0 ? fit_automatic(target, tool, options, first)
                                   : StripSearch(target, tool, options, demand, wanted).run(first);
  if (strips > 1 && !done(best)) {
    options.strips = 1;
    keep_better(best, fit_automatic(target, tool, options, progress.part(kFirst, kSoften)), options);
  }
  // What facets keep from a motion no slender tool brings back, nor does it mend what covers all.
  const bool enough = done(best) || covers(best.after, wanted, options);
  if (enough || !options.search_without_obstacles || !demand.soften || best.after.unheld > 0.0) {
    note_slenderness(tool, options, best);
    return best;
  }
  options.strips = std::max<int>(1, static_cast<int>(best.motions.size()));
  return relax_stiffness_bounds(target, tool, options, std::move(best), progress.part(kSoften, 1.0));
}

/// The tool that was found, with nothing left open.
ToolModel given(const RadialFunction& found) {
  ToolModel tool;
  tool.make = [found](double, double) { return found; };
  tool.axis_length = found.axis_length();
  tool.radius = found.at(0.5 * found.axis_length()).r;
  return tool;
}

FlankFitOptions beside(const TargetGroup& group, FlankFitOptions options) {
  options.obstacles = group.obstacles.get();
  return options;
}

/// Fits of groups with one tool. Large groups decide what the tool is; small ones, as a blade's edges are, take it as it is.
class TogetherFit {
 public:
  TogetherFit(const std::vector<TargetGroup>& groups, const ToolModel& tool, const FlankFitOptions& options,
              const GroupDemand& demand)
      : groups_(groups), tool_(tool), options_(options), demand_(demand) {
    constexpr double kSmall = 0.1;  // of the largest group's area
    double largest = 0.0;
    for (const TargetGroup& group : groups) largest = std::max(largest, group.target->area());
    for (std::size_t g = 0; g < groups.size(); ++g)
      (groups[g].target->area() < kSmall * largest ? small_ : large_).push_back(g);
  }

  GroupFits run(const Progress& progress) {
    constexpr double kFirst = 0.25, kOneEach = 0.5, kLarge = 0.8;  // of the progress
    GroupFits fits;
    fits.fit = fit_one(large_[0], tool_, progress.part(0.0, kFirst));
    fits.group_of_motion.assign(fits.fit.motions.size(), large_[0]);
    if (fits.fit.motions.empty() || progress.stop()) return fits;
    if (large_.size() > 1) fits = fit_large(fits.fit, progress.part(kFirst, kOneEach), progress.part(kOneEach, kLarge));
    return small_.empty() || progress.stop() ? fits : with_small(fits, progress.part(kLarge, 1.0));
  }

 private:
  using FitOne = std::function<FlankFitResult(std::size_t group, const Progress& progress)>;

  [[nodiscard]] FlankFitResult fit_one(std::size_t g, const ToolModel& tool, const Progress& progress) const {
    return fit_group(*groups_[g].target, tool, beside(groups_[g], options_), demand_, demand_.wanted[g], progress);
  }

  /// One strip on each, polished together if that is needed; else as many as each takes.
  [[nodiscard]] GroupFits fit_large(const FlankFitResult& first, const Progress& one_each,
                                    const Progress& progress) const {
    constexpr double kFits = 0.5;  // of the progress
    const ToolModel found = given(first.tool);
    std::optional<GroupFits> one;
    if (demand_.strips == 0 && first.motions.size() == 1) {
      one = polished(first, one_each, [&](std::size_t g, const Progress& part) {
        FlankFitOptions own = beside(groups_[g], options_);
        own.search_without_obstacles = false;
        own.least_coverage_for_last_passes = 2.0;  // none: they come when all are polished
        return fit_automatic(*groups_[g].target, found, own, part);
      });
      if (progress.stop() || meets(one->fit.after, wanted(), options_)) return *one;
    }
    GroupFits all = polished(first, progress.part(0.0, kFits),
                             [&](std::size_t g, const Progress& part) { return fit_one(g, found, part); });
    return one && is_better(one->fit.after, all.fit.after, options_) ? *one : all;
  }

  /// The first group's motions and those that `fit` finds for each of the other large ones.
  [[nodiscard]] GroupFits polished(const FlankFitResult& first, const Progress& progress, const FitOne& fit) const {
    constexpr double kFits = 0.5;  // of the progress
    GroupFits fits;
    std::vector<FitTask> tasks;
    add(first, large_[0], tasks, fits);
    for (std::size_t k = 1; k < large_.size(); ++k)
      add(fit(large_[k], progress.part(0.0, kFits)), large_[k], tasks, fits);
    FlankFitOptions options = options_;
    options.enough_coverage = std::min(options.enough_coverage, wanted());
    fits.fit = fit_together(tasks, first.tool, tool_, options, progress.part(kFits, 1.0));
    return fits;
  }

  [[nodiscard]] GroupFits with_small(const GroupFits& large, const Progress& progress) const {
    const ToolModel found = given(large.fit.tool);
    GroupFits fits;
    std::vector<FitTask> tasks;
    for (std::size_t m = 0; m < large.fit.motions.size(); ++m) {
      const TargetGroup& group = groups_[large.group_of_motion[m]];
      tasks.push_back({group.target.get(), large.fit.motions[m], group.obstacles.get()});
    }
    fits.group_of_motion = large.group_of_motion;
    double may_miss = missed_area(large), left = 0.0;
    for (const std::size_t g : small_) left += groups_[g].target->area();
    for (const std::size_t g : small_) {
      const double area = groups_[g].target->area();
      const FlankFitResult fit = fit_small(g, found, 1.0 - may_miss / left, progress);
      const bool sound = is_clean(fit.after, options_.tolerance_mm) && is_steady(fit.after);
      if (sound) add(fit, g, tasks, fits);
      may_miss -= area * (sound ? 1.0 - fit.after.at_tolerance : 1.0);
      left -= area;
    }
    fits.fit = fit_as_found(tasks, large.fit.tool, tool_, options_);
    fits.fit.notes = large.fit.notes;
    fits.fit.rejected = large.fit.rejected;
    fits.fit.candidates = large.fit.candidates;
    return fits;
  }

  /// The area, mm^2, that small groups may leave: what the whole may miss, less what the large groups leave of it.
  [[nodiscard]] double missed_area(const GroupFits& large) const {
    double all = 0.0, of_large = 0.0;
    for (const TargetGroup& group : groups_) all += group.target->area();
    for (const std::size_t g : large_) of_large += groups_[g].target->area();
    return (1.0 - wanted()) * all - (1.0 - large.fit.after.at_tolerance) * of_large;
  }

  /// A small group as far as the whole needs it: its last percents cost as much as those of a large one, and are little of all.
  [[nodiscard]] FlankFitResult fit_small(std::size_t g, const ToolModel& found, double share,
                                         const Progress& progress) const {
    constexpr double kLeast = 0.5;  // of the group: less is not worth a strip
    const double wanted = std::clamp(share, kLeast, demand_.wanted[g]);
    FlankFitOptions own = beside(groups_[g], options_);
    own.least_coverage = std::min(own.least_coverage, wanted);
    own.enough_coverage = std::min(own.enough_coverage, wanted);
    return fit_group(*groups_[g].target, found, own, demand_, wanted, progress);
  }

  void add(const FlankFitResult& fit, std::size_t g, std::vector<FitTask>& tasks, GroupFits& fits) const {
    for (const RuledMotion& motion : fit.motions) {
      tasks.push_back({groups_[g].target.get(), motion, groups_[g].obstacles.get()});
      fits.group_of_motion.push_back(g);
    }
  }

  [[nodiscard]] double wanted() const { return *std::max_element(demand_.wanted.begin(), demand_.wanted.end()); }

  const std::vector<TargetGroup>& groups_;
  const ToolModel& tool_;
  const FlankFitOptions& options_;
  const GroupDemand& demand_;
  std::vector<std::size_t> large_, small_;  ///< indices of groups; large_ is not empty
};

}  // namespace

GroupFits fit_groups(const std::vector<TargetGroup>& groups, const ToolModel& tool, const FlankFitOptions& options,
                     const GroupDemand& demand, const Progress& progress) {
  if (groups.size() > 1) return TogetherFit(groups, tool, options, demand).run(progress);
  const FlankFitOptions own = beside(groups[0], options);
  FlankFitResult fit = fit_group(*groups[0].target, tool, own, demand, demand.wanted[0], progress);
  const std::vector<std::size_t> group_of_motion(fit.motions.size(), 0);
  return {std::move(fit), group_of_motion};
}

}  // namespace flank::internal
