#include "flank/verify/program_stock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/parallel.h"
#include "flank/error.h"
#include "flank/verify/reach.h"
#include "flank/verify/stock/replay.h"
#include "flank/verify/stock/stock_mesh.h"

namespace flank::internal {
namespace {

constexpr double kRadian = 180.0 / std::numbers::pi;
/// Lines of a stock whose cell is not given: they cost time in proportion.
constexpr double kUsualLines = 1.5e5;
/// Places of the faces from which rays are sent, of all together.
constexpr std::size_t kMostRays = 6000;
/// This near to a plane of the blank the stock has an edge, and no distance.
constexpr double kEdgeCells = 3.0;

/// Holds every ball of the axis that meets the blank.
Box3 box_of(const Tool& tool, const Path& path, const std::vector<HalfSpace>& blank) {
  constexpr int kBalls = 33;
  const double length = tool.radial.axis_length();
  std::array<double, kBalls> places{}, radii{};
  for (std::size_t k = 0; k < kBalls; ++k) {
    places[k] = length * static_cast<double>(k) / (kBalls - 1.0);
    radii[k] = tool.radial.at(places[k]).r;
  }
  Box3 box;
  for (const Strip& strip : path.strips)
    for (const Pose& pose : strip.poses)
      for (std::size_t k = 0; k < kBalls; ++k) {
        const double s = places[k], r = radii[k];
        const Vec3 p = pose.at(s);
        if (std::any_of(blank.begin(), blank.end(), [&](const HalfSpace& h) { return h.normal.dot(p) - r > h.offset; }))
          continue;
        box.add(p - Vec3::Constant(r));
        box.add(p + Vec3::Constant(r));
      }
  return box;
}

/// What an axis-parallel plane of the blank cuts off need not be in the box.
void clip(Box3& box, const std::vector<HalfSpace>& blank) {
  for (const HalfSpace& h : blank)
    for (int k = 0; k < 3; ++k) {
      if (h.normal[k] > 1.0 - 1e-12) box.high[k] = std::min(box.high[k], h.offset);
      if (h.normal[k] < -1.0 + 1e-12) box.low[k] = std::max(box.low[k], -h.offset);
    }
}

double usual_cell(const Box3& box) {
  const Vec3 size = box.high - box.low;
  return std::sqrt((size.x() * size.y() + size.y() * size.z() + size.z() * size.x()) / kUsualLines);
}

/// By kinds in the order in which they first come.
void add_strips(const verify::StockReplay& replay, StockReport& out) {
  for (std::size_t k = 0; k < replay.strips.size(); ++k) {
    const verify::StripReplay& strip = replay.strips[k];
    auto kind = std::find_if(out.kinds.begin(), out.kinds.end(), [&](const auto& x) { return x.kind == strip.kind; });
    if (kind == out.kinds.end()) kind = out.kinds.insert(kind, StockKind{.kind = strip.kind});
    kind->way_mm += strip.way_mm;
    kind->volume_mm3 += strip.volume_mm3;
    const double angle = strip.angle_rad * kRadian;
    if (angle > kind->engagement_deg) {
      kind->engagement_deg = angle;
      kind->strip = static_cast<int>(k);
      kind->pose = strip.pose;
      kind->s = strip.poses[strip.pose].s;
    }
    out.strip_deg.push_back(angle);
    out.strip_mm3.push_back(strip.volume_mm3);
    out.strip_mm.push_back(strip.way_mm);
  }
}

/// Poses that were passed over lie between measured ones, and so does their engagement.
std::vector<double> engagement_of(const verify::StripReplay& strip) {
  constexpr double kDigits = 1e4;
  std::vector<double> out(strip.poses.size(), 0.0);
  std::size_t last = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!strip.poses[k].measured) continue;
    out[k] = std::round(kDigits * strip.poses[k].angle_rad) / kDigits;
    for (std::size_t i = last + 1; i < k; ++i) out[i] = std::max(out[last], out[k]);
    last = k;
  }
  return out;
}

