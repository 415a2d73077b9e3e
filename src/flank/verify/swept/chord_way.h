/// The straight way that stands for a ball's own over some poses.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "flank/vec.h"
#include "flank/verify/swept/segment.h"

namespace flank::internal::verify {

/// The way of the centre at s over segments that follow each other, and the chord that stands for it. The centre passes each place of
/// the chord at no more than the largest distance of a corner.
class ChordWay {
 public:
  ChordWay(const std::vector<Segment>& segments, int own, double s, double most_off_mm);
  [[nodiscard]] const Vec3& end(int step) const { return step > 0 ? end_ : begin_; }
  [[nodiscard]] double off() const { return off_; }

  /// One more segment at this end (1 or -1); false, and nothing changed, where there is none or the chord would be too far off.
  bool go_on(int step);

 private:
  [[nodiscard]] Vec3 at_begin(const Segment& g) const { return g.a0 + s_ * g.w0.normalized(); }
  [[nodiscard]] Vec3 at_end(const Segment& g) const { return g.a0 + g.da + s_ * (g.w0 + g.dw).normalized(); }
  [[nodiscard]] double off_corners(const Vec3& from, const Vec3& to) const;

  const std::vector<Segment>& segments_;
  int first_, last_;
  double s_, most_off_, own_, off_;  ///< mm; own_: of the arcs between poses alone
  Vec3 begin_, end_;
  std::array<Vec3, 16> corners_;
  std::size_t count_ = 2;
};

}  // namespace flank::internal::verify
