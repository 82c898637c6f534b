#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/terminal/program.hpp"
#include "audio/resample/resampler.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/live/sound_tap.hpp"
#include "render/video/video_writer.hpp"

namespace raks::apps {

/// A film of what is danced, written while it is danced. Its time is that of the sound: picture and
/// sample of one moment belong together however the clocks run, and a pause is not in it. It
/// begins with the first sound that comes in once it is started; songs follow each other without a
/// gap.
///
/// Main draws the moments that are wanted; a thread of its own writes pictures and sound. What is
/// on the disk plays up to about a second before the end, also when the program is killed.
/// Threads: main, for all methods.
class Recorder {
 public:
    /// Begins a film. `tap`: where its sound comes from; it must outlive this, and have no other
    /// reader. Errors: a file that is there already; those of VideoWriter::create.
    [[nodiscard]] static Expected<std::unique_ptr<Recorder>> start(const Path& file,
                                                                   render::VideoOptions options,
                                                                   engine::SoundTap& tap);
    ~Recorder();                                    ///< as stop(), and says nothing
    Recorder(const Recorder&) = delete;             ///< the thread refers to it
    Recorder& operator=(const Recorder&) = delete;  ///< likewise

    /// From now on the sound is that of this source of the tap, numbered upward from 1.
    void follow(std::uint32_t source);
    /// The next moment that is to be drawn, where it is time: `passing` is what passes the sound
    /// server now. What is too late to be drawn is shown by the picture before.
    [[nodiscard]] std::optional<StreamTime> wanted(StreamTime passing);
    /// The picture of that moment.
    void give(std::span<const std::uint8_t> rgba);

    /// Why it ended by itself, once: the disk is full or nearly so.
    [[nodiscard]] std::optional<std::string> take_trouble();
    /// Completes the film. Returns the line for the person.
    [[nodiscard]] std::string stop();

 private:
    // Where a source's sound lies in the film.
    struct Anchor {
        std::uint32_t source = 0;
        StreamTime begins{};     // of its first sound
        std::int64_t first = 0;  // picture at that moment
    };
    struct Picture {
        std::int64_t repeats = 0;  // of the one before, first
        std::vector<std::uint8_t> rgba;
    };

    Recorder(Path file,
             const render::VideoOptions& options,
             std::unique_ptr<render::VideoWriter> writer,
             engine::SoundTap& tap);

    [[nodiscard]] Nanos time_of(std::int64_t picture) const noexcept;
    // The thread's.
    void run() noexcept;
    [[nodiscard]] Expected<void> write_sound();
    void begin_source(const engine::SoundTap::Piece& piece);
    [[nodiscard]] Expected<void> write_piece(const engine::SoundTap::Piece& piece);
    [[nodiscard]] Expected<void> write_pictures();
    [[nodiscard]] Expected<void> check_disk();
    void end(const Error& why);

    Path file_;
    render::VideoOptions options_;
    engine::SoundTap& tap_;
    std::uint32_t source_ = 0;                    // main's
    std::atomic<std::uint32_t> first_source_{0};  // what is older is of a film before

    std::mutex mutex_;  // of the six below
    std::condition_variable changed_;
    std::optional<Anchor> anchor_;  // of the last source that was heard
    std::int64_t next_ = 0;         // number of the next picture
    std::int64_t owed_ = 0;         // repeats that go before it
    std::deque<Picture> waiting_;
    std::vector<std::vector<std::uint8_t>> spare_;
    std::optional<std::string> trouble_;
    std::atomic<bool> is_stopping_{false};
    std::atomic<bool> has_ended_{false};
    // The thread's.
    std::unique_ptr<render::VideoWriter> writer_;
    audio::Resampler resampler_;
    int resampled_rate_ = 0;
    std::uint32_t heard_source_ = 0;  // none: 0
    Anchor heard_;
    std::int64_t frames_ = 0;  // of sound in the film
    std::vector<float> resampled_;
    std::vector<std::uint8_t> last_;  // picture in the film
    HostTime looked_{};               // at the disk
    std::thread thread_;
};

}  // namespace raks::apps