std::vector<std::vector<EngagedArc>> arcs_of(const verify::StripReplay& strip) {
  std::vector<std::vector<EngagedArc>> out(strip.poses.size());
  std::size_t last = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!strip.poses[k].measured) continue;
    out[k] = strip.poses[k].arcs;
    const bool more = strip.poses[k].angle_rad > strip.poses[last].angle_rad;
    for (std::size_t i = last + 1; i < k; ++i) out[i] = more ? out[k] : out[last];
    last = k;
  }
  return out;
}

/// A place of a face from which a ray goes to the middle of the cavity.
struct Ray {
  Vec3 point, normal;
  double reach = 0.0;
  bool covered = false;
};

/// The faces with their sides: 1 where the tool is on the side of a normal, else -1.
struct Sides {
  const std::vector<FaceSamples>& faces;
  const std::vector<int>& signs;
  std::size_t stride;  ///< every so many samples are looked at
};

/// From a place to the nearest sample of the targets but one, and whether it lies right across from it rather than before
/// an edge of it: there is nothing between the sides where one of them has ended.
struct Across {
  double distance = std::numeric_limits<double>::infinity();
  bool facing = false;
};

Across across_from(const Vec3& point, std::size_t own, const Sides& sides) {
  Across out;
  for (std::size_t f = 0; f < sides.faces.size(); ++f) {
    const FaceSamples& face = sides.faces[f];
    if (f == own || !face.target || face.normals.size() != face.points.size()) continue;
    const double apart = face.spacing_mm * std::sqrt(static_cast<double>(sides.stride));
    for (std::size_t k = 0; k < face.points.size(); k += sides.stride) {
      const Vec3 to = point - face.points[k];
      if (to.norm() >= out.distance) continue;
      const double along = sides.signs[f] * face.normals[k].dot(to);
      out = {to.norm(), (to - sides.signs[f] * along * face.normals[k]).norm() <= along + apart};
    }
  }
  return out;
}

/// How far a ray goes to the middle between the sides: half of the distance to the other one, less where that ends before
/// an edge of it.
double half_way(const Vec3& point, const Vec3& direction, std::size_t own, const Sides& sides) {
  constexpr int kShares = 4;
  const double least = across_from(point, own, sides).distance;
  for (int k = kShares; std::isfinite(least) && k > 0; --k) {
    const double way = 0.5 * least * k / kShares;
    if (across_from(point + way * direction, own, sides).facing) return way;
  }
  return 0.0;
}

/// How far a ray goes before it comes nearer to another face of a solid than `keep`, at most `reach`: a floor that leans
/// towards a wall lies in the way of rays from its foot. What lies nearer to it than the tool's tip is round was not left
/// between the sides, but on the floor, and the part behind it is no material at all. Faces are taken as the tangent planes
/// of their samples.
double free_way(const Vec3& point, const Vec3& direction, double reach, double keep,
                const std::vector<FaceSamples>& faces) {
  for (const FaceSamples& face : faces) {
    if (face.target || !face.of_solid || face.normals.size() != face.points.size()) continue;
    const double near = reach + face.spacing_mm + keep;
    for (std::size_t k = 0; k < face.points.size(); ++k) {
      const Vec3 to = face.points[k] + keep * face.normals[k] - point;
      const double against = face.normals[k].dot(direction);
      if (against >= 0.0 || to.squaredNorm() > near * near) continue;
      const double way = std::max(0.0, face.normals[k].dot(to) / against);
      if (way < reach && (way * direction - to).squaredNorm() <= face.spacing_mm * face.spacing_mm) reach = way;
    }
  }
  return reach;
}

