#include "flank/pipeline/program/stock_path.h"

namespace flank::internal {
namespace {

constexpr double kSharpCosine = 0.86;  ///< of 30 degrees: blocks along a curve turn far less
constexpr double kMiddle = 0.5;

/// What leads to a pose: a strip of the plan by index, or one of these.
constexpr int kFeed = -1, kRapid = -2;

class StockPathMaker {
 public:
  StockPathMaker(const Backplot& plot, const Path& plan, double length) : plot_(plot), plan_(plan), length_(length) {}

  StockPath make(const std::vector<std::vector<int>>& followed) {
    for (std::size_t s = 0; s < plot_.path.strips.size(); ++s) {
      const std::vector<Pose>& poses = plot_.path.strips[s].poses;
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const PoseMove& move = plot_.moves[s][k];
        if (k == 0) {
          // The end of the strip before, or where the machine comes from afar to: a place, not a way.
          begin(poses[k], move.line, kRapid);
          keep_ = move.rapid && move.from_afar;
          continue;
        }
        const int what = move.rapid ? kRapid : followed[s][k];
        const bool turns = k > 1 && is_sharp(poses[k - 2], poses[k - 1], poses[k]);
        if (what != what_ || turns || move.from_afar) begin(poses[k - 1], plot_.moves[s][k - 1].line, what);
        add(poses[k], move.line);
      }
    }
    return std::move(out_);
  }

 private:
  void begin(const Pose& pose, std::int32_t line, int what) {
    what_ = what;
    Strip strip{static_cast<int>(out_.path.strips.size()) + 1, what == kRapid ? kRapidKind : kFeedKind, "", {pose}};
    if (what >= 0) {
      const Strip& planned = plan_.strips[static_cast<std::size_t>(what)];
      strip.kind = planned.kind;
      strip.face = planned.face;
      strip.layer = planned.layer;
    }
    // A strip of one pose is a place that was left at once; a rapid may have cut there, though.
    if (!keep_ && !out_.path.strips.empty() && out_.path.strips.back().poses.size() == 1) {
      strip.id = out_.path.strips.back().id;
      out_.path.strips.pop_back();
      out_.lines.pop_back();
    }
    out_.path.strips.push_back(std::move(strip));
    out_.lines.push_back({line});
    keep_ = false;
  }

  void add(const Pose& pose, std::int32_t line) {
    out_.path.strips.back().poses.push_back(pose);
    out_.lines.back().push_back(line);
  }

  [[nodiscard]] bool is_sharp(const Pose& a, const Pose& b, const Pose& c) const {
    const Vec3 in = b.at(kMiddle * length_) - a.at(kMiddle * length_),
               out = c.at(kMiddle * length_) - b.at(kMiddle * length_);
    return in.dot(out) < kSharpCosine * in.norm() * out.norm();
  }

  const Backplot& plot_;
  const Path& plan_;
  double length_;
  int what_ = kFeed;
  bool keep_ = false;  ///< the last strip, though it has one pose
  StockPath out_;
};

}  // namespace

StockPath stock_path(const Backplot& plot, const Path& plan, const std::vector<std::vector<int>>& followed,
                     double axis_length) {
  return StockPathMaker(plot, plan, axis_length).make(followed);
}

}  // namespace flank::internal
