#include "flank/pipeline/folder/judged_links.h"

#include <algorithm>

#include "flank/pipeline/folder/judge_job.h"
#include "flank/pipeline/folder/link_lift.h"
#include "flank/setup/targets.h"

namespace flank::internal {
namespace {

/// Of the samples from which a tool is lifted: of the part's diagonal.
constexpr double kLiftSampleShare = 1.0 / 100.0;
/// Each asks the judge once.
constexpr int kMostTries = 8;

/// Beginning and end of each strip, at both of which the tool goes on past it: at the beginning backwards.
std::vector<StripEnd> ends_of(const Path& path, double axis_length) {
  std::vector<StripEnd> ends;
  const auto middle = [&](const Pose& p) { return p.at(0.5 * axis_length); };
  for (const Strip& strip : path.strips) {
    const std::vector<Pose>& poses = strip.poses;
    const Pose &second = poses[std::min<std::size_t>(1, poses.size() - 1)],
               &before = poses[poses.size() > 1 ? poses.size() - 2 : 0];
    ends.push_back({poses.front(), middle(poses.front()) - middle(second)});
    ends.push_back({poses.back(), middle(poses.back()) - middle(before)});
  }
  return ends;
}

KnownPath with_leads(const KnownPath& strips, const LeadSearch& search, LinkOptions& options) {
  options.lead_at_start.clear();
  options.lead_at_end.clear();
  for (std::size_t k = 0; k < search.ends(); k += 2) {
    options.lead_at_start.push_back(search.lead(k));
    options.lead_at_end.push_back(search.lead(k + 1));
  }
  KnownPath linked{with_links(strips.path, options), {}};
  for (const std::vector<double>& known : strips.known) {
    linked.known.emplace_back();
    linked.known.push_back(known);
  }
  linked.known.emplace_back();
  return linked;
}

/// The end of a strip near which a link cuts: link k goes from the end of the strip before it to the beginning of the next.
std::size_t end_near(const WorstPlace& place, const Path& links) {
  const auto link = static_cast<std::size_t>(place.strip);
  const bool in = link == 0 || 2.0 * place.t > static_cast<double>(links.strips[link].poses.size() - 1);
  return in && link + 1 < links.strips.size() ? 2 * link : 2 * link - 1;
}

/// Other leads where a link cuts too deep; false where there are no others.
bool lead_otherwise(const JudgedLinks& judged, double tolerance_mm, LeadSearch& search) {
  const Path links = judged.links();
  std::vector<std::size_t> ends;
  for (const WorstPlace& place : judged.report.worst)
    if (-place.f > tolerance_mm) ends.push_back(end_near(place, links));
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  bool other = false;
  for (const std::size_t end : ends) other = search.next(end) || other;
  return other;
}

}  // namespace

Path JudgedLinks::links() const {
  Path links;
  for (const Strip& strip : linked.path.strips)
    if (strip.kind == kLinkKind) links.strips.push_back(strip);
  return links;
}

double JudgedLinks::depth_mm() const { return std::max(report.overcut_mm, report.gouge_mm); }

JudgedLinks judged_links(const Setup& setup, const JudgeRequest& judge, const Tool& tool, const KnownPath& strips,
                         LinkOptions options, double lift_mm) {
  const double diagonal = setup.part.box.diagonal(), spacing = kLiftSampleShare * diagonal;
  LeadSearch search(tool, ends_of(strips.path, tool.radial.axis_length()), judge_samples(setup, spacing, spacing),
                    lift_mm, diagonal);
  JudgeRequest sampled = judge;
  sampled.reach_radius_mm = {};
  JudgedLinks best;
  for (int k = 0; k < kMostTries; ++k) {
    JudgedLinks now{with_leads(strips, search, options), {}};
    now.report = judge_job(setup, sampled, tool, now.links());
    const bool done = now.depth_mm() <= setup.tolerance_mm || !lead_otherwise(now, setup.tolerance_mm, search);
    if (k == 0 || now.depth_mm() < best.depth_mm()) best = std::move(now);
    if (done) break;
  }
  return best;
}

}  // namespace flank::internal
