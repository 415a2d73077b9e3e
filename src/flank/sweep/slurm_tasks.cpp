#include "flank/sweep/slurm_tasks.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/error.h"
#include "flank/job/command_line.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Slurm's own limit for the tasks of an array, if nobody has changed it (MaxArraySize 1001).
constexpr std::size_t kArray = 1000;
constexpr std::chrono::milliseconds kLook{200};
/// The queue is asked less often than folders are looked at: the controller is everybody's.
constexpr std::chrono::milliseconds kAsk{1000};
/// A controller that does not answer is asked again for so long when something is submitted.
constexpr std::chrono::minutes kSubmitPatience{10};
/// Between the end of a job and the sight of its files, over a network.
constexpr std::chrono::seconds kArrival{5};
/// An element of an array takes tasks until it has worked for so long: the controller needs half a second from one to
/// the next.
constexpr int kElementSeconds = 30;
/// File of a round's lines; LIST.K is made by the element that takes line K.
constexpr const char* kList = "tasks";
constexpr int kKilled = 128 + 9;

struct Answer {
  int exit_code = -1;
  std::string text;  ///< both streams
};
Answer ask(const std::string& command) {
  Answer answer;
  FILE* stream = ::popen((command + " 2>&1 < /dev/null").c_str(), "r");
  if (stream == nullptr) throw InternalError("a shell cannot be started");
  std::array<char, 4096> part{};
  for (std::size_t count = 0; (count = std::fread(part.data(), 1, part.size(), stream)) > 0;)
    answer.text.append(part.data(), count);
  const int status = ::pclose(stream);
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// A word in quotes on one line: the script calls a line's end $nl.
std::string quoted(const std::string& word) {
  std::string text;
  for (const char c : shell_quoted(word)) text += c == '\n' ? std::string("'\"$nl\"'") : std::string(1, c);
  return text;
}

/// One attempt of some tasks, and where they leave their exit codes. There are as many elements of arrays as tasks, but
/// each takes whatever is left: those that find nothing any more are cancelled at the end.
class Round {
 public:
  Round(const fs::path& folder, std::vector<std::size_t> tasks)
      : folder_(folder), waiting_(std::move(tasks)), untaken_(waiting_.size()) {
    fs::create_directories(folder_);
  }
  [[nodiscard]] std::string result_of(std::size_t task) const {
    return (folder_ / (std::to_string(task) + ".exit")).string();
  }

  void submit(const std::string& program, const std::vector<ChildTask>& tasks, const ChildLimits& limits,
              const fs::path& jobs) {
    std::string lines;
    for (const std::size_t k : waiting_) lines += task_line(program, tasks[k], result_of(k), limits.timeout_s) + "\n";
    const std::string list = (folder_ / kList).string(), script = (folder_ / "script").string();
    write_file(list, lines);
    write_file(script, element_script(list, waiting_.size(), kElementSeconds));
    for (std::size_t first = 0; first < waiting_.size(); first += kArray) {
      const std::size_t count = std::min(kArray, waiting_.size() - first);
      const std::string limit = limits.processes > 0 ? fmt::format("%{}", limits.processes) : "";
      const std::string id = submitted(
          fmt::format("sbatch --parsable --job-name=flank --array=0-{}{} --ntasks=1 --cpus-per-task=1 --no-requeue "
                      "--output=/dev/null --error=/dev/null {} {}",
                      count - 1, limit, quoted(script), first));
      queued_.insert(id);
      std::ofstream(jobs, std::ios::app) << id << "\n";
    }
  }

  /// The tasks that have ended since the last call; empty outcome: it vanished.
  [[nodiscard]] std::vector<std::pair<std::size_t, ChildOutcome>> ended(double timeout_s) {
    std::vector<std::pair<std::size_t, ChildOutcome>> found;
    std::size_t taken = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
      taken += entry.path().stem() == kList ? 1 : 0;
      if (entry.path().extension() != ".exit") continue;
      const std::string name = entry.path().stem().string();
      std::size_t task = 0;
      if (std::from_chars(name.data(), name.data() + name.size(), task).ec != std::errc()) continue;
      if (seen_.insert(task).second) found.emplace_back(task, outcome_in(entry.path(), timeout_s));
    }
    cancel_idle(taken);
    std::erase_if(waiting_, [&](std::size_t task) { return seen_.contains(task); });
    if (!waiting_.empty() && has_left_the_queue()) {
      for (const std::size_t task : waiting_) found.emplace_back(task, ChildOutcome{kKilled, false});
      waiting_.clear();
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return found;
  }
  [[nodiscard]] bool over() const { return waiting_.empty(); }

  void cancel() const {
    for (const std::string& id : queued_) (void)ask("scancel --signal=TERM --full " + id + "; scancel " + id);
  }

 private:
  static std::string submitted(const std::string& command) {
    const Clock::time_point begun = Clock::now();
    for (;;) {
      const Answer answer = ask(command);
      const std::string id = answer.text.substr(0, answer.text.find_first_of(";\n"));
      if (answer.exit_code == 0 && !id.empty() && id.find_first_not_of("0123456789") == std::string::npos) return id;
      // 127: the shell has found no such program.
      if (answer.exit_code == 127) throw InternalError("sbatch not found: this engine needs Slurm");
      if (!is_silence(answer) || Clock::now() - begun > kSubmitPatience)
        throw InternalError("sbatch: " + one_line(answer.text));
      std::this_thread::sleep_for(kAsk);
    }
  }

  /// Does the controller not answer? What it refuses has another text.
  static bool is_silence(const Answer& answer) {
    for (const char* text : {"Unable to contact", "Connection refused", "timed out", "Socket timed out",
                             "not responding", "Zero Bytes", "Transport endpoint"})
      if (answer.text.find(text) != std::string::npos) return true;
    return false;
  }

  /// Elements that wait when each line has been taken (one entry for each, one for the list) would find nothing.
  void cancel_idle(std::size_t taken) {
    if (untaken_ == 0 || taken <= untaken_) return;
    untaken_ = 0;
    for (const std::string& id : queued_) (void)ask("scancel --state=PENDING " + id);
  }

  static ChildOutcome outcome_in(const fs::path& file, double timeout_s) {
    std::ifstream stream(file);
    ChildOutcome outcome;
    double seconds = 0.0;
    if (!(stream >> outcome.exit_code >> seconds)) return {kKilled, false};
    outcome.timed_out = timeout_s > 0.0 && outcome.exit_code == kKilled && seconds >= std::floor(timeout_s);
    return outcome;
  }

  /// Whether no array of this round is queued or running any more, for long enough that its files have arrived.
  bool has_left_the_queue() {
    const Clock::time_point now = Clock::now();
    if (now - asked_ < kAsk) return false;
    asked_ = now;
    const Answer answer = ask("squeue --noheader --me --format=%F");
    if (answer.exit_code != 0) return false;
    std::istringstream words(answer.text);
    const std::set<std::string> known{std::istream_iterator<std::string>(words), {}};
    const bool gone = std::none_of(queued_.begin(), queued_.end(), [&](const auto& id) { return known.contains(id); });
    if (!gone) {
      gone_since_.reset();
      return false;
    }
    if (!gone_since_) gone_since_ = now;
    return now - *gone_since_ >= kArrival;
  }

  fs::path folder_;
  std::vector<std::size_t> waiting_;
  std::size_t untaken_;  ///< lines, until all of them have been taken
  std::set<std::size_t> seen_;
  std::set<std::string> queued_;
  Clock::time_point asked_{};
  std::optional<Clock::time_point> gone_since_;
};

/// What an earlier run has left in the queue would write into the same folders.
void cancel_earlier(const fs::path& jobs) {
  std::ifstream stream(jobs);
  std::string all;
  for (std::string id; stream >> id;)
    if (id.find_first_not_of("0123456789") == std::string::npos) all += " " + id;
  if (all.empty()) return;
  (void)ask("scancel" + all);
  std::istringstream words(all);
  const std::set<std::string> ours{std::istream_iterator<std::string>(words), {}};
  for (const Clock::time_point begun = Clock::now(); Clock::now() - begun < kSubmitPatience;) {
    const Answer answer = ask("squeue --noheader --me --format=%F");
    std::istringstream lines(answer.text);
    const std::set<std::string> known{std::istream_iterator<std::string>(lines), {}};
    if (answer.exit_code == 0 &&
        std::none_of(ours.begin(), ours.end(), [&](const auto& id) { return known.contains(id); }))
      return;
    std::this_thread::sleep_for(kAsk);
  }
  throw InternalError("the jobs of an earlier run are still in the queue:" + all);
}

fs::path retired(const fs::path& root) { return root.string() + "-ended"; }

/// All at once: an element that looks for a line still must find either that each is taken, or nothing at all. It would do a task once more
/// whose mark is gone before the list is.
void remove_scratch(const fs::path& root) {
  std::error_code none;
  fs::remove_all(retired(root));
  fs::rename(root, retired(root), none);
  fs::remove_all(retired(root));
}

}  // namespace

