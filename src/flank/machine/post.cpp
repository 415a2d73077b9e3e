#include "flank/machine/post.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/machine/control_time.h"
#include "flank/machine/engagement_feed.h"
#include "flank/machine/feeds/feed.h"
#include "flank/machine/links.h"
#include "flank/machine/nc/write/timed_blocks.h"
#include "flank/path/joined_pose.h"

namespace flank::internal {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// Places of a block at which its feed is planned: this far apart, at least so many where the machine starts and stops.
constexpr double kFeedStepMm = 1.0, kFeedStepRad = 0.02;
constexpr int kMostFeedSteps = 200, kFeedStepsAtEnds = 32;

bool is_link(const Strip& strip) { return strip.kind == kLinkKind; }

/// One path on its way to a program: poses, joints, blocks, feeds, text, in this order. Each step needs all strips of
/// the one before, because joints are chosen and feeds are planned over the path as a whole.
class Poster {
 public:
  Poster(const Machine& machine, const Path& path, const PostTool& tool, const PostOptions& options)
      : machine_(machine),
        path_(path),
        tool_(tool),
        options_(options),
        kinematics_(machine, machine.tool_length),
        control_(machine, kinematics_),
        span_{tip_offset(machine, tool), tip_offset(machine, tool) + tool.axis_length} {}

  Post run() {
    place_poses();
    const JointChoice choice = choose_joints(machine_, kinematics_, poses_, singular_cone(span_, options_.deviation));
    note_least_sine();
    post_.flips = choice.flips;
    if (choice.unreachable) return refused(*choice.unreachable);
    for (std::size_t k = 0; k < path_.strips.size(); ++k)
      if (!linearise_strip(k, choice.joints)) return std::move(post_);
    plan_feeds();
    write_program();
    return std::move(post_);
  }

 private:
  /// Poses of the controlled point in the frame of the work; the first pose of all comes from anywhere.
  void place_poses() {
    const Eigen::Matrix3d r = options_.setup.rotation();
    for (const Strip& strip : path_.strips) {
      first_.push_back(poses_.size());
      for (const Pose& p : strip.poses) {
        // A path's pose is the axis point s = 0; the control holds another one, `span_.low` below it.
        const Pose work{r * p.tip + options_.setup.translation, (r * p.axis).normalized()};
        // Strips follow each other without a gap (with_links has filled them), so every pose but the first is joined.
        poses_.push_back({{work.at(-span_.low), work.axis}, !poses_.empty()});
      }
    }
    first_.push_back(poses_.size());
    if (poses_.empty()) throw InternalError("a path without poses");
  }

  /// Of what is cut: programs begin and end upright, which is singular on most machines and does no harm there.
  void note_least_sine() {
    for (std::size_t k = 0; k < path_.strips.size(); ++k)
      for (std::size_t i = first_[k]; i < first_[k + 1] && !is_link(path_.strips[k]); ++i)
        post_.least_sine = std::min(post_.least_sine, kinematics_.sine_to_first(poses_[i].pose.axis));
  }

  /// Names the pose by its strip and its index there, instead of its index in the whole path.
  Post refused(const Unreachable& why) {
    post_.unreachable = why;
    for (std::size_t k = 0; k < path_.strips.size(); ++k)
      if (why.pose >= first_[k] && why.pose < first_[k + 1]) {
        post_.unreachable_strip = path_.strips[k].id;
        post_.unreachable->pose = why.pose - first_[k];
      }
    return std::move(post_);
  }

  bool linearise_strip(std::size_t k, const std::vector<JointValues>& joints) {
    const bool link = is_link(path_.strips[k]);
    const std::size_t begin = first_[k], count = first_[k + 1] - begin;
    std::vector<Pose> poses;
    for (std::size_t i = begin; i < begin + count; ++i) poses.push_back(poses_[i].pose);
    LineariseOptions options;
    // Links cut nothing: a coarser bound saves blocks.
    options.deviation = link ? std::max(options_.link_deviation, options_.deviation) : options_.deviation;
    LinearisedStrip strip = linearise(kinematics_, control_, poses, {joints.data() + begin, count}, span_, options);
    if (!strip.complete || !std::isfinite(strip.deviation_mm)) {
      post_.unreachable =
          Unreachable{0, {}, "no number of points keeps the control's motion within the required deviation"};
      post_.unreachable_strip = path_.strips[k].id;
      return false;
    }
    // What is told is about cutting: links would hide it by their coarser bound.
    if (!link) {
      post_.planned += count;
      post_.inserted += strip.inserted;
      post_.left_out += strip.left_out;
      post_.deviation_mm = std::max(post_.deviation_mm, strip.deviation_mm);
    }
    strips_.push_back(std::move(strip));
    return true;
  }

