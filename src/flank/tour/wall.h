/// One wall of a chain as lines that a straight flank can lie against, in the order in which a tour passes them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "flank/face.h"
#include "flank/target.h"
#include "flank/tour/chain.h"

namespace flank::internal {

/// A straight line across a wall, mm, with the unit normals of the wall at its ends, towards the machined side.
struct WallLine {
  Vec3 foot, head;
  Vec3 foot_normal, head_normal;
  double place = 0.0;  ///< of a ruled wall: the parameter that tells its lines apart
  [[nodiscard]] double length() const { return (head - foot).norm(); }
  [[nodiscard]] Vec3 direction() const { return (head - foot).normalized(); }
};

/// How a wall's first or last line lies: on the edge there or, of a wall that ends there, over its farthest point; and how
/// far it keeps away from that place, mm, at foot and head.
struct WallEnd {
  double foot_back = 0.0, head_back = 0.0;
};

/// A plane, or a surface whose lines of one direction are straight. Planes keep their lines parallel but near edges that lean.
class Wall {
 public:
  /// `begin`, `end`: the edges where the tour comes and goes; null where the chain ends. None where the face has no such
  /// lines, or an edge is none of them.
  [[nodiscard]] static std::optional<Wall> of(const Face& face, const LateralEdge* begin, const LateralEdge* end);

  [[nodiscard]] const Face& face() const { return *face_; }
  [[nodiscard]] const Target& target() const { return *target_; }
  [[nodiscard]] bool flat() const { return flat_; }
  /// The first line, kept back by this much, and the last one.
  [[nodiscard]] WallLine first(const WallEnd& back) const { return end_line(false, back); }
  [[nodiscard]] WallLine last(const WallEnd& back) const { return end_line(true, back); }
  /// Those two and lines between them, from each of which the tour goes evenly to the next.
  [[nodiscard]] std::vector<WallLine> keys(const WallEnd& begin, const WallEnd& end) const;
  /// Between two of the keys, share in [0, 1].
  [[nodiscard]] WallLine between(const WallLine& a, const WallLine& b, double share) const;
  /// Curvature across its lines at a place, 1/mm, positive where the wall bends towards the tool.
  [[nodiscard]] double bend(const Vec3& place) const;
  /// The largest angle between the normals at both ends of a line, rad: zero where a straight flank touches all along.
  [[nodiscard]] double twist() const;
  /// The way along the wall, mm.
  [[nodiscard]] double way() const;

 private:
  Wall() = default;
  [[nodiscard]] bool lay_flat(const LateralEdge* begin, const LateralEdge* end);
  [[nodiscard]] bool end_at(const LateralEdge* edge, int k);
  [[nodiscard]] bool lay_ruled(const LateralEdge* begin, const LateralEdge* end);
  [[nodiscard]] bool find_places(const LateralEdge* begin, const LateralEdge* end);
  [[nodiscard]] bool is_straight(const LateralEdge& edge, int k);
  [[nodiscard]] WallLine end_line(bool last, const WallEnd& back) const;
  [[nodiscard]] WallLine flat_line(double foot_x, double head_x) const;
  [[nodiscard]] WallLine ruled_line(double place) const;
  [[nodiscard]] Vec3 normal_at(double u, double v) const;

  const Face* face_ = nullptr;
  std::shared_ptr<const Target> target_;
  bool flat_ = false;
  // Of a plane: a frame in it, x in the direction of the tour, y along the lines; the ends of the first and of the last line.
  Vec3 origin_ = Vec3::Zero(), x_ = Vec3::UnitX(), y_ = Vec3::UnitY(), normal_ = Vec3::UnitZ();
  double low_ = 0.0, high_ = 0.0;
  double foot_x_[2]{}, head_x_[2]{};
  // Of a ruled wall: the parameter along its lines from foot to head, and that of its first and last line.
  bool along_u_ = false;
  double foot_ = 0.0, head_ = 1.0, place_[2]{0.0, 1.0};
};

}  // namespace flank::internal
