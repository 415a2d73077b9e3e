/// What can be asked of the library, one struct per command. Data only: run.h does the work.
///
/// Every member that a user may set is described once, in the table of src/flank/job/fields.h: its name, unit, range and
/// help text. The options of the command line, job.json (docs/schema/job.md) and the command that a report shows come
/// from there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace flank {

/// Which faces of which part are machined.
struct PartRequest {
  std::string file;                 ///< CAD or mesh: part_formats() of part.h
  std::optional<std::string> unit;  ///< of a mesh, or of a CAD file that states a wrong one: "mm", "cm", "m" or "in"
  std::string faces = "F1";         ///< "F1", "F1,F3", "F143-F160", "F1a" (a piece)
  std::optional<std::string> skin;  ///< "F143": that face and all that is joined smoothly to it, instead of `faces`
  std::optional<int>
      side;             ///< +1 or -1: the machined side of an open sheet; none: by the part (docs/algorithms/side.md)
  bool facing = false;  ///< the faces are two walls of a cavity; no field: `machined` sets it
  /// > 0: left on purpose. What is wanted, of these faces and of all others of the part, is the face moved outwards by this;
  /// none or 0: the face itself. Of fit, cover and trochoid.
  std::optional<double> allowance_mm = {};
  bool operator==(const PartRequest&) const = default;
  /// For titles: "F1,F3", or "skin of F143".
  [[nodiscard]] std::string target_text() const { return skin ? "skin of " + *skin : faces; }
};

/// The tool, or what is known of it.
struct ToolRequest {
  std::string spec;  ///< "free", a family with parameters ("cone:radius=2,angle=3"), a tool.json, "catalogue" (cover)
  std::optional<double> axis_length_mm;
  bool operator==(const ToolRequest&) const = default;
};

/// Limits of the tool that a fit may find: what can be ground, and clamped.
struct RadiusRequest {
  std::optional<double> min_mm;           ///< none: 1 % of the target's diagonal
  std::optional<double> max_mm;           ///< none: 15 % of the target's diagonal
  double slope_max = 0.95;                ///< of |r'|, below 1
  double slenderness_max = 8.0;           ///< Stiffness (tool.h) of flank and shank
  std::string profile = "tapered";        ///< or "any": radii may fall towards the holder by any share
  double neck = 0.1;                      ///< "tapered": by at most this share of a radius farther down
  std::optional<double> wheel_radius_mm;  ///< least radius of a concave meridian; none: any
  bool operator==(const RadiusRequest&) const = default;
};

/// What the tool must not enter, and what stands above its flank. Heights count from the upper end of the flank.
struct ObstacleRequest {
  std::optional<std::string> check_faces;   ///< "F88,F12": only these; none: every face that is not machined
  std::optional<std::string> ignore_faces;  ///< "F5": not these
  /// "given": what the next two and `tool` give, and where they give nothing as "auto", which is a cylinder as thick as the flank ends (a standard
  /// diameter where one is nearly that), or thinner so that it is clear, long enough to reach out of the part; "none".
  std::string shank = "given";
  std::optional<double> shank_radius_mm;  ///< none: that of the flank's upper end
  std::optional<double> shank_length_mm;  ///< a cylinder on the upper end of the flank
  std::optional<std::string> holder;      ///< "z:r,z:r,...", or a file of such pairs
  std::vector<std::string> fixtures;      ///< part files
  std::optional<std::string>
      fixture_unit;                    ///< of meshes among them, "mm", "cm", "m" or "in"; none: as that of the part
  std::optional<double> clearance_mm;  ///< least distance of shank and holder from the part, of all from fixtures
  bool operator==(const ObstacleRequest&) const = default;
};

