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
inline constexpr Accepted kLength{"a length > 0 mm is needed", length};
inline constexpr Accepted kDistance{"a length >= 0 mm is needed", not_negative};
inline constexpr Accepted kRadius{"a radius > 0 mm is needed", length};
inline constexpr Accepted kRate{"a rate > 0 mm/min is needed", positive};
inline constexpr Accepted kShare{"a share between 0 and 1 is needed", [](double x) { return x >= 0.0 && x <= 1.0; }};
inline constexpr Accepted kCoverage{"a share above 0, at most 1, is needed",
                                    [](double x) { return x > 0.0 && x <= 1.0; }};
inline constexpr Accepted kPrice{"a share from 0 to 1 is needed", [](double x) { return x >= 0.0 && x < 1.0; }};
inline constexpr Accepted kSlope{"a number between 0 and 1 is needed", [](double x) { return x > 0.0 && x < 1.0; }};
inline constexpr Accepted kRatio{"a number > 0 is needed", positive};
inline constexpr Accepted kProfile{"there are tapered and any", nullptr,
                                   [](std::string_view x) { return x == "tapered" || x == "any"; }};
inline constexpr Accepted kEffort{"there are quick, normal and thorough", nullptr,
                                  [](std::string_view x) { return x == "quick" || x == "normal" || x == "thorough"; }};
inline constexpr Accepted kPassCount{"auto or a number from 1 to 64 is needed",
                                     [](double x) { return x >= 0.0 && x <= 64.0; }};
inline constexpr Accepted kStrips{"a number from 1 to 200 is needed", [](double x) { return x >= 1.0 && x <= 200.0; }};
inline constexpr Accepted kFinalists{"a number from 1 to 100 is needed",
                                     [](double x) { return x >= 1.0 && x <= 100.0; }};
inline constexpr Accepted kSide{"+ or - is needed", [](double x) { return x == 1.0 || x == -1.0; }};
inline constexpr Accepted kUnit{"accepted are mm, cm, m, in", nullptr,
                                [](std::string_view x) { return x == "mm" || x == "cm" || x == "m" || x == "in"; }};
inline constexpr Accepted kStrategy{"there are grow and curves", nullptr,
                                    [](std::string_view x) { return x == "grow" || x == "curves"; }};
inline constexpr Accepted kSpeed{"there are feed, constant and optimal", nullptr,
                                 [](std::string_view x) { return x == "feed" || x == "constant" || x == "optimal"; }};
inline constexpr Accepted kOrder{"there are shortest and given", nullptr,
                                 [](std::string_view x) { return x == "shortest" || x == "given"; }};
inline constexpr Accepted kFollow{"there are path and any", nullptr,
                                  [](std::string_view x) { return x == "path" || x == "any"; }};
inline constexpr Accepted kWorkOffset{"a number from 1 to 99 is needed",
                                      [](double x) { return x >= 1.0 && x <= 99.0; }};
inline constexpr Accepted kToolNumber{"a number from 1 to 1000000 is needed",
                                      [](double x) { return x >= 1.0 && x <= 1e6; }};
inline constexpr Accepted kTurn{"an angle above 0, at most 180 degrees, is needed",
                                [](double x) { return x > 0.0 && x <= 180.0; }};
inline constexpr Accepted kTurns{"a number > 0 is needed", positive};
inline constexpr Accepted kEngagement{"an angle above 5 and up to 180 degrees is needed",
                                      [](double x) { return x > 5.0 && x <= 180.0; }};
inline constexpr Accepted kCut{"there are climb and conventional", nullptr,
                               [](std::string_view x) { return x == "climb" || x == "conventional"; }};
inline constexpr Accepted kLayers{"auto or a number from 1 to 12 is needed",
                                  [](double x) { return x >= 0.0 && x <= 12.0; }};
inline constexpr Accepted kCycles{"there are volume, plain and paper", nullptr,
                                  [](std::string_view x) { return x == "volume" || x == "plain" || x == "paper"; }};
inline constexpr Accepted kEntry{"there are auto, open, ramp and plunge", nullptr, [](std::string_view x) {
                                   return x == "auto" || x == "open" || x == "ramp" || x == "plunge";
                                 }};
