#include "flank/results/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/envelope/path_regularity.h"
#include "flank/geom/mesh_topology.h"
#include "flank/job/command_line.h"
#include "flank/results/view_gaps.h"
#include "flank/setup/targets.h"
#include "flank/surface/ball_touch.h"
#include "flank/tool/grown.h"

namespace flank::internal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kProfilePoints = 161;
/// Of a check surface only what is entered is of interest: beyond this many tolerances the judge need not be exact.
constexpr double kCheckHorizon = 4.0;

/// Every so many poses, and always the last one: a page that drew all of them would not turn smoothly.
ViewStrip thinned(const Strip& strip) {
  ViewStrip out;
  out.id = strip.id;
  out.face = strip.face;
  out.pose_count = strip.poses.size();
  const std::size_t stride = std::max<std::size_t>(1, (strip.poses.size() + kMostPosesShown - 2) / kMostPosesShown);
  for (std::size_t k = 0; k < strip.poses.size(); k += stride) out.index.push_back(k);
  if (!strip.poses.empty() && out.index.back() + 1 < strip.poses.size()) out.index.push_back(strip.poses.size() - 1);
  for (std::size_t k : out.index) out.poses.push_back(strip.poses[k]);
  return out;
}

/// The strip in places of equal shares of its steps, with the regularity |c| (MATH.md, section 3) of each; what the
/// judge says is added later.
std::vector<ViewPlace> places_of(const Strip& strip, const RadialFunction& radial, const Touches& touches) {
  if (strip.poses.size() < 2) return {};
  const std::size_t steps = strip.poses.size() - 1;
  std::vector<ViewPlace> places(std::min(steps, kMostPlaces));
  parallel_for(places.size(), [&](std::size_t k) {
    // Place k is the share [k, k + 1] / count of the steps; the steps that it overlaps count for it.
    const std::size_t first = k * steps / places.size();
    const std::size_t last = ((k + 1) * steps + places.size() - 1) / places.size();
    const double middle = (static_cast<double>(k) + 0.5) * static_cast<double>(steps);
    places[k] = {middle / static_cast<double>(places.size()), kInfinity, -kInfinity, 0.0, kInfinity};
    for (std::size_t i = first; i < last; ++i)
      places[k].largest_c = largest_c(strip.poses[i], strip.poses[i + 1], radial, touches, places[k].largest_c);
  });
  return places;
}

/// A vertex counts for the place that is nearest to it, unless that is an end of the strip or of the axis: what lies
/// beyond them is not swept past.
void add_to_places(const SweptDistance& d, double axis_length, std::vector<ViewStrip>& strips) {
  if (d.strip < 0 || !(d.s > 0.0) || !(d.s < axis_length)) return;
  ViewStrip& strip = strips[static_cast<std::size_t>(d.strip)];
  const double steps = static_cast<double>(strip.pose_count) - 1.0;
  if (strip.places.empty() || !(d.t > 0.0) || !(d.t < steps)) return;
  const auto count = static_cast<double>(strip.places.size());
  ViewPlace& place = strip.places[static_cast<std::size_t>(std::min(count - 1.0, d.t / steps * count))];
  place.lowest_f_mm = std::min(place.lowest_f_mm, d.f);
  place.highest_f_mm = std::max(place.highest_f_mm, d.f);
}

/// The least clearance of the poses that a place covers.
void add_clearance(const std::vector<double>& poses, std::vector<ViewPlace>& places) {
  const std::size_t steps = poses.size() - 1;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t first = k * steps / places.size();
    const std::size_t last = ((k + 1) * steps + places.size() - 1) / places.size();
    for (std::size_t i = first; i <= last; ++i) places[k].clearance_mm = std::min(places[k].clearance_mm, poses[i]);
  }
}

/// Check surfaces that are cut by a good part of the tolerance: only these get colours, and the judge's time for
/// them.
std::set<std::string> entered_faces(const VerifyReport& verdict, double tolerance_mm) {
  std::set<std::string> entered;
  for (const FaceVerdict& face : verdict.faces)
    if (!face.target && face.overcut_mm > kEnteredShare * tolerance_mm) entered.insert(face.face);
  return entered;
}

/// Check surfaces that a shank or holder comes too near to.
std::set<std::string> struck_faces(const VerifyReport& verdict) {
  std::set<std::string> struck;
  for (const ClearanceFigure& figure : verdict.clearance.figures)
    if (!figure.kept && figure.role == ObstacleRole::kPart) struck.insert(figure.obstacle);
  return struck;
}

