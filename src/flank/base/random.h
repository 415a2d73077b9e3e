/// Seeded random numbers that are the same on every machine (the distributions of <random> are not).
#pragma once

#include <cmath>
#include <cstdint>

namespace flank::internal {

/// SplitMix64 (Steele, Lea, Flood 2014): small, fast, good enough for sampling. Local generators only; there is no
/// global one.
class Random {
 public:
  /// The same seed gives the same numbers; neighbouring seeds give unrelated ones.
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// 64 uniform bits.
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// Uniform in [low, high), up to the rounding of the product.
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal, by Box and Muller.
  /// Two numbers are drawn per call: the second one of the pair is dropped, so that calls do not depend on each other.
  double normal() {
    // 1 - uniform() is in (0, 1]: the logarithm is finite.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(6.283185307179586 * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace flank::internal