  /// How far the contact moves between two poses at most, mm: the way is convex along the axis, so one of the flank's
  /// ends goes farthest.
  double contact_way(const Pose& a, const Pose& b) const {
    return std::max((b.at(span_.low) - a.at(span_.low)).norm(), (b.at(span_.high) - a.at(span_.high)).norm());
  }

  /// The ways of the contact along a strip, up to each of its poses, mm.
  std::vector<double> ways_of(std::size_t strip) const {
    std::vector<double> ways{0.0};
    for (std::size_t k = first_[strip] + 1; k < first_[strip + 1]; ++k)
      ways.push_back(ways.back() + contact_way(poses_[k - 1].pose, poses_[k].pose));
    return ways;
  }

  /// How far the flank is from where the path has it at a share of block i, mm: by equal shares of the contact's way, as
  /// linearise.h bounds it; affine along the axis, so its ends decide.
  double off_path(std::size_t strip, const std::vector<double>& ways, std::size_t i, double share,
                  const Pose& pose) const {
    const auto way_at = [&](double at) {
      const auto k = std::min(static_cast<std::size_t>(at), ways.size() - 2);
      return std::lerp(ways[k], ways[k + 1], at - static_cast<double>(k));
    };
    if (ways.size() < 2) return 0.0;
    const std::vector<double>& at = strips_[strip].at;
    const double way = std::lerp(way_at(at[i - 1]), way_at(at[i]), share);
    const auto next = std::upper_bound(ways.begin() + 1, ways.end() - 1, way);
    const std::size_t k = static_cast<std::size_t>(next - ways.begin()) - 1;
    const double step = ways[k + 1] - ways[k], t = step > 0.0 ? std::clamp((way - ways[k]) / step, 0.0, 1.0) : 0.0;
    const auto axis_point = [&](std::size_t n) {
      const Pose& p = poses_[first_[strip] + n].pose;
      return Pose{p.at(span_.low), p.axis};
    };
    const Pose planned = joined_pose(axis_point(k), axis_point(k + 1), t);
    return std::max((pose.at(span_.low) - planned.tip).norm(),
                    (pose.at(span_.high) - planned.at(span_.high - span_.low)).norm());
  }

