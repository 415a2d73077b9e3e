#include "flank/pipeline/load/bending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/pipeline/load/known_feeds.h"
#include "flank/setup/targets.h"

namespace flank::internal {

namespace {

std::string bending_text(const BendingReport& b) {
  return fmt::format(
      "bending adds {:.2f} to {:.2f} um of excess material, most at ({:.2f}, {:.2f}, {:.2f}); by samples the gouge is "
      "{:.4f} mm, without bending {:.4f}, the excess material {:.4f} mm, without bending {:.4f}",
      1e3 * b.least_mm, 1e3 * b.most_mm, b.most_point.x(), b.most_point.y(), b.most_point.z(), b.bent_overcut_mm,
      b.overcut_mm, b.bent_undercut_mm, b.undercut_mm);
}

}  // namespace

double bent_along(const Tool& tool, const CuttingRequest& request, const std::vector<double>& heights,
                  const std::vector<EngagedArc>& arcs, const std::vector<Pose>& poses, const MadeBy& place,
                  double feed) {
  const auto k = std::min(static_cast<std::size_t>(std::lround(place.pose)), poses.size() - 1);
  PoseCutter here = cutter_at(tool, request, heights, arcs, poses, k);
  here.per_mm.velocity *= feed, here.per_mm.velocity_by_z *= feed;
  const Vec3& axis = poses[k].axis;
  const Vec3 x = axis.unitOrthogonal(), y = x.cross(axis), outwards = -place.normal;
  const double wanted = std::atan2(outwards.dot(y), outwards.dot(x)), z = meridian_point(tool.radial, place.s).x();
  // The arc on which the place is made, or the end of one that is next to it.
  const std::optional<double> azimuth = nearest_engaged(here.cutter, z, wanted);
  if (!azimuth) return 0.0;
  const std::vector<CuttingLoad> rings =
      ring_loads(here.cutter, here.per_mm, force_coefficients(request.material, request.expected_chip_mm),
                 *azimuth + lag_at(here.cutter, z));
  const std::vector<double> compliance = compliances(tool, here.cutter, std::max(0.0, z));
  Vec3 moved = Vec3::Zero();
  for (std::size_t i = 0; i < rings.size(); ++i)
    moved += compliance[i] * (rings[i].force.x() * x + rings[i].force.y() * y);
  return moved.dot(place.normal);
}

BendingTool::BendingTool(const BendingRequest& asked, const PathArcs& known, const Setup& setup, const Tool& tool,
                         const Tool& judged, const Path& path)
    : tool_(tool),
      path_(path),
      volume_(judged, path),
      arcs_(engaged_arcs(known, asked.finish_stock_mm, setup, tool, path)) {
  if (!knows_load()) return;
  cutting_ = usual_cutting(find_material(*asked.material), *asked.flutes, asked.helix_deg * std::numbers::pi / 180.0,
                           largest_diameter(tool));
  loads_ = path_loads(tool, path, arcs_, cutting_);
}

BendingTool::BentPlace BendingTool::bent(const SweptDistance& at, const Vec3& normal) const {
  BentPlace out{.f = at.f};
  if (at.strip < 0 || !(at.f < 1e100)) return out;
  const auto strip = static_cast<std::size_t>(at.strip);
  const std::vector<Pose>& poses = path_.strips[strip].poses;
  const auto k = std::min(static_cast<std::size_t>(std::lround(at.t)), poses.size() - 1);
  if (arcs_.strips[strip][k].empty()) return out;
  out.loaded = true;
  out.added = bent_along(tool_, cutting_, arcs_.heights, arcs_.strips[strip][k], poses, {at.t, at.s, normal},
                         1.0 / loads_.slowness[strip][k]);
  return out;
}

std::vector<BendingTool::BentPlace> BendingTool::at(const std::vector<Vec3>& points,
                                                    const std::vector<Vec3>& normals) const {
  FLANK_ASSERT(knows_load() && points.size() == normals.size());
  std::vector<BentPlace> places(points.size());
  parallel_for(points.size(), [&](std::size_t k) { places[k] = bent(volume_.distance(points[k]), normals[k]); });
  return places;
}

std::function<std::vector<double>(const std::vector<Vec3>&, const std::vector<Vec3>&)> BendingTool::errors() const {
  if (!knows_load()) return nullptr;
  return [this](const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
    std::vector<double> errors;
    for (const BentPlace& place : at(points, normals)) errors.push_back(place.f + place.added);
    return errors;
  };
}

std::optional<BendingReport> BendingTool::report(const Setup& setup, double spacing_mm) const {
  if (!knows_load()) return std::nullopt;
  BendingReport out;
  for (const FaceSamples& face : judge_samples(setup, spacing_mm, spacing_mm)) {
    if (!face.target || face.normals.size() != face.points.size()) continue;
    const std::vector<BentPlace> places = at(face.points, face.normals);
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (!places[k].loaded) continue;
      ++out.samples;
      const double f = places[k].f, with = f + places[k].added;
      out.overcut_mm = std::max(out.overcut_mm, -f), out.undercut_mm = std::max(out.undercut_mm, f);
      out.bent_overcut_mm = std::max(out.bent_overcut_mm, -with);
      out.bent_undercut_mm = std::max(out.bent_undercut_mm, with);
      out.least_mm = std::min(out.least_mm, places[k].added);
      if (places[k].added > out.most_mm) out.most_mm = places[k].added, out.most_point = face.points[k];
    }
  }
  if (out.samples == 0) return std::nullopt;
  return out;
}

void BendingTool::add_notes(const std::optional<BendingReport>& report, std::vector<std::string>& notes) const {
  if (!knows_load()) {
    notes.push_back("bending: no load is known; give what roughing has left by `finish_stock`");
    return;
  }
  for (std::string& note : load_notes(loads_, path_, cutting_)) notes.push_back(std::move(note));
  notes.push_back(report ? bending_text(*report) : "bending: not calculated, because no load is known on these faces");
}

void require_bending(const BendingRequest& request) {
  const auto refuse = [&](bool given, const char* field) {
    if (given && !request.on) throw UsageError(field, "needs `bending`");
  };
  refuse(request.material.has_value(), "material");
  refuse(request.flutes.has_value(), "flutes");
  refuse(request.finish_stock_mm.has_value(), "finish_stock_mm");
  if (!request.on) return;
  if (!request.material) throw UsageError("bending", "needs a `material`: forces are not known without one");
  if (!request.flutes) throw UsageError("bending", "needs `flutes`: forces are not known without them");
  (void)find_material(*request.material);
}

}  // namespace flank::internal