/// How the result is judged.
struct JudgeRequest {
  double least_coverage = 0.95;            ///< share of what is reachable of the target that must be within tolerance
  std::optional<double> least_whole = {};  ///< share of the whole target, whatever is reachable; none: any
  std::optional<double> sample_mm;         ///< spacing of the samples; none: by the size of the part
  std::optional<double>
      reach_radius_mm;  ///< of the ball that says what is reachable; none: the tool's smallest radius,
                        ///< of a free tool half its demanded length over slenderness_max
  /// Degrees that the motion may turn within 1 % of the face's diagonal; 0: any. Of fit and cover: cycles turn all the time.
  double most_turn_deg = 15.0;
  bool operator==(const JudgeRequest&) const = default;
};

/// Find a tool and motions whose flank is the face.
struct FitJob {
  PartRequest part;
  ToolRequest tool{.spec = "free", .axis_length_mm = {}};
  RadiusRequest radius;
  ObstacleRequest obstacles;
  JudgeRequest judge{.least_coverage = 0.99, .sample_mm = {}, .reach_radius_mm = {}};
  std::optional<double> tolerance_mm;  ///< none: a thousandth of the diagonal of the faces, rounded down to 1, 2 or 5
  std::optional<std::string> start;    ///< "x,y,z,x,y,z": tip and holder end of a first axis, mm
  std::optional<std::string> guide;    ///< file of several such lines
  std::string cut = "climb";           ///< or "conventional"; the spindle turns clockwise seen from the holder
  int strips = 0;                      ///< motions side by side; 0: as many as the tolerance needs
  bool avoid = true;              ///< keep clear of the other faces already in planning; they are judged either way
  std::string effort = "normal";  ///< or "quick", "thorough": how much is tried
  bool stiffness_curve = false;   ///< fit tools of other slendernesses, too, and say what each costs
  /// Least radius of curvature of the paths of tip and holder end; none: any.
  std::optional<double> min_bend_radius_mm;
  bool operator==(const FitJob&) const = default;
};

/// How `cover` chooses among several tools.
struct ChoiceRequest {
  std::optional<std::string> catalogue;  ///< folder of tool files; none: the one that comes with the program
  int finalists = 3;                     ///< tools that are covered in full
  double feed_mm_min = 1000.0;           ///< along strips, for the machining time
  double rapid_mm_min = 5000.0;          ///< between strips
  bool operator==(const ChoiceRequest&) const = default;
};

/// Find the strips with which a tool finishes a face. The tool is given, or chosen: from a catalogue, or from a family of
/// which parameters are open.
struct CoverJob {
  PartRequest part;
  ToolRequest tool;
  ChoiceRequest choice;
  ObstacleRequest obstacles;
  JudgeRequest judge;
  std::optional<double> tolerance_mm;  ///< none: a thousandth of the diagonal of the faces, rounded down to 1, 2 or 5
  std::string cut = "climb";           ///< as in FitJob
  std::string strategy = "grow";       ///< or "curves"
  std::optional<std::uint64_t> seed;   ///< of the clustering; strategy "curves" only
  std::string seeds = "grid";          ///< or "shape": where `grow` begins its lines
  std::optional<int> most_strips;      ///< on one target; none: as many as are worth their price
  std::optional<double> strip_price;   ///< share of the area that a strip must add; none: 0.005
  bool operator==(const CoverJob&) const = default;
};

/// The program that a machine runs, judged instead of a folder's path.
struct NcRequest {
  std::optional<std::string> file;     ///< the program
  std::optional<std::string> machine;  ///< name or file; needed with a program
  std::optional<std::string> setup;    ///< "x,y,z,a,b,c"; none: the program's own
  std::optional<std::string> tool;     ///< tool.json; none: the folder's
  std::optional<std::string> faces;    ///< as in PartRequest; none: the folder's, else F1
  std::optional<int> work_offset;      ///< with which it is run, 1: G54; none: what its header says, else the machine's
  std::optional<int> tool_number;      ///< of the tool in the spindle; none: what its header says
  std::string follow = "path";  ///< "path": it must run the folder's path; "any": where it cuts is its own affair
  bool operator==(const NcRequest&) const = default;
};