std::vector<Ray> rays_from(const Tool& tool, const Path& path, const std::vector<HalfSpace>& blank,
                           const verify::DexelStock& stock, std::vector<FaceSamples>& faces, double tolerance) {
  std::size_t all = 0;
  for (const FaceSamples& face : faces) all += face.points.size();
  const std::size_t stride = std::max<std::size_t>(1, all / kMostRays);
  const double edge = kEdgeCells * stock.cell(), keep = smallest_radius(tool);
  const SweptVolume volume(tool, path);
  std::vector<int> signs;
  for (FaceSamples& face : faces) {
    const bool known = face.of_solid || face.target || face.normals.size() != face.points.size();
    signs.push_back(known ? 1 : side_of_tool(tool, path, face));
  }
  const Sides sides{faces, signs, stride};
  std::vector<Ray> rays;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const FaceSamples& face = faces[f];
    if (face.normals.size() != face.points.size()) continue;
    for (std::size_t k = 0; k < face.points.size(); k += stride) {
      const Vec3& p = face.points[k];
      const bool in_box = ((p - stock.box().low).array() > edge).all() && ((stock.box().high - p).array() > edge).all();
      if (!in_box || std::any_of(blank.begin(), blank.end(),
                                 [&](const HalfSpace& h) { return h.normal.dot(p) > h.offset - edge; }))
        continue;
      Ray ray{p, signs[f] * face.normals[k], 0.0, false};
      if (face.target) {
        ray.covered = std::abs(volume.distance(p, 1.01 * tolerance).f) <= tolerance;
        if (ray.covered) ray.reach = free_way(p, ray.normal, half_way(p, ray.normal, f, sides), keep, faces);
      }
      rays.push_back(ray);
    }
  }
  return rays;
}

void look_along(const std::vector<Ray>& rays, const verify::DexelStock& stock, StockReport& out) {
  std::vector<verify::RayLeft> left(rays.size());
  parallel_for(rays.size(), [&](std::size_t k) {
    left[k] = verify::left_along(stock, rays[k].point, rays[k].normal, rays[k].reach);
  });
  for (std::size_t k = 0; k < rays.size(); ++k) {
    out.entered_mm = std::max(out.entered_mm, left[k].entered_mm);
    if (!rays[k].covered || left[k].over_mm <= out.uncut_mm) continue;
    out.uncut_mm = left[k].over_mm;
    out.uncut_point = rays[k].point;
  }
}

/// Lines of the stock: they cost time in proportion. Its cells are no smaller than this share of the tool's smallest radius, because what is told
/// is told to a few degrees.
constexpr double kRoughLines = 4e5, kFinestShare = 0.05;
constexpr const char* kRoughKind = "rough";
constexpr double kRoughEdgeCells =
    4.0;  ///< beyond what the tool reaches, so that the stock does not end where the tool cuts

double cell_for(const Box3& box, const Tool& tool) {
  const Vec3 size = box.high - box.low;
  return std::max(kFinestShare * smallest_radius(tool),
                  std::sqrt((size.x() * size.y() + size.y() * size.z() + size.z() * size.x()) / kRoughLines));
}

/// What the tool reaches of the blank.
Box3 reached(const Tool& tool, const Path& path, const Box3& blank) {
  const double length = tool.radial.axis_length();
  double radius = tool.radial.at(length).r;
  constexpr int kLooks = 64;
  for (int k = 0; k < kLooks; ++k) radius = std::max(radius, tool.radial.at(length * k / kLooks).r);
  Box3 box;
  for (const Strip& strip : path.strips)
    for (const Pose& pose : strip.poses)
      for (const double s : {0.0, length})
        box.add(pose.at(s) - Vec3::Constant(radius)), box.add(pose.at(s) + Vec3::Constant(radius));
  box.low = box.low.cwiseMax(blank.low), box.high = box.high.cwiseMin(blank.high);
  return box;
}

/// A cell as engagement: near a slot an angle says little, and the limit is not widened by that.
double sine_of(double degrees) {
  return degrees < 90.0 ? std::max(0.1, std::sin(degrees * std::numbers::pi / 180.0)) : 1.0;
}

}  // namespace

