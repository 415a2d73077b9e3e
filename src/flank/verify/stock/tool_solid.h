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

/// Poses, each coordinate in an array of its own: x, y, z of the tips, then of the axes.
struct LatePoses {
  std::array<std::vector<double>, 6> at;
  void clear();
  void add(const Pose& pose);
  [[nodiscard]] std::size_t count() const { return at[0].size(); }
  [[nodiscard]] Pose operator[](std::size_t k) const;
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
  /// What is nearer to the border of a stretch than this is not left to quick tests, whose rounding is another: mm, and mm^2.
  static constexpr double kClear = 1e-6;
  /// Whether a stretch of the line surely lies beside a cylinder of a squared radius: without a root or a division. Outside, and
  /// the nearest place of the whole line to the axis lies beyond one of its ends.
  [[nodiscard]] static bool passes_by(const ToolLine& line, double radius2, double low, double high) {
    const double excess = line.c - radius2 - kClear;
    return (line.a * high + line.b < 0.0 && (line.a * high + 2.0 * line.b) * high + excess > 0.0) ||
           (line.a * low + line.b > 0.0 && (line.a * low + 2.0 * line.b) * low + excess > 0.0);
  }
  /// Whether a stretch of the line surely lies outside of the tool: by the largest radius that it has at the stretch's heights, and
  /// by the spheres of its round ends.
  [[nodiscard]] bool misses(const ToolLine& line, double low, double high) const;
  /// The line inside the tool; `within` of reach().
  [[nodiscard]] LineCuts cut(const ToolLine& line, const LineCut& within) const;
  /// Whether the tool at a pose has a point of the part's frame inside, by more than what the cones may be off.
  [[nodiscard]] bool holds(const Pose& pose, const Vec3& point) const;

  /// Whether it has it inside at one of these poses.
  [[nodiscard]] bool holds(const LatePoses& poses, const Vec3& point) const;

  [[nodiscard]] double low() const { return nodes_.front().x(); }  ///< height of the lower end, <= 0
  [[nodiscard]] double high() const { return nodes_.back().x(); }
  [[nodiscard]] double largest() const { return largest_; }
  /// Of the heights between two.
  [[nodiscard]] double largest(double from, double to) const;
  /// Heights and radii, from low() to high(), heights strictly increasing.
  [[nodiscard]] const std::vector<Vec2>& nodes() const { return nodes_; }

 private:
  void make_shelves();
  void make_bands();
  /// Of equal steps of the height, `kBands` of them, the one that has it; the first or the last one if none has.
  [[nodiscard]] std::size_t band_of(double z) const {
    return static_cast<std::size_t>(std::clamp((z - low()) * bands_per_mm_, 0.0, kBands - 1.0));
  }
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
  /// Squared radii of a band.
  struct Band {
    double least = 0.0;  ///< of the solid, by the chord less
    double most = 0.0;
  };
  static constexpr int kBands = 256;
  /// The sphere of a round end, and the height where the flank begins.
  struct RoundEnd {
    double centre = 0.0, radius2 = 0.0, flank = 0.0;
  };
  std::vector<Vec2> nodes_;
  std::vector<double> slopes_;  ///< of the cones: radius by height
  std::vector<Block> blocks_;
  std::vector<std::size_t> shelves_;  ///< the cones at the lower ends of equal steps of the height
  double shelves_per_mm_ = 0.0;
  std::optional<RangeMaximum> radii_;  ///< of each cone the largest
  std::vector<Band> bands_;
  double bands_per_mm_ = 0.0;
  std::optional<RangeMaximum> squares_;  ///< of each band the largest
  RoundEnd tip_, end_;
  double largest_ = 0.0, chord_ = 0.0;
};

}  // namespace flank::internal::verify
