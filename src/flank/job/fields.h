/// The one table of what a user may ask for: every member of the jobs of job.h with its name, unit, range and help text.
///
/// A new member of a job is one line here, and has then an option of the command line, a key of job.json, a check, and a
/// place in the command that the report shows. tests/job changes every member and looks for it in all of these.
#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

#include "flank/job.h"

namespace flank::internal {

/// Which values a field takes. `words` says it in messages: "... is needed".
struct Accepted {
  std::string_view words;
  bool (*number)(double) = nullptr;          ///< null: any
  bool (*text)(std::string_view) = nullptr;  ///< null: any
};

/// How a value is written on a command line, if not as it is.
enum class Spelling {
  kPlain,
  kFile,         ///< the name of a file or folder: absolute in job.json
  kFileOrText,   ///< a file if there is one of that name; then as kFile
  kOnOff,        ///< of a bool
  kFlag,         ///< of a bool: the option alone, or nothing
  kSign,         ///< of a side: + or -
  kAutoOrCount,  ///< 0 is "auto"
};

struct FieldInfo {
  std::string_view key;    ///< of job.json, and, by flag_of(), of the option: "axis_length" is --axis-length
  std::string_view unit;   ///< "mm", "mm/min"; empty: none
  std::string_view group;  ///< of the help text; empty: the first
  std::string_view help;
  Accepted accepted{};
  Spelling spelling = Spelling::kPlain;
  std::string_view option{};  ///< not by the rule: "--face", or "PART" for a word without option
  bool always = false;        ///< is given, or shown, even if it has its default value
};

}  // namespace flank::internal

