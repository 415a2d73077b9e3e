/// The borders of NURBS faces as curves in space: closest points on them, and which of them are seams or shared with a
/// neighbour.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "flank/geom/bvh.h"
#include "flank/surface/nurbs/nurbs_face.h"

namespace flank::internal {

/// A nearly straight part [t0, t1] of an edge of a loop.
struct BorderPiece {
  int face = 0, edge = 0;  ///< edge: index into the curves of all faces
  /// Range of the edge curve's parameter.
  double t0 = 0.0, t1 = 0.0;
  int previous = -1, next = -1;  ///< along the loop
  /// A seam, a pole of a closed surface, or shared with another face: the target goes on past it.
  bool interior = false;
  int partner = -1;  ///< the piece it coincides with
};

/// A point of a border.
struct BorderPoint {
  int piece = -1;
  double t = 0.0, u = 0.0, v = 0.0;
  Vec3 point = Vec3::Zero();
  double squared = 0.0;  ///< |point - p|^2
};

/// Pieces of all borders of a target. Immutable; the prepared faces are passed to every query and must be those of the
/// constructor.
class NurbsBorders {
 public:
  NurbsBorders() = default;
  /// Loops of whole faces are their rectangles.
  NurbsBorders(const std::vector<Face>& faces, const std::vector<NurbsFace>& prepared);

  [[nodiscard]] const std::vector<BorderPiece>& pieces() const { return pieces_; }
  [[nodiscard]] const BorderPiece& piece(int k) const { return pieces_[static_cast<std::size_t>(k)]; }
  /// The corners of a box that holds the piece; empty once they were taken.
  [[nodiscard]] const std::vector<std::vector<Vec3>>& hulls() const { return hulls_; }
  /// Gives them away: trees are made of them, and no query asks them, which are most of what a border takes.
  [[nodiscard]] std::vector<std::vector<Vec3>> take_hulls() { return std::exchange(hulls_, {}); }

  /// A point of a piece, share = 0 at its start and 1 at its end.
  [[nodiscard]] Vec3 point(const std::vector<NurbsFace>& faces, int piece, double share) const;

  /// The closest point of one piece: Newton in the curve's parameter, clamped to the piece, from its middle and, where
  /// p is near a focal point of the curve, from its ends too.
  [[nodiscard]] BorderPoint closest(const std::vector<NurbsFace>& faces, int piece, const Vec3& p) const;

  /// The piece of border `border` (u = u0, u = u1, v = v0, v = v1) of a whole face that holds the parameters.
  [[nodiscard]] int piece_at(const NurbsFace& face, int face_index, int border, double u, double v) const;

 private:
  /// Point of the curve S(c(t)) in space with two derivatives by t, and its parameters c(t).
  struct CurveJet3 {
    Vec3 p, d1, d2;
    double u, v;
  };
  void add_loop(const TrimLoop& loop, const std::vector<NurbsFace>& faces, int face);
  /// Halves a part of an edge until it is nearly straight.
  void split(const std::vector<NurbsFace>& faces, int face, int edge, double t0, double t1, int depth);
  /// Links pieces that coincide: seams, and borders shared by two faces.
  void find_partners(const std::vector<NurbsFace>& faces);
  /// Parameters at which the curve or the surface below it is not smooth.
  [[nodiscard]] std::vector<double> breaks(const NurbsFace& face, const BSplineCurve2& curve) const;
  [[nodiscard]] BorderPoint descend(const NurbsFace& face, int piece, const Vec3& p, double t, double& stiffness) const;
  [[nodiscard]] CurveJet3 jet(const NurbsFace& face, int edge, double t) const;

  /// In parameters of the faces.
  std::vector<BSplineCurve2> edges_;
  std::vector<BorderPiece> pieces_;
  std::vector<std::vector<Vec3>> hulls_;
  std::vector<std::array<int, 4>> rectangle_edges_;  ///< of each face; -1 where it is trimmed
  /// In the order of the edge's parameter.
  std::vector<std::vector<int>> pieces_of_edge_;
};

}  // namespace flank::internal
