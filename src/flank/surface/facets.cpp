#include "flank/surface/facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flank/base/assert.h"
#include "flank/error.h"
#include "flank/geom/mesh_topology.h"
#include "flank/geom/triangle_bvh.h"
#include "flank/surface/mesh/mesh_samples.h"

namespace flank::internal {
namespace {

constexpr double kOnSide = 1e-12;  ///< a weight of a corner below this: the place lies on the side opposite of it

class Facets final : public Target {
 public:
  explicit Facets(TriangleMesh mesh) : mesh_(std::move(mesh)) {
    if (mesh_.triangles.empty()) throw InputError("a mesh without triangles is no surface");
    topology_ = link_triangles(mesh_, std::numbers::pi);  // no edge is a border but an open one
    normals_ = triangle_normals(mesh_);
    corner_normals_ = vertex_normals(mesh_);
    tree_ = TriangleBvh(mesh_);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      area_ += area(t);
      for (std::size_t k = 0; k < 3; ++k) box_.add(corner(t, k));
    }
  }

  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override {
    if (box_.squared_distance(p) >= horizon_mm * horizon_mm) return {};
    const BvhHit hit = tree_.closest(p);
    Footpoint foot;
    foot.point = hit.point;
    foot.u = hit.u;
    foot.v = hit.v;
    foot.patch = hit.squared_distance < horizon_mm * horizon_mm ? hit.triangle : -1;
    place(hit, foot);
    const double distance = std::sqrt(hit.squared_distance);
    foot.distance = (p - hit.point).dot(foot.normal) < 0.0 ? -distance : distance;
    foot.d1 = foot.normal.unitOrthogonal();
    foot.d2 = foot.normal.cross(foot.d1);
    return foot;
  }

  [[nodiscard]] Footpoint track(const Vec3& p, const Footpoint&) const override { return closest(p); }

  /// The middles of n^2 similar parts of each triangle, in the order of the triangles.
  [[nodiscard]] std::vector<SurfaceSample> samples(double spacing_mm) const override {
    FLANK_ASSERT(spacing_mm > 0.0);
    std::vector<SurfaceSample> samples;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const int n = std::max(1, static_cast<int>(std::ceil(longest_side(t) / spacing_mm)));
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
          samples.push_back(sample(t, (i + 1.0 / 3.0) / n, (j + 1.0 / 3.0) / n, n));
          if (i + j + 1 < n) samples.push_back(sample(t, (i + 2.0 / 3.0) / n, (j + 2.0 / 3.0) / n, n));
        }
    }
    return samples;
  }

  [[nodiscard]] std::vector<Vec3> border_points(double spacing_mm) const override {
    return open_side_points(mesh_, topology_, patch_count(), spacing_mm);
  }

  [[nodiscard]] int patch_count() const override { return static_cast<int>(mesh_.triangles.size()); }

 private:
  [[nodiscard]] const Vec3& corner(std::size_t t, std::size_t k) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[t][k])];
  }
  [[nodiscard]] double area(std::size_t t) const {
    return 0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm();
  }
  [[nodiscard]] double longest_side(std::size_t t) const {
    return std::max({(corner(t, 1) - corner(t, 0)).norm(), (corner(t, 2) - corner(t, 1)).norm(),
                     (corner(t, 0) - corner(t, 2)).norm()});
  }
  [[nodiscard]] SurfaceSample sample(std::size_t t, double u, double v, int n) const {
    const Vec3 point = (1.0 - u - v) * corner(t, 0) + u * corner(t, 1) + v * corner(t, 2);
    return {point, normals_[t], area(t) / n / n, u, v, static_cast<int>(t)};
  }

  /// Location and normal of a closest point.
  void place(const BvhHit& hit, Footpoint& foot) const {
    const auto t = static_cast<std::size_t>(hit.triangle);
    const std::array<double, 3> weights = {1.0 - hit.u - hit.v, hit.u, hit.v};
    foot.location = Location::kInside;
    foot.normal = normals_[t];
    int sides = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (weights[k] > kOnSide) continue;
      ++sides;
      const int beside = topology_.neighbors[t][k];
      if (beside < 0) foot.location = Location::kBorder;
      if (beside >= 0) foot.normal = normals_[t] + normals_[static_cast<std::size_t>(beside)];
    }
    if (sides > 1) {
      const auto at = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
      const auto vertex = static_cast<std::size_t>(mesh_.triangles[t][at]);
      foot.normal = corner_normals_[vertex];
      if (topology_.on_border[vertex] != 0) foot.location = Location::kBorder;
    }
    const double length = foot.normal.norm();
    foot.normal =
        length > 0.0 ? Vec3(foot.normal / length) : corner_normals_[static_cast<std::size_t>(mesh_.triangles[t][0])];
  }

  TriangleMesh mesh_;
  MeshTopology topology_;
  std::vector<Vec3> normals_, corner_normals_;
  TriangleBvh tree_;
};

}  // namespace

std::unique_ptr<Target> make_facets(TriangleMesh mesh) { return std::make_unique<Facets>(std::move(mesh)); }

}  // namespace flank::internal