std::string element_script(const std::string& list, std::size_t count, int seconds) {
  return fmt::format(R"sh(#!/bin/sh
nl='
'
list={0}
cancelled=
trap 'cancelled=1' TERM
end=$(($(date +%s) + {2}))
step=0
while [ $step -lt {1} ]; do
  k=$(((SLURM_ARRAY_TASK_ID + $1 + step) % {1}))
  step=$((step + 1))
  [ -e "$list.$k" ] && continue
  mkdir "$list.$k" 2> /dev/null || continue
  eval "$(sed -n "$((k + 1)){{p;q;}}" "$list")"
  [ -z "$cancelled" ] || exit 143
  [ "$(date +%s)" -lt $end ] || exit 0
done
)sh",
                     quoted(list), count, seconds);
}

std::string task_line(const std::string& program, const ChildTask& task, const std::string& result, double timeout_s) {
  std::string command = quoted(program);
  for (const std::string& word : task.words) command += " " + quoted(word);
  const std::string limit = timeout_s > 0.0 ? fmt::format("timeout -s KILL {} ", timeout_s) : "";
  const std::string file = quoted(result), part = quoted(result + ".part");
  return fmt::format(
      "begun=$(date +%s.%N); cd {} && {}{} < /dev/null > /dev/null 2> {}; code=$?; [ -n \"$cancelled\" ] || {{ echo "
      "\"$code $(echo \"$(date +%s.%N) $begun\" | awk '{{print $1 - $2}}')\" > {} && mv {} {}; }}",
      quoted(task.folder), limit, command, quoted(task.errors), part, part, file);
}

