// Parses the words, runs the command that they choose, turns errors into exit codes.
#include "command_line.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "flank/cad_process.h"
#include "flank/error.h"
#include "flank/printable.h"
#include "flank/threads.h"
#include "flank/version.h"
#include "help.h"
#include "messages.h"

namespace flank::cli {
namespace {

/// One line on stderr, whatever the message holds.
int complain(const std::string& message, int code) {
  std::string line = message;
  for (char& c : line)
    if (c == '\n') c = ' ';
  line = "flank: " + printable(line) + "\n";
  // Nothing can be said where standard error is closed or full; the exit code says it.
  (void)std::fwrite(line.data(), 1, line.size(), stderr);
  return code;
}

/// A first word that is no command is named, with the nearest that is one.
void require_known_command(const CLI::App& parser, const std::vector<std::string>& words) {
  if (words.empty() || words.front().starts_with('-')) return;
  std::vector<std::string> known;
  for (const CLI::App* command : parser.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  if (std::find(known.begin(), known.end(), words.front()) != known.end()) return;
  const std::string nearest = did_you_mean(words.front(), known);
  throw UsageError(fmt::format("unknown command '{}'{} {}", words.front(),
                               nearest.empty() ? "; commands:" : nearest + " Commands:", fmt::join(known, ", ")));
}

/// What the parser complains of, in words that help: the option that does not exist with the nearest that does, or the word too many.
std::string parse_complaint(const CLI::ParseError& error, const CLI::App* command,
                            const std::vector<std::string>& words) {
  if (command == nullptr) return "give a command (see flank --help)";
  const std::string hint = fmt::format(" (see flank {} --help)", command->get_name());
  // An option that is wrong comes first: what it stands for may be what is missing.
  const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
  if (code != CLI::ExitCodes::ExtrasError && code != CLI::ExitCodes::RequiredError) return error.what() + hint;
  std::vector<std::string> known;
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (std::size_t k = 1; k < words.size(); ++k) {
    const std::string name = words[k].substr(0, words[k].find('='));
    // A number may begin with a minus, and a value may stand directly behind a short option.
    const bool option = name.starts_with("--") || (name.size() == 2 && name[0] == '-' && std::isalpha(name[1]) != 0);
    if (option && command->get_option_no_throw(name) == nullptr)
      return fmt::format("flank {} has no option {}{}{}", command->get_name(), name, did_you_mean(name, known), hint);
  }
  return error.what() + hint;
}

/// Which part of the help text of all commands one stands in.
const char* group_of(const std::string& command) {
  for (const char* name : {"tool", "machine"})
    if (command == name) return "Tools and machines";
  for (const char* name : {"design", "sweep", "bound", "redesign", "correct"})
    if (command == name) return "Studies and corrections";
  for (const char* name : {"example", "fields"})
    if (command == name) return "Helpers";
  return "From a part to a program";
}

void add_common(CLI::App& app, CommonOptions& common) {
  app.add_flag("--json", common.json, "Print the result as JSON on stdout, and nothing else");
  app.add_flag("--quiet", common.quiet, "Print errors only");
  const std::string group = kCommonGroup;
  app.add_option("--progress", common.progress, "Progress on stderr: line, or json (one line of JSON for each report)")
      ->check(CLI::IsMember({"line", "json"}))
      ->capture_default_str()
      ->group(group);
  app.add_option("--threads", common.threads, "Number of threads; 0: all cores. The result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->group(group);
  app.add_option("--read-limit", common.read_limit_s,
                 "Limit of processor time for reading a CAD file, seconds. Default: 10, plus 30 for each MB")
      ->check(CLI::Range(0.1, 1e6))
      ->group(group);
  app.add_flag("--no-cache", common.no_cache, "Neither use nor fill the cache of CAD files")->group(group);
}

/// How all commands, which are still to be added, print their help.
void set_help(CLI::App& parser) {
  const auto formatter = std::make_shared<HelpFormatter>();
  formatter->label("Positionals", "Arguments");
  parser.formatter(formatter);
  parser.set_help_flag("-h,--help", "Print this help and exit");
  parser.set_help_all_flag("--help-all", "Print the help with all options and exit");
  parser.set_version_flag("--version", kVersion, "Print the version and exit");
  parser.require_subcommand(1);
  parser.footer("Exit status: 0 request met; 1 request not met; 2 wrong usage; 3 input refused; 4 internal error");
}

/// The flags of a command, and those that all have.
std::map<std::string, std::string> with_common(std::map<std::string, std::string> flags) {
  flags["read_limit"] = "--read-limit";
  return flags;
}

/// What was printed must have arrived: a full disk is noticed when it is flushed. A reader that has seen enough, as `head`, is no fault.
int flushed(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  if (errno == EPIPE) return code;
  return complain(std::string("standard output cannot be written (") + std::strerror(errno) + ")", kRefusedInput);
}

/// Commands with the options that they share, each under its heading.
std::vector<Subcommand> ready_commands(CLI::App& parser, const AddCommands& add, CommonOptions& common) {
  std::vector<Subcommand> commands = add(parser);
  for (const Subcommand& command : commands) {
    command.app->group(group_of(command.app->get_name()));
    add_common(*command.app, common);
  }
  return commands;
}

/// What run does; throws only what nobody can report.
int run_words(const std::vector<std::string>& words, const AddCommands& add) {
  // A reader that has gone away, and a limit on the size of files, are errors of the write, not our end.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App parser{
      "flank: five-axis flank milling (swarf milling). Finds tools and motions whose flank finishes a surface, and "
      "checks them",
      "flank"};
  set_help(parser);
  CommonOptions common;
  common.words = words;
  const std::vector<Subcommand> commands = ready_commands(parser, add, common);
  const auto chosen = [&]() -> const Subcommand* {
    for (const Subcommand& command : commands)
      if (command.app->parsed() || (!words.empty() && command.app->get_name() == words.front())) return &command;
    return nullptr;
  };
  const auto in_flags = [&](const Error& error) {
    const Subcommand* command = chosen();
    return command != nullptr ? flank::cli::in_flags(error, with_common(command->flags)) : std::string(error.what());
  };
  try {
    require_known_command(parser, words);
    parser.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    set_thread_count(common.threads);
    // The command's threads are still to come, so it can be told now how CAD files are read.
    read_cad_in_children(common.read_limit_s, !common.no_cache);
    return flushed(chosen()->run(common));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return flushed(parser.exit(e));
    const Subcommand* command = chosen();
    return complain(parse_complaint(e, command != nullptr ? command->app : nullptr, words), kWrongUsage);
  } catch (const UsageError& e) {
    return complain(in_flags(e), kWrongUsage);
  } catch (const InputError& e) {
    return complain(in_flags(e), kRefusedInput);
  } catch (const Stopped&) {
    return complain(stopped_by() + "; no result yet", kFallsShort);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", kOurFault);
  } catch (const std::system_error& e) {
    // fmt says so when a stream cannot be written.
    if (e.code() == std::errc::broken_pipe) return kRefusedInput;
    return complain(std::string("cannot write (") + e.what() + ")", kRefusedInput);
  } catch (const std::exception& e) {
    return complain(std::string("internal error: ") + e.what(), kOurFault);
  }
}

/// Memory that ends in a destructor (the JSON library's asks for some) comes here, not to a handler of run_command.
[[noreturn]] void end_at_once() {
  try {
    if (const std::exception_ptr what = std::current_exception()) std::rethrow_exception(what);
  } catch (const std::bad_alloc&) {
    constexpr std::string_view kText = "flank: out of memory\n";
    static_cast<void>(!::write(STDERR_FILENO, kText.data(), kText.size()));
    ::_exit(kOurFault);
  } catch (...) {
  }
  std::abort();
}

}  // namespace

int run_command_line(const std::vector<std::string>& words, const AddCommands& add) {
  std::set_terminate(end_at_once);
  try {
    return run_words(words, add);
  } catch (...) {
    return kOurFault;
  }
}

void keep_standard_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(!::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

}  // namespace flank::cli
