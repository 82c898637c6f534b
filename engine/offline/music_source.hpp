#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audio/io/audio_file.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// A section of a music file as a stream of blocks, for the commands that work offline. Memory does
/// not grow with the length.
/// Threads: one. Real-time: no.
class MusicSource {
 public:
    /// `start` in seconds, >= 0; `duration` in seconds, > 0, to the end when absent. Errors: those
    /// of audio::open_audio_file, which gets `is_stopped`; a start behind the file's end.
    [[nodiscard]] static Expected<MusicSource> open(const std::filesystem::path& path,
                                                    double start = 0.0,
                                                    std::optional<double> duration = std::nullopt,
                                                    std::function<bool()> is_stopped = {});

    /// All that an open reader gives, such as one of a pipe.
    [[nodiscard]] static MusicSource of(std::unique_ptr<audio::AudioFileReader> reader);

    /// The file's own sample rate.
    [[nodiscard]] SampleRate rate() const noexcept { return reader_->info().rate; }

    /// One block: the same frames as mono for the analyzer and as stereo for a sound track, both as
    /// the file's Hearing says (audio/io/hearing.hpp). Both
    /// empty at the end. Valid until the next call.
    struct Block {
        std::span<const float> mono;    ///< one value a frame
        std::span<const float> stereo;  ///< interleaved, two values a frame
    };
    /// The next block, at most 1024 frames.
    [[nodiscard]] Block next();

    /// Length of what next() has given so far.
    [[nodiscard]] Nanos given() const noexcept;
    /// Title, artist and more, as the file says them.
    [[nodiscard]] const audio::AudioTags& tags() const noexcept { return reader_->info().tags; }
    /// What is wrong with a file that still plays; empty when nothing is.
    [[nodiscard]] const std::string& warning() const noexcept { return reader_->warning(); }
    /// Length of what is to be given, as the file claims; empty when it does not say.
    [[nodiscard]] std::optional<double> seconds() const noexcept;
    /// Share of the file that is done, [0, 1], as the file claims; empty when it does not say.
    [[nodiscard]] std::optional<double> progress() const noexcept;

 private:
    explicit MusicSource(std::unique_ptr<audio::AudioFileReader> reader);

    [[nodiscard]] std::size_t read_block();

    std::unique_ptr<audio::AudioFileReader> reader_;
    std::optional<std::size_t> read_ahead_;  // frames of the first block, where it is read already
    std::int64_t frames_left_ = 0;
    std::int64_t frames_given_ = 0;
    double start_seconds_ = 0.0;
    std::vector<float> interleaved_;
    std::vector<float> mono_;
    std::vector<float> stereo_;
};

/// The line for people about a file that is not as long as where it is to start: both in seconds.
[[nodiscard]] std::string starts_behind_end(const std::filesystem::path& path,
                                            double length,
                                            double start);

/// The piece that Raks dances to when no file is given: a salsa of its own, synthesized once into
/// the user's cache ($XDG_CACHE_HOME/raks), or where that cannot be written into the folder for
/// temporary files. Errors: neither can be written.
[[nodiscard]] Expected<std::filesystem::path> demo_music();

}  // namespace raks::engine
