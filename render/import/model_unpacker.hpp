// Pictures and meshes that a model holds packed, which the program raks-unpack unpacks in a cage.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "base/expected.hpp"
#include "base/talk_answer.hpp"
#include "base/talking_child.hpp"
#include "render/import/unpack_protocol.hpp"

namespace raks::render {

/// How long unpacking all that one model holds may take.
inline constexpr std::chrono::seconds kLongestUnpacking(60);

/// What is said where a kernel refuses the cage.
inline constexpr const char* kUncagedWarning =
    "it is read without protection against damaged files: this kernel refuses seccomp";

/// Unpacks what one model holds. The libraries that do it (libpng, libjpeg, libwebp, meshoptimizer)
/// run in a process of its own that opens no file and which damaged or malicious bytes can at worst
/// end; it starts with the first thing that is unpacked, anew after one that ended it, and goes
/// with this. Threads: one. Real-time: no.
class ModelUnpacker {
 public:
    explicit ModelUnpacker(std::chrono::milliseconds longest = kLongestUnpacking)
        : longest_(longest) {}

    /// Unpacks into `out`, which has `what.rows` times `what.row_bytes` bytes; `what.packed_bytes`
    /// is filled in. Errors, after which `out` is of no use: what the library says; the process
    /// broke off, hung or answered nonsense; it is not there.
    [[nodiscard]] Expected<void> unpack(UnpackRequest what,
                                        std::span<const std::byte> packed,
                                        std::span<std::byte> out);
    /// Whether something was unpacked without a cage: see kUncagedWarning.
    [[nodiscard]] bool is_uncaged() const noexcept { return is_uncaged_; }

 private:
    std::chrono::milliseconds longest_;
    std::optional<TalkDeadline> deadline_;
    std::optional<TalkingChild> child_;
    bool is_uncaged_ = false;
};

/// Our side of one request, as receive_answer has it. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk unpack_over(int socket,
                               const UnpackRequest& what,
                               std::span<const std::byte> packed,
                               std::span<std::byte> out,
                               TalkDeadline deadline,
                               TalkAnswer& answer);

}  // namespace raks::render
