// Good files with random damage, for the tests of readers: what comes out is read or refused, never a crash.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/base/random.h"
#include "flank/error.h"
#include "sanitized.h"

namespace flank::internal {

/// How many damaged files a test of one reader looks at.
inline constexpr int kMutants = kSanitized ? 150 : 600;

inline std::size_t any_of(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.next() % static_cast<std::uint64_t>(count));
}

/// Where the numbers of a text begin and end.
inline std::vector<std::pair<std::size_t, std::size_t>> numbers_in(std::string_view text) {
  constexpr std::string_view kOfNumbers = "+-.0123456789eE";
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < text.size();) {
    const bool begins =
        std::isdigit(static_cast<unsigned char>(text[i])) != 0 ||
        (text[i] == '-' && i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1])));
    std::size_t end = i + 1;
    if (begins) {
      while (end < text.size() && kOfNumbers.find(text[end]) != std::string_view::npos) ++end;
      found.emplace_back(i, end);
    }
    i = end;
  }
  return found;
}

inline std::string with_other_number(Random& random, const std::string& good) {
  static constexpr std::array<std::string_view, 18> kNumbers = {
      "nan",    "-nan",  "inf",   "-inf",   "1e308",
      "-1e308", "1e999", "1e200", "-1e200", "",
      "1e-320", "1e-99", "0",     "-0.001", "99999999999999999999",
      "2.5e0",  "0x10",  "-1"};
  const auto numbers = numbers_in(good);
  if (numbers.empty()) return good;
  const auto [begin, end] = numbers[any_of(random, numbers.size())];
  return good.substr(0, begin) + std::string(kNumbers[any_of(random, kNumbers.size())]) + good.substr(end);
}

/// Takes a line out, or puts it in again somewhere.
inline std::string with_other_lines(Random& random, const std::string& good) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < good.size();) {
    const std::size_t end = std::min(good.find('\n', at), good.size() - 1) + 1;
    lines.push_back(good.substr(at, end - at));
    at = end;
  }
  const std::size_t from = any_of(random, lines.size()), to = any_of(random, lines.size());
  const std::string line = lines[from];
  if (random.next() % 2 == 0)
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(from));
  else
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(to), line);
  std::string text;
  for (const std::string& l : lines) text += l;
  return text;
}

/// The file with one or two kinds of damage.
inline std::string damaged(Random& random, const std::string& good) {
  std::string text = good;
  for (std::uint64_t times = 1 + random.next() % 2; times > 0 && !text.empty(); --times) {
    switch (random.next() % 5) {
      case 0:
        text[any_of(random, text.size())] = static_cast<char>(random.next() % 256);
        break;
      case 1:
        text.resize(any_of(random, text.size()));
        break;
      case 2:
        text = with_other_lines(random, text);
        break;
      default:
        text = with_other_number(random, text);
    }
  }
  return text;
}

struct MutationCount {
  int read = 0, refused = 0;
};

/// Damages `good` kMutants times. `read` gets the damaged text and says whether what it made of it is sound; it may
/// refuse it by an InputError or UsageError of one line that names `file`.
inline MutationCount mutate(const std::string& good, const std::string& file, std::uint64_t seed,
                            const std::function<bool(const std::string&)>& read) {
  MutationCount count;
  Random random(seed);
  for (int i = 0; i < kMutants && !::testing::Test::HasFailure(); ++i) {
    const std::string bad = damaged(random, good);
    const auto refused = [&](const std::string& message) {
      ++count.refused;
      EXPECT_NE(message.find(file), std::string::npos) << message << "\n for \n" << bad;
    };
    try {
      EXPECT_TRUE(read(bad)) << "read, but not sound:\n" << bad;
      ++count.read;
    } catch (const InputError& e) {
      refused(e.what());
    } catch (const UsageError& e) {
      refused(e.what());
    } catch (const std::exception& e) {
      ADD_FAILURE() << "neither read nor refused, but: " << e.what() << "\n for \n" << bad;
    }
  }
  return count;
}

}  // namespace flank::internal
