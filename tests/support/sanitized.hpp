// Whether this program is a sanitizer build, and why such a build leaves a test out.
#pragma once

#include <string>

namespace macula::test {

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// The reason to give to GTEST_SKIP() for a test that takes minutes there and whose code other tests
// run too.
inline std::string too_long_sanitized(const std::string& what) {
    return what + " takes minutes in a sanitizer build (AddressSanitizer)";
}

} // namespace macula::test
