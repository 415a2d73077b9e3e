// studio: the command becomes the program of the server, which alone links what opens a connection. All other commands start without it.
#include <fmt/format.h>

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "flank/error.h"
#include "studio_options.h"

namespace flank::cli {
namespace {

namespace fs = std::filesystem;

/// This very program, wherever it was started from.
fs::path this_program() {
  std::error_code error;
  fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) throw InternalError("/proc/self/exe cannot be read; the studio cannot start its children");
  return program;
}

/// Beside the command, or where packages keep programs that no user calls.
fs::path studio_program(const fs::path& command) {
  const fs::path folder = command.parent_path();
  for (const fs::path& place : {folder, folder.parent_path() / "libexec" / "openflank"}) {
    std::error_code error;
    fs::path program = place / "flank-studio";
    if (fs::is_regular_file(program, error)) return program;
  }
  constexpr const char* kMissing = FLANK_STUDIO_MISSING;
  throw UsageError("studio",
                   *kMissing != '\0'
                       ? fmt::format("this flank was built without the studio: {}", kMissing)
                       : fmt::format("the program flank-studio is neither in {} nor in ../libexec/openflank of it",
                                     folder.string()));
}

/// Does not return: from here on this process is the server, with the streams and the number that the command had.
[[noreturn]] void become_studio(const std::vector<std::string>& words) {
  const std::string command = this_program(), program = studio_program(command);
  std::vector<std::string> all{program, command};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  throw InternalError(fmt::format("{}: cannot be started ({})", program, std::strerror(errno)));
}

}  // namespace

Subcommand add_studio(CLI::App& parser) {
  const auto words = std::make_shared<StudioWords>();  // the parser writes into it, and the server's parser again
  return {add_studio_words(parser, words),
          [words](const CommonOptions& common) -> int { become_studio(common.words); },
          {{"studio", "studio"}}};
}

}  // namespace flank::cli
