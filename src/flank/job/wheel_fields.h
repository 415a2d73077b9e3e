/// The fields of a wheel: the part of the table (fields.h) that asks for all of its operations.
#pragma once

#include <string>
#include <string_view>

#include "flank/job/fields.h"
#include "flank/wheel_request.h"

namespace flank::internal::accepted {

inline constexpr Accepted kSectors{"expected a number from 1 to 1000",
                                   [](double x) { return x >= 1.0 && x <= 1000.0; }};

inline constexpr Accepted kThicknesses{"expected a number of thicknesses, 1 or more",
                                       [](double x) { return x >= 1.0 && x < 1e300; }};

inline constexpr Accepted kTools{"expected 1 or 2", [](double x) { return x == 1.0 || x == 2.0; }};

}  // namespace flank::internal::accepted

namespace flank::internal {

template <class Visitor, Is<WheelRequest> Request>
void visit_wheel_work(Request& wheel, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kRoughing = "Roughing", kProgram = "Program";
  visit(FieldInfo{"rough", "", "", "off: the channels are not roughed", kAny, Spelling::kOnOff}, wheel.rough);
  visit(FieldInfo{"edges", "", "", "off: leading and trailing edges are not machined", kAny, Spelling::kOnOff},
        wheel.edges);
  visit(
      FieldInfo{
          "blank", "", kRoughing,
          "The blank, a closed body that lies where the part does, as a CAD or mesh file. Default: a turned blank "
          "(a body of revolution) round the part",
          kAny, Spelling::kFile},
      wheel.blank);
  visit(FieldInfo{"allowance", "mm", kRoughing, "Stock of a turned blank over the part", kLength}, wheel.allowance_mm);
  visit(FieldInfo{"most_engagement", "deg", kRoughing,
                  "Largest engagement of the tool while roughing, by trochoidal cycles: 90 is half of its width", kTurn,
                  Spelling::kPlain, "--engagement"},
        wheel.most_engagement_deg);
  visit(FieldInfo{"balance", "", kRoughing,
                  "How far roughing lets a blade stand free on one side alone, in thicknesses of the thinnest blade: "
                  "then the other channels are cut as deep. Default: any, a channel after the other",
                  kThicknesses},
        wheel.balance);
  visit(FieldInfo{"machine", "", kProgram,
                  "The machine: a name (flank machine --list) or a file NAME.toml. No pass of the tip tilts the part "
                  "further than it does, and flank wheel also writes its program. Default: any machine, no program",
                  kAny, Spelling::kFileOrText},
        wheel.machine);
  visit(FieldInfo{"most_tilt", "deg", kProgram,
                  "Largest angle between the tool and the wheel's axis on passes of the tip: as far as the machine "
                  "tilts the part",
                  kTurn},
        wheel.most_tilt_deg);
}

template <class Visitor, Is<WheelRequest> Request>
void visit_wheel_roles(Request& wheel, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kRoles = "Roles";
  visit(FieldInfo{"hub", "", kRoles, "Faces of the hub, as F1. Default: found"}, wheel.hub);
  visit(FieldInfo{"blades", "", kRoles, "Faces of a main blade, as F8,F9,F10; once for each blade. Default: found",
                  kAny, Spelling::kPlain, "--blade"},
        wheel.blades);
  visit(FieldInfo{"splitters", "", kRoles, "Faces of a splitter; once for each splitter. Default: found", kAny,
                  Spelling::kPlain, "--splitter"},
        wheel.splitters);
  visit(FieldInfo{"count", "", kRoles, "Number of equal sectors in a whole turn. Default: found", kSectors},
        wheel.count);
}

/// All but the folder for the results.
template <class Visitor, Is<WheelRequest> Request>
void visit_fields(Request& wheel, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"part", "", "", "CAD or mesh file; flank inspect --help names the formats", kAny, Spelling::kFile,
                  "PART", true},
        wheel.part);
  visit(FieldInfo{"unit", "", "", "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in", kUnit},
        wheel.unit);
  visit(FieldInfo{"tolerance", "mm", "", "Allowed deviation of the machined faces, both ways", kLength},
        wheel.tolerance_mm);
  visit(FieldInfo{"coverage", "", "",
                  "Share of the accessible area of sides, edges, fillets and hub that must be within the tolerance",
                  kCoverage},
        wheel.least_coverage);
  visit(FieldInfo{"effort", "", "", "How long each fit searches", kEffort}, wheel.effort);
  visit(FieldInfo{"tool", "", "",
                  "free (any profile), a family (cone:radius=0.6,angle=12), or a tool file. Default: a cone that the "
                  "root fillets take",
                  kAny, Spelling::kFileOrText},
        wheel.tool);
  visit(FieldInfo{"most_tools", "", "",
                  "2: a larger tool roughs where one fits between the blades; 1: the tool that finishes roughs, too",
                  kTools, Spelling::kPlain, "--tools"},
        wheel.most_tools);
  visit(FieldInfo{"holder", "", "",
                  "Holder outline as z:r,z:r,... (height above its face and radius, mm), or a file of such pairs; "
                  "shanks are as long as it needs. Default: not checked",
                  kAny, Spelling::kFileOrText},
        wheel.holder);
  visit(FieldInfo{"sample", "mm", "", "Fast check at this spacing, without the proof. Default: samples and a proof",
                  kLength},
        wheel.sample_mm);
  visit_wheel_work(wheel, visit);
  visit_wheel_roles(wheel, visit);
}

inline std::string_view command_name(const WheelRequest&) { return "wheel"; }

/// As for the other jobs (check_fields.h, command_line.h).
void check_fields(const WheelRequest& job);
[[nodiscard]] std::string command_line(const WheelRequest& job);

}  // namespace flank::internal
