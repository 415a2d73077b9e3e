/// The longest contact of a tool at one point of a face: an upper bound that is proved, and a pose that comes near it.
#pragma once

#include "flank/bound/contact/question.h"

namespace flank::internal {

struct ContactSearch {
  double gap = 0.05;  ///< ends when the bound is at most this share above what a pose reaches
  int boxes = 800;    ///< or after so many boxes
};

struct LongestContact {
  double bound_mm = 0.0;  ///< no pose touches here over more of its axis; 0: none touches at all
  double found_mm = 0.0;  ///< `pose` touches over so much; 0: none was found
  Pose pose;
  int boxes = 0;  ///< that were looked at
};

/// Of all poses whose nearest point of the face is the site: over how much of the axis, without a gap, is the face within
/// the tolerance of the tool? Poses that cut deeper somewhere else count, too, so the bound holds without them.
[[nodiscard]] LongestContact longest_contact(const ContactQuestion& question, const ContactSite& site,
                                             const ContactSearch& search);

/// Over how much of its axis this pose touches around the station, mm; 0 if it does not touch there. Looks every fine_mm at
/// least.
[[nodiscard]] double contact_of(const ContactQuestion& question, const Pose& pose, double station, double fine_mm);

}  // namespace flank::internal
