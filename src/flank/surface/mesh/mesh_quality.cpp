#include "flank/surface/mesh/mesh_quality.h"

#include <algorithm>
#include <cmath>

#include "flank/geom/mesh_repair.h"

namespace flank::internal {
namespace {

constexpr std::size_t kMostProbes = 1000;

/// Points of the narrowest jets, with enough degrees of freedom for a residual.
constexpr int kNarrow = 36;
constexpr int kWidest = 600;

/// A neighbourhood may leave this much more than the narrow one: then the jets' own error is small beside what the
/// noise leaves in them.
constexpr double kWideAllowance = 1.03;

struct Residuals {
  double median = 0.0, mean_square = 0.0;
};

Residuals residuals(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Vec3>& normals,
                    int points) {
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kMostProbes);
  RingCollector rings(mesh, topology, normals);
  JetWorkspace workspace;
  std::vector<double> all;
  Residuals r;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += step) {
    rings.collect(static_cast<int>(v), points);
    const JetFit fit = fit_jet(rings.points(), mesh.vertices[v], normals[v], Jet::kDegree, 0.0, workspace);
    if (fit.degree < Jet::kDegree) continue;
    all.push_back(fit.residual);
    r.mean_square += fit.residual * fit.residual;
  }
  if (all.empty()) return r;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  r.median = *middle;
  r.mean_square /= static_cast<double>(all.size());
  return r;
}

}  // namespace

MeshQuality estimate_noise(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Vec3>& normals) {
  MeshQuality quality;
  const Residuals narrow = residuals(mesh, topology, normals, kNarrow);
  quality.noise_mm = narrow.median;
  quality.noise_relative = narrow.median / mesh.box().diagonal();
  if (quality.noise_relative <= kExactNoise) return quality;
  const Residuals twice = residuals(mesh, topology, normals, 4 * kNarrow);
  quality.noisy = twice.median <= 1.5 * narrow.median;
  if (!quality.noisy) return quality;
  quality.jets.falloff = 1.0;
  quality.jets.allowance = 6.0 * quality.noise_mm;
  for (int points = kNarrow; points <= kWidest && 2 * points <= static_cast<int>(mesh.vertices.size()); points *= 2) {
    if (residuals(mesh, topology, normals, points).mean_square > kWideAllowance * kWideAllowance * narrow.mean_square)
      break;
    quality.jets.points = points;
  }
  return quality;
}

MeshQuality estimate_noise(const TriangleMesh& mesh) {
  TriangleMesh sound = repair_mesh(mesh).mesh;
  const MeshTopology topology = link_triangles(sound, kCreaseRad);
  return estimate_noise(sound, topology, vertex_normals(sound));
}

}  // namespace flank::internal
