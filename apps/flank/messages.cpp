#include "messages.h"

namespace flank::cli {

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
