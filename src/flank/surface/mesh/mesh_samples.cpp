#include "flank/surface/mesh/mesh_samples.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "flank/base/assert.h"
#include "flank/error.h"
#include "flank/geom/triangle_bvh.h"

namespace flank::internal {
namespace {

/// Largest area of a sample's cell, in squares of the spacing; halving what is larger keeps the mean near one.
constexpr double kMostCell = 1.5;

/// A triangle that is smaller than the spacing.
struct Piece {
  int triangle;
  double area;
  Vec3 center, normal;
};

/// The sample at a place of the blended surface; area in mm^2.
SurfaceSample sample_at(const JetSurface& surface, int triangle, double u, double v, double area) {
  const SurfaceJet s = surface.jet(triangle, u, v);
  SurfaceSample sample;
  sample.point = s.p;
  sample.normal = s.du.cross(s.dv).normalized();
  sample.area = area;
  sample.u = u;
  sample.v = v;
  sample.patch = triangle;
  return sample;
}

Vec3 on_facet(const JetSurface& surface, int triangle, double u, double v) {
  return (1.0 - u - v) * surface.corner(triangle, 0) + u * surface.corner(triangle, 1) +
         v * surface.corner(triangle, 2);
}

/// n^2 similar triangles, n per side; their areas are scaled to add up to that of the triangle.
void divide(const JetSurface& surface, int triangle, int n, std::vector<SurfaceSample>& samples) {
  const double cell = 1.0 / n;
  const std::size_t first = samples.size();
  double total = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      for (int turned = 0; turned < (i + j + 1 < n ? 2 : 1); ++turned) {
        const double inner = turned == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        const double u = (i + inner) * cell, v = (j + inner) * cell;
        const SurfaceJet s = surface.jet(triangle, u, v);
        samples.push_back(sample_at(surface, triangle, u, v, s.du.cross(s.dv).norm()));
        total += samples.back().area;
      }
    }
  }
  const double scale = surface.area(triangle) / total;
  for (std::size_t k = first; k < samples.size(); ++k) samples[k].area *= scale;
}

/// Into how many parts a triangle's sides are divided: cells of at most kMostCell spacing^2 that are at most 3 spacings
/// long.
int divisions(const JetSurface& surface, int triangle, double area, double spacing) {
  const Vec3 &a = surface.corner(triangle, 0), &b = surface.corner(triangle, 1), &c = surface.corner(triangle, 2);
  const double longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  return static_cast<int>(std::ceil(std::max(std::sqrt(area / kMostCell) / spacing, longest / (3.0 * spacing))));
}

class Grouper {
 public:
  Grouper(const JetSurface& surface, double spacing, std::vector<Piece> pieces, std::vector<SurfaceSample>& samples)
      : surface_(surface), square_(spacing * spacing), pieces_(std::move(pieces)), samples_(samples) {}

  void run() {
    if (!pieces_.empty()) group(0, pieces_.size());
  }

 private:
  using Iterator = std::vector<Piece>::iterator;

  /// Halves a range until it is small and flat enough for one sample.
  void group(std::size_t begin, std::size_t end) {
    double area = 0.0;
    Vec3 normal = Vec3::Zero(), center = Vec3::Zero();
    for (std::size_t i = begin; i < end; ++i) {
      area += pieces_[i].area;
      normal += pieces_[i].area * pieces_[i].normal;
      center += pieces_[i].area * pieces_[i].center;
    }
    const bool bent =
        std::any_of(at(begin), at(end), [&](const Piece& p) { return p.normal.dot(normal) < 0.5 * normal.norm(); });
    if (end - begin == 1 || (area <= kMostCell * square_ && !bent)) {
      emit(begin, end, area, center / area);
      return;
    }
    const std::size_t middle = area <= kMostCell * square_ ? split_normals(begin, end) : split_places(begin, end, area);
    group(begin, middle);
    group(middle, end);
  }

  Iterator at(std::size_t i) { return pieces_.begin() + static_cast<std::ptrdiff_t>(i); }

  /// Across the direction of largest spread, at a whole number of samples' areas.
  std::size_t split_places(std::size_t begin, std::size_t end, double area) {
    return split(
        begin, end, [](const Piece& p) -> const Vec3& { return p.center; }, cut_share(area) * area);
  }

