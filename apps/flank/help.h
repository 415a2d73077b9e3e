/// Help texts: 80 columns, the options that most users need first, the others with --help-all.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace flank::cli {

/// The group of options that --help shows; --help-all shows every group.
inline constexpr const char* kBasicGroup = "Options";
/// Groups of options that belong to no other group, and of those that all commands have.
inline constexpr const char* kMoreGroup = "More options";
inline constexpr const char* kCommonGroup = "All commands";

/// Lines of at most `width` columns, the first continuing at column `at`, the others indented by `indent`. A longer word has a line of its own.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t indent, std::size_t at = 0,
                                  std::size_t width = 80);

/// The end of a help text: sentences, and examples one command a line. An example begins behind ": " with "flank ", and ends with the
/// line or before a sentence; "&&" and ";" part commands.
[[nodiscard]] std::string footer_text(std::string_view footer);

/// How all commands print their help. Subcommands without a group stand under "Subcommands".
class HelpFormatter : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;

 private:
  [[nodiscard]] std::string make_option(const CLI::Option* option, bool positional) const override;
  [[nodiscard]] std::string make_subcommand(const CLI::App* app) const override;
};

/// "flank help fit" is "flank fit --help", "flank help" is "flank --help"; other words stay as they are.
[[nodiscard]] std::vector<std::string> with_help_words(std::vector<std::string> words);

}  // namespace flank::cli