namespace flank::internal::accepted {

inline bool positive(double x) { return x > 0.0 && x < 1e300; }
/// What is far below an atom counts as nothing.
inline bool length(double x) { return x >= 1e-9 && x < 1e300; }
inline bool not_negative(double x) { return x >= 0.0 && x < 1e300; }
inline constexpr Accepted kAny{};
inline constexpr Accepted kLength{"expected a length > 0 mm", length};
inline constexpr Accepted kDistance{"expected a length >= 0 mm", not_negative};
inline constexpr Accepted kRadius{"expected a radius > 0 mm", length};
inline constexpr Accepted kRate{"expected a rate > 0 mm/min", positive};
inline constexpr Accepted kShare{"expected a share between 0 and 1", [](double x) { return x >= 0.0 && x <= 1.0; }};
inline constexpr Accepted kCoverage{"expected a share above 0 and at most 1",
                                    [](double x) { return x > 0.0 && x <= 1.0; }};
inline constexpr Accepted kPrice{"expected a share from 0 to 1", [](double x) { return x >= 0.0 && x < 1.0; }};
inline constexpr Accepted kSlope{"expected a number between 0 and 1", [](double x) { return x > 0.0 && x < 1.0; }};
inline constexpr Accepted kRatio{"expected a number > 0", positive};
inline constexpr Accepted kProfile{"must be tapered or any", nullptr,
                                   [](std::string_view x) { return x == "tapered" || x == "any"; }};
inline constexpr Accepted kEffort{"must be quick, normal or thorough", nullptr,
                                  [](std::string_view x) { return x == "quick" || x == "normal" || x == "thorough"; }};
inline constexpr Accepted kPassCount{"expected auto or a number from 1 to 64",
                                     [](double x) { return x >= 0.0 && x <= 64.0; }};
inline constexpr Accepted kStrips{"expected a number from 1 to 200", [](double x) { return x >= 1.0 && x <= 200.0; }};
inline constexpr Accepted kFinalists{"expected a number from 1 to 100",
                                     [](double x) { return x >= 1.0 && x <= 100.0; }};
inline constexpr Accepted kSide{"expected + or -", [](double x) { return x == 1.0 || x == -1.0; }};
inline constexpr Accepted kUnit{"expected mm, cm, m or in", nullptr,
                                [](std::string_view x) { return x == "mm" || x == "cm" || x == "m" || x == "in"; }};
inline constexpr Accepted kStrategy{"must be grow or curves", nullptr,
                                    [](std::string_view x) { return x == "grow" || x == "curves"; }};
inline constexpr Accepted kSpeed{"must be feed, constant or optimal", nullptr,
                                 [](std::string_view x) { return x == "feed" || x == "constant" || x == "optimal"; }};
inline constexpr Accepted kOrder{"must be shortest or given", nullptr,
                                 [](std::string_view x) { return x == "shortest" || x == "given"; }};
inline constexpr Accepted kFollow{"must be path or any", nullptr,
                                  [](std::string_view x) { return x == "path" || x == "any"; }};
inline constexpr Accepted kWorkOffset{"expected a number from 1 to 99", [](double x) { return x >= 1.0 && x <= 99.0; }};
inline constexpr Accepted kToolNumber{"expected a number from 1 to 1000000",
                                      [](double x) { return x >= 1.0 && x <= 1e6; }};
inline constexpr Accepted kTurn{"expected an angle above 0 and at most 180 degrees",
                                [](double x) { return x > 0.0 && x <= 180.0; }};
inline constexpr Accepted kTurns{"expected a number > 0", positive};
inline constexpr Accepted kEngagement{"expected an angle above 5 and up to 180 degrees",
                                      [](double x) { return x > 5.0 && x <= 180.0; }};
inline constexpr Accepted kCut{"must be climb or conventional", nullptr,
                               [](std::string_view x) { return x == "climb" || x == "conventional"; }};
inline constexpr Accepted kShank{"must be given, auto or none", nullptr,
                                 [](std::string_view x) { return x == "given" || x == "auto" || x == "none"; }};
inline constexpr Accepted kClamp{"must be any, bottom or bore", nullptr,
                                 [](std::string_view x) { return x == "any" || x == "bottom" || x == "bore"; }};
inline constexpr Accepted kLayers{"expected auto or a number from 1 to 12",
                                  [](double x) { return x >= 0.0 && x <= 12.0; }};
inline constexpr Accepted kCycles{"must be volume, plain or paper", nullptr,
                                  [](std::string_view x) { return x == "volume" || x == "plain" || x == "paper"; }};
inline constexpr Accepted kEntry{"must be auto, open, ramp or plunge", nullptr, [](std::string_view x) {
                                   return x == "auto" || x == "open" || x == "ramp" || x == "plunge";
                                 }};
inline constexpr Accepted kRampAngle{"expected an angle of at least 0.1 and at most 45 degrees",
                                     [](double x) { return x >= 0.1 && x <= 45.0; }};
inline constexpr Accepted kHelix{"expected an angle from 0 to 60 degrees",
                                 [](double x) { return x >= 0.0 && x <= 60.0; }};
inline constexpr Accepted kCopies{"expected a number from 1 to 999", [](double x) { return x >= 1.0 && x <= 999.0; }};
inline constexpr Accepted kCoolant{"must be off, flood or mist", nullptr,
                                   [](std::string_view x) { return x == "off" || x == "flood" || x == "mist"; }};
inline constexpr Accepted kSeeds{"must be grid or shape", nullptr,
                                 [](std::string_view x) { return x == "grid" || x == "shape"; }};

}  // namespace flank::internal::accepted

