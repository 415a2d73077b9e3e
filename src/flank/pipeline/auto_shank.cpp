#include "flank/pipeline/auto_shank.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "flank/error.h"
#include "flank/pipeline/run_journal.h"
#include "flank/results/acceptance.h"
#include "flank/setup/shank_reach.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {
namespace {

bool fails_by(const Acceptance& acceptance, Figure figure) {
  return std::any_of(acceptance.reasons.begin(), acceptance.reasons.end(),
                     [&](const auto& reason) { return reason.figure == figure_name(figure); });
}

void note_chosen_shank(const Tool& tool, const ObstacleRequest& chosen, std::vector<std::string>& notes) {
  if (chosen.shank_length_mm)
    notes.push_back(chosen_shank_text(tool, chosen) +
                    "; `shank_length_mm` gives another one, `shank` none leaves it out");
}

Tool with_shank(const ObstacleRequest& obstacles, Tool flank) {
  equip_tool(obstacles, flank);
  return flank;
}

/// By how much the shank of a tool is farther from everything than it must be, and than `least_mm`; negative: it is not. None: something else
/// comes too near, which no thinner shank helps.
std::optional<double> room_beside(const ClearanceScene& scene, const Tool& tool, const Path& path, double least_mm) {
  double room = 1e300;
  for (const ClearanceFigure& figure : measure_clearance(scene, tool, path).figures) {
    if (figure.body == ToolBody::kShank)
      room = std::min(room, figure.clearance_mm - figure.bound_mm - std::max(figure.required_mm, least_mm));
    else if (!figure.kept)
      return std::nullopt;
  }
  return room;
}

/// The largest radius, to a hundredth of a millimetre, at which the chosen shank is clear. It grows from a thin one by as much as that has room
/// on all sides: how far a thing is away is told in a moment, and no thing that is farther than it grows is met.
std::optional<double> clear_radius(const ClearanceScene& scene, const Path& path, double slenderest, const Tool& flank,
                                   double least_mm, ObstacleRequest chosen) {
  constexpr int kMost = 8;           // times: the nearest place changes
  constexpr double kWhole = 100.0;   // radii to a hundredth of a millimetre
  constexpr double kThinnest = 0.1;  // of the first radius: thinner ones hold nothing (judge_hold)
  const double thick = with_shank(chosen, flank).shank.back().y();
  double radius = kThinnest * thick;
  for (int k = 0; k < kMost; ++k) {
    chosen.shank_radius_mm = radius;
    const std::optional<double> room = room_beside(scene, with_shank(chosen, flank), path, least_mm);
    if (!room || *room < 0.0) return std::nullopt;
    // The room of the thicker one is again known to the accuracy alone.
    const double spare = *room - 2.0 * scene.options.accuracy_mm;
    const double grown = std::floor(kWhole * std::min(thick, radius + spare)) / kWhole;
    if (!(grown > radius)) break;
    radius = grown;
  }
  chosen.shank_radius_mm = radius;
  if (!(stiffness(with_shank(chosen, flank)).slenderness <= slenderest)) return std::nullopt;
  return radius;
}

}  // namespace

void choose_clear_shank(const ClearanceScene& scene, const Path& path, const Box3& part, double slenderest,
                        const Tool& flank, ObstacleRequest& obstacles) {
  const bool open = !obstacles.shank_radius_mm;
  choose_shank(flank, path, part, obstacles);
  obstacles.shank = "given";
  if (!open) return;
  // A standard one is a little thinner than the flank.
  ObstacleRequest thick = obstacles;
  thick.shank_radius_mm.reset();
  const auto stiff = [&](const ObstacleRequest& request) {
    return stiffness(with_shank(request, flank)).slenderness <= slenderest;
  };
  if (!stiff(obstacles) && stiff(thick)) obstacles = thick;
  // Out of contact, or else no deeper than is allowed.
  for (const double least_mm : {0.0, -1e300}) {
    if (keeps_clear(scene, with_shank(obstacles, flank), path, least_mm)) return;
    const std::optional<double> radius = clear_radius(scene, path, slenderest, flank, least_mm, obstacles);
    if (radius) obstacles.shank_radius_mm = radius;
    if (radius) return;
  }
}