  /// The nodes of block i of a strip, its beginning left out.
  void add_block(std::size_t strip, const std::vector<double>& ways, std::size_t i, bool at_end) {
    const BlockEnd &from = strips_[strip].blocks[i - 1], &to = strips_[strip].blocks[i];
    const RotaryValues a = kinematics_.rotary_of(from.joints), b = kinematics_.rotary_of(to.joints);
    const double turn = std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]), way = contact_way(from.pose, to.pose);
    // A control that needs longer for a block than its way takes would wait at its end.
    const double cap = machine_.block_time > 0.0 && way > 0.0 ? std::min(cap_of(strip, i), way / machine_.block_time)
                                                              : cap_of(strip, i);
    const double wanted = std::ceil(std::max(way / kFeedStepMm, turn / kFeedStepRad));
    // The first and the last block begin and end at rest: with few nodes there, the planner, whose speed is 0 at a
    // node, would take them far too slowly.
    const int least = at_end ? kFeedStepsAtEnds : 1;
    const int steps = std::clamp(static_cast<int>(std::min(wanted, 1e6)), least, kMostFeedSteps);
    Pose before = from.pose;
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const bool last = k == steps;
      const Pose here = last ? to.pose : control_.pose(from, to, t);
      // The last place is taken as it was chosen: computed once more, it would differ by rounding, or by a turn
      // beside the singular direction.
      nodes_.push_back({last ? to.joints : control_.joints(from, to, t), contact_way(before, here), cap, blocks_});
      off_path_.push_back(is_link(path_.strips[strip]) ? 0.0 : off_path(strip, ways, i, t, here));
      before = here;
    }
    ++blocks_;
  }

  /// The contact's fastest over a block. A feed is about cutting; joints' limits hold in either case, by the planner.
  double cap_of(std::size_t strip, std::size_t block) const {
    if (is_link(path_.strips[strip]) || options_.time_optimal) return machine_.rapid;
    const std::vector<double>& at = strips_[strip].at;
    if (strip >= options_.slowness.size()) return options_.feed;
    return feed_between(options_.slowness[strip], at[block - 1], at[block], options_.feed);
  }

  void plan_feeds() {
    // Where the machine stands before the first block: it belongs to none.
    nodes_.push_back({strips_.front().blocks.front().joints, 0.0, machine_.rapid, -1});
    off_path_.push_back(0.0);
    std::size_t total = 0, done = 0;
    for (const LinearisedStrip& strip : strips_) total += strip.blocks.size() - 1;
    for (std::size_t k = 0; k < strips_.size(); ++k) {
      const std::vector<BlockEnd>& ends = strips_[k].blocks;
      const std::vector<double> ways = ways_of(k);
      for (std::size_t i = 1; i < ends.size(); ++i, ++done) add_block(k, ways, i, done == 0 || done + 1 == total);
    }
    block_seconds_.assign(static_cast<std::size_t>(blocks_), 0.0);
    if (blocks_ == 0) return;
    // Rounding the corners by no more than blocks deviate anyway.
    const FeedPlan plan = plan_feed(machine_, nodes_, options_.deviation);
    for (std::size_t i = 1; i < nodes_.size(); ++i)
      block_seconds_[static_cast<std::size_t>(nodes_[i].block)] += plan.seconds[i];
    post_.time_s = plan.time_s;
    note_use(check_feed(machine_, nodes_, plan));
    note_trace(plan);
  }

  void note_trace(const FeedPlan& plan) {
    std::vector<bool> cutting;  // of each block
    for (std::size_t k = 0; k < strips_.size(); ++k)
      cutting.insert(cutting.end(), strips_[k].blocks.size() - 1, !is_link(path_.strips[k]));
    double time = 0.0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      time += plan.seconds[i];
      const double feed = plan.seconds[i] > 0.0 ? nodes_[i].length / plan.seconds[i] : 0.0;
      const bool cuts = nodes_[i].block >= 0 && cutting[static_cast<std::size_t>(nodes_[i].block)];
      post_.trace.push_back({time, nodes_[i].joints, feed, cuts, off_path_[i]});
    }
  }

  /// What the path asks of each joint, in mm or degrees, beside its limits: people look here before they run a
  /// program.
  void note_use(const FeedCheck& check) {
    for (std::size_t k = 0; k < kJointCount; ++k) {
      const Joint& joint = machine_.joints[k];
      double low = nodes_.front().joints[k], high = low;
      for (const FeedNode& node : nodes_) {
        low = std::min(low, node.joints[k]);
        high = std::max(high, node.joints[k]);
      }
      post_.use.push_back({joint.name, in_units(joint, low), in_units(joint, high), in_units(joint, check.speed[k]),
                           in_units(joint, check.acceleration[k])});
    }
  }

  NcMove move_to(const BlockEnd& end) const {
    NcMove move;
    if (machine_.positions == NcPositions::kJoint) {
      for (std::size_t k = 0; k < 3; ++k) move.position(static_cast<int>(k)) = end.joints[machine_.linear[k]];
    } else {
      // The origin of the part is the work offset's; the program has the part's turn, which is how it is clamped and
      // which no control is told of.
      move.position = end.pose.tip - options_.setup.translation;
    }
    if (machine_.positions == NcPositions::kTipVector)
      move.orientation = end.pose.axis;
    else
      for (std::size_t k = 0; k < 2; ++k)
        move.orientation(static_cast<int>(k)) = end.joints[machine_.rotary[k]] * kDegrees;
    return move;
  }

  void write_program() {
    NcProgram& program = post_.program;
    program.header.machine = machine_.name;
    program.header.work_offset = machine_.work_offset;
    // Joint coordinates are the machine's own: no offset may shift them.
    const Vec3 origin =
        machine_.positions == NcPositions::kJoint ? Vec3(Vec3::Zero()) : Vec3(options_.setup.translation);
    program.header.origin = fmt::format("X{} Y{} Z{}", origin.x(), origin.y(), origin.z());
    program.header.tool.name = tool_.name;
    program.header.tool.diameter = 2.0 * tool_.largest_radius;
    program.header.tool.length = machine_.tool_length;
    program.header.tool.tip_offset = span_.low;
    program.positions = machine_.positions;
    program.join = machine_.join;
    program.feed_mode = machine_.feed_mode;
    program.rotary = machine_.rotary_joint(0).name + machine_.rotary_joint(1).name;
    add_moves();
    program.end_rotary = upright_end();
    // Held back by no more than blocks deviate anyway.
    const double held = state_feeds(program, times_, machine_.dialect, options_.deviation);
    post_.rounding_mm = rounding() + held;
    if (rests_between_blocks(machine_, program)) take_control_time();
  }

  /// What the control makes of the program, beside what was planned.
  void take_control_time() {
    const std::vector<double> seconds = resting_seconds(machine_, post_.program);
    double all = 0.0;
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      all += seconds[i];
      const bool link = is_link(path_.strips[static_cast<std::size_t>(post_.program.moves[i].strip)]);
      if (!link) post_.resting_cutting_s += seconds[i];
    }
    post_.resting_s = all;
  }

  /// The blocks of all strips, and how long each shall take.
  void add_moves() {
    NcProgram& program = post_.program;
    std::size_t block = 0;
    const BlockEnd* before = nullptr;
    for (std::size_t k = 0; k < strips_.size(); ++k) {
      program.strips.push_back({path_.strips[k].id, path_.strips[k].kind, path_.strips[k].face});
      const std::vector<BlockEnd>& ends = strips_[k].blocks;
      for (std::size_t i = before == nullptr ? 0 : 1; i < ends.size(); ++i) {
        NcMove move = move_to(ends[i]);
        move.strip = static_cast<std::int32_t>(k);
        BlockTime time;
        // The very first move comes from anywhere, at rapid; its angles are where the program begins.
        if (before == nullptr) {
          move.kind = NcKind::kRapid;
          move.joined = false;
          program.start_rotary = rotary_deg(ends[i].joints);
        } else {
          time = {block_seconds_[block++],
                  (rotary_deg(ends[i].joints) - rotary_deg(before->joints)).cwiseAbs().maxCoeff()};
          if (!is_link(path_.strips[k])) post_.cutting_s += time.seconds;
        }
        program.moves.push_back(move);
        times_.push_back(time);
        before = &ends[i];
      }
    }
  }

  /// In the order of programs.
  [[nodiscard]] Vec2 rotary_deg(const JointValues& q) const {
    return Vec2(q[machine_.rotary[0]], q[machine_.rotary[1]]) * kDegrees;
  }

  /// The rotary axes at zero but for whole turns, by the nearest way: unwinding would take as long as winding. Where the travel
  /// has no such place they stay.
  [[nodiscard]] Vec2 upright_end() const {
    constexpr double kTurnDeg = 360.0;
    Vec2 end = rotary_deg(strips_.back().blocks.back().joints);
    for (std::size_t k = 0; k < 2; ++k) {
      const Joint& joint = machine_.rotary_joint(k);
      double& value = end(static_cast<int>(k));
      for (double turns = std::round(value / kTurnDeg), step = turns > 0.0 ? -1.0 : 1.0, tries = std::abs(turns) + 1.0;
           tries > 0.0; turns += step, tries -= 1.0)
        if (const double at = turns * kTurnDeg; at / kDegrees >= joint.low && at / kDegrees <= joint.high) {
          value = at;
          break;
        }
    }
    return end;
  }

  /// What the digits of the program move the tool by, at most.
  double rounding() const {
    const NcDialect& dialect = machine_.dialect;
    // Half a unit of the last digit: the error of a rounded number.
    const auto half = [](int decimals) { return 0.5 * std::pow(10.0, -decimals); };
    const double height = std::max(std::abs(span_.low), std::abs(span_.high));
    // Under tool-centre control angles turn the tool about the controlled point; without it they turn it about the
    // rotary axes, which may be far away.
    double lever = height;
    if (machine_.positions == NcPositions::kJoint)
      for (const LinearisedStrip& strip : strips_)
        for (const BlockEnd& end : strip.blocks) lever = std::max(lever, height + kinematics_.lever(end.joints));
    const double turn = machine_.positions == NcPositions::kTipVector ? std::sqrt(3.0) * half(dialect.vector_decimals)
                                                                      : 2.0 * half(dialect.angle_decimals) / kDegrees;
    // Three coordinates may all be off by half a unit, and so may three components of a vector or two angles.
    return std::sqrt(3.0) * half(dialect.length_decimals) + lever * turn;
  }

  const Machine& machine_;
  const Path& path_;
  const PostTool& tool_;
  const PostOptions& options_;
  Kinematics kinematics_;
  ControlMotion control_;
  ToolSpan span_;
  std::vector<MachinePose> poses_;
  std::vector<std::size_t> first_;  ///< pose of each strip, and their number
  std::vector<LinearisedStrip> strips_;
  std::vector<FeedNode> nodes_;
  std::vector<double> off_path_;  ///< of each node, mm
  std::int32_t blocks_ = 0;
  std::vector<double> block_seconds_;
  std::vector<BlockTime> times_;  ///< of each move
  Post post_;
};

}  // namespace

double tip_offset(const Machine& machine, const PostTool& tool) {
  return machine.controlled == ControlledPoint::kLowest ? tool.tip_radius : 0.0;
}

Post post(const Machine& machine, const Path& path, const PostTool& tool, const PostOptions& options) {
  return Poster(machine, path, tool, options).run();
}

}  // namespace flank::internal
