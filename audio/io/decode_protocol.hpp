#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "audio/io/audio_file.hpp"
#include "base/talking_child.hpp"

/// What raks and the program raks-decode say to one another: messages over a socket that keeps
/// their bounds, samples in memory that both see. Both programs are of the same build.
/// Threads: any. Real-time: no.
namespace raks::audio {

/// Descriptors of a decoder; the fork server (decoder_fork_server.hpp) has the first alone.
inline constexpr int kDecodeSocket = kTalkSocket;
inline constexpr int kDecodeMemory = kDecodeSocket + 1;
inline constexpr int kDecodePictures = kDecodeMemory;  ///< in its place: where pictures are written
inline constexpr int kDecodeLifeline = kDecodeSocket + 2;  ///< a pipe that closes when raks ends

/// Names of the processes, as lists of them show.
inline constexpr const char* kForkServerName = "raks-decoders";
inline constexpr const char* kDecoderName = "raks-decode";

/// Of every message; other builds have another one.
inline constexpr std::uint32_t kDecodeMagic = 0x52440004;
inline constexpr std::size_t kDecodeTextBytes = 8192;  ///< of the text in a message

/// raks asks for the first six, raks-decode answers with the others.
enum class DecodeKind : std::uint32_t {
    start,      ///< to the fork server: a decoder, with its socket, memory and lifeline
    open_file,  ///< text: its name; with the descriptor
    open_pipe,  ///< the same; value: nanoseconds to wait for the head
    take_back,  ///< a slot that was read
    seek,       ///< value: frame; from here on messages carry its generation, all slots are free
    open_film,  ///< text: its name; with the descriptor
    started,    ///< value: the decoder's process, or minus the error's number
    opened,     ///< head is filled in, of a film picture, too; text: format, tags, then warning
    failed,     ///< text: why it cannot be opened or sought
    samples,    ///< value: frames in the slot, 0 at the end; text: the warning so far
    sought,     ///< text: the warning so far
    picture,    ///< picture is filled in, its pixels are written to kDecodePictures
    film_end,   ///< text: the warning
};

/// A picture of a film, or all of them.
struct DecodedPicture {
    double seconds = 0.0;              ///< its time; of a film: its date since 1970, 0: unknown
    double pictures_per_second = 0.0;  ///< of a film, 0: unknown
    std::int32_t width = 0;            ///< pixels, as it is to be seen
    std::int32_t height = 0;           ///< likewise
    std::int32_t turned = 0;           ///< of a film: degrees clockwise that this took
};

/// AudioFileInfo without its text.
struct DecodedHead {
    std::int32_t rate = 0;
    std::int32_t channels = 0;
    double claimed_seconds = -1.0;     ///< < 0: none
    std::int64_t claimed_frames = -1;  ///< < 0: none
    std::uint32_t is_from_side = 0;    ///< 0 or 1; these three: Hearing
    float offset = 0.0F;
    float gain = 1.0F;
    std::uint32_t format_bytes = 0;  ///< of the text
    std::uint32_t tag_bytes = 0;     ///< of the text behind these: text_of_tags()
    std::uint32_t is_confined = 0;   ///< 1: by seccomp
};

/// Sent up to the end of its text.
struct DecodeMessage {
    std::uint32_t magic = kDecodeMagic;
    DecodeKind kind{};
    std::uint64_t generation = 0;
    std::int64_t value = 0;
    std::uint32_t slot = 0;
    std::uint32_t text_bytes = 0;
    DecodedHead head{};
    DecodedPicture picture{};
    std::array<char, kDecodeTextBytes> text;

    /// Cuts off what has no room.
    void set_text(std::string_view words) noexcept;
    /// The text, never longer than it can be.
    [[nodiscard]] std::string_view words() const noexcept;
};

inline constexpr std::size_t kMostDescriptors = 3;  ///< beside a message

/// Sends, with at most three descriptors. Waits for room.
[[nodiscard]] Talk send_message(int socket,
                                const DecodeMessage& message,
                                std::span<const int> descriptors = {});
/// Receives; waits. The descriptors that came along are put into `descriptors`, -1 for what did
/// not come; those for which there is no place are closed.
[[nodiscard]] Talk receive_message(int socket,
                                   DecodeMessage& message,
                                   std::span<int> descriptors = {});
/// The same without descriptors, but waits no longer than `patience` has it.
[[nodiscard]] Talk await_message(int socket, DecodeMessage& message, const Patience& patience);

inline constexpr std::size_t kDecodeSlots = 8;
inline constexpr std::size_t kDecodeSlotSamples = 16'384;

/// The memory that both see. raks trusts nothing in it.
struct DecodeMemory {
    /// Grows while raks-decode reads or waits for a pipe's writer.
    alignas(64) std::atomic<std::uint64_t> beat;
    alignas(64) std::array<std::array<float, kDecodeSlotSamples>, kDecodeSlots> slots;
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace raks::audio
