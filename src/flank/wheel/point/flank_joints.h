/// How passes along a face go on smoothly from what the flank has left of the faces beside it (MATH.md, section 15).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "flank/wheel/point/face_lines.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {

/// The first and the last line lie on the face's border: their passes touch what the flank has left there. The lines between keep off it, as a
/// pass that runs closer than its scallop asks for would cut into it.
class FlankJoints {
 public:
  using Left = std::function<std::optional<SurfaceLeft>(const Vec3&)>;
  /// `left`: what the flank has left at a place of the border; empty: nothing, and no pass is moved. All must outlive it.
  FlankJoints(const FaceLines& lines, const TipRoom& room, const Left& left);

  /// How far the centre of the sphere is moved from where it would touch its own face, and so much deeper it may enter a wall: as deep as the
  /// flank has cut, so that there is no step.
  struct Shift {
    Vec3 moved = Vec3::Zero();
    double deeper_mm = 0.0;
  };
  [[nodiscard]] Shift at(std::size_t line, double place, const FaceLines::Place& here) const;
  /// Whether a line goes on from the flank at one of its places.
  [[nodiscard]] bool joins(std::size_t line, std::size_t place) const;
  /// Where a line has poses, in places, ascending: at all places, nearer where it joins what the flank has left, as chords between few would
  /// turn the surface's normal there, and nearest where that turns, as it does from pose to pose of the flank.
  [[nodiscard]] std::vector<double> stops(std::size_t line) const;

 private:
  static constexpr std::size_t kSteps = 8;  ///< for each place of a line
  static constexpr double kBeside = 3.0;    ///< places to either side, that a sphere may reach along the border
  static constexpr double kNearMm = 5e-3,   ///< a line whose sphere comes so near to the border has the border's steps
      kMarginMm = 1e-3;                     ///< for what chords between those cut
  /// What the flank has left at a place of a border line.
  struct Joint {
    Shift shift;
    Vec3 normal;
  };
  struct Stop {
    double at = 0.0;  ///< places
    std::optional<Joint> joint;
    Shift shift = {};           ///< the joint's, or what is left of one nearby
    Vec3 place = Vec3::Zero();  ///< on the border
    double off_mm = 0.0;        ///< of the sphere's centre from it; 0: no flank has been near
  };
  using Border = std::vector<Stop>;

  [[nodiscard]] std::optional<Joint> joint_at(std::size_t line, double place, const Left& left) const;
  void refine(std::size_t line, const Stop& from, const Stop& to, const Left& left, Border& out) const;
  [[nodiscard]] Border border_of(std::size_t line, const Left& left) const;
  [[nodiscard]] static const Stop* nearest_joint(const Border& border, std::size_t k);
  /// Of the first and the last line; null: of another one, and where no flank has left anything.
  [[nodiscard]] const Border* border(std::size_t line) const;
  [[nodiscard]] static Border::const_iterator first_from(const Border& border, double place);
  [[nodiscard]] static Shift on_border(const Border& border, double place);
  [[nodiscard]] double up_to_clear(double place, const FaceLines::Place& here, double more_mm) const;

  const FaceLines& lines_;
  double tip_mm_, lift_mm_;
  std::array<Border, 2> borders_;  ///< of the first and the last line; empty: nothing is left by a flank
  std::vector<char> moves_;        ///< of each line, whether it lies on the border or may cut into it
};

}  // namespace flank::internal
