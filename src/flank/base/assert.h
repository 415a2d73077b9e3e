/// Assertions: what the code takes for granted, checked in debug and sanitizer builds.
///
/// For bugs alone: the sizes, ranges and finite numbers that every caller must see to. What a user can cause is an error
/// of error.h, and a numerical or geometric "no" is a status in a result.
#pragma once

/// 1 if assertions are checked in this build.
#if !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FLANK_ASSERTIONS 1
#else
#define FLANK_ASSERTIONS 0
#endif

/// FLANK_ASSERT(condition): if the condition is false, prints it with file, line and function to the standard error
/// output, and aborts. A release build does not evaluate the condition, but it must compile there, too.
#if FLANK_ASSERTIONS
#define FLANK_ASSERT(...)                  \
  (static_cast<bool>(__VA_ARGS__) ? void() \
                                  : ::flank::internal::assertion_failed(#__VA_ARGS__, __FILE__, __LINE__, __func__))
#else
#define FLANK_ASSERT(...) static_cast<void>(sizeof(static_cast<bool>(__VA_ARGS__)))
#endif

namespace flank::internal {

/// What a failed FLANK_ASSERT calls.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line, const char* function);

}  // namespace flank::internal
