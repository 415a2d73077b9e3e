#include "flank/surface/mesh/jet_field.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"

namespace flank::internal {
namespace {

/// Cosine of the largest angle between normals within one jet.
constexpr double kLeastCosine = 0.5;

/// A jet must meet the vertices around its own one within this share of their distance, and be no steeper there than
/// this.
constexpr double kMostMiss = 0.2;
constexpr double kMostSlope = 1.5;

/// How many of the collected points are looked at: those of the first ring come first.
constexpr std::size_t kChecked = 9;

/// Whether the jet stays with the mesh nearby; over sharp bends and crumpled places a polynomial may swing.
bool tame(const Jet& jet, std::span<const Vec3> points, double allowance) {
  for (std::size_t i = 0; i < std::min(points.size(), kChecked); ++i) {
    const Vec3 local = jet.frame.transpose() * (points[i] - jet.origin);
    const Jet::Heights h = jet.heights(local[0], local[1]);
    const double reach = i == 0 ? (points.size() > 1 ? (points[1] - points[0]).norm() : 0.0) : local.norm();
    if (!(std::abs(h.z - local[2]) <= kMostMiss * reach + allowance) ||
        !(h.x * h.x + h.y * h.y <= kMostSlope * kMostSlope))
      return false;
  }
  return true;
}

/// The fit of the highest degree that is tame; at last the tangent plane of the triangles.
JetFit tame_fit(std::span<const Vec3> points, const Vec3& origin, const Vec3& normal, const JetOptions& options,
                JetWorkspace& workspace) {
  JetFit fit = fit_jet(points, origin, normal, options.degree, options.falloff, workspace);
  while (fit.degree > 0 && !tame(fit.jet, points, options.allowance))
    fit = fit_jet(points, origin, normal, fit.degree - 1, options.falloff, workspace);
  return fit;
}

}  // namespace

RingCollector::RingCollector(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Vec3>& normals)
    : mesh_(mesh), topology_(topology), normals_(normals), stamp_(mesh.vertices.size(), 0) {}

void RingCollector::start(int vertex) {
  FLANK_ASSERT(vertex >= 0 && static_cast<std::size_t>(vertex) < mesh_.vertices.size());
  ++now_;
  found_.assign(1, vertex);
  points_.assign(1, mesh_.vertices[static_cast<std::size_t>(vertex)]);
  stamp_[static_cast<std::size_t>(vertex)] = now_;
}

/// Adds the accepted neighbours of found_[begin] to found_[end - 1].
template <class Accept>
void RingCollector::add_ring(std::size_t begin, std::size_t end, const Accept& accept) {
  for (std::size_t i = begin; i < end; ++i) {
    for (int t : topology_.around(found_[i])) {
      for (int other : mesh_.triangles[static_cast<std::size_t>(t)]) {
        const auto o = static_cast<std::size_t>(other);
        if (stamp_[o] == now_) continue;
        stamp_[o] = now_;
        if (!accept(o)) continue;
        found_.push_back(other);
        points_.push_back(mesh_.vertices[o]);
      }
    }
  }
}

// Ring after ring over edges, so that points of another sheet that is near in space are not taken; normals that turn
// away by more than 60 degrees end it at creases.
const std::vector<int>& RingCollector::collect(int vertex, int least) {
  start(vertex);
  const Vec3& normal = normals_[static_cast<std::size_t>(vertex)];
  const auto accept = [&](std::size_t v) { return normals_[v].dot(normal) >= kLeastCosine; };
  for (std::size_t begin = 0; begin < found_.size() && static_cast<int>(found_.size()) < least;) {
    const std::size_t end = found_.size();
    add_ring(begin, end, accept);
    begin = end;
  }
  return found_;
}

const std::vector<int>& RingCollector::collect_within(int vertex, double radius) {
  start(vertex);
  const Vec3 &center = mesh_.vertices[static_cast<std::size_t>(vertex)],
             normal = normals_[static_cast<std::size_t>(vertex)];
  const auto accept = [&](std::size_t v) {
    return normals_[v].dot(normal) >= kLeastCosine && (mesh_.vertices[v] - center).squaredNorm() <= radius * radius;
  };
  for (std::size_t begin = 0; begin < found_.size();) {
    const std::size_t end = found_.size();
    add_ring(begin, end, accept);
    begin = end;
  }
  return found_;
}

std::vector<JetFit> fit_jets(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Vec3>& normals,
                             const JetOptions& options) {
  FLANK_ASSERT(normals.size() == mesh.vertices.size());
  std::vector<JetFit> fits(mesh.vertices.size());
  constexpr std::size_t kGrain = 2048;  // large: each task has a stamp for every vertex of the mesh
  parallel_blocks(fits.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    RingCollector rings(mesh, topology, normals);
    JetWorkspace workspace;
    for (std::size_t v = begin; v < end; ++v) {
      rings.collect(static_cast<int>(v), options.points);
      fits[v] = tame_fit(rings.points(), mesh.vertices[v], normals[v], options, workspace);
    }
  });
  return fits;
}

}  // namespace flank::internal
