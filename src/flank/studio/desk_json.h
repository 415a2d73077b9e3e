/// What a studio answers, without the network: its parts, its files, what its children say. May be asked by several threads.
#pragma once

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flank/studio/child.h"
#include "flank/studio/jobs_json.h"

namespace flank::internal {

/// How the names of files begin that are still being received.
inline constexpr const char* kHalf = ".half-";

/// A text or bytes, and what they are.
struct Answer {
  std::string body;
  std::string type = "application/json";
  std::string name;  ///< of a download; empty: it is shown
};

class Desk {
 public:
  /// Makes the folder. Throws InputError if it cannot be used, or another studio has it.
  Desk(const std::string& folder, std::string program);
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  /// Ends what is asked now: who waits for it is told that it was ended.
  void end() { ended_ = true; }
  [[nodiscard]] Jobs& jobs() { return jobs_; }
  [[nodiscard]] const StudioFolder& folder() const { return folder_; }

  /// A file that is not there yet, "blade-2.step" where "blade.step" is. `name` may be anything.
  [[nodiscard]] std::string new_file(const std::string& name) const;
  /// Reads a part that lies in files(), and keeps its faces beside it; throws InputError with the command's own words.
  void look_at(const std::string& part, const std::string& unit);
  /// Its faces.json.
  [[nodiscard]] Answer faces(const std::string& part) const;
  /// What its faces are, if it is a wheel (docs/schema/wheel.md). Throws InputError with the command's own words.
  [[nodiscard]] Answer wheel(const std::string& part) const;
  /// {"folder", "parts", "files", "jobs"}.
  [[nodiscard]] Answer state();
  [[nodiscard]] Answer fields(const std::string& command) const;
  [[nodiscard]] Answer machines() const;
  /// What a fit would take: {"exit", "said", "defaults"}.
  [[nodiscard]] Answer defaults(const nlohmann::json& asked) const;
  /// report.html of a job, made anew; of an operation of a wheel, "20-side", or of the whole if empty.
  [[nodiscard]] Answer report(const std::string& job, const std::string& operation);
  /// The program of a job for a machine: {"exit", "said", "program"}; then judged: {"exit", "said"}.
  [[nodiscard]] Answer post(const std::string& job, const nlohmann::json& asked);
  [[nodiscard]] Answer judge(const std::string& job, const nlohmann::json& asked);
  /// The set-up sheet of a program: {"exit", "said", "sheet"}; it lies beside the program.
  [[nodiscard]] Answer sheet(const std::string& job, const nlohmann::json& asked);
  /// A file of a result or a program, and all of them.
  [[nodiscard]] Answer file(const std::string& job, const std::string& name);
  [[nodiscard]] Answer program(const std::string& job, const std::string& name);
  [[nodiscard]] Answer zip(const std::string& job);

 private:
  [[nodiscard]] Said ask(const std::vector<std::string>& words) const;

  StudioFolder folder_;
  std::string program_;
  int lock_ = -1;
  std::atomic<bool> ended_{false};
  Jobs jobs_;
};

}  // namespace flank::internal