/// How the cycles of a cavity are planned.
struct CycleRequest {
  double most_engagement_deg = 60.0;  ///< of the cutter, fronts and backs
  std::string cut = "climb";          ///< or "conventional"; the spindle turns clockwise seen from the holder
  int layers = 0;                     ///< 0: as many as the tolerance needs
  /// How a layer begins: "open", before the blank; "ramp", "plunge": inside the material; "auto": open where an end is open,
  /// else ramp.
  std::string entry = "auto";
  double ramp_angle_deg = 3.0;          ///< steepest slope of a ramp
  std::string strategy = "volume";      ///< shapes optimised for removed volume per way; or "plain", "paper"
  double feed_mm_min = 1000.0;          ///< of all but links, for the machining time
  double rapid_mm_min = 5000.0;         ///< of links
  std::optional<double> stock_cell_mm;  ///< of the stock in which the judge replays the program; none: by its size
  bool operator==(const CycleRequest&) const = default;
};

/// Rough and finish the cavity between two sides with one tool.
struct TrochoidJob {
  PartRequest part;                  ///< its `faces` are not used: `left` and `right` are
  std::string left = "F1";           ///< faces of one side, joined to one another
  std::string right = "F2";          ///< of the facing side
  std::optional<std::string> floor;  ///< a face at the bottom: the tip is towards it
  ToolRequest tool{.spec = "free", .axis_length_mm = {}};
  RadiusRequest radius;
  CycleRequest cycles;
  ObstacleRequest obstacles;
  JudgeRequest judge{.sample_mm = {}, .reach_radius_mm = {}, .most_turn_deg = 0.0};
  std::optional<double> tolerance_mm;  ///< none: a thousandth of the diagonal of both sides, rounded down to 1, 2 or 5
  std::string effort = "normal";       ///< or "quick", "thorough": after how much work the search ends
  bool avoid = true;                   ///< keep clear of the other faces already in planning
  bool operator==(const TrochoidJob&) const = default;
};

/// The part and the faces that a job machines.
[[nodiscard]] inline PartRequest machined(const FitJob& job) { return job.part; }
[[nodiscard]] inline PartRequest machined(const CoverJob& job) { return job.part; }
[[nodiscard]] inline PartRequest machined(const TrochoidJob& job) {
  PartRequest part = job.part;
  part.faces = job.left + "," + job.right;
  part.facing = true;
  return part;
}

/// What a tool is run with, for what it leaves when it bends.
struct BendingRequest {
  bool on = false;
  std::optional<std::string> material;  ///< of share/materials; needed
  std::optional<int> flutes;            ///< needed
  double helix_deg = 30.0;
  std::optional<double> finish_stock_mm;  ///< as in PostJob
  bool operator==(const BendingRequest&) const = default;
};

/// Judge again what fit, cover or trochoid left in a folder. What is given takes the place of the job's own.
struct VerifyJob {
  std::string folder;                     ///< may be empty if a program, its part and its tool are given
  std::vector<std::string> more_folders;  ///< of a program of several operations: those after the first, in their order
  NcRequest nc;
  std::optional<std::string> part;  ///< file
  std::optional<double> tolerance_mm, sample_mm, reach_radius_mm, stock_cell_mm;
  std::optional<int> side;  ///< as in PartRequest
  ObstacleRequest obstacles;
  BendingRequest bending;
  bool operator==(const VerifyJob&) const = default;
};