/// What may not be touched, with how far the tool's bodies stay from it.
void add_obstacles(const Setup& setup, const std::set<std::string>& struck, View& view) {
  for (const Part& fixture : setup.fixtures)
    for (ViewFace& body : view_fixture(fixture)) {
      body.face = std::filesystem::path(fixture.file).filename().string() + " " + body.face;
      view.fixtures.push_back(std::move(body));
    }
  std::vector<Pose> poses;
  for (const ViewStrip& strip : view.strips) poses.insert(poses.end(), strip.poses.begin(), strip.poses.end());
  std::vector<ViewFace*> faces;
  for (ViewFace& body : view.fixtures) faces.push_back(&body);
  measure_gaps(view.tool, poses, ToolBodies::kAll, faces);
  faces.clear();
  for (ViewFace& body : view.bodies)
    if (!body.target && struck.contains(body.face)) faces.push_back(&body);
  measure_gaps(view.tool, poses, ToolBodies::kAboveTheFlank, faces);
}

void colour_faces(View& view, const Path& path, const std::set<std::string>& entered) {
  if (path.pose_count() == 0) return;  // a volume without poses has no distance
  const SweptVolume volume(view.allowance_mm > 0.0 ? grown(view.tool, view.allowance_mm) : view.tool, path);
  for (ViewFace& body : view.bodies) {
    if (!body.target && !entered.contains(body.face)) continue;
    FaceSamples samples;
    samples.face = body.face;
    // The judge is asked where colours are drawn: a picture shows no place between the triangles' corners.
    samples.points = body.mesh.vertices;
    // Of a target every distance counts, since what is left shows as well.
    const double horizon = body.target ? 1e300 : kCheckHorizon * view.tolerance_mm;
    for (const SweptDistance& d : swept_distances(volume, samples, horizon)) {
      body.f_mm.push_back(d.f);
      if (body.target) add_to_places(d, view.tool.radial.axis_length(), view.strips);
    }
  }
}

/// The view with the judge's distances; as it is where the program is stopped before it has them all.
void judge_faces(View& view, const Path& path, const std::set<std::string>& entered) {
  View coloured = view;
  try {
    colour_faces(coloured, path, entered);
  } catch (const Stopped&) {
    return;
  }
  view = std::move(coloured);
}

/// The meridian at equal steps of s, with its curvature.
std::vector<ProfilePoint> profile_of(const RadialFunction& radial) {
  std::vector<ProfilePoint> points;
  for (int j = 0; j < kProfilePoints; ++j) {
    const double s = radial.axis_length() * j / (kProfilePoints - 1);
    const RadialJet r = radial.at(s);
    const Vec2 q = meridian_point(radial, s);
    // The meridian's tangent turns by r'' / q over an arc of (q^2 - r r'') / q, q^2 = 1 - r'^2.
    points.push_back({s, q.x(), q.y(), -r.d2 / (1.0 - r.d1 * r.d1 - r.r * r.d2)});
  }
  return points;
}

}  // namespace

View make_view(const PlanJob& job, const Setup& setup, const Tool& tool, const Path& path, const VerifyReport& verdict,
               const BentError& bent) {
  View view;
  // A page is passed on: where files lie on somebody's disk is not its readers' business.
  const PlanJob shown = without_folders(job);
  view.command = command_line(shown);
  std::visit(
      [&](const auto& plan) {
        view.part = machined(plan).file;
        view.faces = machined(plan).target_text();
        view.tolerance_mm = setup.tolerance_mm;
        view.allowance_mm = setup.allowance_mm;
        view.least_coverage = plan.judge.least_coverage;
      },
      shown);
  const std::set<std::string> entered = entered_faces(verdict, view.tolerance_mm);
  const std::set<std::string> struck = struck_faces(verdict);
  std::set<std::string> fine = entered;
  fine.insert(struck.begin(), struck.end());
  view.bodies = view_faces(setup.part, setup.targets, fine);
  view.tool = tool;
  view.sides = verdict.sheet_sides;
  view.profile = profile_of(tool.radial);
  // Whether the flank touches a target decides where |c| matters: elsewhere a plunge leaves no trace.
  const std::vector<TargetGroup> groups = make_targets(setup);
  std::vector<const Target*> targets;
  for (const TargetGroup& group : groups) targets.push_back(group.target.get());
  const Touches touches = [&](const Vec3& centre, double radius) {
    return ball_touches(targets, centre, radius, view.tolerance_mm);
  };
  for (const Strip& strip : path.strips) {
    view.strips.push_back(thinned(strip));
    view.strips.back().places = places_of(strip, tool.radial, touches);
    const std::size_t index = view.strips.size() - 1;
    if (const auto& by_strip = verdict.clearance.pose_clearance_mm; index < by_strip.size())
      add_clearance(by_strip[index], view.strips.back().places);
  }
  add_obstacles(setup, struck, view);
  judge_faces(view, path, entered);
  for (ViewFace& body : view.bodies)
    if (bent && body.target && !body.f_mm.empty()) body.bent_mm = bent(body.mesh.vertices, vertex_normals(body.mesh));
  return view;
}

}  // namespace flank::internal
