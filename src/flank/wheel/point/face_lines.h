/// Lines along a face for passes of a sphere: where they lie, and how far apart.
#pragma once

#include <optional>
#include <vector>

#include "flank/face.h"
#include "flank/geom/trim.h"

namespace flank::internal {

/// Parameter lines of the face's longer direction; where the trimmed face lies aslant in its parameters, as a strip of a plane may, straight
/// lines of the parameters along it. Places along a line and lines are numbered evenly: by the way along, and by the scallop across.
class FaceLines {
 public:
  /// `tip_mm`: radius of the sphere; `scallop_mm`: that two lines may leave between them; `step_mm`: between places along a line.
  FaceLines(const Face& face, double tip_mm, double scallop_mm, double step_mm);
  [[nodiscard]] std::size_t lines() const { return across_.size(); }
  [[nodiscard]] std::size_t places() const { return along_.size(); }
  struct Place {
    Vec3 point, normal;  ///< the normal points away from the material
  };
  /// At a place, which need not be whole, of a line; none beside the trimmed face.
  [[nodiscard]] std::optional<Place> at(std::size_t line, double place) const;

 private:
  struct Frame {
    Vec3 point, normal, along, across;  ///< tangents by the parameters
    double bend = 0.0;                  ///< across, 1/mm, > 0 towards the normal
  };
  [[nodiscard]] std::optional<Frame> frame(double along, double across) const;
  void place_lines(double tip_mm, double scallop_mm);
  void place_steps(double step_mm);
  [[nodiscard]] std::vector<Vec2> inside() const;
  void lay_along_parameters();
  void lay_aslant(const std::vector<Vec2>& inside);
  [[nodiscard]] Vec2 parameters(double along, double across) const {
    return origin_ + along * along_way_ + across * across_way_;
  }

  const Face& face_;
  TrimRegion region_;
  Vec2 origin_ = Vec2::Zero(), along_way_ = Vec2::UnitX(), across_way_ = Vec2::UnitY();  ///< in the parameter plane
  double a0_ = 0.0, a1_ = 1.0, c0_ = 0.0, c1_ = 1.0;  ///< of the trimmed region, along and across
  std::vector<double> along_, across_;
};

}  // namespace flank::internal
