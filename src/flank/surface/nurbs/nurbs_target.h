/// Target of one or more trimmed NURBS faces (see target.h).
#pragma once

#include "flank/geom/bvh.h"
#include "flank/surface/nurbs/nurbs_border.h"
#include "flank/surface/nurbs/nurbs_cells.h"

namespace flank::internal {

/// How the queries work: docs/algorithms/nurbs_footpoints.md.
class NurbsTarget : public Target {
 public:
  /// Throws InputError naming the face whose surface is degenerate (a weight that is not positive, no extent) or whose
  /// trims leave nothing.
  NurbsTarget(const std::vector<Face>& faces, int side, const ExtensionOptions& options);

  /// Of a point that is not finite: patch -1 and a distance that is no number.
  [[nodiscard]] Footpoint closest_within(const Vec3& p, double horizon_mm) const override;
  [[nodiscard]] Footpoint track(const Vec3& p, const Footpoint& hint) const override;
  [[nodiscard]] std::vector<SurfaceSample> samples(double spacing_mm) const override;
  [[nodiscard]] std::vector<Vec3> border_points(double spacing_mm) const override;
  [[nodiscard]] int patch_count() const override { return static_cast<int>(faces_.size()); }

 private:
  /// The closest point found so far by one query.
  struct Best;
  /// Throws InputError for a face that cannot be a target.
  static void check(const Face& face);
  /// Box and area of the trimmed faces.
  void measure();
  void measure_cell(const FlatCell& cell);
  Descent descend_cell(const FlatCell& cell, const Vec3& p, double u, double v, Best& best) const;
  /// Lowers `best` by what one cell, or one piece of a border, holds.
  void search_cell(const FlatCell& cell, const Vec3& p, Best& best) const;
  void search_border(int piece, const Vec3& p, Best& best) const;
  /// The footpoint of the best place, with its location and sign.
  [[nodiscard]] Footpoint finish(const Vec3& p, const Best& best) const;
  /// Whether all border pieces that meet at the point lead on into the target; `partner` is one that does, -1 without
  /// any.
  [[nodiscard]] bool leads_on(const Best& best, int& partner) const;
  [[nodiscard]] const NurbsFace& face(int k) const { return faces_[static_cast<std::size_t>(k)]; }

  std::vector<NurbsFace> faces_;
  NurbsBorders borders_;
  std::vector<FlatCell> cells_;
  std::vector<int> searched_pieces_;  ///< items of the tree after the cells: the borders of trimmed faces
  std::vector<bool> has_neighbour_;   ///< whether a face shares a border with another one
  BoxTree tree_;
};

}  // namespace flank::internal
