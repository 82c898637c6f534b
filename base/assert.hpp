#pragma once

namespace raks {

/// Prints where and what, then aborts. Never returns.
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line) noexcept;

}  // namespace raks

/// Checks a condition that only a mistake in this program can break. On in dev, sanitizer and test
/// builds; elsewhere it costs nothing and does not evaluate its argument. Not for input from
/// outside: that is an Error.
#ifdef RAKS_ASSERTS
#define RAKS_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::raks::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define RAKS_ASSERT(condition) static_cast<void>(sizeof(!(condition)))
#endif
