/// What a depth search cuts into ever smaller cells: a trimmed face or a mesh, its borders and corners included.
#pragma once

#include <array>
#include <vector>

#include "flank/vec.h"

namespace flank::internal::verify {

/// A cell: a part of the face, of one of its border curves, or a corner. What the numbers mean is the shape's business.
struct Cell {
  std::array<double, 4> at{};
  float stretch_u = 0.0F, stretch_v = 0.0F;  ///< lengths of the two directions, mm: where to cut
  int kind = 0;
  int index = 0;
  bool inside = false;   ///< no border is in it
  bool final = false;    ///< too small to be cut again
  double bound = 1e300;  ///< no place of the cell is cut deeper, mm
};

/// Where a cell is looked at.
struct Probe {
  bool empty = false;    ///< nothing of the face is in the cell
  bool on_face = false;  ///< `point` belongs to the face
  Vec3 point = Vec3::Zero();
  double reach = 0.0;  ///< no place of the cell is farther from `point`, mm
  /// `point` is at most so far from a plane (curve: line) that touches the cell at any place of it, mm; infinite: not known.
  double bend = 0.0;
};

/// The deepest place of a face lies inside a cell of the face or of a curve, where nothing is deeper beside it, or is a
/// corner: the cells of a shape hold every place of it in one of these ways (docs/algorithms/judge.md).
class Shape {
 public:
  virtual ~Shape() = default;
  [[nodiscard]] virtual std::vector<Cell> first() const = 0;
  /// Looks at a cell, and notes in it what splitting needs.
  [[nodiscard]] virtual Probe look(Cell& cell) const = 0;
  /// The parts of a cell that has been looked at.
  virtual void split(const Cell& cell, std::vector<Cell>& parts) const = 0;

  /// The cell of a sample (FaceSamples::cells).
  [[nodiscard]] virtual Cell cell_of(const std::array<double, 4>& sample) const = 0;
  /// Points whose convex hull holds all of a cell of the surface; false if none are known.
  [[nodiscard]] virtual bool hull(const Cell& cell, std::vector<Vec3>& points) const = 0;
  /// The area of such a cell is no larger, mm^2, what lies beyond the border included; infinite: not known.
  [[nodiscard]] virtual double area_bound(const Cell& cell) const = 0;
};

}  // namespace flank::internal::verify
