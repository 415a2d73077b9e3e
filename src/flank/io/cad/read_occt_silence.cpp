#include "flank/io/cad/read_occt_silence.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <iostream>

namespace flank::internal {
namespace {

std::recursive_mutex& occt_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

OcctSilence::OcctSilence() : lock_(occt_mutex()), out_(std::cout.rdbuf(&nothing_)), error_(std::cerr.rdbuf(&nothing_)) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
}

OcctSilence::~OcctSilence() {
  std::cout.rdbuf(out_);
  std::cerr.rdbuf(error_);
}

}  // namespace flank::internal