void lengthen_for_holder(const ClearanceScene& scene, const Path& path, const Box3& part,
                         const std::vector<Vec2>& outline, ObstacleRequest& obstacles, Tool& tool) {
  const auto with = [&](double length) {
    obstacles.shank_length_mm = length;
    Tool longer = with_shank(obstacles, tool);
    longer.holder = outline;
    for (Vec2& p : longer.holder) p.x() += longer.shank.back().x();
    return longer;
  };
  const auto clear = [&](double length) { return keeps_clear(scene, with(length), path); };
  double widest = 0.0;
  for (const Vec2& p : outline) widest = std::max(widest, p.y());
  double least = obstacles.shank_length_mm.value_or(0.0);
  // There the whole holder is out of the part's box: nothing of the part is nearer.
  double longest = std::max(least, std::ceil(shank_reach(tool, path, part, widest)));
  if (clear(least)) longest = least;
  while (longest - least > 1.0) {
    const double middle = std::floor(0.5 * (least + longest));
    (clear(middle) ? longest : least) = middle;
  }
  tool = with(longest);
}

void take_clear_shank(const ClearanceScene& scene, const Box3& part, double slenderest, ObstacleRequest& obstacles,
                      Result& result) {
  Tool flank = result.tool;
  flank.shank.clear();
  choose_clear_shank(scene, result.path, part, slenderest, flank, obstacles);
  equip_tool(obstacles, result.tool);
}

std::string default_shank(const ObstacleRequest& request, bool own_body) {
  const bool given = own_body || request.shank_length_mm || request.holder;
  return request.shank == "given" && !given ? "auto" : request.shank;
}

namespace {

/// The second plan; nothing if it was stopped, however early.
template <class Job>
std::optional<Result> whole_of(const ShankPlan<Job>& plan, const Job& job, KnownShank known, const Progress& progress) {
  try {
    Result result = plan(job, known, progress);
    if (result.complete) return result;
  } catch (const Stopped&) {  // what was found before stays
  }
  return std::nullopt;
}

/// The job once more, with what the first plan `made` of its obstacles.
template <class Job>
Job with_shank_of(const ObstacleRequest& made, const Job& job, KnownShank known) {
  Job with = job;
  with.obstacles = made;
  if (known == KnownShank::kLength) with.obstacles.shank_radius_mm = job.obstacles.shank_radius_mm;
  return with;
}

bool is_better(const Result& again, const Result& found) {
  const std::size_t now = again.acceptance().reasons.size(), before = found.acceptance().reasons.size();
  return now < before || (now == before && stiffness(again.tool).slenderness < stiffness(found.tool).slenderness);
}

/// What keeps a plan from being used, and a plan that knows of its shank may do better; nothing if there is none such.
std::optional<KnownShank> known_next(const Result& found, bool chosen, double slenderest) {
  const Acceptance acceptance = found.acceptance();
  // Where nothing at all could hold the tool there is no room for any shank.
  if (fails_by(acceptance, Figure::kClearance) && !fails_by(acceptance, Figure::kHold)) return KnownShank::kInTheWay;
  const bool slender = chosen && acceptance.reasons.empty() && stiffness(found.tool).slenderness > slenderest;
  return slender ? std::optional(KnownShank::kLength) : std::nullopt;
}

}  // namespace

template <class Job>
Result with_room_for_shank(const Job& job, bool always, double slenderest, const ShankPlan<Job>& plan,
                           const Progress& asked) {
  constexpr double kFirst = 0.8;  // of the progress
  constexpr int kMost = 2;        // plans more: an axis that leans otherwise has another way out of the part
  const Progress progress = with_journal(asked);
  Result found = plan(job, KnownShank::kNothing, progress.part(0.0, kFirst));
  const auto shank = [&]() -> const ObstacleRequest& { return std::get<Job>(found.job).obstacles; };
  const bool chosen = shank().shank_length_mm && !job.obstacles.shank_length_mm;
  for (int k = 0; k < kMost && found.complete && shank().shank_length_mm && (chosen || !always); ++k) {
    const std::optional<KnownShank> known = known_next(found, chosen, slenderest);
    if (!known) break;
    const std::optional<Result> again =
        whole_of(plan, with_shank_of(shank(), job, *known), *known, progress.part(kFirst, 1.0));
    if (!again) {
      found.complete = false;
      found.journal = progress.journal;
    } else if (is_better(*again, found)) {
      found = *again;
    } else {
      break;
    }
  }
  if (chosen) note_chosen_shank(found.tool, shank(), found.notes);
  return found;
}

template Result with_room_for_shank<FitJob>(const FitJob&, bool, double, const ShankPlan<FitJob>&, const Progress&);
template Result with_room_for_shank<CoverJob>(const CoverJob&, bool, double, const ShankPlan<CoverJob>&,
                                              const Progress&);
template Result with_room_for_shank<TrochoidJob>(const TrochoidJob&, bool, double, const ShankPlan<TrochoidJob>&,
                                                 const Progress&);

}  // namespace flank::internal
