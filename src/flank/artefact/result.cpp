// What a result says of itself.
#include <algorithm>

#include "flank/artefact/acceptance.h"
#include "flank/run.h"

namespace flank {

Acceptance Result::acceptance() const {
  const double least_coverage = std::visit([](const auto& request) { return request.judge.least_coverage; }, job);
  Acceptance out = internal::accept(tool, verify, least_coverage, complete);
  if (const auto* cavity = std::get_if<TrochoidSummary>(&plan)) internal::accept_cavity(*cavity, out);
  if (const auto* cavity = std::get_if<TrochoidJob>(&job); cavity && verify.stock)
    internal::accept_stock(*verify.stock, cavity->cycles.most_engagement_deg, verify.tolerance_mm, out);
  return out;
}

double TrochoidSummary::largest_deg() const {
  double largest = 0.0;
  for (const LayerSummary& layer : layers) largest = std::max({largest, layer.front_deg, layer.back_deg});
  return largest;
}

double TrochoidSummary::way_mm() const {
  double way = 0.0;
  for (const LayerSummary& layer : layers) way += layer.fronts_mm + layer.backs_mm + layer.sides_mm;
  return way;
}

bool TrochoidSummary::done() const {
  return !layers.empty() &&
         std::all_of(layers.begin(), layers.end(), [](const LayerSummary& layer) { return layer.status == "done"; });
}

TargetCover CoverSummary::whole() const {
  TargetCover whole;
  double reachable = 0.0, before = 0.0, after = 0.0, milled = 0.0;  // mm^2
  for (const TargetCover& t : targets) {
    whole.faces += (whole.faces.empty() ? "" : ",") + t.faces;
    whole.area_mm2 += t.area_mm2;
    whole.seeds += t.seeds;
    whole.lines += t.lines;
    whole.grown += t.grown;
    whole.strips += t.strips;
    whole.links_mm += t.links_mm;
    whole.overcut_mm = std::max(whole.overcut_mm, t.overcut_mm);
    const double reached = t.reachable * t.area_mm2;
    reachable += reached;
    before += t.before * reached;
    after += t.after * reached;
    milled += (1.0 + t.overlap) * t.after * reached;
  }
  if (whole.area_mm2 > 0.0) whole.reachable = reachable / whole.area_mm2;
  if (reachable > 0.0) {
    whole.before = before / reachable;
    whole.after = after / reachable;
  }
  if (after > 0.0) whole.overlap = milled / after - 1.0;
  return whole;
}

}  // namespace flank