namespace flank::internal {

/// T or const T.
template <class Job, class T>
concept Is = std::same_as<std::remove_const_t<Job>, T>;

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
  visit(
      FieldInfo{
          "shank", "", kAbove,
          "auto: a shank as thick as the flank's upper end, or the standard diameter just below it, long enough to "
          "reach out of the part; none: no shank; given: that of --shank-length or of the tool",
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

inline constexpr std::string_view kCurveHelp =
    "on: also fit free tools of other L:D and report finished area, gouge and excess material of each";

inline constexpr std::string_view kBendHelp =
    "Smallest radius of curvature of the paths of tip and holder end that meets the request. Default: any";

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
    "Largest turn of the motion within 1 % of the face's diagonal, degrees. A sharper turn is a kink and does not meet "
    "the request. 180: any";

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

/// Calls visit(FieldInfo, member) for every field of the job, in the order of the help text.
template <class Visitor, Is<FitJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(FieldInfo{"tool", "", "",
                  "free (any profile), a family with any of its parameters (cone:radius=2,angle=3), or a tool file",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"allowance", "mm", "", kAllowanceHelp, kDistance}, job.part.allowance_mm);
  visit(FieldInfo{"axis_length", "mm", "",
                  "Length of the tool's axis, tip centre to upper end. Default: as the face needs", kLength},
        job.tool.axis_length_mm);
  visit(FieldInfo{"strips", "", "",
                  "Number of passes side by side with one tool, or auto: as many as the tolerance needs", kPassCount,
                  Spelling::kAutoOrCount},
        job.strips);
  visit(FieldInfo{"effort", "", "",
                  "How long to search: quick ends after about 20 s of one processor, with at most four passes; normal "
                  "after about five minutes; thorough has no limit",
                  kEffort},
        job.effort);
  visit(FieldInfo{"start", "", "", "First tool axis x,y,z,x,y,z (tip, holder end), mm. Default: found"}, job.start);
  visit(FieldInfo{"guide", "", "", "File of several axes, one a line, that the motion follows", kAny, Spelling::kFile},
        job.guide);
  visit_radius(job.radius, visit);
  visit(FieldInfo{"stiffness_curve", "", "Stiffness", kCurveHelp, kAny, Spelling::kOnOff}, job.stiffness_curve);
  visit(FieldInfo{"cut", "", "Motion", kCutHelp, kCut}, job.cut);
  visit(FieldInfo{"min_bend_radius", "mm", "Motion", kBendHelp, kRadius}, job.min_bend_radius_mm);
  visit(FieldInfo{"turn_max", "", "Motion", kTurnHelp, kTurn}, job.judge.most_turn_deg);
  visit_judge(job.judge, visit);
  visit_obstacles(job.obstacles, visit);
  visit(FieldInfo{"avoid", "", "Other faces",
                  "on: plan around the neighbouring faces; off: plan without them (they are checked all the same)",
                  kAny, Spelling::kOnOff},
        job.avoid);
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

template <class Visitor, Is<CoverJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(
      FieldInfo{
          "tool", "", "",
          "A tool file; a family with all its parameters (barrel:arc=85,radius=5) and --axis-length; a family with "
          "some or none (barrel), the others are found for this face; or catalogue, the best of a folder of tools",
          kAny, Spelling::kFileOrText, "", true},
      job.tool.spec);
  visit(FieldInfo{"axis_length", "mm", "",
                  "Axis length of a family's tool. If parameters are found, default: the width of the face over 1, 2, "
                  "3 and 4 passes, all tried",
                  kLength},
        job.tool.axis_length_mm);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"allowance", "mm", "", kAllowanceHelp, kDistance}, job.part.allowance_mm);
  visit(FieldInfo{"strategy", "", "",
                  "How passes are found: grow (extended step by step), or curves (the published method, to compare)",
                  kStrategy},
        job.strategy);
  visit(FieldInfo{"seed", "", "", "Seed of the random numbers of --strategy curves. Default: 1"}, job.seed);
  visit(FieldInfo{"seeds", "", "", "Where passes start: grid, spread evenly; shape, more where the face is curved more",
                  kSeeds},
        job.seeds);
  visit(FieldInfo{"strips", "", "", "Largest number of passes. Default: until another one adds less than --strip-price",
                  kStrips},
        job.most_strips);
  visit(FieldInfo{"strip_price", "", "", "Share of the face that another pass must add. Default: 0.005", kPrice},
        job.strip_price);
  visit(FieldInfo{"cut", "", "Motion", kCutHelp, kCut}, job.cut);
  visit(FieldInfo{"turn_max", "", "Motion", kTurnHelp, kTurn}, job.judge.most_turn_deg);
  visit_judge(job.judge, visit);
  visit_choice(job.choice, visit);
  visit_obstacles(job.obstacles, visit);
}

inline constexpr std::string_view kMachineHelp = "The machine: a name (flank machine --list) or a file NAME.toml";

