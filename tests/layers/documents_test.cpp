/// What the documents write in backticks is there: files, types, functions, options of structs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace flank::layers {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = FLANK_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Every name in the code (comments left out: they can be stale as well), and every path below the root, each on a line
/// of its own after a slash.
struct Names {
  std::set<std::string> words;
  std::string paths;

  explicit Names(const fs::path& root) {
    for (const char* folder :
         {"src", "include", "tests", "bench", "apps", "examples", "cmake", "scripts", "docs", "share", "web", "python"})
      for (const auto& entry : fs::recursive_directory_iterator(root / folder))
        if (entry.is_regular_file()) add_file(entry.path(), root);
  }

 private:
  void add_file(const fs::path& file, const fs::path& root) {
    paths += '/' + file.lexically_relative(root).string() + '\n';
    const std::string stem = file.stem().string(), type = file.extension().string();
    words.insert(stem);
    if (stem.ends_with("_bench")) words.insert("bench_" + stem.substr(0, stem.size() - 6));  // its executable
    if (type == ".h" || type == ".cpp" || type == ".txt" || type == ".cmake" || type == ".py") add_words(text_of(file));
  }

  void add_words(const std::string& text) {
    std::string word;
    for (std::size_t i = 0; i <= text.size(); ++i) {
      const char c = i < text.size() ? text[i] : '\n';
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
        word += c;
        continue;
      }
      if (!word.empty()) words.insert(std::exchange(word, ""));
      if (text.compare(i, 2, "//") == 0) i = std::min(text.find('\n', i), text.size());
    }
  }
};

/// The names in one quoted text that ought to be in `names` and are not. Options, numbers, files that the program
/// writes and plain words are no names.
std::vector<std::string> unknown_names(const Names& names, const std::string& quoted) {
  static const std::regex path(R"((?!build/|out/)[\w-]+(/[\w.-]+)*(/|/[\w.-]*\*[\w.]*|\.h|\.cpp)|)"
                               R"((?:src|tests|docs|bench|share|examples)/[\w/.-]+)");
  static const std::regex name(R"(\w+((::|\.)\w+)*(\.\*)?(\(\))?)");
  static const std::regex part(R"(\w+)");
  static const std::regex telling(
      R"(.*[a-z0-9]_[a-z0-9].*|(k?[A-Z][a-z0-9]+){2,}|k[A-Z]\w*)");  // snake_case, CamelCase, kName
  std::vector<std::string> unknown;
  if (std::regex_match(quoted, path)) {
    const std::string start = '/' + quoted.substr(0, quoted.find('*'));
    if (names.paths.find(start) == std::string::npos) unknown.push_back(quoted);
  } else if (std::regex_match(quoted, name)) {
    for (std::sregex_iterator it(quoted.begin(), quoted.end(), part), end; it != end; ++it) {
      const bool qualified = quoted.find("::") != std::string::npos;
      if ((qualified || std::regex_match(it->str(), telling)) && !names.words.contains(it->str()))
        unknown.push_back(it->str());
    }
  }
  return unknown;
}

std::vector<std::string> unknown_names_of_text(const Names& names, const std::string& text) {
  static const std::regex fence("```[^]*?```"), quote("`([^`\n]+)`");
  const std::string prose = std::regex_replace(text, fence, "");
  std::vector<std::string> unknown;
  for (std::sregex_iterator it(prose.begin(), prose.end(), quote), end; it != end; ++it)
    for (const std::string& name : unknown_names(names, (*it)[1].str())) unknown.push_back(name);
  return unknown;
}

TEST(Documents, NameOnlyWhatIsThere) {
  const Names names(kRoot);
  std::vector<fs::path> files = {kRoot / "README.md", kRoot / "ARCHITECTURE.md", kRoot / "CONTRIBUTING.md",
                                 kRoot / "GLOSSARY.md"};
  for (const char* folder : {"docs", "docs/algorithms", "docs/schema"})
    for (const auto& entry : fs::directory_iterator(kRoot / folder))
      if (entry.path().extension() == ".md") files.push_back(entry.path());
  ASSERT_GT(files.size(), 20u);
  for (const fs::path& file : files)
    for (const std::string& name : unknown_names_of_text(names, text_of(file)))
      ADD_FAILURE() << file.lexically_relative(kRoot).string() << " names `" << name
                    << "`, which is nowhere in the tree";
}

TEST(Documents, AnInventedNameIsFound) {
  const Names names(kRoot);
  const std::string name = std::string("no") + "_such_name";  // in two parts, or this file would make it known
  const auto unknown = [&](const std::string& text) { return unknown_names_of_text(names, text); };
  EXPECT_EQ(unknown("`" + name + "` and `fit_automatic`"), std::vector{name});
  EXPECT_EQ(unknown("`Target::" + name + "()`"), std::vector{name});
  EXPECT_EQ(unknown("`src/flank/" + name + "/`, `flank/vec.h`, `tests/layers/doc*`"),
            std::vector{"src/flank/" + name + "/"});
  EXPECT_TRUE(unknown("`--tolerance`, `tool.json`, `fit`, `1e-9`\n```\n`" + name + "`\n```\n").empty());
}

}  // namespace
}  // namespace flank::layers
