#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "audio/io/audio_file.hpp"
#include "audio/io/decoder_process.hpp"

namespace raks::audio {

/// What a decoder in another process is given.
struct DecodedSource {
    std::string name;     ///< for messages
    int descriptor = -1;  ///< open; stays the caller's, who may close it after open()
    bool is_pipe = false;
    Nanos longest_wait{};  ///< for the head of a pipe
    /// Asked every 50 ms while something is waited for; true ends that and all that follows.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// A file or pipe that raks-decode decodes. Nothing that it does, or does not, harms this process:
/// when it dies, hangs (2 s without a sign of life, 30 s without an answer; a pipe may wait for its
/// writer) or answers nonsense, it is ended, warning() says it in one line, and the sound ends.
/// Threads: one at a time. Real-time: no.
class DecoderClient final : public AudioFileReader {
 public:
    /// Errors: those of the decoders; it cannot be started; it broke off or hung.
    [[nodiscard]] static Expected<std::unique_ptr<DecoderClient>> open(DecodedSource source);
    /// The same with a process that has no file yet.
    [[nodiscard]] static Expected<std::unique_ptr<DecoderClient>> open(
        DecodedSource source, std::unique_ptr<DecoderProcess> process);

    [[nodiscard]] std::size_t read(std::span<float> interleaved) override;
    [[nodiscard]] Expected<void> seek(std::int64_t frame) override;

 private:
    DecoderClient(DecodedSource source, std::unique_ptr<DecoderProcess> process)
        : source_(std::move(source)), process_(std::move(process)) {}
    [[nodiscard]] Expected<void> start();
    [[nodiscard]] Talk receive();
    [[nodiscard]] Talk receive_sought();
    [[nodiscard]] bool is_new() const noexcept { return message_.generation == generation_; }
    [[nodiscard]] bool take_head();
    [[nodiscard]] bool take_samples();
    [[nodiscard]] bool next_slot();
    void give_slot_back();
    std::string end(Talk why);
    void break_off(Talk why);

    DecodedSource source_;
    std::unique_ptr<DecoderProcess> process_;  // null once it is ended
    DecodeMessage message_;                    // the newest
    std::uint64_t generation_ = 0;
    std::int64_t position_ = 0;  // frames
    bool has_slot_ = false;
    std::uint32_t slot_ = 0;
    std::size_t slot_at_ = 0;  // samples
    std::size_t slot_end_ = 0;
    bool is_at_end_ = false;
};

}  // namespace raks::audio