inline constexpr Accepted kRampAngle{"an angle of at least 0.1 and at most 45 degrees is needed",
                                     [](double x) { return x >= 0.1 && x <= 45.0; }};
inline constexpr Accepted kSeeds{"there are grid and shape", nullptr,
                                 [](std::string_view x) { return x == "grid" || x == "shape"; }};

}  // namespace flank::internal::accepted

namespace flank::internal {

/// T or const T.
template <class Job, class T>
concept Is = std::same_as<std::remove_const_t<Job>, T>;

inline constexpr std::string_view kSideHelp =
    "Machined side of open sheets: + (where the normal of the file points) or -; default: the outer one of what "
    "encloses a space, "
    "else +";

template <class Visitor, Is<PartRequest> Request>
void visit_part(Request& part, Visitor& visit) {
  using namespace accepted;
  visit(FieldInfo{"part", "", "", "CAD or mesh file; `flank inspect --help` names the formats", kAny, Spelling::kFile,
                  "PART", true},
        part.file);
  visit(FieldInfo{"unit", "", "", "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in", kUnit},
        part.unit);
  visit(FieldInfo{"faces", "", "", "Faces to machine: F1, F1,F3, F143-F160, or a piece F1a (see flank inspect)", kAny,
                  Spelling::kPlain, "--face", true},
        part.faces);
  visit(FieldInfo{"skin", "", "", "Instead: this face with all that is joined smoothly to it, F143", kAny}, part.skin);
  visit(FieldInfo{"side", "", "", kSideHelp, kSide, Spelling::kSign}, part.side);
}

template <class Visitor, Is<ObstacleRequest> Request>
void visit_obstacles(Request& obstacles, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kFaces = "Other faces", kAbove = "Clearance";
  visit(
      FieldInfo{"check_faces", "", kFaces,
                "The tool must not enter these faces, F88,F12; default: any face that is not machined. Entering one by "
                "more than the tolerance is exit 1"},
      obstacles.check_faces);
  visit(FieldInfo{"ignore_faces", "", kFaces, "It may enter these: they are not checked; S2-S5: all of solids 2 to 5"},
        obstacles.ignore_faces);
  visit(FieldInfo{"shank_length", "mm", kAbove, "A cylindrical shank above the flank, of this length", kLength},
        obstacles.shank_length_mm);
  visit(FieldInfo{"shank_radius", "mm", kAbove, "Its radius; default: that of the flank's upper end", kLength},
        obstacles.shank_radius_mm);
  visit(
      FieldInfo{
          "holder", "", kAbove,
          "Outline of the holder: z:r,z:r,... (z above the flank's upper end, radius, mm), or a file of such pairs",
          kAny, Spelling::kFileOrText},
      obstacles.holder);
  visit(FieldInfo{"fixtures", "", kAbove,
                  "Part file that shank, holder and flank must not touch; may be given several times", kAny,
                  Spelling::kFile, "--fixture"},
        obstacles.fixtures);
  visit(FieldInfo{"fixture_unit", "", kAbove,
                  "Unit of fixtures that are meshes: mm, cm, m or in; default: `unit`, where the job has it", kUnit},
        obstacles.fixture_unit);
  visit(FieldInfo{"clearance", "mm", kAbove,
                  "Least distance of the holder from the part, of the shank from its other faces (it stands on the "
                  "flank and may "
                  "touch the machined face), and of all from fixtures; default: no collision",
                  kDistance},
        obstacles.clearance_mm);
}

inline constexpr std::string_view kCurveHelp =
    "on: free tools of other slendernesses are fitted, too, each from the next one; summary and report say what each "
    "covers, what it cuts and what it leaves";

inline constexpr std::string_view kBendHelp =
    "Least radius of curvature of the paths of tip and holder end (s = L): a sharper bend does not meet the request; "
    "default: any";

inline constexpr std::string_view kToleranceHelp =
    "Tolerance; default: a thousandth of the diagonal of all that is machined, rounded down to 1, 2 or 5 times a power "
    "of ten, from "
    "0.005 to 0.5 mm";

inline constexpr std::string_view kTurnHelp =
    "Largest angle, degrees, by which the motion may turn within 1 % of the face's diagonal, tip and upper end of the "
    "axis "
    "together: a sharper turn is a kink, and does not meet the request; 180: any";

inline constexpr std::string_view kReachHelp =
    "A place of the face counts as reachable if a ball of this radius touches it without entering another face, or a "
    "corner of this one; --coverage is about those; default: of a given tool its smallest radius; of one that is found "
    "or chosen half of the axis length (or of the root of the face's area) over the largest slenderness, in a cavity "
    "the thickest that goes through it; less where the face is a groove or runs into a tighter fillet";

inline constexpr std::string_view kCellHelp =
    "Between the lines of the stock in which the judge replays a cavity's program; default: by the size of the cavity";

inline constexpr std::string_view kSampleHelp =
    "Judge by samples at this spacing alone, which is quick: it passes only if nothing deeper than the tolerance has "
    "room between them; default: "
    "samples for the figures, and a proof";

template <class Visitor, Is<JudgeRequest> Request>
void visit_judge(Request& judge, Visitor& visit) {
  using namespace accepted;
  visit(FieldInfo{"coverage", "", "", "Share of what is reachable of the face, within tolerance, that counts as done",
                  kCoverage},
        judge.least_coverage);
  visit(
      FieldInfo{"coverage_whole", "", "",
                "Share of the whole face, reachable or not, that must be within tolerance; default: any, what is left "
                "is told",
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
  visit(FieldInfo{"radius_min", "mm", "", "Smallest radius of a free tool (core); default: 1 % of the face's diagonal",
                  kRadius},
        radius.min_mm);
  visit(
      FieldInfo{"radius_max", "mm", "", "Largest radius of a free tool; default: 15 % of the face's diagonal", kRadius},
      radius.max_mm);
  visit(FieldInfo{"slope_max", "", "", "Largest |r'| of a free tool", kSlope}, radius.slope_max);
  visit(FieldInfo{"slenderness_max", "", kStiff,
                  "Largest slenderness of a free tool, flank and shank: length over the diameter of the cylinder that "
                  "bends as much. Where the part does not allow it, the least that does",
                  kRatio},
        radius.slenderness_max);
  visit(FieldInfo{"profile", "", kStiff, "tapered: a free tool has no neck; any: it may", kProfile}, radius.profile);
  visit(FieldInfo{"neck", "", kStiff,
                  "By which share the radius of a tapered tool may fall below what it was farther down", kShare},
        radius.neck);
  visit(FieldInfo{"wheel_radius", "mm", kStiff,
                  "Least radius of a concave meridian: of the wheel that grinds it; default: any", kRadius},
        radius.wheel_radius_mm);
}

/// Calls visit(FieldInfo, member) for every field of the job, in the order of the help text.
template <class Visitor, Is<FitJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(FieldInfo{"tool", "", "", "free, a family with any of its parameters (cone:radius=2,angle=3), or a tool.json",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"axis_length", "mm", "", "Length of the tool's axis; default: as the face needs", kLength},
        job.tool.axis_length_mm);
  visit(FieldInfo{"strips", "", "",
                  "Passes side by side with one tool: a number, or auto: as many as the tolerance needs", kPassCount,
                  Spelling::kAutoOrCount},
        job.strips);
  visit(
      FieldInfo{"effort", "", "",
                "How much is tried: normal ends after about five minutes of one processor, with its best; quick after "
                "20 seconds, with few starts, four strips at most and no tool more slender than --slenderness-max; "
                "thorough has twice the starts and no limit",
                kEffort},
      job.effort);
  visit(FieldInfo{"start", "", "", "First axis x,y,z,x,y,z (tip, holder end), mm; default: automatic"}, job.start);
  visit(FieldInfo{"guide", "", "", "File of several such lines: the axis follows them", kAny, Spelling::kFile},
        job.guide);
  visit_radius(job.radius, visit);
  visit(FieldInfo{"stiffness_curve", "", "Stiffness", kCurveHelp, kAny, Spelling::kOnOff}, job.stiffness_curve);
  visit(FieldInfo{"min_bend_radius", "mm", "Motion", kBendHelp, kRadius}, job.min_bend_radius_mm);
  visit(FieldInfo{"turn_max", "", "Motion", kTurnHelp, kTurn}, job.judge.most_turn_deg);
  visit_judge(job.judge, visit);
  visit_obstacles(job.obstacles, visit);
  visit(
      FieldInfo{"avoid", "", "Other faces",
                "on: steer the tool clear of the other faces; off: fit as if they were not there (they are judged all "
                "the same)",
                kAny, Spelling::kOnOff},
      job.avoid);
}

template <class Visitor, Is<ChoiceRequest> Request>
void visit_choice(Request& choice, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Choice of the tool";
  visit(
      FieldInfo{"catalogue", "", kGroup,
                "Folder of tool files (NAME.json) for --tool catalogue; default: $FLANK_CATALOGUE, else the tools that "
                "come with flank (share/openflank/catalogue)",
                kAny, Spelling::kFile},
      choice.catalogue);
  visit(FieldInfo{"finalists", "", kGroup,
                  "Tools that are covered in full, strips smoothed; the others are compared by strips as they grow",
                  kFinalists},
        choice.finalists);
  visit(FieldInfo{"feed", "mm/min", kGroup, "Feed along the strips, for the machining time in the ranking", kRate},
        choice.feed_mm_min);
  visit(FieldInfo{"rapid", "mm/min", kGroup, "Rate between the strips", kRate}, choice.rapid_mm_min);
}

template <class Visitor, Is<CoverJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit_part(job.part, visit);
  visit(
      FieldInfo{
          "tool", "", "",
          "A tool.json; a family with all its parameters (barrel:arc=85,radius=5) and --axis-length; a family with "
          "some or none (barrel, barrel:radius=5): the others are searched for this face; or catalogue: the best "
          "of a folder of tools",
          kAny, Spelling::kFileOrText, "", true},
      job.tool.spec);
  visit(
      FieldInfo{
          "axis_length", "mm", "",
          "Length of the axis of a family; if parameters are searched, default: the width of the face over 1, 2, 3 "
          "and 4 strips, all tried",
          kLength},
      job.tool.axis_length_mm);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"strategy", "", "", "How strips are found: grow, or curves (the published method, to compare)",
                  kStrategy},
        job.strategy);
  visit(FieldInfo{"seed", "", "", "Seed of the random numbers of --strategy curves; default: 1"}, job.seed);
  visit(FieldInfo{"seeds", "", "",
                  "Where lines are begun: grid, spread evenly, or shape, more where the face bends more", kSeeds},
        job.seeds);
  visit(FieldInfo{"strips", "", "", "Most strips on one target; default: as many as are worth their price", kStrips},
        job.most_strips);
  visit(FieldInfo{"strip_price", "", "", "Share of the face that a strip must add to be worth it; default: 0.005",
                  kPrice},
        job.strip_price);
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
  visit(FieldInfo{"nc", "", kGroup, "Judge this NC program, run on --machine, instead of the path of DIR", kAny,
                  Spelling::kFile},
        nc.file);
  visit(FieldInfo{"machine", "", kGroup, kMachineHelp, kAny, Spelling::kFileOrText}, nc.machine);
  visit(FieldInfo{"setup", "", kGroup,
                  "Where the part sits: x,y,z,a,b,c (mm, degrees); default: as the program's header says", kAny},
        nc.setup);
  visit(FieldInfo{"tool", "", kGroup, "The tool.json of the program; default: that of DIR", kAny, Spelling::kFile},
        nc.tool);
  visit(FieldInfo{"faces", "", kGroup, "Faces that it machines; default: those of DIR, else F1", kAny, Spelling::kPlain,
                  "--face"},
        nc.faces);
  visit(
      FieldInfo{"work_offset", "", kGroup,
                "The work offset that holds the set-up: 1 is G54; default: as the header says, else the machine's file",
                kWorkOffset},
      nc.work_offset);
  visit(FieldInfo{"tool_number", "", kGroup, "The number of the tool of DIR; default: as the header says", kToolNumber},
        nc.tool_number);
  visit(
      FieldInfo{"follow", "", kGroup,
                "path: what it cuts must be the path of DIR, all of it and in its order; any: only what is cut counts",
                kFollow},
      nc.follow);
}

