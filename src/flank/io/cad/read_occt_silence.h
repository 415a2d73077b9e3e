/// Keeps Open CASCADE from printing. Private to io.
#pragma once

#include <mutex>
#include <streambuf>

namespace flank::internal {

/// Open CASCADE reports through a messenger and, here and there, straight to std::cout and std::cerr. While this lives
/// it does neither. One at a time: its settings are global, so that a second thread waits here.
class OcctSilence {
 public:
  OcctSilence();
  ~OcctSilence();
  OcctSilence(const OcctSilence&) = delete;
  OcctSilence& operator=(const OcctSilence&) = delete;

 private:
  struct Nothing : std::streambuf {
    int overflow(int c) override { return traits_type::not_eof(c); }
  };
  std::unique_lock<std::recursive_mutex> lock_;
  Nothing nothing_;
  std::streambuf *out_, *error_;
};

}  // namespace flank::internal
