#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "audio/io/audio_file.hpp"

namespace raks::audio {

/// An open pipe, and how long it is waited for.
struct OpenPipe {
    std::string name;      ///< for messages
    int descriptor = -1;   ///< stays the caller's
    Nanos longest_wait{};  ///< for each piece of the head
    /// Asked while a read waits; true ends it and all that follow.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// What PipeReader reads, decoded in this process by FFmpeg: for the program raks-decode.
/// Threads: one. Real-time: no.
class PipedSound final : public AudioFileReader {
 public:
    /// Errors: as PipeReader::open, but for a pipe that cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<AudioFileReader>> open(OpenPipe pipe);
    ~PipedSound() override;                             ///< does not close the pipe
    PipedSound(const PipedSound&) = delete;             ///< a pipe has one reader
    PipedSound& operator=(const PipedSound&) = delete;  ///< likewise

    /// As AudioFileReader::read; waits for the writer.
    [[nodiscard]] std::size_t read(std::span<float> interleaved) override;
    /// Errors: always, unless `frame` is where the reader is.
    [[nodiscard]] Expected<void> seek(std::int64_t frame) override;

 private:
    struct Decoder;
    explicit PipedSound(std::unique_ptr<Decoder> decoder);

    std::unique_ptr<Decoder> decoder_;
    std::vector<float> decoded_;  // interleaved; from decoded_at_ on not yet read
    std::size_t decoded_at_ = 0;
    std::int64_t position_ = 0;
};

}  // namespace raks::audio
