#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "audio/io/audio_file.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// How long a pipe is waited for.
struct PipeOptions {
    /// For each piece of the head: a pipe that nobody writes to must not keep the program waiting.
    Nanos longest_wait = std::chrono::seconds(5);
    /// Asked while a read waits, by the thread that reads; true ends it and all that follow.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// Sound from a pipe: standard input ("-") or a FIFO that another program writes WAV, FLAC, Ogg
/// (Vorbis, Opus, FLAC) or MP3 to. It is read once, from its beginning: it cannot be sought and
/// claims no length. Once the head is there a read waits as long as the writer does; it ends when
/// the writer closes the pipe or when stop() is called.
///
/// Threads: one at a time, but stop() from any. Real-time: no.
class PipeReader final : public AudioFileReader {
 public:
    /// Errors, one line each: nobody writes; nothing came for too long; what came ended within its
    /// head, or is not of these formats; standard input is a terminal; the pipe cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<PipeReader>> open(
        const std::filesystem::path& path, const PipeOptions& options = {});

    /// As AudioFileReader::read; waits for the writer.
    [[nodiscard]] std::size_t read(std::span<float> interleaved) override;
    /// Errors: always, unless `frame` is where the reader is.
    [[nodiscard]] Expected<void> seek(std::int64_t frame) override;

    /// A flag that ends a read that waits, and all that follow, once it is set. It may outlive
    /// this.
    [[nodiscard]] std::shared_ptr<std::atomic<bool>> stop_flag() const noexcept;

 private:
    PipeReader(std::string name,
               std::unique_ptr<AudioFileReader> decoder,
               std::shared_ptr<std::atomic<bool>> stop);

    std::string name_;
    std::int64_t position_ = 0;  // frames; the decoder is ahead
    std::unique_ptr<AudioFileReader> decoder_;
    std::shared_ptr<std::atomic<bool>> stop_;
};

}  // namespace raks::audio
