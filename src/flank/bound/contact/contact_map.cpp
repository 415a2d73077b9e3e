#include "flank/bound/contact/contact_map.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/bound/contact/free_ball.h"

namespace flank::internal {
namespace {

constexpr std::size_t kBlock = 64;  ///< points between two looks at whether the run is to stop

MapPoint point_of(const ContactQuestion& question, const std::vector<const Target*>& faces, const SurfaceSample& sample,
                  const ContactMapOptions& options) {
  MapPoint point;
  const ContactSite site(question, sample.point);
  point.point = site.point;
  point.normal = site.normal;
  point.area_mm2 = sample.area;
  point.may_be_finished = may_be_finished(site.point, site.normal, faces, question.thin_mm, question.tolerance_mm);
  // Nearest points are no farther apart than this many times the points that they belong to, as long as the tool lies
  // in free balls of this radius.
  const double thick = question.thick_mm + question.tolerance_mm;
  point.stretch = site.roof_mm > 0.0 ? site.roof_mm / (site.roof_mm - thick) : 0.0;
  if (point.may_be_finished) point.contact = longest_contact(question, site, options.search);
  return point;
}

void sum_up(ContactMap& map) {
  for (const MapPoint& point : map.points) {
    map.area_mm2 += point.area_mm2;
    if (!point.may_be_finished || point.contact.bound_mm <= 0.0)
      map.blocked_mm2 += point.area_mm2;
    else if (point.stretch > 0.0)
      map.way_mm += point.area_mm2 / (point.contact.bound_mm * point.stretch);
  }
  if (map.border_mm > 0.0) map.strips = static_cast<int>(std::ceil(map.way_mm / (0.5 * map.border_mm) - 1e-9));
  if (map.blocked_mm2 < map.area_mm2) map.strips = std::max(map.strips, 1);
}

}  // namespace

ContactMap contact_map(const Target& target, const std::vector<const Target*>& others, const Tool& tool,
                       const ContactMapOptions& options, const Progress& progress) {
  const ContactQuestion question(target, tool.radial, options.tolerance_mm);
  std::vector<const Target*> faces = {&target};
  faces.insert(faces.end(), others.begin(), others.end());
  const std::vector<SurfaceSample> samples = target.samples(options.spacing_mm);
  ContactMap map;
  map.points.resize(samples.size());
  std::size_t done = 0;
  while (done < samples.size() && !progress.stop()) {
    const std::size_t count = std::min(kBlock, samples.size() - done);
    parallel_for(count,
                 [&](std::size_t k) { map.points[done + k] = point_of(question, faces, samples[done + k], options); });
    done += count;
    progress.step("bound", static_cast<double>(done) / static_cast<double>(samples.size()));
  }
  map.complete = done == samples.size();
  map.points.resize(done);
  const double spacing = 0.1 * options.spacing_mm;
  map.border_mm = spacing * static_cast<double>(target.border_points(spacing).size());
  sum_up(map);
  return map;
}

}  // namespace flank::internal
