/// Obstacles as the flank sees them: how far is a point of the axis from what its ball must not enter?
///
/// A signed answer (MATH section 7): an axis that has passed through the hub's surface must find its way back, so a
/// face that the target's machining side sees from outside counts as a wall, negative behind it.
#pragma once

#include <memory>
#include <vector>

#include "flank/obstacles.h"
#include "flank/target.h"

namespace flank {

/// Distance of a point to the nearest face, less the clearance that this face wants.
struct ObstacleDistance {
  double distance_mm = 0.0;  ///< negative behind a wall, or nearer than its clearance; the horizon if nothing is nearer
  Vec3 gradient = Vec3::Zero();  ///< of the distance, a unit vector; zero beyond the horizon
  int face = -1;                 ///< index of the face; -1 beyond the horizon; of an estimate: 0
};

/// The faces, and a lattice of distances around the target that is filled when a place is first asked for. Every const
/// function may be called from many threads at once: nodes are atomics, and every thread computes the same value.
class ObstacleField {
 public:
  /// The faces of `obstacles`, which the flank of a tool on `target` must not enter by more than the allowance. Parts
  /// overlap and are open, so a vote settles which side of a face is material. Voters are points `offset_mm` above the
  /// target, where the tool is free; a voter counts if its nearest point on the face is interior to it, not on its
  /// border. A face is a wall if most voters see its outer side (docs/decisions/0010); a face without orientation is
  /// first turned to where most are. All other faces have a distance without sign: the blade's own back, signed, would
  /// forbid every place in front of the blade. A face that all voters see from the material's side lies behind the
  /// target, and is left out. A wall says nothing of what is farther behind it than it is large.
  ObstacleField(const Obstacles& obstacles, const Target& target, double offset_mm, double allowance_mm);

  ~ObstacleField();
  ObstacleField(ObstacleField&&) noexcept;

  /// Exact distance, if it is below the horizon; asking for less is faster.
  [[nodiscard]] ObstacleDistance at(const Vec3& p, double horizon_mm) const;
  /// As at(), but interpolated where that is accurate to a twentieth of the allowance, which is checked place by
  /// place (obstacle/distance_cells). Many times as fast once a neighbourhood is known: for the iterations of a fit, not
  /// for its verdict.
  [[nodiscard]] ObstacleDistance interpolated(const Vec3& p, double horizon_mm) const;
  /// The distance (never a horizon) by interpolation in a lattice around the target: accurate to a few hundredths of
  /// the lattice step (1/48 of the target's size, three times that farther out), except near points equidistant from two
  /// faces. Much faster; for searches that start rough.
  [[nodiscard]] ObstacleDistance estimate(const Vec3& p) const;
  /// A distance, and how far it may be off; where a wall's sign ends, farther.
  struct Rough {
    double distance_mm = 0.0, off_mm = 0.0;
  };
  /// As estimate(), with its bound: a distance changes by no more than the way to the nodes of the lattice.
  [[nodiscard]] Rough rough(const Vec3& p) const;
  /// On which side of `level_mm` the distance is, and about how far: as interpolated() where estimate() cannot tell, else
  /// as that (which may err where a wall's sign ends). For searches of where a ball is free, most of whose places are far
  /// from where it touches.
  [[nodiscard]] double beside(const Vec3& p, double level_mm) const;
  /// Whether a ball of this radius that touches the target at the sample enters no obstacle by more than `depth_mm`
  /// (MATH section 9).
  [[nodiscard]] bool reachable(const SurfaceSample& sample, double radius_mm, double depth_mm) const;
  /// How deep the flank may enter, mm, >= 0. Not zero, because the target's border belongs to its neighbours, too: a
  /// fit lies as often below the target as above it, and must not be pushed off there.
  [[nodiscard]] double allowance_mm() const { return allowance_mm_; }
  [[nodiscard]] int count() const { return static_cast<int>(faces_.size()); }
  /// +1, -1: a wall as it is oriented, or turned; 0: its distance has no sign.
  [[nodiscard]] int sign(int face) const { return signs_[static_cast<std::size_t>(face)]; }

 private:
  struct Lattice;
  struct Exact;
  [[nodiscard]] double node_distance(Lattice& lattice, std::ptrdiff_t index, const Vec3& place) const;
  /// Faces that can be nearest within half a cell of a node with this distance.
  [[nodiscard]] std::vector<std::size_t> faces_near(const Vec3& place, double distance_mm) const;
  /// As estimate(), in one lattice; nothing off it.
  [[nodiscard]] bool estimate_in(Lattice& lattice, const Vec3& p, ObstacleDistance& sum) const;
  /// As at(), of these faces, where nothing that matters is farther than the sight.
  [[nodiscard]] ObstacleDistance search(const std::vector<std::size_t>& faces, const Vec3& p, double horizon_mm,
                                        double sight_mm) const;
  /// Of one face, with its gradient.
  [[nodiscard]] ObstacleDistance to_face(std::size_t face, const Vec3& p, const Footpoint& foot) const;
  /// Without the clearance.
  [[nodiscard]] double signed_distance(std::size_t face, const Vec3& p, const Footpoint& foot) const;

  std::vector<ObstacleFace> faces_;
  double allowance_mm_;
  std::vector<int> signs_;
  std::vector<std::size_t> order_;  ///< in which they are asked: walls first; those behind the target not at all
  /// Around the target, and around that: thick tools and long axes run out of the first.
  std::unique_ptr<Lattice> lattice_, around_;
};

}  // namespace flank
