/// Typed errors. A bug is an assertion (assert.h); a numerical "no" is a status in a result; these are for bad input at
/// the boundary.
#pragma once

#include <stdexcept>
#include <string>

namespace flank {

/// Base of every error that the command line turns into an exit code.
class Error : public std::runtime_error {
 public:
  Error(int exit_code, const std::string& what) : std::runtime_error(what), exit_code_(exit_code) {}
  /// 2, 3 or 4: see the classes below.
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// The command or an option is wrong (exit 2). The message names the option and says what would be accepted.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& what) : Error(2, what) {}
};

/// A file or a part is refused (exit 3). The message names the file, line or face and says what would be accepted.
class InputError : public Error {
 public:
  explicit InputError(const std::string& what) : Error(3, what) {}
};

/// Our own fault (exit 4).
class InternalError : public Error {
 public:
  explicit InternalError(const std::string& what) : Error(4, what) {}
};

}  // namespace flank
