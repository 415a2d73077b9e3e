/// Keeps Open CASCADE from printing. Private to io.
#pragma once

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <iostream>
#include <mutex>
#include <streambuf>

namespace flank::internal {

/// Open CASCADE reports through a messenger and, here and there, straight to std::cout and std::cerr. While this lives
/// it does neither. One at a time: its settings are global, so that a second thread waits here.
class OcctSilence {
 public:
  OcctSilence() : lock_(mutex()), out_(std::cout.rdbuf(&nothing_)), error_(std::cerr.rdbuf(&nothing_)) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~OcctSilence() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
  }
  OcctSilence(const OcctSilence&) = delete;
  OcctSilence& operator=(const OcctSilence&) = delete;

 private:
  struct Nothing : std::streambuf {
    int overflow(int c) override { return traits_type::not_eof(c); }
  };
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex only;
    return only;
  }
  std::unique_lock<std::recursive_mutex> lock_;
  Nothing nothing_;
  std::streambuf *out_, *error_;
};

}  // namespace flank::internal
