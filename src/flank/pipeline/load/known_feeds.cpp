#include "flank/pipeline/load/known_feeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "flank/error.h"
#include "flank/machine/engagement_feed.h"
#include "flank/pipeline/load/path_loads.h"
#include "flank/setup/targets.h"
#include "flank/verify/finish_arcs.h"

namespace flank::internal {
namespace {

/// Of a dry run, mm/min, unless another one is given.
constexpr double kDryFeed = 1000.0;
constexpr double kPerMinute = 1.0 / 60.0, kDegree = std::numbers::pi / 180.0;
/// Samples of a target with stock left on it: of the part's diagonal, and the finest and coarsest, mm. Check faces are not asked.
constexpr double kStockShare = 1.0 / 300.0, kFinest = 0.05, kCoarsest = 0.5, kChecksShare = 0.1;

/// A cavity's cycles are planned for a limit of the engagement: there the feed is what was asked for.
void follow_engagement(const PostJob& request, double feed, const FolderEngagement& engagement, KnownFeeds& out) {
  if (engagement.largest.empty()) {
    out.notes.emplace_back("no engagement.json (flank verify writes it): the feed is the same everywhere");
    return;
  }
  const EngagementFeed rule{.feed = kPerMinute * feed,
                            .reference = engagement.limit_rad,
                            .most_feed = kPerMinute * request.most_feed_mm_min.value_or(kMostFeedFactor * feed)};
  out.slowness.clear();
  for (const std::vector<double>& strip : engagement.largest) {
    std::vector<double>& slowness = out.slowness.emplace_back();
    for (const double angle : strip) slowness.push_back(1.0 / feed_at(angle, rule));
  }
  out.notes.push_back(
      fmt::format("the feed follows the engagement: its thickest chip is that of {:g} mm/min at {:g} degrees, the feed "
                  "at most {:g} "
                  "mm/min",
                  feed, engagement.limit_rad / kDegree, 60.0 * rule.most_feed));
}

CuttingRequest cutting_request(const PostJob& request, const Tool& tool, double feed) {
  CuttingRequest out = usual_cutting(find_material(*request.material), *request.flutes, request.helix_deg * kDegree,
                                     largest_diameter(tool));
  out.spindle_rpm = *request.spindle_rpm;
  out.feed = kPerMinute * feed;
  out.most_feed = kPerMinute * request.most_feed_mm_min.value_or(kMostFeedFactor * feed);
  // The chip of the material, or that of the feed that is asked for where it is thinner.
  out.limits.chip_mm = std::min(out.limits.chip_mm, feed / (out.flutes * out.spindle_rpm));
  out.expected_chip_mm = out.limits.chip_mm;
  if (request.most_force_n) out.limits.force_n = *request.most_force_n;
  if (request.most_power_w) out.limits.power_w = *request.most_power_w;
  if (request.most_deflection_mm) out.limits.deflection_mm = *request.most_deflection_mm;
  return out;
}

}  // namespace

PathArcs engaged_arcs(const PathArcs& known, std::optional<double> finish_stock_mm, const Setup& setup,
                      const Tool& tool, const Path& path) {
  if (!known.heights.empty() || !finish_stock_mm) return known;
  const double diagonal = setup.part.box.diagonal(), spacing = std::clamp(kStockShare * diagonal, kFinest, kCoarsest);
  return finish_arcs(tool.radial, path, judge_samples(setup, spacing, kChecksShare * diagonal), *finish_stock_mm);
}

KnownFeeds known_feeds(const PostJob& request, const Setup& setup, const Tool& tool, const Path& path,
                       const FolderEngagement& engagement) {
  const double feed = request.feed_mm_min.value_or(kDryFeed);
  KnownFeeds out{.feed = kPerMinute * feed};
  out.slowness.resize(path.strips.size());
  if (request.speed != "feed") return out;
  if (request.material && !request.dry) {
    const PathArcs arcs = engaged_arcs(engagement.arcs, request.finish_stock_mm, setup, tool, path);
    if (!arcs.heights.empty()) {
      const CuttingRequest cutting = cutting_request(request, tool, feed);
      PathLoads loads = path_loads(tool, path, arcs, cutting);
      out.notes = load_notes(loads, path, cutting);
      out.slowness = std::move(loads.slowness);
      return out;
    }
    if (!(engagement.limit_rad > 0.0))
      out.notes.emplace_back(
          "no load is known: the feed is the same everywhere; give what roughing has left by `finish_stock`");
  }
  if (engagement.limit_rad > 0.0) follow_engagement(request, feed, engagement, out);
  return out;
}

void refuse_loads(const PostJob& request) {
  const auto refuse = [](bool given, const char* field) {
    if (given) throw UsageError(field, "needs a `material`");
  };
  refuse(request.finish_stock_mm.has_value(), "finish_stock_mm");
  refuse(request.most_force_n.has_value(), "most_force");
  refuse(request.most_power_w.has_value(), "most_power");
  refuse(request.most_deflection_mm.has_value(), "most_deflection_mm");
}

}  // namespace flank::internal
