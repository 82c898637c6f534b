#pragma once

#include <string>
#include <string_view>

namespace raks {

/// SHA-256 of some bytes (FIPS 180-4) as 64 hexadecimal digits, as `sha256sum` prints it: whoever
/// wants to cannot make other bytes of the same hash. About 200 MB a second. Threads: any.
/// Real-time: no.
[[nodiscard]] std::string sha256_of(std::string_view bytes);

}  // namespace raks