template <class Visitor, Is<PostJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  constexpr std::string_view kLinks = "Links";
  visit(FieldInfo{"folder", "", "", "A folder written by flank fit, cover or trochoid", kAny, Spelling::kFile, "DIR",
                  true},
        job.folder);
  visit(FieldInfo{"machine", "", "", kMachineHelp, kAny, Spelling::kFileOrText, "", true}, job.machine);
  visit(FieldInfo{"part", "", "", "Part instead of the one named in job.json", kAny, Spelling::kFile}, job.part);
  visit(
      FieldInfo{"setup", "", "",
                "Where the part sits on the table: x,y,z,a,b,c: its origin, mm, and its turn about X, then Y, then Z, "
                "degrees; default: searched so that the machine reaches all of it",
                kAny},
      job.setup);
  visit(FieldInfo{"feed", "mm/min", "",
                  "Feed of the contact along the strips; needed, but for a dry run (1000) and --speed optimal", kRate},
        job.feed_mm_min);
  visit(FieldInfo{"speed", "", "",
                  "feed: at the feed wherever the axes can, and in a cavity faster where less is engaged, slower where "
                  "more is, so that the thickest chip stays the same; constant: at the feed; optimal: as fast as the "
                  "axes can",
                  kSpeed},
        job.speed);
  visit(FieldInfo{"most_feed", "mm/min", "",
                  "In a cavity: the feed where little or nothing is engaged; default: three times the feed", kRate},
        job.most_feed_mm_min);
  visit(FieldInfo{"deviation", "mm", "",
                  "How far the control's own motion may leave the path; default: 0.5 % of the tolerance", kLength},
        job.deviation_mm);
  visit(FieldInfo{"tool_length", "mm", "", "From the gauge line to the controlled point; default: the machine's",
                  kLength},
        job.tool_length_mm);
  visit(FieldInfo{"spindle", "", "", "Spindle speed, 1/min; needed, but for a dry run and with --material", kTurns},
        job.spindle_rpm);
  visit(
      FieldInfo{
          "material", "", "",
          "What is cut (share/materials: aluminium, titanium, ...): its cutting speed at the largest diameter and its "
          "chip load give --spindle and --feed where they are not given; needs --flutes"},
      job.material);
  visit(FieldInfo{"flutes", "", "", "Cutting edges of the tool, for the feed that --material gives", kToolNumber},
        job.flutes);
  visit(FieldInfo{"dry", "", "", "A dry run: the spindle stands still, and the program's header says so", kAny,
                  Spelling::kFlag},
        job.dry);
  visit(FieldInfo{"force", "", "",
                  "Write the program although it does not meet its request; its header says why, and the exit code is "
                  "still 1",
                  kAny, Spelling::kFlag},
        job.force);
  visit(FieldInfo{"link_clearance", "mm", kLinks, "Distance from the part's surroundings between strips", kLength},
        job.link_clearance_mm);
  visit(FieldInfo{"lift", "mm", kLinks, "Way off the surface before and after each strip", kLength}, job.lift_mm);
  visit(FieldInfo{"order", "", kLinks,
                  "Of the strips: shortest: short ways between them; given: that of the path. A cavity's cycles keep "
                  "theirs",
                  kOrder},
        job.order);
}

