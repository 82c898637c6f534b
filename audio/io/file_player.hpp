#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "audio/io/audio_file.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

struct FilePlayerConfig {
    /// Audio frames decoded ahead (about 1.4 s at 48 kHz), >= 1024.
    std::size_t ahead_frames = 65'536;
    double start_seconds = 0.0;  ///< where the first file starts, >= 0
};

/// What one pull gave.
struct PulledAudio {
    std::size_t frames = 0;     ///< whole frames of the block that hold the file's sound
    int track = 0;              ///< which of the files they are from
    SampleRate rate{48'000};    ///< that file's rate
    std::int64_t position = 0;  ///< frame number in the file of the first of them
    bool is_jump = false;       ///< they do not follow the previous ones: first, seek, next file
    bool is_ended = false;      ///< frames == 0: all files have been played to their end
};

/// Decodes files ahead on a thread of its own, one after the other, as stereo at each file's own
/// rate (mono doubled, more channels mixed down: downmix.hpp). A file that cannot be opened is
/// passed over with a message.
///
/// Threads: pull from the audio thread alone; the control methods from one other thread.
/// Real-time: pull yes (wait-free, bounded), the rest no.
class FilePlayer {
 public:
    /// Opens the first file (its error is the result's) and starts decoding.
    /// Errors: no file, the first file cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<FilePlayer>> start(
        std::vector<std::filesystem::path> files, const FilePlayerConfig& config = {});
    ~FilePlayer();  ///< stop()
    FilePlayer(const FilePlayer&) = delete;
    FilePlayer& operator=(const FilePlayer&) = delete;

    /// Fills `stereo` (whole frames); what is beyond `frames` of the result is set to 0. One pull
    /// never mixes two files or two sides of a seek: when it gives fewer frames than the block
    /// holds, more may be there already; pull again for the rest. Nothing ready although the file
    /// goes on is counted in underruns(); not right after a seek (that is_seeking()).
    PulledAudio pull(std::span<float> stereo) noexcept;

    /// Goes on at `seconds` (clamped to >= 0) of file `track`; what was decoded ahead is dropped.
    void seek(int track, double seconds);
    /// Ends the decoder thread and joins it. What is in the ring can still be pulled.
    void stop();
    /// Lines for the user since the last call: files passed over, damaged files.
    [[nodiscard]] std::vector<std::string> take_messages();

    [[nodiscard]] int track_count() const noexcept;
    [[nodiscard]] const std::filesystem::path& path_of(int track) const;
    /// Head of the first file (known from the start).
    [[nodiscard]] const AudioFileInfo& first_info() const noexcept;
    /// Threads: any. True from seek() until the first frames of the new place were pulled.
    [[nodiscard]] bool is_seeking() const noexcept;
    /// Threads: any. Pulls that found too little decoded.
    [[nodiscard]] std::uint64_t underruns() const noexcept;
    /// Blocks the caller until at least `frames` are decoded ahead, or all that there is.
    void wait_until_ready(std::size_t frames);

 private:
    struct Impl;
    explicit FilePlayer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace raks::audio
