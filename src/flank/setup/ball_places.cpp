#include "flank/setup/ball_places.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {

BallPlaces::BallPlaces(const std::vector<FaceSamples>& samples, double radius_mm) {
  double spacing = 0.0;
  for (const FaceSamples& face : samples)
    if (face.target) spacing = std::max(spacing, face.spacing_mm);
  // A cell on the border of a face may lie as far beside its sample once more.
  edge_mm_ = 2.0 * radius_mm + 2.0 * spacing;
  for (const FaceSamples& face : samples) {
    if (!face.target) continue;
    for (const Vec3& p : face.points) {
      const Cube at = cube_of(p);
      for (int k = 0; k < 27; ++k) cubes_.insert({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
    }
  }
}

bool BallPlaces::meet(const Box3& box) const {
  const Cube low = cube_of(box.low), high = cube_of(box.high);
  double count = 1.0;
  for (std::size_t i = 0; i < 3; ++i) count *= static_cast<double>(high[i] - low[i]) + 1.0;
  if (count > static_cast<double>(cubes_.size()))
    return std::any_of(cubes_.begin(), cubes_.end(), [&](const Cube& cube) {
      for (std::size_t i = 0; i < 3; ++i)
        if (cube[i] < low[i] || cube[i] > high[i]) return false;
      return true;
    });
  for (long x = low[0]; x <= high[0]; ++x)
    for (long y = low[1]; y <= high[1]; ++y)
      for (long z = low[2]; z <= high[2]; ++z)
        if (cubes_.contains({x, y, z})) return true;
  return false;
}

std::size_t BallPlaces::Hash::operator()(const Cube& c) const {
  std::size_t hash = 0;
  for (const long i : c) hash = hash * 1'000'003U ^ static_cast<std::size_t>(i);
  return hash;
}

BallPlaces::Cube BallPlaces::cube_of(const Vec3& p) const {
  Cube out{};
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = std::lround(std::floor(p[i] / edge_mm_));
  return out;
}

TriangleMesh near_part(const TriangleMesh& mesh, const BallPlaces& places) {
  TriangleMesh out;
  std::vector<int> kept(mesh.vertices.size(), -1);
  for (const auto& triangle : mesh.triangles) {
    Box3 box;
    for (const int v : triangle) box.add(mesh.vertices[static_cast<std::size_t>(v)]);
    if (!places.meet(box)) continue;
    out.triangles.push_back(triangle);
    for (int& v : out.triangles.back()) {
      int& at = kept[static_cast<std::size_t>(v)];
      if (at < 0) {
        at = static_cast<int>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = at;
    }
  }
  return out;
}

}  // namespace flank::internal