template <class Visitor, Is<CycleRequest> Request>
void visit_cycles(Request& cycles, Visitor& visit) {
  using namespace accepted;
  constexpr std::string_view kGroup = "Cycles";
  visit(FieldInfo{"max_engagement", "", kGroup, "Largest engagement angle of the cutter, degrees", kEngagement},
        cycles.most_engagement_deg);
  visit(FieldInfo{"cut", "", kGroup, "climb or conventional; the spindle turns clockwise seen from the holder", kCut},
        cycles.cut);
  visit(FieldInfo{"layers", "", kGroup, "Layers, one tool for all: a number, or auto: as many as the tolerance needs",
                  kLayers, Spelling::kAutoOrCount},
        cycles.layers);
  visit(
      FieldInfo{
          "entry", "", kGroup,
          "How a layer begins: open, before the blank; ramp, to and fro over its first front, sinking; plunge, along "
          "the tool's axis at places of that front; auto: open where an end is open, else ramp. A ramp or a plunge "
          "cuts a slot: --max-engagement does not hold there, its engagement is told by itself",
          kEntry},
      cycles.entry);
  visit(FieldInfo{"ramp_angle", "", kGroup, "Steepest slope of a ramp, degrees", kRampAngle}, cycles.ramp_angle_deg);
  visit(FieldInfo{"strategy", "", kGroup,
                  "volume: the shape of every cycle is optimised for removed volume per way; plain: its step alone; "
                  "paper: steps whose fronts are moved back where they engage too far (the published method, to "
                  "compare)",
                  kCycles},
        cycles.strategy);
  visit(FieldInfo{"feed", "mm/min", kGroup, "Feed of the cycles and sides, for the machining time", kRate},
        cycles.feed_mm_min);
  visit(FieldInfo{"rapid", "mm/min", kGroup, "Rate of the links", kRate}, cycles.rapid_mm_min);
  visit(FieldInfo{"stock_cell", "mm", kGroup, kCellHelp, kLength}, cycles.stock_cell_mm);
}

