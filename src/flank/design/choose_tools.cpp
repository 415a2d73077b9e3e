#include "flank/design/choose_tools.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr int kRootSteps = 400, kNodeSteps = 40;
/// Steps without a better bound after which the step of the subgradient is halved.
constexpr int kPatience = 10;
constexpr double kFirstStep = 2.0, kLeastStep = 1e-4;
constexpr double kProof = 1e-9;

enum class State : char { kFree, kIn, kOut };

struct Relaxed {
  double bound = -std::numeric_limits<double>::infinity();
  std::vector<double> prices;   ///< of the faces, at which the bound holds
  std::vector<double> savings;  ///< of each tool there: the less, the better
  std::vector<int> taken;       ///< tools of the relaxed problem's answer
  double last = 0.0;            ///< the largest saving among the free ones that were taken; 0: one more could be
};

class Search {
 public:
  Search(const SetProblem& problem, int most) : problem_(problem), most_(std::min(most, problem.tools)) {
    for (const double x : problem.minutes)
      if (!(x >= 0.0)) throw InternalError("the time of a tool on a face is below 0 or not a number");
    // More than every set costs that leaves one face less.
    penalty_ = 1.0 + problem.tool_minutes * problem.tools;
    for (int f = 0; f < problem.faces; ++f) {
      double worst = 0.0;
      for (int t = 0; t < problem.tools; ++t)
        if (std::isfinite(problem.at(t, f))) worst = std::max(worst, problem.at(t, f));
      penalty_ += worst;
    }
    cost_.reserve(problem.minutes.size());
    for (const double x : problem.minutes) cost_.push_back(std::min(x, penalty_));
    best_value_ = value({});
  }

  ToolSet run() {
    std::vector<State> states(static_cast<std::size_t>(problem_.tools), State::kFree);
    std::vector<double> prices(static_cast<std::size_t>(problem_.faces));
    for (int f = 0; f < problem_.faces; ++f) {
      // Between its best and its second best tool.
      double first = penalty_, second = penalty_;
      for (int t = 0; t < problem_.tools; ++t) {
        const double x = cost(t, f);
        if (x < first)
          second = std::exchange(first, x);
        else
          second = std::min(second, x);
      }
      prices[static_cast<std::size_t>(f)] = 0.5 * (first + second);
    }
    if (most_ > 0 && problem_.faces > 0) branch(std::move(states), std::move(prices), kRootSteps);
    return answer();
  }

 private:
  [[nodiscard]] double cost(int tool, int face) const {
    return cost_[static_cast<std::size_t>(tool * problem_.faces + face)];
  }

  [[nodiscard]] double value(std::span<const int> tools) const {
    double sum = problem_.tool_minutes * static_cast<double>(tools.size());
    for (int f = 0; f < problem_.faces; ++f) {
      double least = penalty_;
      for (const int t : tools) least = std::min(least, cost(t, f));
      sum += least;
    }
    return sum;
  }

  void offer(std::vector<int> tools) {
    std::sort(tools.begin(), tools.end());
    const double found = value(tools);
    if (found >= best_value_) return;
    best_value_ = found;
    best_ = std::move(tools);
  }

  /// A set made better by exchanges of one tool, until none helps.
  void improve(std::vector<int> tools, const std::vector<State>& states) {
    double now = value(tools);
    for (bool better = true; better;) {
      better = false;
      for (std::size_t k = 0; k <= tools.size() && k < static_cast<std::size_t>(most_); ++k)
        for (int t = 0; t < problem_.tools; ++t) {
          if (states[static_cast<std::size_t>(t)] == State::kOut) continue;
          std::vector<int> other = tools;
          if (k == tools.size())
            other.push_back(t);
          else
            other[k] = t;
          const double then = value(other);
          if (then >= now) continue;
          now = then;
          tools = std::move(other);
          better = true;
        }
    }
    offer(std::move(tools));
  }

  /// The Lagrangian bound at given prices, and what the relaxed problem takes.
  Relaxed relax(const std::vector<State>& states, const std::vector<double>& prices) const {
    Relaxed relaxed;
    relaxed.prices = prices;
    relaxed.bound = std::accumulate(prices.begin(), prices.end(), 0.0);
    std::vector<int> free;
    int in = 0;
    for (int t = 0; t < problem_.tools; ++t) {
      double saving = problem_.tool_minutes;
      for (int f = 0; f < problem_.faces; ++f)
        saving += std::min(0.0, cost(t, f) - prices[static_cast<std::size_t>(f)]);
      relaxed.savings.push_back(saving);
      const State state = states[static_cast<std::size_t>(t)];
      if (state == State::kIn) {
        relaxed.taken.push_back(t);
        relaxed.bound += saving;
        ++in;
      } else if (state == State::kFree) {
        free.push_back(t);
      }
    }
    std::stable_sort(free.begin(), free.end(), [&](int a, int b) {
      return relaxed.savings[static_cast<std::size_t>(a)] < relaxed.savings[static_cast<std::size_t>(b)];
    });
    const auto room = static_cast<std::size_t>(most_ - in);
    for (std::size_t k = 0; k < free.size() && k < room; ++k) {
      const double saving = relaxed.savings[static_cast<std::size_t>(free[k])];
      if (saving >= 0.0) break;
      relaxed.taken.push_back(free[k]);
      relaxed.bound += saving;
      if (k + 1 == room) relaxed.last = saving;
    }
    return relaxed;
  }

