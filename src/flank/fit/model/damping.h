/// How much a step of Levenberg-Marquardt is held back, and what the fate of one step says about the next.
#pragma once

#include <algorithm>

namespace flank::internal {

/// A damping without unit: a share of the diagonal (ArrowSystem::solve). It grows with every step that is refused, the
/// faster the more of them, and falls with the gain of one that is accepted (Nielsen, "Damping parameter in Marquardt's
/// method", 1999), but not below one at which a step was refused just before: every refusal costs all contacts.
class Damping {
 public:
  /// Small at first, because the problem is nearly quadratic near a good start: 1e-6 crawls (MATH section 7).
  static constexpr double kFirst = 1e-9;

  [[nodiscard]] double value() const { return value_; }
  /// At the most, a step is 1e-8 of a gradient step and nothing is to be gained any more.
  [[nodiscard]] bool is_spent() const { return value_ > kMost; }

  /// No step can be had at this damping, or it leads too far to be worth a look.
  void raise() { value_ = std::max(kMore * value_, kRetry); }
  /// The step does not lower the cost.
  void refuse() {
    refused_ = true;
    value_ = std::max(more_ * value_, kRetry);
    more_ *= kSooner;
  }
  /// The step lowers the cost by `gain` times what the quadratic model promises.
  void accept(double gain) {
    const double off = 2.0 * gain - 1.0;
    value_ = std::max(value_ * std::max(refused_ ? 1.0 : kLess, 1.0 - off * off * off), kLeast);
    more_ = kMore;
    refused_ = false;
  }

 private:
  /// The least keeps the diagonal above round-off of the factorisation. Between there and kRetry the step hardly changes.
  static constexpr double kLeast = 1e-14, kRetry = 1e-8, kMost = 1e8;
  static constexpr double kMore = 5.0, kSooner = 1.5, kLess = 0.1;

  double value_ = kFirst;
  double more_ = kMore;
  bool refused_ = false;
};

}  // namespace flank::internal
