#include "flank/bound/contact/longest_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

#include "flank/bound/contact/contact_box.h"

namespace flank::internal {
namespace {

constexpr int kAngles = 24, kStations = 6;  ///< first boxes, of a tool that is no cylinder
constexpr int kSteps = 48;                  ///< in which a pose's contact is followed along the axis
constexpr int kHalvings = 7;
constexpr double kGood = 0.9;  ///< share of a box's bound with which no other pose of it is tried

struct OpenBox {
  ContactBox box;
  BoxBound bound;
  int index = 0;
  bool operator<(const OpenBox& other) const {
    return bound.most_mm != other.bound.most_mm ? bound.most_mm < other.bound.most_mm : index > other.index;
  }
};

class Search {
 public:
  Search(const ContactQuestion& question, const ContactSite& site, const ContactSearch& options)
      : question_(question), site_(site), options_(options) {}

  LongestContact run() {
    open_first();
    while (!open_.empty() && result_.boxes < options_.boxes) {
      const OpenBox next = open_.top();
      open_.pop();
      if (next.bound.most_mm <= enough()) {
        settled_ = std::max(settled_, next.bound.most_mm);
        continue;
      }
      try_pose(next);
      split(next);
    }
    if (!open_.empty()) settled_ = std::max(settled_, open_.top().bound.most_mm);
    // Axes that lean more than the boxes hold touch over less than this.
    if (settled_ > 0.0) settled_ = std::max(settled_, site_.least_mm);
    result_.bound_mm = std::max(settled_, result_.found_mm);
    return result_;
  }

 private:
  [[nodiscard]] double enough() const { return std::max(site_.least_mm, result_.found_mm * (1.0 + options_.gap)); }

  void open_first() {
    const int stations = question_.cylinder() ? 1 : kStations;
    const double half = 0.5 * question_.length_mm / stations, turn = std::numbers::pi / kAngles;
    for (int k = 0; k < stations; ++k)
      for (int j = 0; j < kAngles; ++j)
        add({.station = half * (2 * k + 1), .half_station = half, .angle = turn * (2 * j + 1), .half_angle = turn});
  }

  void add(const ContactBox& box) {
    ++result_.boxes;
    const BoxBound bound = BoxSearch(question_, site_, box).run(enough());
    if (bound.most_mm <= enough())
      settled_ = std::max(settled_, bound.most_mm);
    else
      open_.push({box, bound, result_.boxes});
  }

  /// A station of a cylinder is as good as any other: the tool is pushed along its axis until all that touches is flank.
  void try_pose(const OpenBox& open) {
    ContactBox box = open.box;
    if (question_.cylinder()) {
      const double from = open.bound.back, to = open.bound.ahead, length = question_.length_mm;
      box.station = std::clamp(0.5 * length - 0.5 * (from + to), 0.0, length);
    }
    for (const Vec2& move : open.bound.moves) {
      const Pose pose = BoxSearch::pose(question_, site_, box, move);
      const double found = contact_of(question_, pose, box.station, 0.3 * site_.least_mm);
      if (found > result_.found_mm) {
        result_.found_mm = found;
        result_.pose = pose;
      }
      if (found > kGood * open.bound.most_mm) return;
    }
  }

  void split(const OpenBox& open) {
    ContactBox part = open.box;
    part.back = open.bound.back;
    part.ahead = open.bound.ahead;
    // Where neither width costs slack, an end of the tool may: narrower stations then say where it is.
    const bool stations =
        !question_.cylinder() &&
        (open.bound.by_station > open.bound.by_angle ||
         (open.bound.by_angle < 0.02 * question_.tolerance_mm && part.half_station > 0.002 * question_.length_mm));
    double& half = stations ? part.half_station : part.half_angle;
    double& middle = stations ? part.station : part.angle;
    half *= 0.5;
    const double at = middle;
    for (const double side : {-1.0, 1.0}) {
      middle = at + side * half;
      add(part);
    }
  }

  const ContactQuestion& question_;
  const ContactSite& site_;
  const ContactSearch& options_;
  std::priority_queue<OpenBox> open_;
  double settled_ = 0.0;  ///< largest bound of the boxes that are done with
  LongestContact result_;
};

bool touches(const ContactQuestion& question, const Pose& pose, double s) {
  const double r = question.radial->at(s).r, reach = r + question.tolerance_mm;
  const Vec3 p = pose.at(s);
  const Footpoint foot = question.target->closest_within(p, reach);
  return foot.patch >= 0 && (p - foot.point).norm() >= r - question.tolerance_mm;
}

}  // namespace

LongestContact longest_contact(const ContactQuestion& question, const ContactSite& site, const ContactSearch& search) {
  return Search(question, site, search).run();
}

double contact_of(const ContactQuestion& question, const Pose& pose, double station, double fine_mm) {
  if (!touches(question, pose, station)) return 0.0;
  const double step = std::min(question.length_mm / kSteps, fine_mm);
  const auto end = [&](double sign, double limit) {
    double at = station;
    while (sign * (limit - at) > 0.0) {
      const double next = sign > 0.0 ? std::min(at + step, limit) : std::max(at - step, limit);
      if (touches(question, pose, next)) {
        at = next;
        continue;
      }
      double off = next;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (at + off);
        (touches(question, pose, middle) ? at : off) = middle;
      }
      break;
    }
    return at;
  };
  return end(1.0, question.length_mm) - end(-1.0, 0.0);
}

}  // namespace flank::internal
