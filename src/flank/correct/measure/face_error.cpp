#include "flank/correct/measure/face_error.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr std::size_t kFewest = 100;  ///< points on the face
constexpr double kFar = 0.05;         ///< share of the face's diagonal: no face as cut is that far off
constexpr double kMostBeside = 0.5;   ///< share of the points that may lie beside the face
constexpr double kLeastSeen = 0.9;    ///< share of the face's area that must have a point near
constexpr double kFlat = 1e-4;        ///< mm; errors below it are all of one weight
constexpr int kMoves = 16;
constexpr int kMirrorDegree = 3;  ///< at least: the error's spline has it

[[noreturn]] void refuse(const FaceErrorOptions& options, const std::string& why) {
  throw InputError(options.file + ": " + why);
}

/// What each pass of the plan leaves there; nothing where none is given.
std::vector<double> planned_at(const Vec3& p, const FaceErrorOptions& options) {
  return options.planned_mm ? options.planned_mm(p) : std::vector<double>(1, 0.0);
}

double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

double planned_rms(const Target& target, const std::vector<MeasuredPoint>& points, const FaceErrorOptions& options) {
  if (!options.planned_mm || points.empty()) return 0.0;
  double sum = 0.0;
  for (const MeasuredPoint& point : points)
    sum += std::pow(least(planned_at(target.closest(point.point).point, options)), 2);
  return std::sqrt(sum / static_cast<double>(points.size()));
}

double rms(const std::vector<MeasuredPoint>& points) {
  double sum = 0.0;
  for (const MeasuredPoint& point : points) sum += point.error_mm * point.error_mm;
  return points.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(points.size()));
}

bool on_face(const Footpoint& foot) { return foot.patch >= 0 && foot.location == Location::kInside; }

/// Nearest points of the face; their distances are those beyond what the plan leaves.
std::vector<Footpoint> footpoints(const Target& target, const std::vector<Vec3>& points, const RigidMove& move,
                                  const FaceErrorOptions& options) {
  std::vector<Footpoint> feet(points.size());
  parallel_for(points.size(), [&](std::size_t k) {
    feet[k] = target.closest_within(move.of(points[k]), kFar * target.diagonal());
    if (on_face(feet[k])) feet[k].distance -= least(planned_at(feet[k].point, options));
  });
  return feet;
}

Eigen::Matrix3d turn_of(const Vec3& w) {
  const double angle = w.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

/// One step of the best fit: point to plane, with less weight for points that are far off the others. A move along which the face
/// slides on itself is not made.
void improve(const std::vector<Vec3>& points, const std::vector<Footpoint>& feet, double size, RigidMove& move) {
  std::vector<double> errors;
  for (const Footpoint& foot : feet)
    if (on_face(foot)) errors.push_back(foot.distance);
  const double scale = 2.0 * std::max(typical(errors), kFlat);
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!on_face(feet[k])) continue;
    const Vec3 arm = (move.of(points[k]) - move.middle) / size;
    Eigen::Matrix<double, 6, 1> row;
    row << feet[k].normal, arm.cross(feet[k].normal);
    const double weight = 1.0 / std::max(1.0, std::abs(feet[k].distance) / scale);
    normal += weight * row * row.transpose();
    right -= weight * feet[k].distance * row;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(normal);
  Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
  for (int k = 0; k < 6; ++k)
    if (modes.eigenvalues()[k] > 1e-6 * modes.eigenvalues()[5])
      step += modes.eigenvectors().col(k) * (modes.eigenvectors().col(k).dot(right) / modes.eigenvalues()[k]);
  const Eigen::Matrix3d turn = turn_of(step.tail<3>() / size);
  move.turn = turn * move.turn;
  move.shift = turn * move.shift + step.head<3>();
}

std::vector<MeasuredPoint> measured(const Face& face, const std::vector<Vec3>& points,
                                    const std::vector<Footpoint>& feet, const RigidMove& move) {
  const BSplineSurface& s = face.surface;
  std::vector<MeasuredPoint> all;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (on_face(feet[k]))
      all.push_back({static_cast<int>(k), move.of(points[k]), (feet[k].u - s.u_first()) / (s.u_last() - s.u_first()),
                     (feet[k].v - s.v_first()) / (s.v_last() - s.v_first()), feet[k].distance});
  return all;
}

std::vector<double> above_least(std::vector<double> values) {
  const double lowest = least(values);
  for (double& value : values) value -= lowest;
  return values;
}

void add_passes(const std::vector<Footpoint>& feet, const FaceErrorOptions& options,
                std::vector<MeasuredPoint>& points) {
  parallel_for(points.size(), [&](std::size_t k) {
    const Footpoint& foot = feet[static_cast<std::size_t>(points[k].index)];
    points[k].higher_mm = above_least(planned_at(foot.point, options));
  });
}

/// Every part of the face must have a measured point near.
void require_seen(const Target& target, const std::vector<MeasuredPoint>& points, const FaceErrorOptions& options) {
  const double spacing = std::sqrt(target.area() / static_cast<double>(points.size()));
  const double near = std::max(4.0 * spacing, 0.08 * target.diagonal());
  double seen = 0.0, whole = 0.0;
  for (const SurfaceSample& sample : target.samples(target.diagonal() / 40.0)) {
    whole += sample.area;
    for (const MeasuredPoint& point : points)
      if ((point.point - sample.point).squaredNorm() < near * near) {
        seen += sample.area;
        break;
      }
  }
  if (seen < kLeastSeen * whole)
    refuse(options, "the points cover only " + std::to_string(static_cast<int>(100.0 * seen / whole)) +
                        " % of the face; measure points all over it");
}