  /// Two sheets that lie close to each other come apart by their normals.
  std::size_t split_normals(std::size_t begin, std::size_t end) {
    const std::size_t middle = split(
        begin, end, [](const Piece& p) -> const Vec3& { return p.normal; }, -1.0);
    return middle;
  }

  [[nodiscard]] double cut_share(double area) const {
    const double count = std::max(2.0, std::round(area / square_));
    return std::floor(0.5 * count) / count;
  }

  /// Sorts by the coordinate of `key` along its principal direction and cuts where `share` of the area is reached, or,
  /// if negative, at the mean.
  template <class Key>
  std::size_t split(std::size_t begin, std::size_t end, Key key, double share) {
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = begin; i < end; ++i) mean += key(pieces_[i]);
    mean /= static_cast<double>(end - begin);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t i = begin; i < end; ++i) spread += (key(pieces_[i]) - mean) * (key(pieces_[i]) - mean).transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(spread);
    const Vec3 axis = solver.eigenvectors().col(2);
    std::sort(at(begin), at(end), [&](const Piece& a, const Piece& b) {
      const double x = axis.dot(key(a)), y = axis.dot(key(b));
      return x != y ? x < y : a.triangle < b.triangle;
    });
    std::size_t middle = begin;
    double sum = 0.0;
    while (middle < end && (share < 0.0 ? axis.dot(key(pieces_[middle]) - mean) < 0.0 : sum < share))
      sum += pieces_[middle++].area;
    return std::clamp(middle, begin + 1, end - 1);
  }

  /// One sample for a range of pieces: the point of their triangles that is nearest to their centre.
  void emit(std::size_t begin, std::size_t end, double area, const Vec3& center) {
    TrianglePoint best;
    int triangle = -1;
    for (std::size_t i = begin; i < end; ++i) {
      const int t = pieces_[i].triangle;
      const TrianglePoint q =
          closest_on_triangle(center, surface_.corner(t, 0), surface_.corner(t, 1), surface_.corner(t, 2));
      if (triangle >= 0 && q.squared_distance >= best.squared_distance) continue;
      best = q;
      triangle = t;
    }
    samples_.push_back(sample_at(surface_, triangle, best.u, best.v, area));
  }

  const JetSurface& surface_;
  double square_;
  std::vector<Piece> pieces_;
  std::vector<SurfaceSample>& samples_;
};

}  // namespace

std::vector<SurfaceSample> mesh_samples(const JetSurface& surface, double spacing_mm, SamplePlaces places) {
  if (!(spacing_mm > 0.0))
    throw UsageError("sample spacing must be positive, got " + std::to_string(spacing_mm) + " mm");
  std::vector<SurfaceSample> samples;
  std::vector<Piece> pieces;
  for (int t = 0; t < surface.real_triangles; ++t) {
    const double area = surface.area(t);
    const int n = divisions(surface, t, area, spacing_mm);
    if (n > 1) {
      divide(surface, t, n, samples);
      continue;
    }
    const SurfaceJet s = surface.jet(t, 1.0 / 3.0, 1.0 / 3.0);
    const Vec3 normal = s.du.cross(s.dv);
    pieces.push_back({t, area, s.p, normal.normalized()});
  }
  Grouper(surface, spacing_mm, std::move(pieces), samples).run();
  if (places == SamplePlaces::kFacets)
    for (SurfaceSample& sample : samples) sample.point = on_facet(surface, sample.patch, sample.u, sample.v);
  return samples;
}

std::vector<Vec3> open_side_points(const TriangleMesh& mesh, const MeshTopology& topology, int triangles,
                                   double spacing_mm) {
  FLANK_ASSERT(spacing_mm > 0.0);
  std::vector<Vec3> points;
  for (std::size_t t = 0; t < static_cast<std::size_t>(triangles); ++t) {
    const auto corner = [&](std::size_t k) {
      return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k % 3])];
    };
    for (std::size_t side = 0; side < 3; ++side) {
      const int neighbor = topology.neighbors[t][side];
      if (neighbor >= 0 && neighbor < triangles) continue;
      const Vec3 a = corner(side + 1), b = corner(side + 2);
      const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / spacing_mm)));
      for (int i = 0; i < steps; ++i) points.push_back(a + (b - a) * (static_cast<double>(i) / steps));
    }
  }
  return points;
}

}  // namespace flank::internal
