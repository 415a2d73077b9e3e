/// What the tool must touch. One interface for trimmed NURBS faces, meshes with jets, and several of them together.
///
/// What every target guarantees:
/// - `closest` is the global closest point of the trimmed target: of NURBS faces within 1e-9 of its diagonal
///   (docs/algorithms/nurbs_footpoints.md), of a mesh on its jets (docs/algorithms/mesh_footpoints.md)
/// - `track` is smooth in the query point as long as the footpoint keeps its branch, also past the border
/// - samples come in a fixed order, and each stands for its share of the trimmed area
/// - it does not change after construction, and any number of threads may ask it
///
/// Lengths in mm, points in the frame of the part, normals towards the machining side.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "flank/face.h"
#include "flank/triangle_mesh.h"
#include "flank/vec.h"

namespace flank {

/// Where a footpoint lies. kInside: in the interior of the trimmed face, p - point is along the normal. kBorder: on the
/// border, p - point is not along the normal. kExtension: on the smooth extrapolation past the border (only `track`
/// returns it).
enum class Location { kInside, kBorder, kExtension };

/// Closest point of a target to a query point p (MATH: section 4 of the design's formulas).
struct Footpoint {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit surface normal at `point`, towards the machining side
  /// kInside and kExtension: <p - point, normal>, signed, negative on the material's side. kBorder: |p - point| with
  /// the sign of that product.
  double distance = 0.0;
  double k1 = 0.0,
         k2 = 0.0;  ///< principal curvatures, positive where the surface bends towards the machining side; k1 <= k2
  Vec3 d1 = Vec3::UnitX(), d2 = Vec3::UnitY();  ///< their unit directions
  double u = 0.0, v = 0.0;                      ///< surface parameters (mesh: barycentric)
  int patch = -1;  ///< which face (mesh: which triangle); -1: not found yet, usable as "no hint"
  Location location = Location::kInside;
};

/// A dense sample of the target: the middle of a cell of its surface.
struct SurfaceSample {
  Vec3 point;
  Vec3 normal;
  double area = 0.0;  ///< mm^2, the share of the trimmed area that this sample stands for
  double u = 0.0, v = 0.0;
  int patch = 0;
};

/// Immutable after construction; every member function may be called from many threads at once.
class Target {
 public:
  virtual ~Target() = default;

  /// Cold query: the globally closest point of the trimmed target itself (never on an extension).
  [[nodiscard]] Footpoint closest(const Vec3& p) const {
    return closest_within(p, std::numeric_limits<double>::infinity());
  }
  /// The same where it is nearer than the horizon; else patch is -1. Asking for less is faster.
  [[nodiscard]] virtual Footpoint closest_within(const Vec3& p, double horizon_mm) const = 0;

  /// Warm query: the locally closest point near `hint` on the target extended past its borders; falls back to a cold
  /// start (then continued onto the extension where the footpoint would lie on the border) if hint.patch < 0 or the
  /// iteration fails. The result varies smoothly with p as long as the footpoint keeps its branch: this is what fits
  /// use.
  [[nodiscard]] virtual Footpoint track(const Vec3& p, const Footpoint& hint) const = 0;

  /// Batches; result[i] belongs to points[i]. footpoints is hint (patch >= 0) and result in track_batch.
  void closest_batch(std::span<const Vec3> points, std::span<Footpoint> footpoints) const;
  void track_batch(std::span<const Vec3> points, std::span<Footpoint> footpoints) const;

  /// Samples on the trimmed target with a spacing of about `spacing_mm`, in a fixed order; of a mesh on its triangles.
  [[nodiscard]] virtual std::vector<SurfaceSample> samples(double spacing_mm) const = 0;

  /// The sample as the part is given there: of a mesh with the normal of its triangle, where `normal` is that of the smooth surface
  /// through its corners.
  [[nodiscard]] virtual SurfaceSample as_given(const SurfaceSample& sample) const { return sample; }
  /// Is the target as it is given, of a mesh its triangles, nearer to p than this?
  [[nodiscard]] virtual bool is_nearer(const Vec3& p, double mm) const { return closest_within(p, mm).patch >= 0; }
  /// How far samples may lie off the surface that footpoints lie on, mm: of a mesh its triangles off the smooth surface through their
  /// corners. Else 0.
  [[nodiscard]] virtual double samples_off_mm() const { return 0.0; }

  /// Points on the border of the trimmed target (not on seams and inner edges), at most `spacing_mm` apart along it.
  [[nodiscard]] virtual std::vector<Vec3> border_points(double spacing_mm) const = 0;

  [[nodiscard]] virtual int patch_count() const = 0;
  [[nodiscard]] const Box3& box() const { return box_; }
  [[nodiscard]] double diagonal() const { return box_.diagonal(); }
  [[nodiscard]] double area() const { return area_; }

 protected:
  Box3 box_;  ///< tight, of the trimmed target
  double area_ = 0.0;
};

/// How far a target is extended past its borders, as a share of its size in that direction, and the share of each
/// iso-line that the extrapolation is fitted to.
struct ExtensionOptions {
  double length_share = 0.10;
  double fit_share = 0.18;
};

/// Target of one or more trimmed NURBS faces. side = +1: the machining side is the face's outward normal
/// (Face::reversed), -1: the other one.
[[nodiscard]] std::unique_ptr<Target> make_target(std::vector<Face> faces, int side = +1, const ExtensionOptions& = {});

/// Target of a triangle mesh with local polynomial surfaces ("jets") fitted at its vertices. The triangles' orientation
/// gives the machining side.
[[nodiscard]] std::unique_ptr<Target> make_target(TriangleMesh mesh, const ExtensionOptions& = {});

}  // namespace flank
