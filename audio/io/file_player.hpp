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
#include "audio/io/pipe_reader.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Settings of FilePlayer::start().
struct FilePlayerConfig {
    /// Audio frames decoded ahead (about 1.4 s at 48 kHz), >= 1024.
    std::size_t ahead_frames = 65'536;
    double start_seconds = 0.0;  ///< where the first file starts, >= 0
};

/// What one call of pull() returned.
struct PulledAudio {
    std::size_t frames = 0;     ///< frames of the block that hold sound
    int track = 0;              ///< index of the file that they are from
    SampleRate rate{48'000};    ///< that file's rate
    std::int64_t position = 0;  ///< frame number of the first of them in its file
    bool is_jump = false;       ///< not the continuation: first, seek, next file
    bool is_ended = false;      ///< frames == 0: all files have been played to their end
    Hearing hearing{};          ///< how an analyzer should hear them: hear_mono()
};

/// Decodes files one after the other, ahead of time on a thread of its own, as stereo at each
/// file's own rate (mono doubled, more channels mixed down: downmix.hpp; softer where the file is
/// far above full scale: hearing.hpp). A file that cannot be opened is skipped with a message.
///
/// Threads: pull from the audio thread alone; the control methods from one other thread.
/// Real-time: pull yes (wait-free, bounded), the rest no.
class FilePlayer {
 public:
    /// Opens the first file (its error is the result's) and starts decoding.
    /// Errors: no file, the first file cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<FilePlayer>> start(
        std::vector<std::filesystem::path> files, const FilePlayerConfig& config = {});
    /// The same with what comes through a pipe, called `name`: it is decoded as far ahead as it has
    /// come, cannot be sought, and a pull waits for nothing where it is late.
    [[nodiscard]] static std::unique_ptr<FilePlayer> start(std::unique_ptr<PipeReader> pipe,
                                                           const std::filesystem::path& name);
    /// Calls stop().
    ~FilePlayer();
    /// Not copyable: it owns a thread.
    FilePlayer(const FilePlayer&) = delete;
    /// As above.
    FilePlayer& operator=(const FilePlayer&) = delete;

    /// Fills `stereo` (whole frames); what is beyond `frames` of the result is set to 0. One pull
    /// never mixes two files or both sides of a seek: when it returns fewer frames than the block
    /// holds, more may be ready; call again for the rest. If too little is decoded although the
    /// file continues, underruns() counts it, but not right after a seek (is_seeking()).
    PulledAudio pull(std::span<float> stereo) noexcept RAKS_NONBLOCKING;

    /// Continues at `seconds` (>= 0, else 0) of file `track`; all that was decoded ahead is
    /// dropped. In a pipe it does nothing.
    void seek(int track, double seconds);
    /// Whether there is going back and ahead: not in a pipe.
    [[nodiscard]] bool can_seek() const noexcept;
    /// Ends the decoder thread and waits for it, at most 0.1 s where a decoder hangs. What is
    /// decoded can still be pulled.
    void stop();
    /// Messages for the user since the last call: files that were skipped or are damaged.
    [[nodiscard]] std::vector<std::string> take_messages();

    /// Number of files.
    [[nodiscard]] int track_count() const noexcept;
    /// Path of a file, 0 <= track < track_count().
    [[nodiscard]] const std::filesystem::path& path_of(int track) const;
    /// Properties of the first file; known from the start.
    [[nodiscard]] const AudioFileInfo& first_info() const noexcept;
    /// True from seek() until the first frames from there were pulled. Threads: any.
    [[nodiscard]] bool is_seeking() const noexcept RAKS_NONBLOCKING;
    /// Number of pulls for which too little was decoded. Threads: any.
    [[nodiscard]] std::uint64_t underruns() const noexcept;
    /// Blocks the caller until at least `frames` are decoded ahead, or all that remains, or
    /// `is_stopped`, asked every 50 ms, says that it is to stop.
    void wait_until_ready(std::size_t frames, const std::function<bool()>& is_stopped = {});

 private:
    struct Impl;
    explicit FilePlayer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace raks::audio
