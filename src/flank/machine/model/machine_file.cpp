#include "flank/machine/model/machine_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "flank/base/shared_folder.h"
#include "flank/error.h"
#include "flank/io/text/toml_table.h"
#include "flank/machine/model/body_file.h"
#include "flank/machine/nc/dialects/languages.h"
#include "flank/machine/nc/without_effect.h"
#include "flank/printable.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "openflank/machine/1";
constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr double kFarMm = 1e6;                ///< no machine is larger
constexpr double kFarDegrees = 1e6;           ///< rotary travels: "many turns"
constexpr double kLeastSine = 1e-6;           ///< of axes that count as not parallel
constexpr std::size_t kMostBytes = 1u << 20;  // what is larger is no machine's file, and not parsed

/// A unit vector from three numbers of any size: people write (0, 1, 1) for 45 degrees.
Vec3 read_direction(const TomlTable& table, const std::string& key) {
  const Vec3 d = table.vector(key, {-1e6, 1e6});
  if (!(d.norm() > 1e-9)) table.refuse(key, "expected a direction, not (0, 0, 0)");
  return d.normalized();
}

/// [low, high] with low < high.
std::vector<double> read_travel(const TomlTable& table, const std::string& key, double far) {
  std::vector<double> travel = table.numbers(key, 2, {-far, far});
  if (!(travel[0] < travel[1])) table.refuse(key, "expected [lower, upper] with lower < upper");
  return travel;
}

/// Travel and dynamics of a linear joint; the file has mm/min, as data sheets do, the library mm/s.
void read_linear(const TomlTable& table, Joint& joint) {
  const std::vector<double> travel = read_travel(table, "travel_mm", kFarMm);
  joint.low = travel[0];
  joint.high = travel[1];
  joint.speed = table.number("speed_mm_min", {1e-3, 1e7}) / 60.0;
  joint.acceleration = table.number("acceleration_mm_s2", {1e-3, 1e7});
  if (table.has("jerk_mm_s3")) joint.jerk = table.number("jerk_mm_s3", {1e-3, 1e10});
}

/// The same of a rotary joint, in degrees and seconds. Without a travel it turns endlessly; the point on its axis is
/// the machine's origin if none is named.
void read_rotary(const TomlTable& table, Joint& joint) {
  if (table.has("point_mm")) joint.point = table.vector("point_mm", {-kFarMm, kFarMm});
  if (table.has("travel_deg")) {
    const std::vector<double> travel = read_travel(table, "travel_deg", kFarDegrees);
    joint.low = travel[0] * kRadiansPerDegree;
    joint.high = travel[1] * kRadiansPerDegree;
  }
  joint.speed = table.number("speed_deg_s", {1e-3, 1e6}) * kRadiansPerDegree;
  joint.acceleration = table.number("acceleration_deg_s2", {1e-3, 1e7}) * kRadiansPerDegree;
  if (table.has("jerk_deg_s3")) joint.jerk = table.number("jerk_deg_s3", {1e-3, 1e10}) * kRadiansPerDegree;
}

Joint read_joint(const TomlTable& table, bool on_table) {
  Joint joint;
  joint.table = on_table;
  joint.kind = table.word("kind", {"linear", "rotary"}) == "rotary" ? JointKind::kRotary : JointKind::kLinear;
  const bool rotary = joint.kind == JointKind::kRotary;
  joint.name = rotary ? table.word("name", {"A", "B", "C"}) : table.word("name", {"X", "Y", "Z"});
  joint.direction = read_direction(table, "direction");
  // Of a joint of the head, link and tool are the same thing, whatever the file says.
  if (table.has("positive")) joint.reversed = on_table && table.word("positive", {"tool", "link"}) == "link";
  if (rotary)
    read_rotary(table, joint);
  else
    read_linear(table, joint);
  // A misspelled key would leave a limit out, which nobody would notice before the machine does.
  table.require_all_known();
  return joint;
}

/// Five joints from the work to the tool, with the tables that they were read from.
struct Chain {
  std::vector<Joint> joints;
  std::vector<TomlTable> tables;
};

