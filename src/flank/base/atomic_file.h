/// Writing files so that a reader never sees half of one: a temporary name in the same folder, then a rename. What is said
/// to be written is on the disk.
#pragma once

#include <string>
#include <string_view>

namespace flank::internal {

/// Owns the temporary name of a file that is being written by somebody else (a library that wants a path). The
/// destructor removes what was not committed.
class AtomicFile {
 public:
  /// A link is followed: what it points to is written, and it stays. What writers of this file have left that were killed is removed. Throws
  /// InputError when the folder does not exist, or the file cannot be created there, or `file` is a folder, a device or a pipe, or is read by
  /// who asked for it (base/kept).
  explicit AtomicFile(const std::string& file);
  /// Without commit() the temporary file is removed, and the real one is as before.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write. The file exists already, empty.
  [[nodiscard]] const std::string& temporary() const { return temporary_; }

  /// Puts the temporary file in the place of the real one, on the disk. Throws InputError if that fails.
  void commit();

 private:
  /// The name that readers know; the temporary one lies in the same folder, so that a rename is enough.
  std::string file_;
  /// Unique, so that two writers of one file do not meet.
  std::string temporary_;
  int lock_ = -1;  ///< descriptor of the temporary file: as long as it is locked, somebody writes it
  bool committed_ = false;
};

/// Writes `content` (text or bytes) as the whole of `file`. Throws InputError naming the file; nothing half-written is
/// left, and what was there before stays until the new content is complete.
void write_file(const std::string& file, std::string_view content);

/// Makes a file of that name, which must be new, and writes it down to the disk. Throws InputError naming the file; what
/// was written so far stays.
void write_new_file(const std::string& file, std::string_view content);

/// Brings names that were made, changed or removed in a folder to the disk. Throws InputError.
void sync_folder(const std::string& folder);

/// rename(2); what the system interrupts, or refuses once, is tried again. Throws InputError naming `to`.
void rename_file(const std::string& from, const std::string& to);

}  // namespace flank::internal
