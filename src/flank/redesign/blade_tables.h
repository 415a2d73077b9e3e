/// What a redesign changes for who designed the part: thickness, the gap to the next blade, edges, sections.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flank/part.h"
#include "flank/redesign/millable_surface.h"
#include "flank/redesign/regions.h"
#include "flank/target.h"

namespace flank::internal {

/// A redesigned face beside what it was.
struct ChangedFace {
  int index = 0;  ///< in the part
  std::string id;
  std::unique_ptr<Target> old;  ///< from the machined side
  MillableSurface surface;
  FaceBorders borders;
  Vec3 span = Vec3::UnitZ();  ///< unit, from root to tip: the mean direction of the tool's axis
};

/// Distances from a face to what lies opposite of it, before and after, mm.
struct DistanceFigure {
  bool known = false;  ///< there is something opposite
  double least_before = 0.0, least_after = 0.0, mean_before = 0.0, mean_after = 0.0;
  Vec3 at = Vec3::Zero();  ///< where the least one after is
};

/// One place of a face.
struct DeviationPoint {
  Vec3 point, normal;  ///< of the old face; the normal points to the tool
  double area_mm2 = 0.0;
  double deviation_mm = 0.0;  ///< > 0: the new surface lies outside, material is added
  double thickness_before_mm = 0.0,
         thickness_after_mm = 0.0;  ///< to the opposite face of the same solid; 0: there is none
};

struct SectionPoint {
  Vec3 before, after;
  double deviation_mm = 0.0;
};

/// The section of a face with a plane across its span.
struct Section {
  double height_percent = 0.0, height_mm = 0.0;              ///< from root; along the span, from the origin
  std::vector<SectionPoint> points;                          ///< in order, from border to border
  double chord_mm = 0.0;                                     ///< between its ends
  double largest_mm = 0.0, rms_mm = 0.0;                     ///< of the deviation
  double thickest_before_mm = 0.0, thickest_after_mm = 0.0;  ///< 0: nothing opposite
  double leading_radius_mm = 0.0,
         trailing_radius_mm = 0.0;  ///< of the neighbours at its ends, which stay as they are; 0: none or flat
  double leading_kink_before_deg = 0.0, leading_kink_after_deg = 0.0;  ///< between the face and that neighbour
  double trailing_kink_before_deg = 0.0, trailing_kink_after_deg = 0.0;
};

/// All that is told of one face.
struct FaceTables {
  std::string id;
  std::vector<DeviationPoint> points;
  double area_mm2 = 0.0, rms_mm = 0.0, highest_mm = 0.0, lowest_mm = 0.0;  ///< of the deviation
  DistanceFigure thickness, gap;  ///< to the opposite face of the same solid; across the free space, to what faces it
  std::vector<Section> sections;
};

/// Distances to what is opposite: on the side of the material (thickness) or across the free space in front.
class Opposite {
 public:
  Opposite(const Part& part, const std::vector<ChangedFace>& changed);
  /// From a point of face `face` with its normal (towards the tool), mm; none: nothing there. `after`: with the new surfaces.
  [[nodiscard]] double thickness(int face, const Vec3& p, const Vec3& normal, bool after) const;
  [[nodiscard]] double gap(int face, const Vec3& p, const Vec3& normal, bool after) const;
  /// Of a face that stays, at the place nearest to p within near_mm; patch -1: none.
  [[nodiscard]] Footpoint neighbour(const std::string& id, const Vec3& p, double near_mm) const;

 private:
  [[nodiscard]] double nearest(int face, const Vec3& p, const Vec3& normal, bool after, double side) const;
  struct Wall {
    int index = 0, solid = -1;
    std::string id;
    std::unique_ptr<Target> target;   ///< as it was
    const Target* changed = nullptr;  ///< as it is after; null: as it was
  };
  std::vector<Wall> walls_;
  double size_mm_ = 0.0;
};

/// `heights`: percent of the span.
[[nodiscard]] FaceTables face_tables(const Part& part, const ChangedFace& face, const Opposite& opposite,
                                     const std::vector<double>& heights);

}  // namespace flank::internal