Chain read_chain(const TomlTable& file) {
  Chain chain;
  std::vector<TomlTable> tables = file.tables("table");
  // The file goes from the bed outward.
  std::reverse(tables.begin(), tables.end());
  for (const TomlTable& table : tables) {
    chain.joints.push_back(read_joint(table, true));
    chain.tables.push_back(table);
  }
  for (const TomlTable& table : file.tables("head")) {
    chain.joints.push_back(read_joint(table, false));
    chain.tables.push_back(table);
  }
  // Letters are how programs address joints.
  for (std::size_t i = 0; i < chain.joints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (chain.joints[i].name == chain.joints[j].name)
        chain.tables[i].refuse("name", chain.joints[i].name + " is used twice");
  return chain;
}

/// Puts the joints into the machine; refuses chains that are none.
void place_joints(const TomlTable& file, const Chain& chain, Machine& machine) {
  const auto count = [&](JointKind kind) {
    return std::count_if(chain.joints.begin(), chain.joints.end(), [&](const Joint& j) { return j.kind == kind; });
  };
  // Names are different and of X, Y, Z and A, B, C: with these counts every linear letter is there once.
  if (chain.joints.size() != kJointCount || count(JointKind::kRotary) != 2)
    file.refuse(
        chain.tables.empty() || file.has("head") ? "head" : "table",
        fmt::format("the chain has {} linear and {} rotary axes; expected [[table]] and [[head]] with the three "
                    "linear axes X, Y, Z and two of A, B, C",
                    count(JointKind::kLinear), count(JointKind::kRotary)));
  for (std::size_t k = 0; k < kJointCount; ++k) {
    machine.joints[k] = chain.joints[k];
    const std::string& name = chain.joints[k].name;
    if (name == "X" || name == "Y" || name == "Z") machine.linear[static_cast<std::size_t>(name[0] - 'X')] = k;
  }
}

/// The two rotary joints in the order of programs, and that they can turn the tool anywhere.
void place_rotary(const TomlTable& control, const Chain& chain, Machine& machine) {
  // In the order of the chain: the one nearer to the work comes first.
  std::vector<std::size_t> rotary;
  for (std::size_t k = 0; k < kJointCount; ++k)
    if (machine.joints[k].kind == JointKind::kRotary) rotary.push_back(k);
  const Joint &near_work = machine.joints[rotary[0]], &near_tool = machine.joints[rotary[1]];
  // Parallel axes, or a second one along the spindle, reach a cone of directions at most: no program of ours fits it.
  if (near_work.direction.cross(near_tool.direction).norm() < kLeastSine)
    chain.tables[rotary[1]].refuse("direction", "the two rotary axes are parallel; expected two directions");
  if (near_tool.direction.cross(machine.tool_axis).norm() < kLeastSine)
    chain.tables[rotary[1]].refuse(
        "direction", "this axis turns the tool about itself; its direction must not be that of the spindle");
  // Inverse kinematics solve three equations in the linear joints (Kinematics::joints).
  Eigen::Matrix3d directions;
  for (int k = 0; k < 3; ++k) directions.col(k) = machine.linear_joint(static_cast<std::size_t>(k)).direction;
  if (std::abs(directions.determinant()) < kLeastSine)
    chain.tables[machine.linear[2]].refuse("direction", "the directions of X, Y and Z lie in one plane");
  // Programs name rotary axes by letter; in which order is a habit of the control, alphabetical where the file is
  // silent.
  std::sort(rotary.begin(), rotary.end(),
            [&](std::size_t i, std::size_t j) { return machine.joints[i].name < machine.joints[j].name; });
  machine.rotary = {rotary[0], rotary[1]};
  const std::string forward = machine.joints[rotary[0]].name + machine.joints[rotary[1]].name;
  const std::string backward = machine.joints[rotary[1]].name + machine.joints[rotary[0]].name;
  machine.dialect.rotary = control.has("rotary") ? control.word("rotary", {forward, backward}) : forward;
  if (machine.dialect.rotary == backward) std::swap(machine.rotary[0], machine.rotary[1]);
}

/// Where the tool is held, along which direction, and what programs say of it. All keys have defaults.
void read_spindle(const TomlTable& table, Machine& machine) {
  if (table.has("gauge_mm")) machine.gauge = table.vector("gauge_mm", {-kFarMm, kFarMm});
  if (table.has("direction")) machine.tool_axis = read_direction(table, "direction");
  if (table.has("tool_length_mm")) machine.tool_length = table.number("tool_length_mm", {0.0, 1e4});
  if (table.has("rapid_mm_min")) machine.rapid = table.number("rapid_mm_min", {1.0, 1e6}) / 60.0;
  if (table.has("controlled_point"))
    machine.controlled = table.word("controlled_point", {"lowest", "centre"}) == "lowest" ? ControlledPoint::kLowest
                                                                                          : ControlledPoint::kCentre;
  table.require_all_known();
}

void read_digits(const TomlTable& table, const char* key, int& digits) {
  if (table.has(key)) digits = table.whole(key, 0, 9);
}

/// Words that move nothing here: programs that hold them are read.
void read_words(const TomlTable& table, NcDialect& dialect) {
  if (!table.has("without_effect")) return;
  for (std::string word : table.texts("without_effect")) {
    for (char& c : word) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (const std::string why = why_not_without_effect(word); !why.empty())
      table.refuse("without_effect", fmt::format("\"{}\" {}", printable(word), why));
    dialect.without_effect.push_back(std::move(word));
  }
}

/// How the program is written; what it means is read_meaning's.
void read_dialect(const TomlTable& table, Machine& machine) {
  NcDialect& dialect = machine.dialect;
  dialect.language = nc_language(table.word("language", nc_language_names()));
  if (table.has("tcp_on")) dialect.tcp_on = table.text("tcp_on");
  if (table.has("tcp_off")) dialect.tcp_off = table.text("tcp_off");
  read_words(table, dialect);
  if (table.has("function_tcpm")) dialect.function_tcpm = table.flag("function_tcpm");
  if (table.has("decimal_comma")) dialect.decimal_comma = table.flag("decimal_comma");
  if (table.has("line_numbers")) dialect.line_numbers = table.flag("line_numbers");
  if (table.has("smoothing_mm")) dialect.smoothing_mm = table.number("smoothing_mm", {0.0, 10.0});
  if (table.has("smoothing_deg")) dialect.smoothing_deg = table.number("smoothing_deg", {0.0, 10.0});
  read_digits(table, "length_decimals", dialect.length_decimals);
  read_digits(table, "angle_decimals", dialect.angle_decimals);
  read_digits(table, "vector_decimals", dialect.vector_decimals);
  read_digits(table, "feed_decimals", dialect.feed_decimals);
  if (table.has("work_offset")) machine.work_offset = table.whole("work_offset", 1, 6);
}

/// Where the machine's Z stands when the tool is out of the way: as the file says, else just before the end of its travel on
/// the holder's side, of controls that have no word of their own for such a place.
void read_retract(const TomlTable& control, Machine& machine) {
  constexpr double kBeforeTheEnd = 1.0;  // mm: a soft limit itself is refused by some controls
  const Joint& z = machine.linear_joint(2);
  NcDialect& dialect = machine.dialect;
  if (control.has("retract_mm")) {
    dialect.retract_mm = control.number("retract_mm", {-kFarMm, kFarMm});
    if (!(*dialect.retract_mm >= z.low && *dialect.retract_mm <= z.high))
      control.refuse("retract_mm", fmt::format("is beyond the travel of Z, {:g} to {:g}", z.low, z.high));
  } else if (!row_of(dialect.language).retract_word) {
    const bool up = (z.reversed ? -1.0 : 1.0) * z.direction.dot(machine.tool_axis) >= 0.0;
    dialect.retract_mm = up ? z.high - kBeforeTheEnd : z.low + kBeforeTheEnd;
  }
}

void read_meaning(const TomlTable& table, Machine& machine) {
  const std::string positions = table.word("positions", {"tip-rotary", "tip-vector", "joint"});
  machine.positions = positions == "joint"        ? NcPositions::kJoint
                      : positions == "tip-vector" ? NcPositions::kTipVector
                                                  : NcPositions::kTipRotary;
  // The dialect needs these two when programs are read: no word of theirs says them (LinuxCNC, Fanuc).
  machine.dialect.positions = machine.positions;
  machine.join = table.word("join", {"axes", "great-circle"}) == "axes" ? NcJoin::kAxes : NcJoin::kGreatCircle;
  machine.feed_mode = table.word("feed", {"per-minute", "inverse-time"}) == "inverse-time" ? NcFeedMode::kInverseTime
                                                                                           : NcFeedMode::kPerMinute;
  machine.dialect.join = machine.join;
  if (table.has("block_time_ms")) machine.block_time = 1e-3 * table.number("block_time_ms", {0.0, 1e3});
  // What the control cannot say is refused here, by line, rather than when the first program is written.
  const NcLanguageRow& language = row_of(machine.dialect.language);
  const std::string title(language.title);
  if (machine.positions == NcPositions::kJoint && machine.join != NcJoin::kAxes)
    table.refuse("join",
                 "positions = \"joint\" (axis positions) needs join = \"axes\" (blocks run linearly in the axes)");
  if (!language.great_circle && machine.join != NcJoin::kAxes)
    table.refuse("join", title + " can join blocks by \"axes\" only");
  if (!language.vectors && machine.positions == NcPositions::kTipVector)
    table.refuse("positions", title + " has no vectors; expected \"tip-rotary\", \"joint\"");
  if (!language.inverse_time && machine.feed_mode == NcFeedMode::kInverseTime)
    table.refuse("feed", title + "'s feeds must be \"per-minute\"");
}

std::string read_text(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  // A folder opens like a file, and reads as an empty one.
  if (!in || fs::is_directory(file))
    throw InputError("machine", file, "cannot be read; expected a file as docs/schema/machine.md describes");
  return text.str();
}

}  // namespace

