/// A quick look at all candidates of a ring, several at a time: which of them may reach into what is still open of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flank/trochoid/stock/near_poses.h"

namespace flank::internal {

/// Radians: an open arc from which on some pose may reach into it without holding one of its ends, and without lying within
/// its sector.
inline constexpr double kWide = 3.0;

/// What is open of a ring, in its plane and the frame of its row: from one point of it to another, anticlockwise.
struct OpenArc {
  Vec2 from, to;
  bool wide = false;  ///< about half of the ring or more: whoever reaches the ring may reach into it
};

/// Rings of a tool that lie near to each other, as one: what is open of them is given in the middle, on the mean radius.
struct RingGroup {
  double z = 0.0, half_z = 0.0;            ///< middle and half of their heights, mm
  double radius = 0.0, half_radius = 0.0;  ///< of their radii
};

/// Where the candidates of one row meet the planes of its rings, in single precision. Not for several threads at once: it
/// keeps scratch memory.
class PoseFilter {
 public:
  /// Of this tool, which candidates and rings share.
  explicit PoseFilter(const ToolProfile& profile);

  /// Candidates of a row, in place of those before.
  void take(std::span<const NearPose> candidates);
  void take(const SeenPoses& candidates);
  /// Of those of another filter only these.
  void take(const PoseFilter& from, std::span<const std::size_t> which);
  /// Indices of the candidates, in their order, whose tools may cover a part of an arc of this ring: they hold one of its
  /// ends, or their axes lie in its sector, near enough. Single precision may add some, and leaves none out. Valid until
  /// the next call.
  [[nodiscard]] const std::vector<std::size_t>& reaching(const ToolRing& ring, std::span<const OpenArc> arcs);
  /// The same of every ring of a group, whose arcs lie in the sectors of these: more, and none left out. The heights of a
  /// group are no farther apart than group_height().
  [[nodiscard]] const std::vector<std::size_t>& reaching(const RingGroup& group, std::span<const OpenArc> arcs);
  [[nodiscard]] double group_height() const { return group_height_; }

 private:
  void resize(std::size_t count);
  /// `from`: as SeenPoses has them.
  void take(std::size_t count, const std::array<const double*, 6>& from);
  void find_reaches(double z);
  void find_reaches(const RingGroup& group);
  /// Of the candidates whose reaches were found.
  const std::vector<std::size_t>& find_reaching(double radius, std::span<const OpenArc> arcs);
  static constexpr int kBands = 256;
  /// In bands of height, two more below and above the tool: how far it reaches from its axis, and a little more, mm; 0: it has ended.
  std::vector<float> bands_;
  std::vector<float> group_bands_;  ///< the same for the heights of a group about that
  double low_ = 0.0, per_mm_ = 0.0, largest_ = 0.0, group_height_ = 0.0;
  std::array<std::vector<double>, 6> lanes_;  ///< of candidates that are taken
  std::vector<float> x_, y_, dx_, dy_;        ///< as NearPose has them
  std::vector<float> band_, band_by_z_;       ///< the same of h0 and dh, in bands
  std::vector<float> slope_;                  ///< of the axes, or a little more
  std::vector<float> leaning_;         ///< how far a leaning tool reaches in the plane of a ring, mm; 0: it is upright
  std::vector<float> swing_;           ///< and over which heights of its own about its axis', in bands
  std::vector<float> x_at_, y_at_;     ///< axes in the plane of the ring
  std::vector<float> reach_, excess_;  ///< mm; squared distance less squared reach, the least of all arcs, mm^2
  std::vector<std::int32_t> place_;    ///< index of the candidate's band at the ring
  std::vector<std::uint8_t> marks_;    ///< 1: it reaches what is open
  std::vector<std::size_t> reaching_;
};

}  // namespace flank::internal
