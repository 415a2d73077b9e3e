/// The faces of a part as samples, triangles and borders: what recognition looks at, of CAD faces and of regions of a mesh alike.
#pragma once

#include <string>
#include <vector>

#include "flank/geom/triangle_bvh.h"
#include "flank/part.h"

namespace flank::internal {

/// A place of a face. Curvatures are 1/mm, positive where the face bends towards its normal; 0 for a mesh.
struct FaceSample {
  Vec3 point, normal;  ///< the normal points away from the material
  double area = 0.0;   ///< mm^2, the share of the face that it stands for
  double low = 0.0, high = 0.0;
};

struct WheelFace {
  std::string id, type;  ///< "F3", or "F3b" for a piece; the type as the file has it
  int index = -1;        ///< of the part's face; of a piece: of the face that it is a piece of
  int solid = -1;
  bool edge = false;  ///< a piece that is an edge
  std::vector<FaceSample> samples;
  std::vector<Vec3> border;
  TriangleMesh mesh;
  TriangleBvh tree;
  Box3 box;
  double area = 0.0;       ///< mm^2
  double border_mm = 0.0;  ///< length of the loops
  /// Mean width across its long extent, mm.
  [[nodiscard]] double width() const { return border_mm > 0.0 ? 2.0 * area / border_mm : 0.0; }
};

/// Every face that could be read, in the order of the part. A face that wraps all round a blade stands as its pieces.
[[nodiscard]] std::vector<WheelFace> wheel_faces(const Part& part);

/// How two faces meet.
struct FaceContact {
  int points = 0;  ///< of the first one's border that lie on the second
  double bend =
      0.0;  ///< mean sine of the angle by which the second rises over the first: > 0 concave, < 0 convex, near 0 smooth
};
/// Points of the border of `a` that are within `near_mm` of `b`.
[[nodiscard]] FaceContact contact(const WheelFace& a, const WheelFace& b, double near_mm);

/// The nearest place of a set of faces: signed distance, > 0 outside the material, and the normal there.
struct NearFace {
  double height = 0.0;
  Vec3 normal = Vec3::UnitZ(), point = Vec3::Zero();
  int face = -1;  ///< place in the list
};
[[nodiscard]] NearFace nearest(const std::vector<const WheelFace*>& faces, const Vec3& p);

}  // namespace flank::internal
