#include "flank/pipeline/folder/judged_links.h"

#include <algorithm>

#include "flank/pipeline/folder/link_lift.h"
#include "flank/pipeline/judge/judge_job.h"
#include "flank/setup/targets.h"

namespace flank::internal {
namespace {

/// Of the samples from which a tool is lifted: of the part's diagonal.
constexpr double kLiftSampleShare = 1.0 / 100.0;
/// Each asks the judge once.
constexpr int kMostTries = 24;

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
/// Between their leads it is on the sphere, where it cuts nothing.
std::size_t end_near(const WorstPlace& place, const Path& links, const KnownPath& strips, const LeadSearch& search) {
  const auto link = static_cast<std::size_t>(place.strip);
  const std::size_t count = links.strips.size(), poses = links.strips[link].poses.size();
  if (link == 0) return 0;
  if (link + 1 == count) return 2 * link - 1;
  const std::vector<Strip>& all = strips.path.strips;
  const std::size_t out = lead_out(all[link - 1].poses.back(), search.lead(2 * link - 1)).size(),
                    in = lead_out(all[link].poses.front(), search.lead(2 * link)).size();
  // Midway between the two leads, by poses.
  const double middle = 0.5 * (static_cast<double>(out) + static_cast<double>(poses) - static_cast<double>(in));
  return place.t > middle ? 2 * link : 2 * link - 1;
}

/// Other leads where a link cuts too deep; false where there are no others.
bool lead_otherwise(const JudgedLinks& judged, const KnownPath& strips, double tolerance_mm, LeadSearch& search) {
  const Path links = judged.links();
  std::vector<std::size_t> ends;
  for (const WorstPlace& place : judged.report.worst)
    if (-place.f > tolerance_mm) ends.push_back(end_near(place, links, strips, search));
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
  const double spacing = kLiftSampleShare * setup.part.box.diagonal(), tolerance = setup.tolerance_mm;
  const std::vector<FaceSamples> samples = judge_samples(setup, spacing, spacing);
  LeadSearch search(judged_tool(setup, tool), strips.path, samples, lift_mm, tolerance, options);
  JudgeRequest request = judge;
  request.reach_radius_mm = {};
  request.sample_mm = {};  // of a draft: links are proved all the same
  JudgedLinks best;
  for (int k = 0; k < kMostTries; ++k) {
    JudgedLinks now{with_leads(strips, search, options), {}};
    // Samples refuse a way cheaply; a proof looks between them at what they let pass.
    now.report = judge_job(setup, request, tool, now.links(), DepthProof::kSampled);
    if (now.depth_mm() <= tolerance) now.report = judge_job(setup, request, tool, now.links());
    const bool done = now.depth_mm() <= tolerance || !lead_otherwise(now, strips, tolerance, search);
    if (k == 0 || now.depth_mm() < best.depth_mm()) best = std::move(now);
    if (done) break;
  }
  return best;
}

}  // namespace flank::internal
