#pragma once

#include <cstdint>
#include <string_view>

namespace raks {

/// Hash of some bytes (FNV-1a, 64 bits): the same on every machine; not safe against deliberate
/// collisions. `start`: hash of the bytes before, to continue from. Real-time: yes.
[[nodiscard]] constexpr std::uint64_t hash_of(
    std::string_view bytes, std::uint64_t start = 14'695'981'039'346'656'037ULL) noexcept {
    std::uint64_t hash = start;
    for (const char byte : bytes) {
        hash = (hash ^ static_cast<unsigned char>(byte)) * 1'099'511'628'211ULL;
    }
    return hash;
}
static_assert(hash_of("a") == 0xaf63dc4c8601ec8cULL);

}  // namespace raks
