#include "flank/surface/mesh/mesh_parameters.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

/// The turn of the rim is measured between chords of this share of its length to both sides.
constexpr double kCornerChord = 0.03;

/// A corner turns by more than this, and the rim elsewhere by less.
constexpr double kCornerTurn = 0.7;

/// Least cosine between the normals of a graph and its plane.
constexpr double kGraphCosine = 0.25;

/// Share of the square left free around a patch that does not fill it.
constexpr double kMargin = 0.02;

/// The vertex at which each side of the loop starts.
std::vector<int> loop_vertices(const TriangleMesh& mesh, const std::vector<TriangleSide>& loop) {
  std::vector<int> vertices;
  for (const TriangleSide& s : loop)
    vertices.push_back(mesh.triangles[static_cast<std::size_t>(s.triangle)][(s.side + 1) % 3]);
  return vertices;
}

/// A closed polyline with its arc length, mm.
struct Path {
  std::vector<Vec3> points;
  std::vector<double> length;  // up to each point; one more for the closed whole
};

/// The loop's vertices in space, with the length up to each.
Path path_of(const TriangleMesh& mesh, const std::vector<int>& loop) {
  Path path;
  path.length.push_back(0.0);
  for (int v : loop) path.points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  for (std::size_t i = 0; i < path.points.size(); ++i)
    path.length.push_back(path.length.back() + (path.points[(i + 1) % path.points.size()] - path.points[i]).norm());
  return path;
}

/// Mean direction of the path over `reach` before (sign -1) or after (+1) point i.
Vec3 direction(const Path& path, std::size_t i, double reach, int sign) {
  const std::size_t n = path.points.size();
  Vec3 sum = Vec3::Zero();
  std::size_t at = i;
  double gone = 0.0;
  while (gone < reach) {
    const std::size_t next = (at + (sign > 0 ? 1 : n - 1)) % n;
    gone += (path.points[next] - path.points[at]).norm();
    sum += path.points[next] - path.points[i];  // all chords: noise averages out
    at = next;
    if (at == i) break;
  }
  return sum.normalized();
}

/// The four corners in the order of the loop, if there are exactly four.
std::optional<std::array<std::size_t, 4>> corners(const Path& path) {
  const std::size_t n = path.points.size();
  // A corner is a turn between the directions over a stretch on either side, not between two edges: rims are ragged.
  const double reach = kCornerChord * path.length.back();
  std::vector<double> turn(n);
  for (std::size_t i = 0; i < n; ++i)
    turn[i] = std::acos(std::clamp(-direction(path, i, reach, -1).dot(direction(path, i, reach, 1)), -1.0, 1.0));
  std::vector<std::size_t> found;
  // Sharpest turn first; its surroundings turn as well and are not corners of their own.
  std::vector<char> taken(n, 0);
  for (;;) {
    std::size_t best = n;
    for (std::size_t i = 0; i < n; ++i)
      if (!taken[i] && (best == n || turn[i] > turn[best])) best = i;
    if (best == n || turn[best] < kCornerTurn) break;
    found.push_back(best);
    for (std::size_t i = 0; i < n; ++i) {
      const double apart = std::abs(path.length[i] - path.length[best]);
      if (std::min(apart, path.length.back() - apart) < 2.0 * reach) taken[i] = 1;
    }
  }
  // With three corners or five the rim is not the four sides of a square: a plane has to do.
  if (found.size() != 4) return std::nullopt;
  std::sort(found.begin(), found.end());
  return std::array<std::size_t, 4>{found[0], found[1], found[2], found[3]};
}

/// Cotangent of the angle at a corner: the weight of the side opposite to it in the harmonic map.
double cotangent(const TriangleMesh& mesh, int triangle, int corner) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  const auto point = [&](int k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k % 3])]; };
  const Vec3 a = point(corner + 1) - point(corner), b = point(corner + 2) - point(corner);
  // Bounded from both sides: weights stay positive, as the map needs to be one to one.
  return std::clamp(a.dot(b) / std::max(a.cross(b).norm(), 1e-300), 0.05, 20.0);
}