Machine machine_from_toml(std::string_view text, const std::string& file) {
  if (text.size() > kMostBytes)
    throw InputError(fmt::format("{}: {} bytes; a machine's file has at most {}", file, text.size(), kMostBytes));
  const TomlTable table = TomlTable::parse(text, file);
  (void)table.word("schema", {kSchema});
  Machine machine;
  machine.name = table.text("name");
  if (table.has("description")) machine.description = table.text("description");
  const Chain chain = read_chain(table);
  place_joints(table, chain, machine);
  read_spindle(table.table("spindle"), machine);
  if (!table.has("control")) table.refuse("control", "is missing; expected a table [control]");
  const TomlTable control = table.table("control");
  read_dialect(control, machine);
  read_meaning(control, machine);
  // After the spindle and the dialect: it holds the joints against the first, and writes its letters into the second.
  place_rotary(control, chain, machine);
  machine.bodies = read_bodies(table, machine);
  read_retract(control, machine);
  control.require_all_known();
  table.require_all_known();
  return machine;
}

std::string machine_folder() {
  return find_shared_folder({.name = "machines",
                             .variable = "FLANK_MACHINES",
                             .installed = FLANK_MACHINES_INSTALLED,
                             .content = "machine files",
                             .things = "machines",
                             .advice = "name their folder by FLANK_MACHINES"});
}

std::vector<std::string> machine_names() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(machine_folder()))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());  // folders list their files in any order
  return names;
}

namespace {

bool is_named_file(const std::string& name_or_file) {
  return name_or_file.find('/') != std::string::npos || fs::path(name_or_file).extension() == ".toml";
}

}  // namespace

std::string machine_file(const std::string& name_or_file) {
  return is_named_file(name_or_file) ? name_or_file : (fs::path(machine_folder()) / (name_or_file + ".toml")).string();
}

Machine read_machine(const std::string& name_or_file) {
  if (is_named_file(name_or_file)) return machine_from_toml(read_text(name_or_file), name_or_file);
  const std::vector<std::string> names = machine_names();
  // By the list, not by trying to open the file: the message can say what there is.
  if (std::find(names.begin(), names.end(), name_or_file) == names.end())
    throw InputError("machine", name_or_file,
                     fmt::format("no such machine; expected {}, or a file NAME.toml", fmt::join(names, ", ")));
  const std::string file = machine_file(name_or_file);
  return machine_from_toml(read_text(file), file);
}

}  // namespace flank::internal
