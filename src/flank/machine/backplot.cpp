#include "flank/machine/backplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/machine/links.h"
#include "flank/path/joined_pose.h"

namespace flank::internal {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
/// Of a joint's speed: what digits of a feed may add.
constexpr double kSpeedSlack = 1e-3;
/// Joined poses of one block, at most.
constexpr double kMostPieces = 1e5;

/// Between places of the track: over them joints of any chain are straight to some hundredths of a millimetre.
constexpr double kTrackMm = 1.0, kTrackRad = 0.02;

/// Runs a program as the control would, and takes down where the flank's axis goes. It shares kinematics and joins
/// with the post, but none of its choices: it knows the program's words alone.
class Backplotter {
 public:
  Backplotter(const Machine& machine, const NcProgram& program, const std::string& file, const BackplotOptions& options)
      : machine_(machine),
        program_(program),
        file_(file),
        options_(options),
        kinematics_(machine, options.tool_length),
        control_(machine_, kinematics_),
        turn_(options.setup.rotation()) {}

  Backplot run() {
    require_same_meaning();
    for (const NcMove& move : program_.moves) add(move);
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(std::int32_t line, const std::string& text) const {
    throw InputError(fmt::format("{}: line {}: {}", file_, line, text));
  }

  /// Letters and kind of position must be the machine's, or every number would mean another joint. Tool vectors name
  /// no joints.
  void require_same_meaning() const {
    const auto refuse_whole = [&](const std::string& text) {
      if (program_.moves.empty()) throw InputError(file_ + ": " + text);
      refuse(program_.moves.front().line, text);
    };
    const bool joint = program_.positions == NcPositions::kJoint;
    if (joint != (machine_.positions == NcPositions::kJoint))
      refuse_whole(fmt::format("states {}, but machine {} takes {}", joint ? "axis positions" : "tool-centre positions",
                               machine_.name, joint ? "tool-centre positions" : "axis positions"));
    const std::string letters = machine_.rotary_joint(0).name + machine_.rotary_joint(1).name;
    if (program_.positions != NcPositions::kTipVector && program_.rotary != letters)
      refuse_whole(fmt::format("turns the axes {}, but machine {} has {}", program_.rotary, machine_.name, letters));
  }

  void add(const NcMove& move) {
    BlockEnd end = end_of(move);
    const bool joined = move.joined && !result_.joints.empty();
    // A strip of the program that is left and taken up again is two strips of the path: between them the tool was
    // elsewhere, be it at its reference position.
    const bool goes_on = joined && !result_.path.strips.empty() && strip_ == move.strip;
    if (!goes_on) begin_strip(move, joined);
    here_ = {move.line, move.kind == NcKind::kRapid, !joined};
    double seconds = 0.0;
    if (joined) {
      add_block(end);
      seconds = seconds_of(move, end);
      check_speed(move, end, seconds);
    } else {
      // From the reference position: the way there is not the path's, and not known.
      push(end.pose);
    }
    add_track(move, end, joined);
    check_travel(move, end);
    result_.joints.push_back(end.joints);
    result_.seconds.push_back(seconds);
    result_.time_s += seconds;
    before_ = end;
    before_move_ = &move;
  }

  /// A strip begins where the one before it ended, if the move is joined to it.
  void begin_strip(const NcMove& move, bool joined) {
    strip_ = move.strip;
    Strip strip{next_id_++, kLinkKind, "", {}};
    if (move.strip >= 0) {
      const NcStrip& named = program_.strips[static_cast<std::size_t>(move.strip)];
      strip.kind = named.kind;
      strip.face = named.face;
    } else if (move.kind == NcKind::kFeed) {
      // A program of others names no strips: what cuts in it is judged like a strip.
      strip.kind = "flank";
    }
    result_.path.strips.push_back(strip);
    result_.moves.emplace_back();
    if (joined) push(before_.pose);
  }

  /// From the letters' order in programs, degrees, to the chain's order, radians.
  RotaryValues stated_rotary(const Vec3& orientation) const {
    JointValues q{};
    for (std::size_t k = 0; k < 2; ++k) q[machine_.rotary[k]] = orientation(static_cast<int>(k)) * kRadians;
    return kinematics_.rotary_of(q);
  }

  BlockEnd end_of(const NcMove& move) const {
    if (program_.positions == NcPositions::kJoint) {
      JointValues q{};
      for (std::size_t k = 0; k < 3; ++k) q[machine_.linear[k]] = move.position(static_cast<int>(k));
      for (std::size_t k = 0; k < 2; ++k) q[machine_.rotary[k]] = move.orientation(static_cast<int>(k)) * kRadians;
      return {kinematics_.forward(q), q};
    }
    // The program's origin is the work offset's; the frame of the work has it at the set-up's translation.
    const Vec3 tip = move.position + options_.setup.translation;
    if (program_.positions == NcPositions::kTipRotary) {
      const RotaryValues rotary = stated_rotary(move.orientation);
      return {{tip, kinematics_.direction(rotary)}, kinematics_.joints(tip, rotary)};
    }
    const Vec3 axis = move.orientation.normalized();
    // A user's program may ask for any direction: it is refused by its line, not by an assertion in the middle of the
    // chain.
    if (kinematics_.rotary(axis, 0.0).count == 0)
      refuse(move.line, fmt::format("axis {} cannot tilt the tool into this direction",
                                    machine_.joints[kinematics_.rotary_joints()[1]].name));
    const RotaryValues rotary = nearest_rotary(kinematics_, axis, near_rotary(axis));
    return {{tip, axis}, kinematics_.joints(tip, rotary)};
  }

  /// Where a control that is given vectors looks for its angles: where it stands, else where the program begins.
  RotaryValues near_rotary(const Vec3& axis) const {
    if (!result_.joints.empty()) return kinematics_.rotary_of(before_.joints);
    if (program_.start_rotary) return stated_rotary({program_.start_rotary->x(), program_.start_rotary->y(), 0.0});
    const RotarySolutions both = kinematics_.rotary(axis, 0.0);
    for (const RotaryValues& values : both.values) {
      const JointValues q = kinematics_.joints(Vec3::Zero(), values);
      bool inside = true;
      for (const std::size_t k : machine_.rotary)
        inside = inside && q[k] >= machine_.joints[k].low && q[k] <= machine_.joints[k].high;
      if (inside) return values;
    }
    return both.values[0];
  }

  /// From the controlled point in the frame of the work to s = 0 in the part's, which is what paths are about.
  void push(const Pose& controlled) {
    const Vec3 tip = controlled.at(options_.tip_offset);
    result_.path.strips.back().poses.push_back(
        {turn_.transpose() * (tip - options_.setup.translation), (turn_.transpose() * controlled.axis).normalized()});
    result_.moves.back().push_back(here_);
  }

  /// As many joined poses as keep the chord: by the bends of the control's motion and of the joins.
  void add_block(const BlockEnd& end) {
    const double low = options_.tip_offset, high = low + options_.axis_length;
    // Equal axes but for rounding have no bend; opposite ones have no straight join, and the control's own bend,
    // which is large there, gives the pieces.
    const double turn = end.pose.axis.dot(before_.pose.axis) < 1.0 ? joined_bend(before_.pose, end.pose) : 0.0;
    const double bend = std::max(control_.bend(before_, end, low), control_.bend(before_, end, high)) +
                        options_.axis_length * (std::isfinite(turn) ? turn : 0.0);
    // A chord of a piece of length 1 / n is off by at most max |f''| / (8 n^2).
    const double pieces = std::clamp(std::ceil(std::sqrt(bend / (8.0 * options_.chord))), 1.0, kMostPieces);
    // From the pieces that are taken: where their number is capped, the bound says so.
    result_.chord_bound_mm = std::max(result_.chord_bound_mm, bend / (8.0 * pieces * pieces));
    const int count = static_cast<int>(pieces);
    for (int k = 1; k < count; ++k) push(control_.pose(before_, end, static_cast<double>(k) / count));
    push(end.pose);
  }

  /// The way from a reference position is not known; it is taken as straight.
  void add_track(const NcMove& move, const BlockEnd& end, bool joined) {
    int count = 1;
    if (joined) {
      const RotaryValues a = kinematics_.rotary_of(before_.joints), b = kinematics_.rotary_of(end.joints);
      const double turn = std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]);
      const double way = (end.pose.tip - before_.pose.tip).norm();
      count = static_cast<int>(std::clamp(std::ceil(std::max(way / kTrackMm, turn / kTrackRad)), 1.0, kMostPieces));
    }
    for (int k = 1; k <= count; ++k) {
      result_.track.push_back(k == count ? end.joints : control_.joints(before_, end, static_cast<double>(k) / count));
      result_.track_lines.push_back(move.line);
    }
  }

