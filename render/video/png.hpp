#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "base/expected.hpp"

namespace raks::render {

/// Writes one picture as PNG, appearing under its name only when complete. `rgba`: width x height
/// x 4 bytes, top row first. Fast rather than small: level 1, no filter (18 CPU-ms at 1280x720).
/// The same picture gives the same bytes. Errors: a size < 1 or one that does not fit the bytes,
/// a folder that does not exist, a full disk.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<void> write_png(const std::filesystem::path& path,
                                       int width,
                                       int height,
                                       std::span<const std::uint8_t> rgba);

/// The same picture as bytes, packed small (level 9) rather than fast. Errors: a size < 1 or one
/// that does not fit the bytes.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> encode_png(int width,
                                               int height,
                                               std::span<const std::uint8_t> rgba);

}  // namespace raks::render