template <class Visitor, Is<TrochoidJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"part", "", "", "STEP, IGES or BREP file", kAny, Spelling::kFile, "PART", true}, job.part.file);
  visit(FieldInfo{"left", "", "", "Faces of one side of the cavity: F9, or several that are joined, F9,F10", kAny,
                  Spelling::kPlain, "", true},
        job.left);
  visit(FieldInfo{"right", "", "", "Faces of the side that faces it", kAny, Spelling::kPlain, "", true}, job.right);
  visit(FieldInfo{"floor", "", "",
                  "A face at the bottom of the cavity: the tool's tip is towards it; default: the walls "
                  "say so, else the narrower end is the bottom"},
        job.floor);
  visit(FieldInfo{"tool", "", "", "free, a family with any of its parameters (cone:radius=2,angle=3), or a tool.json",
                  kAny, Spelling::kFileOrText},
        job.tool.spec);
  visit(FieldInfo{"tolerance", "mm", "", kToleranceHelp, kLength}, job.tolerance_mm);
  visit(FieldInfo{"axis_length", "mm", "", "Length of the tool's axis; default: as a layer needs", kLength},
        job.tool.axis_length_mm);
  visit_cycles(job.cycles, visit);
  visit_radius(job.radius, visit);
  visit_judge(job.judge, visit);
  visit_obstacles(job.obstacles, visit);
  visit(
      FieldInfo{"avoid", "", "Other faces",
                "on: steer the tool clear of the other faces; off: plan as if they were not there (they are judged all "
                "the same)",
                kAny, Spelling::kOnOff},
      job.avoid);
}

