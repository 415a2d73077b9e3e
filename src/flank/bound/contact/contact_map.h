/// The longest contact of a tool all over a face, and what follows from it.
#pragma once

#include <vector>

#include "flank/bound/contact/longest_contact.h"
#include "flank/progress.h"
#include "flank/tool.h"

namespace flank::internal {

struct ContactMapOptions {
  double tolerance_mm = 0.01;
  double spacing_mm = 1.0;  ///< of the points
  ContactSearch search;
};

/// A point of the map.
struct MapPoint {
  Vec3 point, normal;
  double area_mm2 = 0.0;        ///< that the point stands for
  bool may_be_finished = true;  ///< false: no pose touches here without cutting a face too deep
  double stretch = 1.0;         ///< contact on the face is at most this many times as long as along the axis
  LongestContact contact;
};

struct ContactMap {
  std::vector<MapPoint> points;
  double area_mm2 = 0.0;
  double border_mm = 0.0;    ///< length of the border, at most
  double blocked_mm2 = 0.0;  ///< where no pose finishes, by the points
  double way_mm = 0.0;       ///< least way of the contact, sideways, to pass over the rest
  int strips = 0;            ///< least number of strips, none of them longer than half of the border
  bool complete = true;      ///< false: stopped early; points that are left have no bound
};

/// `others`: faces that the tool must not enter. Parallel; the same bits for any number of threads.
[[nodiscard]] ContactMap contact_map(const Target& target, const std::vector<const Target*>& others, const Tool& tool,
                                     const ContactMapOptions& options, const Progress& progress);

}  // namespace flank::internal