ProgramStock replay_program(const Tool& tool, const Path& path, const std::vector<HalfSpace>& blank,
                            std::vector<FaceSamples> faces, const ProgramStockOptions& options) {
  Box3 box = box_of(tool, path, blank);
  if (!((box.high - box.low).minCoeff() > 0.0)) throw InputError("the path never meets the blank");
  const double cell = options.cell_mm.value_or(usual_cell(box));
  // The faces that the tool finishes are where its balls end: they must not be where the stock ends.
  box.low.array() -= (kEdgeCells + 1.0) * cell;
  box.high.array() += (kEdgeCells + 1.0) * cell;
  clip(box, blank);
  if (!((box.high - box.low).minCoeff() > 0.0)) throw InputError("the path never meets the blank");
  verify::DexelStock stock(box, blank, cell);
  const verify::StockReplay replay = verify::replay(stock, tool.radial, path);
  ProgramStock out;
  out.report.cell_mm = stock.cell();
  out.report.resolution_deg =
      stock.cell() / (smallest_radius(tool) * std::max(0.1, std::sin(options.most_engagement_deg / kRadian))) * kRadian;
  out.report.before_mm3 = replay.before_mm3;
  out.report.left_mm3 = replay.after_mm3;
  add_strips(replay, out.report);
  for (const verify::StripReplay& strip : replay.strips) {
    out.engagement.push_back(engagement_of(strip));
    out.arcs.strips.push_back(arcs_of(strip));
  }
  out.arcs.heights = replay.heights;
  look_along(rays_from(tool, path, blank, stock, faces, options.tolerance_mm), stock, out.report);
  if (options.most_triangles > 0.0)
    out.left = verify::stock_mesh(stock, verify::stride_for(stock, options.most_triangles));
  return out;
}

StockReport rough_stock(const Tool& tool, const Path& path, const TriangleMesh& blank, double most_engagement_deg) {
  Box3 box = reached(tool, path, blank.box());
  if (!((box.high - box.low).minCoeff() > 0.0)) throw InputError("the path never meets the blank");
  const double cell = cell_for(box, tool);
  box.low = (box.low.array() - kRoughEdgeCells * cell).max(blank.box().low.array()).matrix();
  box.high = (box.high.array() + kRoughEdgeCells * cell).min(blank.box().high.array()).matrix();
  verify::DexelStock stock(blank, box, cell);
  const verify::StockReplay replay = verify::replay(stock, tool.radial, path);
  StockReport out;
  out.cell_mm = replay.cell_mm;
  out.resolution_deg = kRadian * replay.cell_mm / (smallest_radius(tool) * sine_of(most_engagement_deg));
  out.before_mm3 = replay.before_mm3, out.left_mm3 = replay.after_mm3;
  StockKind all{.kind = kRoughKind};
  for (std::size_t k = 0; k < replay.strips.size(); ++k) {
    const verify::StripReplay& strip = replay.strips[k];
    all.way_mm += strip.way_mm, all.volume_mm3 += strip.volume_mm3;
    if (kRadian * strip.angle_rad > all.engagement_deg) {
      all.engagement_deg = kRadian * strip.angle_rad;
      all.strip = static_cast<int>(k), all.pose = strip.pose, all.s = strip.poses[strip.pose].s;
    }
    out.strip_deg.push_back(kRadian * strip.angle_rad);
    out.strip_mm3.push_back(strip.volume_mm3);
    out.strip_mm.push_back(strip.way_mm);
  }
  out.kinds.push_back(all);
  return out;
}

}  // namespace flank::internal

namespace flank {

double StockReport::cycles_deg() const {
  double largest = 0.0;
  for (const StockKind& kind : kinds)
    if (kind.kind == "front" || kind.kind == "back" || kind.kind == "entry")
      largest = std::max(largest, kind.engagement_deg);
  return largest;
}

}  // namespace flank
