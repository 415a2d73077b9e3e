#include "flank/verify/swept/chord_way.h"

#include <algorithm>
#include <cmath>

namespace flank::internal::verify {
namespace {

/// How far the centre at s is beside the straight way between the ends of its segment. Between unit vectors the chord has the directions
/// of the arc, at the same tau, and is shorter than 1 by c^2 / 4 at most; what their lengths lack to 1 moves tau.
double off_chord(const Segment& g, double s) {
  const Vec3 w1 = g.w0 + g.dw;
  const double lengths = std::abs(g.w0.norm() - 1.0) + std::abs(w1.norm() - 1.0);
  return s * (0.25 * (w1.normalized() - g.w0.normalized()).squaredNorm() + 2.0 * lengths);
}

}  // namespace

ChordWay::ChordWay(const std::vector<Segment>& segments, int own, double s, double most_off_mm)
    : segments_(segments),
      first_(own),
      last_(own),
      s_(s),
      most_off_(most_off_mm),
      own_(off_chord(segments[static_cast<std::size_t>(own)], s)),
      off_(own_) {
  const Segment& g = segments[static_cast<std::size_t>(own)];
  begin_ = at_begin(g), end_ = at_end(g);
  corners_[0] = begin_, corners_[1] = end_;
}

bool ChordWay::go_on(int step) {
  const int next = step > 0 ? last_ + 1 : first_ - 1;
  if (count_ == corners_.size() || next < 0 || next >= static_cast<int>(segments_.size())) return false;
  const Segment& g = segments_[static_cast<std::size_t>(next)];
  if (g.strip != segments_[static_cast<std::size_t>(first_)].strip) return false;
  const Vec3 from = step > 0 ? begin_ : at_begin(g), to = step > 0 ? at_end(g) : end_;
  const double own = std::max(own_, off_chord(g, s_)), off = own + off_corners(from, to);
  if (off > most_off_) return false;
  own_ = own, off_ = off, begin_ = from, end_ = to;
  (step > 0 ? last_ : first_) = next;
  corners_[count_++] = step > 0 ? to : from;
  return true;
}

double ChordWay::off_corners(const Vec3& from, const Vec3& to) const {
  const Vec3 along = to - from;
  const double squared = along.squaredNorm();
  double most = 0.0;
  for (std::size_t k = 0; k < count_; ++k) {
    const Vec3 d = corners_[k] - from;
    const double t = squared > 0.0 ? std::clamp(d.dot(along) / squared, 0.0, 1.0) : 0.0;
    most = std::max(most, (d - t * along).norm());
  }
  return most;
}

}  // namespace flank::internal::verify
