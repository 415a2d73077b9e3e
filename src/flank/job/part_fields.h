/// Fields that several jobs have: the part and its faces, what must be kept clear of, and what the judge requires.
#pragma once

#include <string_view>

#include "flank/job.h"
#include "flank/job/field_info.h"

namespace flank::internal {

inline constexpr std::string_view kSideHelp =
    "Machined side of an open sheet: + (towards the normal in the file) or -. Default: the outside where the faces "
    "enclose a space, else +";

template <class Visitor, Is<PartRequest> Request>
void visit_part(Request& part, Visitor& visit) {
  using namespace accepted;
  visit(FieldInfo{"part", "", "", "CAD or mesh file; flank inspect --help names the formats", kAny, Spelling::kFile,
                  "PART", true},
        part.file);
  visit(FieldInfo{"unit", "", "", "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in", kUnit},
        part.unit);
  visit(FieldInfo{"faces", "", "", "Faces to machine: F1, F1,F3, F143-F160, or a piece F1a (see flank inspect)", kAny,
                  Spelling::kPlain, "--face", true},
        part.faces);
  visit(FieldInfo{"skin", "", "", "Instead of --face: this face and all faces tangent to it, as F143", kAny},
        part.skin);
  visit(FieldInfo{"side", "", "", kSideHelp, kSide, Spelling::kSign}, part.side);
}

template <class Visitor, Is<ObstacleRequest> Request>
void visit_obstacles(Request& obstacles, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kFaces = "Other faces", kAbove = "Clearance";
  visit(FieldInfo{"check_faces", "", kFaces,
                  "Faces that the tool must not gouge by more than the tolerance, as F88,F12. Default: all faces that "
                  "are not machined"},
        obstacles.check_faces);
  visit(FieldInfo{"ignore_faces", "", kFaces,
                  "Faces that the tool may cut into; they are not checked. S2-S5 names all faces of solids 2 to 5"},
        obstacles.ignore_faces);
  visit(FieldInfo{"shank", "", kAbove,
                  "given: that of --shank-length or of the tool, and where there is none as auto; auto: a shank that "
                  "reaches out of "
                  "the part, as thick as the flank's upper end or thinner, so that it is clear; none: no shank",
                  kShank},
        obstacles.shank);
  visit(FieldInfo{"shank_length", "mm", kAbove, "Length of a cylindrical shank above the flank", kLength},
        obstacles.shank_length_mm);
  visit(FieldInfo{"shank_radius", "mm", kAbove, "Shank radius. Default: the radius of the flank's upper end", kLength},
        obstacles.shank_radius_mm);
  visit(
      FieldInfo{
          "holder", "", kAbove,
          "Holder outline as z:r,z:r,... (height above the flank's upper end and radius, mm), or a file of such pairs",
          kAny, Spelling::kFileOrText},
      obstacles.holder);
  visit(FieldInfo{"fixtures", "", kAbove,
                  "Part file that flank, shank and holder must not touch; may be given several times", kAny,
                  Spelling::kFile, "--fixture"},
        obstacles.fixtures);
  visit(FieldInfo{"fixture_unit", "", kAbove,
                  "Unit of fixtures that are meshes: mm, cm, m or in; default: that given for the part", kUnit},
        obstacles.fixture_unit);
  visit(FieldInfo{"clearance", "mm", kAbove,
                  "Smallest distance of the holder from the part, of the shank from the faces that are not machined, "
                  "and of the whole tool from fixtures. Default: no collision",
                  kDistance},
        obstacles.clearance_mm);
}

inline constexpr std::string_view kToleranceHelp =
    "Allowed deviation of the machined face, both ways. Default: a thousandth of the diagonal of the machined faces, "
    "rounded down to 1, 2 or 5 times a power of ten, from 0.005 to 0.5 mm";

inline constexpr std::string_view kAllowanceHelp =
    "Material left on purpose, for a later pass: the machined faces and all other faces of the part count as moved "
    "outwards "
    "by this, in planning and in the check. Default: 0";

inline constexpr std::string_view kCutHelp =
    "climb or conventional milling, in every pass; the spindle turns clockwise seen from the holder";

inline constexpr std::string_view kTurnHelp =
    "Largest change of the motion's direction over 1 % of the face's diagonal, degrees. A larger one is a kink and "
    "does not meet the request. 180: any";

inline constexpr std::string_view kReachHelp =
    "Areas where a ball of this radius would gouge a face are not accessible and do not count for --coverage. Default: "
    "the smallest radius of a given tool; for a free tool axis length / (2 x slenderness-max); in a cavity the largest "
    "that fits through; smaller in grooves and fillets";

inline constexpr std::string_view kCellHelp =
    "Grid spacing of the stock simulation. Default: by the size of the cavity";

inline constexpr std::string_view kSampleHelp =
    "Fast check of samples at this spacing only; it passes if no gouge deeper than the tolerance fits between "
    "them. Default: samples, and a proof that no place in between is cut deeper";

template <class Visitor, Is<JudgeRequest> Request>
void visit_judge(Request& judge, Visitor& visit) {
  using namespace accepted;
  visit(FieldInfo{"coverage", "", "", "Share of the accessible area that must be within the tolerance", kCoverage},
        judge.least_coverage);
  visit(FieldInfo{"coverage_whole", "", "",
                  "Share of the whole face, accessible or not, that must be within the tolerance. Default: any; a "
                  "caution reports the rest",
                  kCoverage},
        judge.least_whole);
  visit(FieldInfo{"sample", "mm", "", kSampleHelp, kLength}, judge.sample_mm);
  visit(FieldInfo{"reach_radius", "mm", "Other faces", kReachHelp, kRadius}, judge.reach_radius_mm);
}

}  // namespace flank::internal
