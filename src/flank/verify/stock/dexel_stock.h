/// A tri-dexel stock: the judge's own model of the workpiece, cut by tool poses in their order. It shares no code with the
/// planner's stock, which is made of sweeps and closed forms.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "flank/path/half_space.h"
#include "flank/triangle_mesh.h"
#include "flank/verify/stock/dexel_field.h"
#include "flank/verify/stock/empty_blocks.h"
#include "flank/verify/stock/line_weights.h"
#include "flank/verify/stock/tool_solid.h"

namespace flank::internal::verify {

/// What lines say of a place.
enum class Sight { kOut, kIn, kMixed };

/// Not for several threads at once, but for reading; works in parallel itself, with the same bits for any number of threads.
class DexelStock {
 public:
  /// The part of the box that all planes hold. Throws UsageError for a cell that is not > 0, and
  /// InputError for an empty box or one of more than a thousand million cells across its lines.
  DexelStock(const Box3& box, const std::vector<HalfSpace>& planes, double cell_mm);
  /// What a closed mesh holds of the box. Throws UsageError and InputError as above, and InputError for a mesh that is not closed: cracks between faces are, but
  /// a face that is missing is not.
  DexelStock(const TriangleMesh& body, const Box3& box, double cell_mm);

  /// Takes the tool at a pose away; returns the volume that was material, mm^3: the mean of the three directions.
  double cut(const ToolSolid& tool, const Pose& pose);
  /// What is left, mm^3, as the mean of the three directions, and as each of them has it.
  [[nodiscard]] double volume() const;
  [[nodiscard]] std::array<double, 3> volumes() const;

  /// Signed distance to the surface of the stock, mm: > 0 in the material. Beside a smooth surface to a fraction of the
  /// cell, and farther off to first order; near edges to about a cell. Far from the surface it is only the sign that
  /// counts; -infinity where no line has any material.
  [[nodiscard]] double depth(const Vec3& x) const;
  /// Whether depth(x) > 0, of a place where layers of material lie across a direction: quicker, as most places lie deep in the
  /// material or far from it.
  [[nodiscard]] bool holds(const Vec3& x, const Vec3& across) const;
  /// The same, sooner where it was asked before: `known`, of the stock's fields, is from the stock as it is or was.
  [[nodiscard]] bool holds(const Vec3& x, const Vec3& across, std::vector<EmptyBlocks>& known) const;
  [[nodiscard]] std::vector<EmptyBlocks> empty_blocks() const { return {fields_.begin(), fields_.end()}; }
  /// The distance where lines see a smooth surface; none at edges, and where there is no material near.
  [[nodiscard]] std::optional<double> distance(const Vec3& x) const;

  [[nodiscard]] double cell() const { return cell_; }
  [[nodiscard]] const Box3& box() const { return box_; }
  [[nodiscard]] const DexelField& field(int axis) const { return fields_[static_cast<std::size_t>(axis)]; }

 private:
  /// The surface along four lines around a point: bilinear, where all four have it.
  struct Surface {
    double distance = std::numeric_limits<double>::infinity();  ///< signed, mm, > 0 in the material
    bool found = false;
    bool any = false;     ///< one of the lines has material
    bool inside = false;  ///< of the nearest line
  };
  [[nodiscard]] static Surface surface_along(const DexelField& field, const Vec3& x, double cell);
  /// Where the surface along one of the fields is known.
  [[nodiscard]] double depth(const Vec3& x, const DexelField* known, const Surface& of_known) const;
  /// By the lines of a field first.
  [[nodiscard]] bool holds_by(const DexelField& first, const Vec3& x, Sight sight) const;
  double cut_field(std::size_t axis, const ToolSolid& tool, const Pose& pose);
  Box3 box_;
  double cell_;
  std::vector<DexelField> fields_;
  std::vector<LineWeights> weights_;  ///< of the fields
};

}  // namespace flank::internal::verify
