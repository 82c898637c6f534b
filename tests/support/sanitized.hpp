#pragma once

namespace raks::test {

/// Whether this build looks for faults with a sanitizer. A test of a minute takes ten then: where
/// the other cases go the same ways through the code, one of them is enough.
#if defined(RAKS_SANITIZED)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace raks::test