template <class Visitor, Is<NcRequest> Request>
void visit_nc(Request& nc, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Program";
  visit(FieldInfo{"nc", "", kGroup, "Check this NC program, run on --machine, instead of the path of DIR", kAny,
                  Spelling::kFile},
        nc.file);
  visit(FieldInfo{"machine", "", kGroup, kMachineHelp, kAny, Spelling::kFileOrText}, nc.machine);
  visit(FieldInfo{"setup", "", kGroup,
                  "Set-up of the part x,y,z,a,b,c (mm, degrees). Default: the one in the program's header", kAny},
        nc.setup);
  visit(FieldInfo{"tool", "", kGroup, "Tool file of the program. Default: that of DIR", kAny, Spelling::kFile},
        nc.tool);
  visit(FieldInfo{"faces", "", kGroup, "Faces that the program machines. Default: those of DIR, else F1", kAny,
                  Spelling::kPlain, "--face"},
        nc.faces);
  visit(
      FieldInfo{
          "work_offset", "", kGroup,
          "Work offset that holds the set-up; 1 is G54. Default: the one in the header, else in the machine's file",
          kWorkOffset},
      nc.work_offset);
  visit(FieldInfo{"tool_number", "", kGroup, "Number of the tool in the program. Default: the one in its header",
                  kToolNumber},
        nc.tool_number);
  visit(FieldInfo{"follow", "", kGroup,
                  "path: the program must cut the whole path of DIR in its order; any: only what it cuts counts",
                  kFollow},
        nc.follow);
}

/// Of a program of several operations.
template <class Visitor, Is<PostJob> Job>
void visit_operations(Job& job, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Operations";
  visit(FieldInfo{"operations", "", kGroup,
                  "Settings of one operation, NUMBER:KEY=VALUE,...: name, tool (number), length (mm), spindle "
                  "(1/min), feed (mm/min), flutes; as 2:name=finish,tool=7. May be given several times",
                  kAny, Spelling::kPlain, "--operation"},
        job.operations);
  visit(
      FieldInfo{"copies", "", kGroup,
                "Run each operation so many times, turned by 360 degrees / copies about --copy-axis. The part must be "
                "the same when it is turned",
                kCopies},
      job.copies);
  visit(
      FieldInfo{"copy_axis", "", kGroup,
                "Axis of the copies in the part's frame x,y,z,x,y,z: a point (mm) and a direction. Default: its Z axis",
                kAny},
      job.copy_axis);
  visit(FieldInfo{"coolant", "", "", "Coolant while the tool cuts: off, flood (M8) or mist (M7)", kCoolant},
        job.coolant);
}

/// What the feed follows, and what bounds it.
template <class Visitor, Is<PostJob> Job>
void visit_loads(Job& job, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Load (with --material)";
  visit(FieldInfo{"helix", "", kGroup, "Helix angle of the cutting edges, degrees", kHelix}, job.helix_deg);
  visit(FieldInfo{"finish_stock", "mm", kGroup,
                  "Thickness of what roughing has left on the machined faces: the feed follows the load of taking it. "
                  "Not needed for a cavity, whose folder holds its load",
                  kLength},
        job.finish_stock_mm);
  visit(FieldInfo{"most_force", "", kGroup, "Largest cutting force, N: the feed is slower where it would be exceeded",
                  kRatio},
        job.most_force_n);
  visit(FieldInfo{"most_power", "", kGroup, "Largest cutting power, W", kRatio}, job.most_power_w);
  visit(FieldInfo{"most_deflection", "mm", kGroup, "Largest deflection of the tool's tip", kLength},
        job.most_deflection_mm);
}

