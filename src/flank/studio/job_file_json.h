/// A job of the studio as a file: studio.json in its folder. All that must survive a restart is in it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "flank/studio/child.h"

namespace flank::internal {

enum class JobState { kWaiting, kRunning, kDone };

struct StudioJob {
  std::string id;                  ///< "0001", the name of its folder
  std::string command;             ///< "fit", "cover", "trochoid"
  std::string part;                ///< name of the file
  nlohmann::json fields;           ///< as the page asked for them
  std::vector<std::string> words;  ///< of the command line, without the program
  std::string line;                ///< as somebody would type it beside the part
  JobState state = JobState::kWaiting;
  bool resume = false;    ///< go on where it was stopped
  bool stopping = false;  ///< it was told to stop, and keeps its best
  Child child;
  std::optional<int> exit_code;
  double seconds = 0.0;  ///< of the runs that have ended
  double begun = 0.0;    ///< of the present run, seconds since 1970
};

[[nodiscard]] const char* name_of(JobState state);
[[nodiscard]] nlohmann::json to_json(const StudioJob& job);
/// Throws InputError for what is no such file; what is in it is checked like what a stranger wrote.
[[nodiscard]] StudioJob job_from(const nlohmann::json& json, const std::string& file);

/// Lines of progress that begin at byte `from` of a file, at most `most` bytes of it, and where the next ones begin; only whole lines
/// that are objects of JSON. The last line that is none is the message.
struct ProgressLines {
  nlohmann::json lines = nlohmann::json::array();
  std::size_t next = 0;
  std::string message;
};
[[nodiscard]] ProgressLines read_progress(const std::string& file, std::size_t from, std::size_t most);

}  // namespace flank::internal
