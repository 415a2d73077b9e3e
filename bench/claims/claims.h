// The claims of the README, measured: each claim runs one case and prints the figures beside what was asked for.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace flank::internal::bench {

/// One figure of a case. `wanted` is the bound that the project asks of itself; a figure without one is only shown.
struct Figure {
  std::string what;
  double value = 0.0;
  double bound = 0.0;
  enum class Kind { kShown, kAtMost, kAtLeast } kind = Kind::kShown;
  [[nodiscard]] bool holds() const {
    return kind == Kind::kShown || (kind == Kind::kAtMost ? value <= bound : value >= bound);
  }
};

inline Figure at_most(std::string what, double value, double bound) {
  return {std::move(what), value, bound, Figure::Kind::kAtMost};
}
inline Figure at_least(std::string what, double value, double bound) {
  return {std::move(what), value, bound, Figure::Kind::kAtLeast};
}
inline Figure shown(std::string what, double value) { return {std::move(what), value, 0.0, Figure::Kind::kShown}; }

/// A case to measure; `run` throws if it cannot be measured (a part that is not there).
struct Claim {
  std::string name;  ///< group/case
  std::function<std::vector<Figure>()> run;
};

void add_envelope_claims(std::vector<Claim>& claims);
void add_mesh_claims(std::vector<Claim>& claims);
void add_given_tool_claims(std::vector<Claim>& claims);
void add_part_claims(std::vector<Claim>& claims);
void add_avoidance_claims(std::vector<Claim>& claims);
void add_cover_claims(std::vector<Claim>& claims);
void add_judge_claims(std::vector<Claim>& claims);

}  // namespace flank::internal::bench