template <class Visitor, Is<PostJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  constexpr std::string_view kLinks = "Links";
  visit(FieldInfo{"folder", "", "", "A folder written by flank fit, cover or trochoid", kAny, Spelling::kFile, "DIR",
                  true},
        job.folder);
  visit(FieldInfo{"more_folders", "", "",
                  "More folders of the same part: the program has an operation for each, with its own tool", kAny,
                  Spelling::kFile, "MORE"},
        job.more_folders);
  visit(FieldInfo{"machine", "", "", kMachineHelp, kAny, Spelling::kFileOrText, "", true}, job.machine);
  visit(FieldInfo{"part", "", "", "Another part than the one named in job.json", kAny, Spelling::kFile}, job.part);
  visit(FieldInfo{"setup", "", "",
                  "Set-up of the part on the table, x,y,z,a,b,c: its origin in mm, its turns about X, then Y, then Z "
                  "in degrees. Default: found, so that the machine reaches everything",
                  kAny},
        job.setup);
  visit(
      FieldInfo{
          "feed", "mm/min", "",
          "Feed rate of the contact point along the passes; required, except for a dry run (1000) and --speed optimal",
          kRate},
      job.feed_mm_min);
  visit(FieldInfo{"clamp", "", "",
                  "How the part is clamped, where --setup is not given. any: any way up; bottom: its Z axis up; bore: "
                  "--copy-axis (default: its Z axis) up and on the axis of the table",
                  kClamp},
        job.clamp);
  visit(FieldInfo{"speed", "", "",
                  "feed: --feed, slower where the axes need it, and in a cavity adapted to the engagement so that the "
                  "thickest chip stays the same; constant: --feed everywhere; optimal: as fast as the axes can",
                  kSpeed},
        job.speed);
  visit(FieldInfo{"most_feed", "mm/min", "",
                  "In a cavity: largest feed, where little or nothing is engaged. Default: three times --feed", kRate},
        job.most_feed_mm_min);
  visit(FieldInfo{"deviation", "mm", "",
                  "Allowed deviation of the control's motion from the path. Default: 0.5 % of the tolerance", kLength},
        job.deviation_mm);
  visit(FieldInfo{"tool_length", "mm", "",
                  "Tool length, from the gauge line to the controlled point. Default: the machine's", kLength},
        job.tool_length_mm);
  visit(
      FieldInfo{"spindle", "", "", "Spindle speed, 1/min; required, except for a dry run and with --material", kTurns},
      job.spindle_rpm);
  visit(FieldInfo{"material", "", "",
                  "Workpiece material (share/materials: aluminium, titanium, ...): derives --spindle and --feed from "
                  "its cutting speed and chip load; needs --flutes"},
        job.material);
  visit(FieldInfo{"flutes", "", "", "Number of the tool's cutting edges, for the feed of --material", kToolNumber},
        job.flutes);
  visit_loads(job, visit);
  visit_operations(job, visit);
  visit(FieldInfo{"dry", "", "", "Dry run: the spindle stands still, and the program's header says so", kAny,
                  Spelling::kFlag},
        job.dry);
  visit(FieldInfo{"force", "", "",
                  "Write the program although it does not meet its request; its header says why, and the exit code is "
                  "still 1",
                  kAny, Spelling::kFlag},
        job.force);
  visit(FieldInfo{"link_clearance", "mm", kLinks, "Distance of the links from the part and its surroundings", kLength},
        job.link_clearance_mm);
  visit(FieldInfo{"lift", "mm", kLinks, "Lead-in and lead-out distance from the surface, before and after each pass",
                  kLength},
        job.lift_mm);
  visit(FieldInfo{"order", "", kLinks,
                  "Order of the passes: shortest (short links) or given (as in the path). Trochoidal "
                  "cycles keep their order",
                  kOrder},
        job.order);
}

template <class Visitor, Is<CycleRequest> Request>
void visit_cycles(Request& cycles, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Cycles";
  visit(FieldInfo{"max_engagement", "", kGroup, "Largest engagement angle of the cutter, degrees", kEngagement},
        cycles.most_engagement_deg);
  visit(FieldInfo{"cut", "", kGroup, "climb or conventional milling; the spindle turns clockwise seen from the holder",
                  kCut},
        cycles.cut);
  visit(FieldInfo{"layers", "", kGroup, "Number of layers with one tool, or auto: as many as the tolerance needs",
                  kLayers, Spelling::kAutoOrCount},
        cycles.layers);
  visit(FieldInfo{"entry", "", kGroup,
                  "How a layer is entered: open, from outside the blank; ramp, to and fro while sinking; plunge, along "
                  "the tool's axis; auto: open where an end is open, else ramp. Ramps and plunges cut a slot, beyond "
                  "--max-engagement; their engagement is reported by itself",
                  kEntry},
        cycles.entry);
  visit(FieldInfo{"ramp_angle", "", kGroup, "Steepest slope of a ramp, degrees", kRampAngle}, cycles.ramp_angle_deg);
  visit(FieldInfo{"strategy", "", kGroup,
                  "volume: optimise the shape of every cycle for removed volume per path length; plain: optimise its "
                  "step only; paper: the published method, to compare",
                  kCycles},
        cycles.strategy);
  visit(FieldInfo{"feed", "mm/min", kGroup, "Feed of cycles and side paths, for the machining time", kRate},
        cycles.feed_mm_min);
  visit(FieldInfo{"rapid", "mm/min", kGroup, "Rapid rate of the links, for the machining time", kRate},
        cycles.rapid_mm_min);
  visit(FieldInfo{"stock_cell", "mm", kGroup, kCellHelp, kLength}, cycles.stock_cell_mm);
}

