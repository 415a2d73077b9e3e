/// The cutting part of a tool as a solid that lines are cut with: the union of the spheres of radius r(s) about the axis.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "flank/radial_function.h"
#include "flank/verify/swept/range_maximum.h"

namespace flank::internal::verify {

/// A stretch of a line, mm along it.
struct LineCut {
  double low = 0.0, high = 0.0;
};

/// Stretches of one line inside the tool, in their order along it.
struct LineCuts {
  static constexpr int kMost = 8;   ///< further ones are joined to the last: no real meridian has as many waves
  std::array<LineCut, kMost> cuts;  // not set
  int count = 0;
  void add(double low, double high);
};

/// A line beside a tool: point + k direction, both as the tool's axis sees them.
struct ToolLine {
  double z0 = 0.0, dz = 0.0;         ///< height over the tip of k = 0, and per mm
  double a = 1.0, b = 0.0, c = 0.0;  ///< squared distance from the axis: a k^2 + 2 b k + c
};

/// A solid of revolution between cones that join points of the meridian and of both round ends. Immutable.
class ToolSolid {
 public:
  /// The cones stay within `chord_mm` of the meridian, inside of it where it is convex. Throws InputError for a tool
  /// that is not legitimate.
  ToolSolid(const RadialFunction& radial, double chord_mm);

  /// Point and unit direction in the frame of the part.
  [[nodiscard]] static ToolLine line(const Pose& pose, const Vec3& point, const Vec3& direction);
  /// Whether the line meets a cylinder about the tool's axis, and where at most: of a radius that the tool has nowhere
  /// exceeded where the line may meet it.
  [[nodiscard]] bool reach(const ToolLine& line, double radius, LineCut& within) const;
  /// Whether a stretch of the line surely lies beside that cylinder: without a root or a division. Outside, and the nearest
  /// place of the whole line to the axis lies beyond one of its ends.
  [[nodiscard]] static bool passes_by(const ToolLine& line, double radius, double low, double high) {
    const double excess = line.c - radius * radius - kClear;
    return (line.a * high + line.b < 0.0 && (line.a * high + 2.0 * line.b) * high + excess > 0.0) ||
           (line.a * low + line.b > 0.0 && (line.a * low + 2.0 * line.b) * low + excess > 0.0);
  }
  /// The line inside the tool; `within` of reach().
  [[nodiscard]] LineCuts cut(const ToolLine& line, const LineCut& within) const;
  /// Whether the tool at a pose has a point of the part's frame inside, by more than what the cones may be off.
  [[nodiscard]] bool holds(const Pose& pose, const Vec3& point) const;

  [[nodiscard]] double low() const { return nodes_.front().x(); }  ///< height of the lower end, <= 0
  [[nodiscard]] double high() const { return nodes_.back().x(); }
  [[nodiscard]] double largest() const { return largest_; }
  /// Of the heights between two.
  [[nodiscard]] double largest(double from, double to) const;
  /// Heights and radii, from low() to high(), heights strictly increasing.
  [[nodiscard]] const std::vector<Vec2>& nodes() const { return nodes_; }

 private:
  /// What is nearer to the border of a stretch than this is not left to quick tests, whose rounding is another: mm, and mm^2.
  static constexpr double kClear = 1e-6;
  void make_shelves();
  void add_cone(const ToolLine& line, std::size_t cone, double from, double to, LineCuts& out) const;
  /// The cone that has the height, ends included.
  [[nodiscard]] std::size_t cone_at(double z) const;
  /// The same, from one that is not far off.
  [[nodiscard]] std::size_t cone_near(std::size_t cone, double z) const;
  /// What of the stretch is no farther from the axis than the largest radius of these cones.
  [[nodiscard]] LineCut narrowed(const ToolLine& line, const LineCut& within, std::size_t first,
                                 std::size_t last) const;
  /// Radii of kBlock cones that follow each other.
  struct Block {
    double smallest = 1e300, largest = 0.0;
  };
  static constexpr std::size_t kBlock = 8;
  enum class Side { kInside, kOutside, kBoth };
  /// Where the line lies between two places, beside cones of such radii.
  [[nodiscard]] static Side side_of(const ToolLine& line, const Block& block, double from, double to);
  std::vector<Vec2> nodes_;
  std::vector<double> slopes_;  ///< of the cones: radius by height
  std::vector<Block> blocks_;
  std::vector<std::size_t> shelves_;  ///< the cones at the lower ends of equal steps of the height
  double shelves_per_mm_ = 0.0;
  std::optional<RangeMaximum> radii_;  ///< of each cone the largest
  double largest_ = 0.0, chord_ = 0.0;
};

}  // namespace flank::internal::verify
