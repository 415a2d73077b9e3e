/// Fields of a tool that is found: the bounds of a free one, and the choice among given ones.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/field_info.h"

namespace flank::internal {

/// Bounds of a free tool.
template <class Visitor, Is<RadiusRequest> Request>
void visit_radius(Request& radius, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kStiff = "Stiffness";
  visit(FieldInfo{"radius_min", "mm", "", "Smallest radius of a free tool (core). Default: 1 % of the face's diagonal",
                  kRadius},
        radius.min_mm);
  visit(
      FieldInfo{"radius_max", "mm", "", "Largest radius of a free tool. Default: 15 % of the face's diagonal", kRadius},
      radius.max_mm);
  visit(FieldInfo{"slope_max", "", "", "Steepest taper of a free tool's profile, dr/ds", kSlope}, radius.slope_max);
  visit(FieldInfo{"slenderness_max", "", kStiff,
                  "Largest L:D of a free tool with its shank: length over the diameter of a cylinder that bends as "
                  "much. If the part does not allow it, the stiffest tool found is used",
                  kRatio},
        radius.slenderness_max);
  visit(FieldInfo{"profile", "", kStiff, "tapered: a free tool has no neck; any: it may have one", kProfile},
        radius.profile);
  visit(FieldInfo{"neck", "", kStiff, "Allowed necking of a tapered tool, as a share of the radius nearer the tip",
                  kShare},
        radius.neck);
  visit(FieldInfo{"wheel_radius", "mm", kStiff,
                  "Smallest radius of a concave profile, as the grinding wheel needs it. Default: any", kRadius},
        radius.wheel_radius_mm);
}

template <class Visitor, Is<ChoiceRequest> Request>
void visit_choice(Request& choice, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Choice of the tool";
  visit(FieldInfo{"catalogue", "", kGroup,
                  "Folder of tool files (NAME.json) for --tool catalogue. Default: $FLANK_CATALOGUE, else the tools "
                  "that come with flank (share/openflank/catalogue)",
                  kAny, Spelling::kFile},
        choice.catalogue);
  visit(FieldInfo{"finalists", "", kGroup,
                  "Number of tools whose passes are planned in full; the others are compared by a quick plan",
                  kFinalists},
        choice.finalists);
  visit(FieldInfo{"feed", "mm/min", kGroup, "Feed along the passes, for the machining time in the ranking", kRate},
        choice.feed_mm_min);
  visit(FieldInfo{"rapid", "mm/min", kGroup, "Rapid rate between the passes", kRate}, choice.rapid_mm_min);
}

}  // namespace flank::internal
