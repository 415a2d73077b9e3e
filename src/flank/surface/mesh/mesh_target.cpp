#include "flank/surface/mesh/mesh_target.h"

#include <algorithm>
#include <cmath>

#include "flank/geom/mesh_repair.h"
#include "flank/surface/mesh/jet_field.h"
#include "flank/surface/mesh/mesh_extension.h"
#include "flank/surface/mesh/mesh_samples.h"
#include "flank/surface/mesh/mesh_spline.h"

namespace flank::internal {
namespace {

/// Other starts that a cold query tries at most, besides the flat closest point.
constexpr int kMostStarts = 8;

/// A spline that leaves more than this many times the noise has missed some of the shape.
constexpr double kSplineAllowance = 1.2;

/// Places less than this many times the triangle's size apart lead to the same minimum.
constexpr double kSameBasin = 3.0;

}  // namespace

MeshTarget::MeshTarget(TriangleMesh mesh, const ExtensionOptions& options) {
  surface_.mesh = repair_mesh(std::move(mesh)).mesh;
  surface_.real_triangles = static_cast<int>(surface_.mesh.triangles.size());
  surface_.topology = link_triangles(surface_.mesh, kCreaseRad);
  const std::vector<Vec3> normals = vertex_normals(surface_.mesh);
  quality_ = estimate_noise(surface_.mesh, surface_.topology, normals);
  for (const JetFit& fit : fit_jets(surface_.mesh, surface_.topology, normals, quality_.jets))
    surface_.jets.push_back(fit.jet);
  tree_ = TriangleBvh(surface_.mesh);
  measure();
  extend(surface_, normals, options);
}

/// Area, box, and how far the smooth surface is from the flat triangles: by so much a flat distance may mislead a
/// search.
void MeshTarget::measure() {
  for (int t = 0; t < surface_.real_triangles; ++t) {
    const SurfaceJet s = surface_.jet(t, 1.0 / 3.0, 1.0 / 3.0);
    area_ += surface_.area(t);
    const Vec3 flat = (surface_.corner(t, 0) + surface_.corner(t, 1) + surface_.corner(t, 2)) / 3.0;
    flat_error_ = std::max(flat_error_, (s.p - flat).norm());
    box_.add(s.p);
    for (int k = 0; k < 3; ++k) {
      const Vec3 corner = surface_.jet(t, k == 1, k == 2).p;
      flat_error_ = std::max(flat_error_, (corner - surface_.corner(t, k)).norm());
      box_.add(corner);
      box_.add(surface_.jet(t, k == 0 ? 0.5 : 0.5 * (k == 1), k == 0 ? 0.5 : 0.5 * (k == 2)).p);
    }
  }
}

/// The flat closest point is a start; so is every other triangle that, as far as the flat distance can tell, might be
/// as near on the blended surface and is not close by.
MeshWalk MeshTarget::closest_walk(const Vec3& p) const {
  BvhTies ties;
  const BvhHit hit = tree_.closest(p, 2.0 * flat_error_, ties);
  MeshWalk best = walk_to_footpoint(surface_, p, {hit.triangle, hit.u, hit.v}, Reach::kReal);
  const auto size = [&](int t) { return (surface_.corner(t, 1) - surface_.corner(t, 0)).norm(); };
  const double distance = std::sqrt(hit.squared_distance), reach = distance + 2.0 * flat_error_;
  std::array<Vec3, kMostStarts + 1> starts;
  starts[0] = hit.point;
  std::size_t count = 1;
  for (int i = 0; i < ties.count && count <= kMostStarts; ++i) {
    const int t = ties.triangle[static_cast<std::size_t>(i)];
    // Also within the stretch over which the flat distance hardly changes: on a sphere about p it sags by about
    // flat_error_ there.
    const double near = kSameBasin * std::max(size(t), std::sqrt(flat_error_ * distance));
    bool known = false;
    for (std::size_t k = 0; k < count; ++k)
      known = known || (surface_.corner(t, 0) - starts[k]).squaredNorm() < near * near;
    if (known) continue;
    const TrianglePoint flat =
        closest_on_triangle(p, surface_.corner(t, 0), surface_.corner(t, 1), surface_.corner(t, 2));
    if (flat.squared_distance > reach * reach) continue;
    starts[count++] = flat.point;
    const MeshWalk other = walk_to_footpoint(surface_, p, {t, flat.u, flat.v}, Reach::kReal);
    if ((other.jet.p - p).squaredNorm() < (best.jet.p - p).squaredNorm()) best = other;
  }
  return best;
}

Footpoint MeshTarget::closest_within(const Vec3& p, double horizon_mm) const {
  if (box_.squared_distance(p) >= horizon_mm * horizon_mm) return {};
  Footpoint foot = footpoint_of(closest_walk(p), p, surface_.real_triangles);
  // As if there were none: the caller asked for what is nearer.
  if ((foot.point - p).norm() >= horizon_mm) foot.patch = -1;
  return foot;
}

Footpoint MeshTarget::track(const Vec3& p, const Footpoint& hint) const {
  if (hint.patch >= 0 && hint.patch < static_cast<int>(surface_.mesh.triangles.size())) {
    // A hint may come from another triangle's border, off by rounding.
    const double u = std::clamp(hint.u, 0.0, 1.0), v = std::clamp(hint.v, 0.0, 1.0 - u);
    const MeshWalk walk = walk_to_footpoint(surface_, p, {hint.patch, u, v}, Reach::kExtended);
    if (walk.converged) return footpoint_of(walk, p, surface_.real_triangles);
  }
  MeshWalk walk = closest_walk(p);
  // On the real surface the search ended at its border: on the extension there may be a point with p above it.
  if (walk.on_border) walk = walk_to_footpoint(surface_, p, walk.place, Reach::kExtended);
  return footpoint_of(walk, p, surface_.real_triangles);
}

// Triangles of the extension are no neighbours here: the real border is asked for.
std::vector<Vec3> MeshTarget::border_points(double spacing_mm) const {
  return open_side_points(surface_.mesh, surface_.topology, surface_.real_triangles, spacing_mm);
}

// What is finished is the part as it is given: on a coarse mesh the blended surface is farther above the triangles than a
// tolerance.
std::vector<SurfaceSample> MeshTarget::samples(double spacing_mm) const {
  return mesh_samples(surface_, spacing_mm, SamplePlaces::kFacets);
}

SurfaceSample MeshTarget::as_given(const SurfaceSample& sample) const {
  SurfaceSample flat = sample;
  const Vec3 &a = surface_.corner(sample.patch, 0), &b = surface_.corner(sample.patch, 1),
             &c = surface_.corner(sample.patch, 2);
  flat.normal = (b - a).cross(c - a).normalized();
  return flat;
}

bool MeshTarget::is_nearer(const Vec3& p, double mm) const {
  return mm > 0.0 && tree_.closest(p).squared_distance < mm * mm;
}

}  // namespace flank::internal

namespace flank {
using namespace internal;

std::unique_ptr<Target> make_target(TriangleMesh mesh, const ExtensionOptions& options) {
  const MeshQuality quality = estimate_noise(mesh);
  if (quality.noisy) {
    const auto spline = fit_spline_to_mesh(mesh);
    if (spline && spline->residual_mm < kSplineAllowance * quality.noise_mm)
      return make_target(std::vector<Face>{spline->face}, +1, options);
  }
  return std::make_unique<MeshTarget>(std::move(mesh), options);
}

}  // namespace flank
