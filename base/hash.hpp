#pragma once

#include <cstdint>
#include <cstring>
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

/// Hash of many bytes, eight at a time, several times as fast: for what this machine keeps for
/// itself, as it depends on the byte order. `start`: as above. Real-time: yes.
[[nodiscard]] inline std::uint64_t fast_hash_of(
    std::string_view bytes, std::uint64_t start = 14'695'981'039'346'656'037ULL) noexcept {
    constexpr std::uint64_t kMultiplier = 0x9e37'79b9'7f4a'7c15ULL;  // 2^64 / golden ratio, odd
    std::uint64_t hash = start ^ bytes.size();                       // zeros at the end count
    while (!bytes.empty()) {
        std::uint64_t word = 0;
        const std::size_t size = bytes.size() < sizeof word ? bytes.size() : sizeof word;
        std::memcpy(&word, bytes.data(), size);
        bytes.remove_prefix(size);
        // The product moves low bits up only; the shift brings high bits down again.
        hash = (hash ^ word) * kMultiplier;
        hash ^= hash >> 32U;
    }
    return hash;
}

}  // namespace raks