/// Knots of a space of a degree (at least the old one) that holds what the old knots hold, with spans of at most an eighth.
std::vector<double> finer_knots(const std::vector<double>& knots, int degree, int finer) {
  constexpr double kSpans = 8.0;
  const double longest = (knots.back() - knots.front()) / kSpans;
  std::vector<double> out;
  for (std::size_t k = 0; k < knots.size();) {
    std::size_t next = k;
    while (next < knots.size() && knots[next] == knots[k]) ++next;
    const int times = static_cast<int>(next - k) + finer - degree;
    out.insert(out.end(), static_cast<std::size_t>(times), knots[k]);
    if (next < knots.size()) {
      const double span = knots[next] - knots[k];
      const int pieces = static_cast<int>(std::ceil(span / longest - 1e-9));
      for (int i = 1; i < pieces; ++i) out.push_back(knots[k] + span * i / pieces);
    }
    k = next;
  }
  return out;
}

void require_this_face(std::size_t on, std::size_t all, const FaceErrorOptions& options) {
  if (on < kFewest && all - on <= all / 2)
    refuse(options,
           std::to_string(on) + " points lie on the face; at least " + std::to_string(kFewest) + " are required");
  if (static_cast<double>(all - on) > kMostBeside * static_cast<double>(all))
    refuse(
        options,
        "only " + std::to_string(on) + " of " + std::to_string(all) +
            " points lie on the face or near it: the others belong to another face, or the points have another datum");
}

}  // namespace

double RigidMove::angle() const { return Eigen::AngleAxisd(turn).angle(); }

double FaceError::of_pass(std::size_t pass, double u, double v) const {
  return std::clamp(field.of_pass(pass, u, v), -limit_mm, limit_mm);
}

double FaceError::at(double u, double v, const std::vector<double>& planned_mm) const {
  const std::vector<double> higher = planned_mm.empty() ? planned_mm : above_least(planned_mm);
  return std::clamp(field.at(u, v, higher), -limit_mm, limit_mm);
}

FaceError face_error(const Target& target, const Face& face, const std::vector<Vec3>& points,
                     const FaceErrorOptions& options) {
  FaceError error;
  error.limit_mm = options.limit_mm;
  error.move.middle = target.box().center();
  if (points.size() < kFewest)
    refuse(options, std::to_string(points.size()) + " points; at least " + std::to_string(kFewest) + " are required");
  std::vector<Footpoint> feet = footpoints(target, points, error.move, options);
  error.rms_before_mm = rms(measured(face, points, feet, error.move));
  for (int k = 0; options.fit_datum && k < kMoves; ++k) {
    improve(points, feet, 0.5 * target.diagonal(), error.move);
    feet = footpoints(target, points, error.move, options);
  }
  error.points = measured(face, points, feet, error.move);
  require_this_face(error.points.size(), points.size(), options);
  error.beside = static_cast<int>(points.size() - error.points.size());
  error.rms_after_mm = rms(error.points);
  require_seen(target, error.points, options);
  add_passes(feet, options, error.points);
  SmoothedError smoothed = smoothed_error(error.points);
  error.field = std::move(smoothed.field);
  error.points = std::move(smoothed.points);
  error.outliers = std::move(smoothed.outliers);
  double square = 0.0;
  for (const MeasuredPoint& point : error.points) {
    const double raw = error.field.at(point.u, point.v, point.higher_mm);
    error.limited = error.limited || std::abs(raw) > options.limit_mm;
    square += raw * raw;
    error.smooth_largest_mm = std::max(error.smooth_largest_mm, std::abs(raw));
  }
  error.smooth_rms_mm = std::sqrt(square / static_cast<double>(error.points.size()));
  error.planned_rms_mm = planned_rms(target, error.points, options);
  return error;
}

Face mirrored_face(const Face& face, const FaceError& error, int side, const PlannedLeft& planned_mm) {
  // The sum of face and error in a space that holds both: a ruled face, or one of few control points, has none for the error.
  const BSplineSurface& old = face.surface;
  Face mirrored = face;
  BSplineSurface& s = mirrored.surface;
  const int degree_u = std::max(old.degree_u, kMirrorDegree), degree_v = std::max(old.degree_v, kMirrorDegree);
  const std::vector<double> knots_u = finer_knots(old.knots_u, old.degree_u, degree_u),
                            knots_v = finer_knots(old.knots_v, old.degree_v, degree_v);
  std::vector<Vec3> points;
  for (const double u : greville_sites(knots_u, degree_u))
    for (const double v : greville_sites(knots_v, degree_v)) {
      const SurfaceJet jet = old.jet(u, v);
      const Vec3 normal = side * jet.du.cross(jet.dv);
      const double e = error.at((u - old.u_first()) / (old.u_last() - old.u_first()),
                                (v - old.v_first()) / (old.v_last() - old.v_first()),
                                planned_mm ? planned_mm(jet.p) : std::vector<double>());
      points.push_back(normal.norm() > 0.0 ? Vec3(jet.p - e * normal.normalized()) : jet.p);
    }
  s = interpolate_grid(points, knots_u, knots_v, degree_u, degree_v);
  return mirrored;
}

}  // namespace flank::internal
