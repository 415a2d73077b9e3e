#include "flank/studio/words_json.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "flank/error.h"
#include "flank/job/fields_json.h"

namespace flank::internal {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 120, kLongestWord = 4000;

bool is_control(char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }

/// A value of the page as words; refused if it is a list of lists or an object.
std::vector<std::string> words_of(const std::string& name, const Json& value) {
  if (value.is_array()) {
    std::vector<std::string> words;
    for (const Json& one : value)
      for (std::string& word : words_of(name, one.is_array() ? Json() : one)) words.push_back(std::move(word));
    return words;
  }
  if (value.is_string()) return {value.get<std::string>()};
  if (value.is_number()) return {value.dump()};
  if (value.is_boolean()) return {value.get<bool>() ? "on" : "off"};
  throw UsageError(name, "expected a text, a number or a list of them");
}

/// A word as it may stand on a command line: of a file, its path.
std::string checked(const Json& field, const std::string& word, const std::string& files) {
  const std::string name = field.at("name");
  if (word.size() > kLongestWord || std::any_of(word.begin(), word.end(), is_control))
    throw UsageError(name, "is too long, or contains control characters");
  const Json& file = field.at("file");
  const bool may = file != false, must = file == true;
  if (may && is_plain_name(word) && fs::is_regular_file(fs::symlink_status(fs::path(files) / word)))
    return (fs::path(files) / word).string();
  if (must) throw UsageError(name, word, "is not a file of this studio; drop it here first");
  if (word.find('/') != std::string::npos)
    throw UsageError(name, word, "must be a file of this studio, not a path; drop the file here");
  return word;
}

void add(const Json& field, const std::vector<std::string>& words, const std::string& files,
         std::vector<std::string>& out) {
  const std::string option = field.at("option");
  if (field.value("flag", false)) {
    if (words.size() == 1 && words.front() == "on") out.push_back(option);
    return;
  }
  // With "=": a side is "-", which would be taken for an option.
  for (const std::string& word : words)
    if (!word.empty()) out.push_back(option + "=" + checked(field, word, files));
}

bool needs_quotes(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) == 0 &&
         std::string_view("-_=+.,:/%@").find(c) == std::string_view::npos;
}

}  // namespace

bool is_plain_name(const std::string& name) {
  if (name.empty() || name.size() > kLongestName || name.front() == '.' || name.front() == '-') return false;
  return std::none_of(name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || is_control(c); });
}

std::string plain_name(const std::string& name) {
  const std::size_t slash = name.find_last_of("/\\");
  std::string plain = slash == std::string::npos ? name : name.substr(slash + 1);
  for (char& c : plain)
    if (is_control(c)) c = '_';
  while (!plain.empty() && (plain.front() == '.' || plain.front() == '-')) plain.erase(0, 1);
  // The end has the format in it.
  if (plain.size() > kLongestName) plain.erase(0, plain.size() - kLongestName);
  return is_plain_name(plain) ? plain : "file";
}

std::vector<std::string> option_words(const std::string& command, const Json& fields, const std::string& files,
                                      const std::vector<std::string>& kept) {
  if (!fields.is_object()) throw UsageError("fields", "expected an object of names and values");
  const Json table = Json::parse(fields_json(command));
  std::vector<std::string> words;
  for (const auto& item : fields.items()) {
    const std::string& name = item.key();
    const Json& value = item.value();
    const auto& all = table.at("fields");
    const auto field = std::find_if(all.begin(), all.end(), [&](const Json& one) { return one.at("name") == name; });
    if (field == all.end() || std::find(kept.begin(), kept.end(), name) != kept.end())
      throw UsageError(name, "is not a field of " + command);
    add(*field, words_of(name, value), files, words);
  }
  return words;
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    line += line.empty() ? "" : " ";
    if (!word.empty() && std::none_of(word.begin(), word.end(), needs_quotes)) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace flank::internal
