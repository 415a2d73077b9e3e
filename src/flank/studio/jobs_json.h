/// The jobs of a studio: a folder each, run one after the other by children of ours.
#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "flank/studio/job_file_json.h"

namespace flank::internal {

/// Where things lie below the folder of a studio.
struct StudioFolder {
  std::string path;  ///< absolute
  [[nodiscard]] std::string files() const { return path + "/parts"; }
  [[nodiscard]] std::string jobs() const { return path + "/jobs"; }
};

/// May be asked by several threads. Every change is on the disk before it is told: a studio that is killed loses nothing. Its children go
/// on then; the next studio finds them.
class Jobs {
 public:
  /// `program`: the command. Reads the jobs that are there; what was waiting goes on waiting.
  Jobs(StudioFolder folder, std::string program);
  /// Tells what runs to stop, and waits for it: the best so far is kept.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Puts a job at the end of the queue; its id. Throws UsageError and InputError.
  [[nodiscard]] std::string add(const std::string& command, const std::string& part, const nlohmann::json& fields);
  /// All of them, the newest first, without their progress.
  [[nodiscard]] nlohmann::json list();
  /// One of them with its lines of progress from byte `from` on. Throws InputError if there is none of that name.
  [[nodiscard]] nlohmann::json one(const std::string& id, std::size_t from);
  /// Ends a job that runs or waits.
  void stop(const std::string& id);
  /// Puts a job that was stopped at the end of the queue again.
  void resume(const std::string& id);
  /// The folder of its result. Throws InputError if there is no such job.
  [[nodiscard]] std::string result(const std::string& id);
  /// The folder of its programs.
  [[nodiscard]] std::string programs(const std::string& id);

 private:
  void read_all();
  void work();
  void look_after(StudioJob& job);
  void begin(StudioJob& job);
  void finish(StudioJob& job, int exit_code);
  void keep(const StudioJob& job) const;
  [[nodiscard]] StudioJob& find(const std::string& id);
  [[nodiscard]] nlohmann::json told(const StudioJob& job) const;
  [[nodiscard]] std::string folder_of(const std::string& id) const { return folder_.jobs() + "/" + id; }

  StudioFolder folder_;
  std::string program_;
  std::mutex mutex_;
  std::deque<StudioJob> jobs_;  ///< in the order of their ids
  std::atomic<bool> ending_{false};
  std::thread worker_;
};

}  // namespace flank::internal
