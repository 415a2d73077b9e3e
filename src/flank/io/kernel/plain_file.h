/// Files for readers that take a name only, and stumble over a byte order mark.
#pragma once

#include <string>

namespace flank::internal {

/// The file itself, or, where it begins with a byte order mark, a copy without it that lives in memory as long as this.
class PlainFile {
 public:
  /// Throws InputError as read_bytes does.
  explicit PlainFile(std::string file);
  ~PlainFile();
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  int copy_ = -1;  ///< descriptor of the copy
};

}  // namespace flank::internal
