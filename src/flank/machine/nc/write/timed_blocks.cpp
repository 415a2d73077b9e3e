#include "flank/machine/nc/write/timed_blocks.h"

#include <algorithm>
#include <cmath>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// Below this a written way is none: no dialect has so many decimals.
constexpr double kNoWay = 1e-10;
/// LinuxCNC's own limit is 0.1; twice that leaves room for its rounding.
constexpr double kSlowestOfLinuxCnc = 0.2;
/// With which a point that was held back makes its way good, mm/min.
constexpr double kCatchUpFeed = 60.0;
constexpr int kMostPieces = 100'000;

double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

/// What is written of a move. Vectors stay: they are told to eight digits and more, and must stay of unit length.
void round_move(const NcProgram& program, const NcDialect& dialect, NcMove& move) {
  for (int i = 0; i < 3; ++i) move.position[i] = rounded(move.position[i], dialect.length_decimals);
  if (program.positions == NcPositions::kTipVector) return;
  for (int i = 0; i < 2; ++i) move.orientation[i] = rounded(move.orientation[i], dialect.angle_decimals);
}

class Stater {
 public:
  Stater(NcProgram& program, const NcDialect& dialect, double hold_mm)
      : program_(program),
        dialect_(dialect),
        hold_mm_(hold_mm),
        slowest_mm_s_(slowest_turning_feed(program, dialect) / 60.0) {}

  double run(const std::vector<BlockTime>& times) {
    if (times.size() != program_.moves.size()) throw InternalError("the times belong to other moves");
    for (std::size_t i = 0; i < times.size(); ++i) {
      NcMove move = program_.moves[i];
      round_move(program_, dialect_, move);
      if (out_.empty() || move.kind == NcKind::kRapid)
        out_.push_back(move);
      else
        add(move, times[i]);
    }
    program_.moves = std::move(out_);
    return held_;
  }

 private:
  /// A word holds at most 1e6 (nc_number.h): a block shorter than this allows is run a little slower.
  [[nodiscard]] double feed(const NcMove& to, const BlockTime& time) const {
    constexpr double kShortest = 1e-4;
    if (program_.feed_mode == NcFeedMode::kInverseTime) return 60.0 / std::max(time.seconds, kShortest);
    const double way = (to.position - out_.back().position).norm();
    // Where the controlled point stands still, controls take the feed for that of the rotary axes, degrees per minute.
    const double per_minute = (way > kNoWay ? way : time.turn_deg) / std::max(time.seconds, 1e-9) * 60.0;
    // Controls refuse F0, and three decimals would print it.
    return std::clamp(per_minute, 1e-3, 1e6);
  }

  void push(NcMove move, const BlockTime& time) {
    move.feed = feed(move, time);
    out_.push_back(move);
  }

  void add(const NcMove& move, const BlockTime& time) {
    const Vec3 from = out_.back().position;
    const double way = (move.position - from).norm();
    if (!(way > kNoWay) || !(time.turn_deg > 0.0) || way >= slowest_mm_s_ * time.seconds) return push(move, time);
    // The point lags by less than `hold_mm`: it waits for a block that is faster, or for its own.
    const int pieces = static_cast<int>(std::clamp(std::ceil(way / hold_mm_), 1.0, double{kMostPieces}));
    const Vec3 turned_from = out_.back().orientation;
    for (int k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / pieces;
      NcMove turn = move;
      turn.position = out_.back().position;
      turn.orientation = turned_from + share * (move.orientation - turned_from);
      round_move(program_, dialect_, turn);
      push(turn, {time.seconds / pieces, time.turn_deg / pieces});
      NcMove straight = turn;
      straight.position = from + share * (move.position - from);
      round_move(program_, dialect_, straight);
      const double lag = (straight.position - turn.position).norm();
      held_ = std::max(held_, lag);
      if (pieces > 1 && lag > kNoWay) push(straight, {lag / (kCatchUpFeed / 60.0), 0.0});
    }
  }

  NcProgram& program_;
  const NcDialect& dialect_;
  double hold_mm_, slowest_mm_s_;
  double held_ = 0.0;
  std::vector<NcMove> out_;
};

}  // namespace

double slowest_turning_feed(const NcProgram& program, const NcDialect& dialect) {
  const bool limited = dialect.language == NcLanguage::kLinuxCnc && program.feed_mode == NcFeedMode::kInverseTime;
  return limited ? kSlowestOfLinuxCnc : 0.0;
}

double state_feeds(NcProgram& program, const std::vector<BlockTime>& times, const NcDialect& dialect, double hold_mm) {
  return Stater(program, dialect, hold_mm).run(times);
}

}  // namespace flank::internal