template <class Visitor, Is<TrochoidJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"part", "", "", "STEP, IGES or BREP file", kAny, Spelling::kFile, "PART", true}, job.part.file);
  visit(FieldInfo{"left", "", "", "Faces of one side of the cavity, as F9, or several that are joined, F9,F10", kAny,
                  Spelling::kPlain, "", true},
        job.left);
  visit(FieldInfo{"right", "", "", "Faces of the opposite side", kAny, Spelling::kPlain, "", true}, job.right);
  visit(FieldInfo{"floor", "", "",
                  "A face at the bottom of the cavity, where the tool's tip is. Default: found from the walls, else at "
                  "the narrower end"},
        job.floor);
  visit(FieldInfo{"tool", "", "",
                  "free (any profile), a family with any of its parameters (cone:radius=2,angle=3), or a tool file",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"allowance", "mm", "", kAllowanceHelp, kDistance}, job.part.allowance_mm);
  visit(FieldInfo{"axis_length", "mm", "",
                  "Length of the tool's axis, tip centre to upper end. Default: as a layer needs", kLength},
        job.tool.axis_length_mm);
  visit_cycles(job.cycles, visit);
  visit_radius(job.radius, visit);
  visit_judge(job.judge, visit);
  visit_obstacles(job.obstacles, visit);
  visit(FieldInfo{"avoid", "", "Other faces",
                  "on: plan around the neighbouring faces; off: plan without them (they are checked all the same)",
                  kAny, Spelling::kOnOff},
        job.avoid);
}

template <class Visitor, Is<BendingRequest> Request>
void visit_bending(Request& bending, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Bending";
  visit(FieldInfo{"bending", "", kGroup,
                  "Also report the errors with the tool bent by its load, at the feed of flank post with this material",
                  kAny, Spelling::kFlag},
        bending.on);
  visit(FieldInfo{"material", "", kGroup, "Workpiece material (share/materials); needed by --bending"},
        bending.material);
  visit(FieldInfo{"flutes", "", kGroup, "Number of the tool's cutting edges; needed by --bending", kToolNumber},
        bending.flutes);
  visit(FieldInfo{"helix", "", kGroup, "Helix angle of the cutting edges, degrees", kHelix}, bending.helix_deg);
  visit(FieldInfo{"finish_stock", "mm", kGroup,
                  "Thickness of what roughing has left on the machined faces. Not needed for a cavity, whose folder "
                  "holds its load",
                  kLength},
        bending.finish_stock_mm);
}

template <class Visitor, Is<VerifyJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"folder", "", "", "A folder written by flank fit, cover or trochoid; not needed with --nc", kAny,
                  Spelling::kFile, "DIR"},
        job.folder);
  visit(FieldInfo{"more_folders", "", "", "The folders of the program's other operations, in their order", kAny,
                  Spelling::kFile, "MORE"},
        job.more_folders);
  visit_nc(job.nc, visit);
  visit(
      FieldInfo{"part", "", "", "Check against this part instead of the one named in job.json", kAny, Spelling::kFile},
      job.part);
  visit(FieldInfo{"side", "", "", kSideHelp, kSide, Spelling::kSign}, job.side);
  visit(FieldInfo{"tolerance", "mm", "", "Another tolerance than that of the job", kLength}, job.tolerance_mm);
  visit(FieldInfo{"sample", "mm", "", kSampleHelp, kLength}, job.sample_mm);
  visit(FieldInfo{"reach_radius", "mm", "Other faces", kReachHelp, kRadius}, job.reach_radius_mm);
  visit(FieldInfo{"stock_cell", "mm", "", kCellHelp, kLength}, job.stock_cell_mm);
  visit_obstacles(job.obstacles, visit);
  visit_bending(job.bending, visit);
}

/// The word of the command line that asks for such a job.
inline std::string_view command_name(const FitJob&) { return "fit"; }
inline std::string_view command_name(const CoverJob&) { return "cover"; }
inline std::string_view command_name(const TrochoidJob&) { return "trochoid"; }
inline std::string_view command_name(const VerifyJob&) { return "verify"; }
inline std::string_view command_name(const PostJob&) { return "post"; }

}  // namespace flank::internal
