/// Jobs with values of all kinds that their fields accept.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flank/base/random.h"
#include "flank/job/bound_fields.h"
#include "flank/job/correct_fields.h"
#include "flank/job/design_fields.h"
#include "flank/job/redesign_fields.h"
#include "flank/job/wheel_fields.h"

namespace flank::internal::jobs {

/// Text with all that a shell could take for something else.
inline std::string nasty_text(Random& random) {
  static const std::vector<std::string> kLetters = {"a", "Z", "0", "9", " ", "'", "\"", "$", "`",  "\\",      "*",
                                                    ";", "&", "|", "<", ">", "(", ")",  "#", "~",  "!",       "?",
                                                    "=", ",", ":", ".", "@", "+", "-",  "_", "\n", "\xc3\xbc"};
  std::string text;
  for (int k = 0; k < 8; ++k)
    text += kLetters[static_cast<std::size_t>(random.uniform() * 0.999 * static_cast<double>(kLetters.size()))];
  return text;
}

inline void randomise(const FieldInfo& info, std::string& value, Random& random) {
  if (info.accepted.text) {
    for (const char* word :
         {"mm",           "cm",    "m",         "in",       "grow",   "curves",  "grid",    "shape", "tapered",
          "any",          "quick", "normal",    "thorough", "feed",   "optimal", "volume",  "plain", "climb",
          "conventional", "both",  "catalogue", "ramp",     "plunge", "keep",    "largest", "auto",  "none",
          "flood",        "mist",  "bottom",    "bore"})
      if (info.accepted.text(word) && random.uniform() < 0.5) value = word;
    if (!info.accepted.text(value))
      for (const char* word : {"in", "curves", "shape", "any", "quick", "optimal", "plain", "conventional", "both",
                               "ramp", "keep", "largest"})
        if (info.accepted.text(word)) value = word;
    return;
  }
  value = (info.spelling == Spelling::kFile ? "/parts/" : "") + nasty_text(random);
  if (info.spelling == Spelling::kFile) value += "x";
}

inline void randomise(const FieldInfo& info, double& value, Random& random) {
  do value = std::pow(10.0, 6.0 * random.uniform() - 3.0);
  while (info.accepted.number && !info.accepted.number(value));
}

inline void randomise(const FieldInfo& info, int& value, Random& random) {
  do value = static_cast<int>(std::floor(140.0 * random.uniform())) - 20;
  while (info.accepted.number && !info.accepted.number(value));
}

inline void randomise(const FieldInfo&, std::uint64_t& value, Random& random) {
  value = static_cast<std::uint64_t>(random.uniform() * 1.8e19);
}
inline void randomise(const FieldInfo&, bool& value, Random&) { value = !value; }
inline void randomise(const FieldInfo& info, std::vector<std::string>& values, Random& random) {
  values.resize(1 + static_cast<std::size_t>(2.9 * random.uniform()));
  for (std::string& value : values) randomise(info, value, random);
}
template <class T>
void randomise(const FieldInfo& info, std::optional<T>& value, Random& random) {
  value.emplace();
  randomise(info, *value, random);
}

/// Each field is changed with the probability `share`.
template <class Job>
Job random_job(Random& random, double share = 0.6) {
  Job job;
  visit_fields(job, [&](const FieldInfo& info, auto& value) {
    if (info.always || random.uniform() < share) randomise(info, value, random);
  });
  return job;
}

}  // namespace flank::internal::jobs
