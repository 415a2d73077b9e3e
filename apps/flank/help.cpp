#include "help.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <regex>

namespace flank::cli {
namespace {

constexpr std::size_t kTextColumn = 26;

/// "TEXT", "NUMBER", "line|json": without what a validator adds to it.
std::string value_word(const CLI::Option& option) {
  std::string word = option.get_type_name();
  const std::size_t colon = word.find(':');
  if (colon != std::string::npos) {
    std::string choices = word.substr(colon + 1);
    if (choices.size() > 2 && choices.front() == '{' && choices.back() == '}') {
      std::replace(choices.begin(), choices.end(), ',', '|');
      return choices.substr(1, choices.size() - 2);
    }
    word.resize(colon);
  }
  return word == "FLOAT" || word == "INT" || word == "UINT" ? "NUMBER" : word;
}

/// A name and its text beside it, or below it where the name is long.
std::string entry(const std::string& name, const std::string& text) {
  std::string out = "  " + name;
  if (text.empty()) return out + "\n";
  if (out.size() + 2 > kTextColumn)
    out += "\n" + std::string(kTextColumn, ' ');
  else
    out.resize(kTextColumn, ' ');
  return out + wrapped(text, kTextColumn, kTextColumn) + "\n";
}

bool is_hidden(const std::string& group, CLI::AppFormatMode mode) {
  return mode != CLI::AppFormatMode::All && group != kBasicGroup;
}

/// The commands of an example, each on a line; a long one goes on behind a backslash.
std::string command_lines(const std::string& commands) {
  static const std::regex kEnds(R"(\s*(?:&&|;)\s+(?=flank ))");
  std::string out;
  std::sregex_token_iterator command(commands.begin(), commands.end(), kEnds, -1);
  for (; command != std::sregex_token_iterator(); ++command) {
    std::string line = wrapped(command->str(), 6, 2, 78);
    for (std::size_t end = line.find('\n'); end != std::string::npos; end = line.find('\n', end + 3))
      line.insert(end, " \\");
    out += "  " + line + "\n";
  }
  return out;
}

/// One line of a footer.
std::string footer_line(const std::string& line) {
  static const std::regex kExample(R"(^(.*?): (flank .*?)(?:\. ([A-Z].*))?$)");
  std::smatch found;
  if (!std::regex_match(line, found, kExample)) return wrapped(line, 0) + "\n";
  const std::string after = found[3].matched ? "\n" + wrapped(found[3].str(), 0) + "\n" : "";
  return found[1].str() + ":\n" + command_lines(found[2].str()) + after;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t indent, std::size_t at, std::size_t width) {
  std::string out;
  std::size_t column = at;
  bool first = true;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    if (!first && column + 1 + word.size() > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
    first = false;
    begin = text.find_first_not_of(' ', end);
  }
  return out;
}

std::string footer_text(std::string_view footer) {
  std::string out;
  while (!footer.empty()) {
    const std::size_t end = std::min(footer.find('\n'), footer.size());
    if (end > 0) out += "\n" + footer_line(std::string(footer.substr(0, end)));
    footer.remove_prefix(std::min(end + 1, footer.size()));
  }
  return out;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool positional) const {
  std::string name = make_option_name(option, positional);
  // A word without an option is its own name: "PART".
  if (!positional && option->get_type_size() != 0 && !option->get_type_name().empty())
    name += " " + value_word(*option);
  if (option->get_expected_max() == CLI::detail::expected_max_vector_size) name += " ...";
  std::string text = option->get_description();
  if (option->get_required() && !positional) text += " (required)";
  if (!option->get_default_str().empty()) text += " (default: " + option->get_default_str() + ")";
  return entry(name, text);
}

std::string HelpFormatter::make_subcommand(const CLI::App* app) const {
  return entry(app->get_name(), app->get_description());
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string out = wrapped(app->get_description(), 0) + "\n";
  out += make_usage(app, name) + make_positionals(app);
  bool hidden = false;
  for (const std::string& group : app->get_groups()) {
    const auto options = app->get_options([&](const CLI::Option* option) {
      return option->get_group() == group && option->nonpositional() && !group.empty();
    });
    if (options.empty()) continue;
    if (is_hidden(group, mode))
      hidden = true;
    else
      out += make_group(group, false, options);
  }
  if (hidden) out += "\n" + wrapped("More options: " + name + " --help-all", 0) + "\n";
  out += make_subcommands(app, CLI::AppFormatMode::Normal);
  return out + footer_text(app->get_footer());
}

std::vector<std::string> with_help_words(std::vector<std::string> words) {
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  if (words.size() < 2) words.emplace_back("--help");
  return words;
}

}  // namespace flank::cli