  /// The best bound that the subgradient finds from these prices.
  Relaxed bound(const std::vector<State>& states, std::vector<double> prices, int steps) {
    Relaxed best;
    double step = kFirstStep;
    int since = 0;
    for (int k = 0; k < steps && step > kLeastStep; ++k) {
      Relaxed now = relax(states, prices);
      offer(now.taken);
      std::vector<double> slope(prices.size(), 1.0);
      for (const int t : now.taken)
        for (int f = 0; f < problem_.faces; ++f)
          if (cost(t, f) < prices[static_cast<std::size_t>(f)]) slope[static_cast<std::size_t>(f)] -= 1.0;
      const double bound_now = now.bound;
      if (bound_now > best.bound) {
        best = std::move(now);
        since = 0;
      } else if (++since == kPatience) {
        step *= 0.5;
        since = 0;
      }
      if (is_proved(best.bound)) return best;
      double norm = 0.0;
      for (const double s : slope) norm += s * s;
      if (norm == 0.0) break;
      const double length = step * std::max(best_value_ - bound_now, kProof * best_value_) / norm;
      // A face left alone costs the penalty: a higher price would not be a bound.
      for (std::size_t f = 0; f < prices.size(); ++f)
        prices[f] = std::clamp(prices[f] + length * slope[f], 0.0, penalty_);
    }
    return best;
  }

  [[nodiscard]] bool is_proved(double bound) const { return bound >= best_value_ - kProof * std::abs(best_value_); }

  void branch(std::vector<State> states, std::vector<double> prices, int steps) {
    const Relaxed relaxed = bound(states, std::move(prices), steps);
    improve(relaxed.taken, states);
    if (is_proved(relaxed.bound)) return;
    int next = -1, in = 0;
    for (int t = 0; t < problem_.tools; ++t) {
      State& state = states[static_cast<std::size_t>(t)];
      if (state == State::kIn) ++in;
      if (state != State::kFree) continue;
      const double saving = relaxed.savings[static_cast<std::size_t>(t)];
      // With it, the bound would be higher by what it saves less than the last one taken.
      if (saving > relaxed.last && is_proved(relaxed.bound + saving - relaxed.last)) {
        state = State::kOut;
      } else if (next < 0 || saving < relaxed.savings[static_cast<std::size_t>(next)]) {
        next = t;
      }
    }
    if (next < 0 || in == most_) {
      std::vector<int> tools;
      for (int t = 0; t < problem_.tools; ++t)
        if (states[static_cast<std::size_t>(t)] == State::kIn) tools.push_back(t);
      offer(std::move(tools));
      return;
    }
    states[static_cast<std::size_t>(next)] = State::kIn;
    branch(states, relaxed.prices, kNodeSteps);
    states[static_cast<std::size_t>(next)] = State::kOut;
    branch(std::move(states), relaxed.prices, kNodeSteps);
  }

  [[nodiscard]] ToolSet answer() const {
    ToolSet choice;
    for (int f = 0; f < problem_.faces; ++f) {
      int tool = -1;
      double least = kNeverFinishes;
      for (const int t : best_)
        if (problem_.at(t, f) < least) {
          least = problem_.at(t, f);
          tool = t;
        }
      choice.tool_of_face.push_back(tool);
      if (tool < 0)
        ++choice.unfinished;
      else
        choice.minutes += least;
    }
    for (const int t : best_)
      if (std::count(choice.tool_of_face.begin(), choice.tool_of_face.end(), t) > 0) choice.tools.push_back(t);
    choice.minutes += problem_.tool_minutes * static_cast<double>(choice.tools.size());
    return choice;
  }

  const SetProblem& problem_;
  int most_;
  double penalty_ = 0.0;
  std::vector<double> cost_;
  std::vector<int> best_;
  double best_value_ = 0.0;
};

}  // namespace

ToolSet choose_tools(const SetProblem& problem, int most) { return Search(problem, most).run(); }

ToolSet choose_fewest(const SetProblem& problem) {
  int never = 0;
  for (int f = 0; f < problem.faces; ++f) {
    bool finished = false;
    for (int t = 0; t < problem.tools && !finished; ++t) finished = std::isfinite(problem.at(t, f));
    if (!finished) ++never;
  }
  ToolSet choice = choose_tools(problem, 1);
  for (int most = 2; choice.unfinished > never && most <= problem.tools; ++most) choice = choose_tools(problem, most);
  return choice;
}

}  // namespace flank::internal