/// Write the program with which a machine runs the path of a folder, or the paths of several, one operation after the other.
struct PostJob {
  std::string folder;
  std::vector<std::string>
      more_folders;  ///< of the operations after the first, in their order: other tools, the same part and set-up
  /// "2:name=finish,tool=7,length=120,spindle=12000,feed=800,flutes=3": what holds for one operation (by its number) only.
  std::vector<std::string> operations;
  int copies = 1;  ///< each operation is run so many times, turned by 360 degrees / copies about `copy_axis`
  std::optional<std::string>
      copy_axis;                ///< "x,y,z,x,y,z": a point and a direction, in the part's frame; none: its Z axis
  std::string coolant = "off";  ///< or "flood", "mist"
  /// How the part is clamped, where the set-up is searched: "any" way up; "bottom", its Z axis up; "bore", `copy_axis` up, and on the
  /// axis of the table.
  std::string clamp = "any";
  std::string machine;                ///< name of a machine that comes with the program, or a file
  std::optional<std::string> part;    ///< file; none: the job's
  std::optional<std::string> setup;   ///< "x,y,z,a,b,c": where the part sits; none: searched
  std::optional<double> feed_mm_min;  ///< of the contact along strips; needed but for a dry run or the speed "optimal"
  /// "feed": in a cavity the feed follows the engagement, elsewhere it is even; "constant"; "optimal": as fast as the machine can.
  std::string speed = "feed";
  std::optional<double>
      most_feed_mm_min;                  ///< where less is engaged than the cavity's limit; none: three times the feed
  std::optional<double> deviation_mm;    ///< of the control's motion from the path; none: 0.5 % of the tolerance
  std::optional<double> tool_length_mm;  ///< from the gauge line to the controlled point; none: the machine's
  double link_clearance_mm = 5.0;        ///< of the tool from the part's surroundings on links
  double lift_mm = 2.0;                  ///< off the surface, before and after each strip
  std::string order = "shortest";        ///< of the strips: the shortest ways between them, or "given"
  std::optional<double> spindle_rpm;     ///< needed but for a dry run
  bool dry = false;                      ///< the spindle stands still, and the program's header says so
  bool force = false;  ///< write the program although it does not meet its request; its header says why
  std::optional<std::string>
      material;               ///< of share/materials: gives the spindle's speed and the feed where they are not given
  std::optional<int> flutes;  ///< of the tool, for the feed of a material
  double helix_deg = 30.0;    ///< of the tool's cutting edges to its axis
  /// Thickness of what roughing has left on the targets, for this path to take: with a material, the feed follows the load.
  std::optional<double> finish_stock_mm;
  std::optional<double> most_force_n, most_power_w, most_deflection_mm;  ///< bounds of the load; the last of the tip
  bool operator==(const PostJob&) const = default;
};

/// What makes a tool and a path.
using PlanJob = std::variant<FitJob, CoverJob, TrochoidJob>;

/// What a member of a job holds.
enum class FieldKind {
  kText,
  kTexts,  ///< any number of texts, none at first
  kNumber,
  kCount,        ///< a whole number
  kAutoOrCount,  ///< a whole number, or "auto"
  kSign,         ///< "+" or "-"
  kSwitch,       ///< "on" or "off"
};

/// A line of the table of fields, for programs that offer jobs to their own users.
struct JobField {
  std::string name;    ///< as in messages, with the unit: "tolerance_mm"
  std::string option;  ///< of the command line: "--tolerance", or "PART" for a word without option
  std::string unit;    ///< "mm", "mm/min"; empty: none
  std::string group;   ///< of the help text; empty: the first
  std::string help;
  std::string accepted;  ///< "a length > 0 mm is needed"; empty: any
  FieldKind kind = FieldKind::kText;
  bool needed = false;               ///< has no default and must be given
  std::optional<std::string> usual;  ///< the default as a word; none: not set
};

/// The table of a command ("fit", "cover", "trochoid", "verify", "post", "design"), in the order of its help text. Throws
/// UsageError for another word.
[[nodiscard]] std::vector<JobField> job_fields(const std::string& command);

/// Sets a field, named as in JobField::name, from words as they would stand on the command line: one, and of kTexts any
/// number. Ranges are checked when the job is run. Throws UsageError for a name that the job has not (it lists those that
/// it has), for a word that is no such value, and for a number of words that is not one.
void set_field(FitJob& job, const std::string& name, const std::vector<std::string>& words);
void set_field(CoverJob& job, const std::string& name, const std::vector<std::string>& words);
void set_field(TrochoidJob& job, const std::string& name, const std::vector<std::string>& words);
void set_field(VerifyJob& job, const std::string& name, const std::vector<std::string>& words);
void set_field(PostJob& job, const std::string& name, const std::vector<std::string>& words);

}  // namespace flank