/// Harmonic values inside for given values at the vertices marked in `fixed`.
void solve_harmonic(const TriangleMesh& mesh, const std::vector<char>& fixed, std::vector<Vec2>& uv) {
  // Only free vertices are unknowns; the fixed ones go to the right-hand side.
  std::vector<int> number(mesh.vertices.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (!fixed[v]) number[v] = count++;
  if (count == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const double w = cotangent(mesh, static_cast<int>(t), k);
      const auto a = static_cast<std::size_t>(mesh.triangles[t][(k + 1) % 3]);
      const auto b = static_cast<std::size_t>(mesh.triangles[t][(k + 2) % 3]);
      for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
        if (fixed[i]) continue;
        entries.emplace_back(number[i], number[i], w);
        if (fixed[j]) {
          right.row(number[i]) += w * uv[j].transpose();
        } else {
          entries.emplace_back(number[i], number[j], -w);
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  const Eigen::MatrixX2d solution = factor.solve(right);
  for (std::size_t v = 0; v < number.size(); ++v)
    // Weights are positive, so values lie between those of the rim, but for rounding.
    if (!fixed[v]) uv[v] = solution.row(number[v]).transpose().cwiseMax(0.0).cwiseMin(1.0);
}

/// Covers each hole by a fan about its centre, so that the map goes on evenly across it.
TriangleMesh with_holes_covered(TriangleMesh mesh, const std::vector<std::vector<int>>& holes) {
  for (const auto& hole : holes) {
    Vec3 center = Vec3::Zero();
    for (int v : hole) center += mesh.vertices[static_cast<std::size_t>(v)] / static_cast<double>(hole.size());
    const int id = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(center);
    for (std::size_t i = 0; i < hole.size(); ++i) mesh.triangles.push_back({hole[(i + 1) % hole.size()], hole[i], id});
  }
  return mesh;
}

/// The rim onto the square's sides by arc length, its inside harmonically. The patch's sides become iso-lines, which
/// is what splines fit best.
MeshParameters spread_square(const TriangleMesh& mesh, const std::vector<int>& rim, const Path& path,
                             const std::array<std::size_t, 4>& corner, const std::vector<std::vector<int>>& holes) {
  MeshParameters result;
  result.four_sided = true;
  result.uv.assign(mesh.vertices.size(), Vec2::Constant(0.5));
  result.side.assign(mesh.vertices.size(), 0);
  std::vector<char> fixed(mesh.vertices.size(), 0);
  // Counter-clockwise: v = 0, u = 1, v = 1, u = 0.
  const std::array<Vec2, 4> from{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  const std::array<char, 4> bit{4, 2, 8, 1};
  const std::size_t n = rim.size();
  for (std::size_t s = 0; s < 4; ++s) {
    const std::size_t first = corner[s], last = corner[(s + 1) % 4] + (s == 3 ? n : 0);
    const auto length = [&](std::size_t i) { return path.length[i % n] + (i >= n ? path.length.back() : 0.0); };
    const double whole = length(last) - length(first);
    (s % 2 == 0 ? result.size_u : result.size_v) += 0.5 * whole;
    for (std::size_t i = first; i <= last; ++i) {
      const auto v = static_cast<std::size_t>(rim[i % n]);
      result.uv[v] = from[s] + (length(i) - length(first)) / whole * (from[(s + 1) % 4] - from[s]);
      result.side[v] = static_cast<char>(result.side[v] | bit[s]);
      fixed[v] = 1;
    }
  }
  const TriangleMesh covered = with_holes_covered(mesh, holes);
  fixed.resize(covered.vertices.size(), 0);
  result.uv.resize(covered.vertices.size(), Vec2::Constant(0.5));
  solve_harmonic(covered, fixed, result.uv);
  result.uv.resize(mesh.vertices.size());
  return result;
}

/// Onto the plane of the mean normal, u along the longest extent; nothing if the mesh folds back over it.
std::optional<MeshParameters> project_plane(const TriangleMesh& mesh) {
  Vec3 normal = Vec3::Zero(), mean = Vec3::Zero();
  const std::vector<Vec3> normals = triangle_normals(mesh);
  for (const Vec3& n : normals) normal += n;
  normal.normalize();
  for (const Vec3& n : normals)
    if (n.dot(normal) < kGraphCosine) return std::nullopt;
  for (const Vec3& x : mesh.vertices) mean += x / static_cast<double>(mesh.vertices.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& x : mesh.vertices) {
    const Vec3 flat = (x - mean) - normal.dot(x - mean) * normal;
    spread += flat * flat.transpose();
  }
  const Vec3 a = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2), b = normal.cross(a);
  MeshParameters result;
  Vec2 low = Vec2::Constant(1e300), high = -low;
  for (const Vec3& x : mesh.vertices) {
    result.uv.emplace_back(a.dot(x - mean), b.dot(x - mean));
    low = low.cwiseMin(result.uv.back());
    high = high.cwiseMax(result.uv.back());
  }
  const Vec2 size = high - low;
  result.size_u = size[0];
  result.size_v = size[1];
  for (Vec2& q : result.uv)
    q = (Vec2::Constant(kMargin) + (1.0 - 2.0 * kMargin) * (q - low).cwiseQuotient(size)).eval();
  result.side.assign(mesh.vertices.size(), 0);
  return result;
}

}  // namespace

std::optional<MeshParameters> parametrize(const TriangleMesh& mesh, const MeshTopology& topology) {
  const std::vector<int> number = components(topology);
  if (std::any_of(number.begin(), number.end(), [](int c) { return c > 0; })) return std::nullopt;
  std::vector<int> rim;
  std::vector<std::vector<int>> holes;
  for (const auto& loop : border_loops(mesh, topology)) {
    if (loop.size() < 3) continue;
    const double turning = total_turning(mesh, topology, loop);
    if (turning < -std::numbers::pi) {
      holes.push_back(loop_vertices(mesh, loop));
    } else if (rim.empty() && turning > std::numbers::pi) {
      rim = loop_vertices(mesh, loop);
    } else {
      // A tube, or two rims: no map onto a square.
      return std::nullopt;
    }
  }
  if (rim.empty()) return std::nullopt;
  const Path path = path_of(mesh, rim);
  std::optional<MeshParameters> result;
  if (const auto four = corners(path)) {
    result = spread_square(mesh, rim, path, *four, holes);
  } else {
    result = project_plane(mesh);
    if (result) holes.insert(holes.begin(), rim);
  }
  if (result) result->holes = std::move(holes);
  return result;
}

}  // namespace flank::internal
