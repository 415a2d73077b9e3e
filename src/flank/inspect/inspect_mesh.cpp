#include "flank/inspect/inspect_mesh.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "flank/geom/mesh_topology.h"

namespace flank::internal {
namespace {

/// The vertices nearest to `start` along edges, ring by ring, up to kPatchVertices.
std::vector<int> patch_around(int start, const TriangleMesh& mesh, const MeshTopology& fans,
                              std::vector<int>& seen_by) {
  std::vector<int> patch{start};
  seen_by[static_cast<std::size_t>(start)] = start;
  for (std::size_t i = 0; i < patch.size() && patch.size() < kPatchVertices; ++i) {
    for (const int t : fans.around(patch[i])) {
      const auto& corners = mesh.triangles[static_cast<std::size_t>(t)];
      const auto own = std::find(corners.begin(), corners.end(), patch[i]) - corners.begin();
      for (const auto k : {own + 1, own + 2}) {
        const int n = corners[static_cast<std::size_t>(k % 3)];
        if (seen_by[static_cast<std::size_t>(n)] == start) continue;
        seen_by[static_cast<std::size_t>(n)] = start;
        patch.push_back(n);
      }
    }
  }
  return patch;
}

/// Curvatures of the graph z = a + b x + c y + d x^2 / 2 + e x y + f y^2 / 2 at the origin.
std::pair<double, double> graph_curvatures(double b, double c, double d, double e, double f) {
  const double w = 1.0 + b * b + c * c, root = std::sqrt(w);
  const double mean = 0.5 * ((1.0 + c * c) * d - 2.0 * b * c * e + (1.0 + b * b) * f) / (w * root);
  const double gauss = (d * f - e * e) / (w * w);
  const double spread = std::sqrt(std::max(0.0, mean * mean - gauss));
  return {mean - spread, mean + spread};
}

std::optional<std::pair<double, double>> fit_patch(const TriangleMesh& mesh, const MeshTopology& fans,
                                                   const std::vector<int>& patch) {
  const Eigen::Index count = static_cast<Eigen::Index>(patch.size());
  Vec3 normal = Vec3::Zero();
  for (const int v : patch) normal += vertex_normal(mesh, v, fans.around(v));
  if (count < kLeastPatchVertices || normal.norm() == 0.0) return std::nullopt;
  normal.normalize();
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x),
             origin = mesh.vertices[static_cast<std::size_t>(patch.front())];
  double size = 0.0;
  for (const int v : patch) size = std::max(size, (mesh.vertices[static_cast<std::size_t>(v)] - origin).norm());
  Eigen::MatrixXd rows(count, 6);
  Eigen::VectorXd heights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 p = (mesh.vertices[static_cast<std::size_t>(patch[static_cast<std::size_t>(i)])] - origin) / size;
    const double s = p.dot(x), t = p.dot(y);
    rows.row(i) << 1.0, s, t, 0.5 * s * s, s * t, 0.5 * t * t;
    heights[i] = p.dot(normal);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  if (qr.rank() < 6) return std::nullopt;
  const Eigen::VectorXd k = qr.solve(heights);
  return graph_curvatures(k[1], k[2], k[3] / size, k[4] / size, k[5] / size);
}

}  // namespace

std::vector<std::pair<double, double>> mesh_curvatures(const TriangleMesh& mesh, int count) {
  const MeshTopology fans = fans_of(mesh);
  std::vector<int> seen_by(mesh.vertices.size(), -1);
  const int total = static_cast<int>(mesh.vertices.size()), step = std::max(1, total / count);
  std::vector<std::pair<double, double>> curvatures;
  for (int v = 0; v < total; v += step)
    if (const auto fitted = fit_patch(mesh, fans, patch_around(v, mesh, fans, seen_by))) curvatures.push_back(*fitted);
  return curvatures;
}

}  // namespace flank::internal
