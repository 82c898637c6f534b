#pragma once

#include <cstddef>
#include <span>

#include "base/expected.hpp"
#include "render/import/unpack_protocol.hpp"

namespace raks::engine {

/// Unpacks into `out`, which has `what.rows` times `what.row_bytes` bytes. Errors: what the library
/// says of broken bytes; numbers that it cannot be called with. Threads: any. Real-time: no.
[[nodiscard]] Expected<void> unpack(const render::UnpackRequest& what,
                                    std::span<const std::byte> packed,
                                    std::span<std::byte> out);

}  // namespace raks::engine
