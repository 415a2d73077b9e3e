#include <algorithm>
#include <cmath>

#include "flank/error.h"
#include "flank/judge.h"

namespace flank {
namespace {

/// Of a triangle's sides: bounds the number of samples if the spacing is absurdly small.
constexpr double kMostParts = 20000.0;

}  // namespace

// A triangle is cut into n^2 similar ones, each as large as the spacing allows; a centroid is farthest from its own
// corners.
FaceSamples sample_mesh(const std::string& id, const TriangleMesh& mesh, double spacing_mm, bool target) {
  if (!(spacing_mm > 0.0)) throw UsageError("sample spacing " + std::to_string(spacing_mm) + " mm: must be > 0");
  for (const Vec3& v : mesh.vertices)
    if (!v.allFinite()) throw InputError("mesh " + id + " has a vertex that is not finite");
  FaceSamples out;
  out.face = id;
  out.target = target;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 ab = mesh.vertices[static_cast<std::size_t>(t[1])] - a;
    const Vec3 ac = mesh.vertices[static_cast<std::size_t>(t[2])] - a;
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    const int n = static_cast<int>(std::clamp(std::ceil(longest / spacing_mm), 1.0, kMostParts));
    const double area = 0.5 * ab.cross(ac).norm() / (n * n);
    const Vec3 normal = area > 0.0 ? ab.cross(ac).normalized() : Vec3(Vec3::Zero());
    const Vec3 centroid = (ab + ac) / 3.0;
    out.spacing_mm =
        std::max({out.spacing_mm, centroid.norm() / n, (centroid - ab).norm() / n, (centroid - ac).norm() / n});
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        out.points.push_back(a + ((i + 1.0 / 3.0) * ab + (j + 1.0 / 3.0) * ac) / n);
        out.areas.push_back(area);
        out.normals.push_back(normal);
        if (i + j + 1 >= n) continue;
        out.points.push_back(a + ((i + 2.0 / 3.0) * ab + (j + 2.0 / 3.0) * ac) / n);
        out.areas.push_back(area);
        out.normals.push_back(normal);
      }
    }
  }
  return out;
}

}  // namespace flank
