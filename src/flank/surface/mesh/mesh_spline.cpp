#include "flank/surface/mesh/mesh_spline.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/geom/mesh_repair.h"
#include "flank/geom/mesh_topology.h"
#include "flank/geom/trim.h"
#include "flank/surface/mesh/mesh_parameters.h"
#include "flank/surface/mesh/scattered_spline.h"

namespace flank::internal {
namespace {

/// Ratio of control point numbers between one try and the next.
constexpr double kCountGrowth = 1.3;

/// Without a better cross-validation error for this many tries, the search ends.
constexpr int kPatience = 2;

/// Newton steps towards the parameters of the closest point; a vertex on a side of the square stays there.
Vec2 corrected(const BSplineSurface& surface, const Vec3& p, Vec2 uv, char side) {
  for (int i = 0; i < 3; ++i) {
    const SurfaceJet s = surface.jet(uv[0], uv[1]);
    const Vec3 r = s.p - p;
    Vec2 gradient(r.dot(s.du), r.dot(s.dv));
    Eigen::Matrix2d metric;
    metric << s.du.dot(s.du), s.du.dot(s.dv), s.du.dot(s.dv), s.dv.dot(s.dv);
    if ((side & 3) != 0) {
      metric(0, 1) = metric(1, 0) = 0.0;
      gradient[0] = 0.0;
    }
    if ((side & 12) != 0) {
      metric(0, 1) = metric(1, 0) = 0.0;
      gradient[1] = 0.0;
    }
    uv = (uv - metric.inverse() * gradient).cwiseMax(0.0).cwiseMin(1.0);
  }
  return uv;
}

/// A spline through all vertices by least squares, and their parameters on it.
struct Fit {
  BSplineSurface surface;
  std::vector<Vec2> uv;
  double squares = 0.0;          // of the distances along the normal
  double validation = INFINITY;  // generalised cross-validation error
};

/// Sum of the squared distances along the normal: those along the surface are changes of the parameters, not errors.
double normal_squares(const BSplineSurface& surface, const std::vector<Vec3>& points, const std::vector<Vec2>& uv) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfaceJet s = surface.jet(uv[i][0], uv[i][1]);
    const double d = (points[i] - s.p).dot(s.du.cross(s.dv).normalized());
    sum += d * d;
  }
  return sum;
}

/// A spline of `count` control points along the longer side of the patch, and as dense along the other. Parameters
/// are corrected between fits: the first ones are of a map, not of closest points.
Fit fit_with(const TriangleMesh& mesh, const MeshParameters& parameters, std::vector<Vec2> uv, int count,
             const MeshSplineOptions& options) {
  const double longer = std::max(parameters.size_u, parameters.size_v);
  const auto along = [&](double size) {
    return std::max(options.degree + 2, static_cast<int>(std::lround(count * size / longer)));
  };
  ScatteredSplineOptions spline;
  spline.degree = options.degree;
  spline.count_u = along(parameters.size_u);
  spline.count_v = along(parameters.size_v);
  Fit fit;
  fit.uv = std::move(uv);
  for (int round = 0;; ++round) {
    fit.surface = fit_scattered(mesh.vertices, fit.uv, spline);
    if (round == options.corrections) break;
    constexpr std::size_t kGrain = 1024;
    parallel_blocks(fit.uv.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        fit.uv[i] = corrected(fit.surface, mesh.vertices[i], fit.uv[i], parameters.side[i]);
    });
  }
  fit.squares = normal_squares(fit.surface, mesh.vertices, fit.uv);
  const double points = static_cast<double>(mesh.vertices.size()), unknowns = spline.count_u * spline.count_v;
  // With nearly as many unknowns as points a spline follows the noise, and the figure divides by nothing: it stays
  // infinite.
  if (unknowns < 0.7 * points)
    fit.validation = fit.squares / points / ((1.0 - unknowns / points) * (1.0 - unknowns / points));
  return fit;
}

/// A closed polygon in the parameter plane.
TrimLoop polygon(const std::vector<int>& loop, const std::vector<Vec2>& uv) {
  BSplineCurve2 curve;
  curve.degree = 1;
  const auto n = static_cast<Eigen::Index>(loop.size());
  curve.poles.resize(2, n + 1);
  curve.knots.push_back(0.0);
  for (Eigen::Index i = 0; i <= n; ++i) {
    curve.poles.col(i) = uv[static_cast<std::size_t>(loop[static_cast<std::size_t>(i % n)])];
    curve.knots.push_back(static_cast<double>(i) / static_cast<double>(n));
  }
  curve.knots.push_back(1.0);
  return {{curve}};
}

/// Whether the spline's normals mostly point against those of the mesh, at about 500 vertices.
bool against_mesh(const TriangleMesh& mesh, const Fit& fit) {
  double sum = 0.0;
  const std::vector<Vec3> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 1 + mesh.vertices.size() / 500) {
    const SurfaceJet s = fit.surface.jet(fit.uv[i][0], fit.uv[i][1]);
    sum += s.du.cross(s.dv).normalized().dot(normals[i]);
  }
  return sum < 0.0;
}

}  // namespace

std::optional<MeshSpline> fit_spline_to_mesh(const TriangleMesh& mesh, const MeshSplineOptions& options) {
  TriangleMesh sound = repair_mesh(mesh).mesh;
  const MeshTopology topology = link_triangles(sound, kCreaseRad);
  const std::optional<MeshParameters> parameters = parametrize(sound, topology);
  if (!parameters) return std::nullopt;
  Fit best;
  std::vector<Vec2> uv = parameters->uv;
  int without_gain = 0;
  for (double count = options.fewest; count <= options.most + 0.5 && without_gain < kPatience; count *= kCountGrowth) {
    Fit fit = fit_with(sound, *parameters, uv, static_cast<int>(std::lround(count)), options);
    // The next, finer spline begins with parameters that are corrected already.
    uv = fit.uv;
    ++without_gain;
    if (fit.validation >= best.validation) continue;
    best = std::move(fit);
    without_gain = 0;
  }
  if (!std::isfinite(best.validation)) return std::nullopt;
  MeshSpline result;
  result.face.id = "F1";
  result.face.surface = best.surface;
  result.face.reversed = against_mesh(sound, best);
  const double points = static_cast<double>(sound.vertices.size());
  // Unbiased: as many points as unknowns have no error left in them.
  result.residual_mm = std::sqrt(best.squares / (points - best.surface.count_u * best.surface.count_v));
  if (parameters->four_sided && !parameters->holes.empty()) result.face.loops.push_back(rectangle_loop({}));
  for (const auto& hole : parameters->holes) result.face.loops.push_back(polygon(hole, best.uv));
  return result;
}

}  // namespace flank::internal