template <class Visitor, Is<VerifyJob> Job>
void visit_fields(Job& job, Visitor&& visit) {
  using namespace accepted;
  visit(FieldInfo{"folder", "", "", "A folder written by flank fit, cover or trochoid; not needed with --nc", kAny,
                  Spelling::kFile, "DIR"},
        job.folder);
  visit_nc(job.nc, visit);
  visit(
      FieldInfo{"part", "", "", "Judge against this part instead of the one named in job.json", kAny, Spelling::kFile},
      job.part);
  visit(FieldInfo{"side", "", "", kSideHelp, kSide, Spelling::kSign}, job.side);
  visit(FieldInfo{"tolerance", "mm", "", "Tolerance instead of the job's", kLength}, job.tolerance_mm);
  visit(FieldInfo{"sample", "mm", "", kSampleHelp, kLength}, job.sample_mm);
  visit(FieldInfo{"reach_radius", "mm", "Other faces", kReachHelp, kRadius}, job.reach_radius_mm);
  visit(FieldInfo{"stock_cell", "mm", "", kCellHelp, kLength}, job.stock_cell_mm);
  visit_obstacles(job.obstacles, visit);
}

/// The word of the command line that asks for such a job.
inline std::string_view command_name(const FitJob&) { return "fit"; }
inline std::string_view command_name(const CoverJob&) { return "cover"; }
inline std::string_view command_name(const TrochoidJob&) { return "trochoid"; }
inline std::string_view command_name(const VerifyJob&) { return "verify"; }
inline std::string_view command_name(const PostJob&) { return "post"; }

}  // namespace flank::internal
