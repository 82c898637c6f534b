#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace raks::engine {

/// A link as a square of light and dark modules that a phone's camera reads (QR code, ISO/IEC
/// 18004).
struct LinkCode {
    std::size_t side = 0;               ///< modules a row and a column; 0: none
    std::vector<std::uint8_t> modules;  ///< row by row from the top; 1: dark
};

/// Of a link; none where it is too long, or the program was built without its library. Threads:
/// any. Real-time: no.
[[nodiscard]] LinkCode link_code(const std::string& link);

}  // namespace raks::engine
