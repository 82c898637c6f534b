#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace raks::render {

/// The bytes of a file as characters, which they must outlive. Threads: any. Real-time: yes.
[[nodiscard]] inline std::string_view characters_of(std::span<const std::byte> bytes) noexcept {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace raks::render
