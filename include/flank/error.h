/// Typed errors. A bug is an assertion (assert.h); a numerical "no" is a status in a result; these are for bad input at
/// the boundary.
#pragma once

#include <stdexcept>
#include <string>

namespace flank {

/// Base of every error that the library throws on purpose.
///
/// A message may be about one field of a request (job.h): then it begins with the field's name, as in
/// "tolerance_mm: a length > 0 mm is needed". Further fields that it mentions stand in backquotes. A program with another
/// name for a field, as the command line has, can put that in its place.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& what) : std::runtime_error(what) {}
  Error(const std::string& field, const std::string& text) : std::runtime_error(field + ": " + text), field_(field) {}
  Error(const std::string& field, const std::string& value, const std::string& text)
      : std::runtime_error(field + " " + value + ": " + text), field_(field) {}

  /// Name of the field that the message is about and begins with; empty if it is about none.
  [[nodiscard]] const std::string& field() const { return field_; }

 private:
  std::string field_;
};

/// A request is wrong. The message names the field and says what would be accepted.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// A file or a part is refused. The message names the file, line or face and says what would be accepted.
class InputError : public Error {
 public:
  using Error::Error;
};

/// Our own fault.
class InternalError : public Error {
 public:
  using Error::Error;
};

}  // namespace flank
