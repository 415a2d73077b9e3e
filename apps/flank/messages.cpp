#include "messages.h"

#include <algorithm>

namespace flank::cli {
namespace {

/// Letters to insert, to leave out, to change or to swap with their neighbour until a is b (optimal string alignment).
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> apart(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) apart[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) apart[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      apart[i][j] = std::min({apart[i - 1][j] + 1, apart[i][j - 1] + 1, apart[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        apart[i][j] = std::min(apart[i][j], apart[i - 2][j - 2] + 1);
    }
  return apart[a.size()][b.size()];
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kLettersAWrongOne = 3;
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / kLettersAWrongOne) + 1;
  for (const std::string& one : known) {
    const std::size_t apart = word.size() > 2 && one.starts_with(word) ? 1 : letters_apart(word, one);
    if (apart >= least) continue;
    least = apart;
    nearest = one;
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::string in_flags(const Error& error, const std::map<std::string, std::string>& flags) {
  std::string text = error.what();
  const auto named = flags.find(error.field());
  if (named != flags.end()) text.replace(0, error.field().size(), named->second);
  for (std::size_t open = text.find('`'); open != std::string::npos;) {
    const std::size_t close = text.find('`', open + 1);
    if (close == std::string::npos) break;
    const auto flag = flags.find(text.substr(open + 1, close - open - 1));
    if (flag != flags.end()) text.replace(open, close - open + 1, flag->second);
    open = text.find('`', flag != flags.end() ? open + flag->second.size() : close + 1);
  }
  return text;
}

}  // namespace flank::cli