  /// By its feed; a rapid by the slowest of the machine's own limits. Blocks that only turn have a feed in degrees
  /// per minute (post.cpp).
  double seconds_of(const NcMove& move, const BlockEnd& end) const {
    const double way = (move.position - before_move_->position).norm();
    double turn = 0.0, fastest = way / machine_.rapid;
    for (const std::size_t k : machine_.rotary) {
      turn = std::max(turn, std::abs(end.joints[k] - before_.joints[k]) / kRadians);
      fastest = std::max(fastest, std::abs(end.joints[k] - before_.joints[k]) / machine_.joints[k].speed);
    }
    if (move.kind == NcKind::kRapid) return fastest;
    if (program_.feed_mode == NcFeedMode::kInverseTime) return 60.0 / move.feed;
    return (way > 1e-6 ? way : turn) / move.feed * 60.0;
  }

  void check_travel(const NcMove& move, const BlockEnd& end) {
    std::string joint;
    const std::string violation = travel_violation(machine_, end.joints, &joint);
    if (!violation.empty()) note(result_.travel, {move.line, joint, violation});
  }

  void check_speed(const NcMove& move, const BlockEnd& end, double seconds) {
    if (move.kind == NcKind::kRapid) return;  // a control runs rapids as fast as its joints can, by itself
    for (std::size_t k = 0; k < kJointCount; ++k) {
      const Joint& joint = machine_.joints[k];
      const double needed = std::abs(end.joints[k] - before_.joints[k]) / std::max(seconds, 1e-12);
      if (needed <= joint.speed * (1.0 + kSpeedSlack)) continue;
      note(result_.speed, {move.line, joint.name,
                           fmt::format("axis {} would have to run at {:.4g} {}/s, its limit is {:.4g}", joint.name,
                                       in_units(joint, needed), joint.kind == JointKind::kRotary ? "degrees" : "mm",
                                       in_units(joint, joint.speed))});
    }
  }

