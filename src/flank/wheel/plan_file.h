/// plan.json: the operations of a wheel as a file, and those that an earlier run has finished.
#pragma once

#include <map>
#include <string>

#include "flank/wheel/wheel_job.h"

namespace flank::internal {

/// The operations of a plan.json that are done, by id; none where there is no such file, or one of another kind.
[[nodiscard]] std::map<std::string, WheelOperation> finished_operations(const std::string& file);

/// plan.json during a run: what an earlier run has finished stays in it until this one comes to it, so that a run that is stopped again and
/// again loses nothing.
class PlanKeeper {
 public:
  /// `result` gets what the file tells of an earlier run. It must outlive this.
  PlanKeeper(std::string file, WheelResult& result);
  /// An operation is done anew: what an earlier run has left in its folder is finished no more.
  void begin(const std::string& id);
  void add(WheelOperation operation);
  /// All is done: what an earlier run had besides is of another request.
  void end();

 private:
  void drop(const std::string& id);
  void write() const;
  std::string file_;
  WheelResult& result_;
};

/// plan.json (docs/schema/wheel.md), and a table for people.
[[nodiscard]] std::string plan_json(const WheelResult& result);
[[nodiscard]] std::string wheel_text(const WheelResult& result);

}  // namespace flank::internal