std::vector<ChildOutcome> slurm_tasks(const std::string& program, const std::vector<ChildTask>& tasks,
                                      const ChildLimits& limits, const std::string& scratch,
                                      const std::function<void(std::size_t, const ChildOutcome&)>& done,
                                      const std::function<bool()>& cancelled) {
  const fs::path root = fs::absolute(scratch), jobs = root / "jobs";
  require_unread_below(root.string());
  require_unread_below(retired(root).string());
  cancel_earlier(jobs);
  remove_scratch(root);
  std::vector<ChildOutcome> outcomes(tasks.size());
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < tasks.size(); ++k) open.push_back(k);
  bool stopped = false;
  for (int attempt = 0; !open.empty() && !stopped; ++attempt) {
    Round round(root / std::to_string(attempt), open);
    round.submit(program, tasks, limits, jobs);
    open.clear();
    while (!round.over() && !stopped) {
      for (const auto& [task, outcome] : round.ended(limits.timeout_s)) {
        if (outcome.failed() && attempt < limits.retries) {
          open.push_back(task);
        } else {
          outcomes[task] = outcome;
          if (done) done(task, outcome);
        }
      }
      stopped = cancelled && cancelled();
      if (stopped)
        round.cancel();
      else if (!round.over())
        std::this_thread::sleep_for(kLook);
    }
    std::sort(open.begin(), open.end());
  }
  remove_scratch(root);
  return outcomes;
}

}  // namespace flank::internal