  /// One finding a joint: the first line tells where to look, a thousand lines tell nothing more.
  static void note(std::vector<LimitFinding>& list, LimitFinding finding) {
    for (const LimitFinding& known : list)
      if (known.joint == finding.joint) return;
    list.push_back(std::move(finding));
  }

  Machine machine_;  ///< with the joins of the program
  const NcProgram& program_;
  const std::string& file_;
  const BackplotOptions& options_;
  Kinematics kinematics_;
  ControlMotion control_;
  Eigen::Matrix3d turn_;
  BlockEnd before_;
  const NcMove* before_move_ = nullptr;
  PoseMove here_;            ///< of the poses that are pushed
  std::int32_t strip_ = -2;  // none yet; -1 is what belongs to no strip
  int next_id_ = 1;
  Backplot result_;
};

/// The machine, joining as the program says.
Machine as_programmed(const Machine& machine, const NcProgram& program) {
  Machine same = machine;
  same.join = program.join;
  if (program.positions != NcPositions::kJoint && machine.positions != NcPositions::kJoint)
    same.positions = program.positions;
  return same;
}

}  // namespace

Backplot backplot(const Machine& machine, const NcProgram& program, const std::string& file,
                  const BackplotOptions& options) {
  return Backplotter(as_programmed(machine, program), program, file, options).run();
}

}  // namespace flank::internal
