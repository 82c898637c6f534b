#include "audio/io/file_player.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/channels/audio_ring.hpp"
#include "base/channels/event_queue.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kReadFrames = 512;             // decoded at once
constexpr std::size_t kMinAheadFrames = 1024;        // smallest ring
constexpr std::size_t kMostSegments = 256;           // files and seeks that may wait in the queue
constexpr std::size_t kMostDroppedPerPull = 16'384;  // frames: bounds the work after a seek
constexpr int kMostStepsPerPull = 64;  // segments and drops: bounds the loops of a pull
// The audio thread must not wake the decoder, which would be a system call; the decoder looks for
// room in the ring at this interval.
constexpr auto kLookForRoom = std::chrono::milliseconds(5);

// How often whoever waits looks whether it is to stop.
constexpr auto kLookForStop = std::chrono::milliseconds(50);

// Describes the samples in the ring from position `start` up to the next segment.
struct Segment {
    std::uint64_t start = 0;       ///< frames written to the ring before it
    std::uint64_t generation = 0;  ///< number of the seek that it answers
    std::int64_t position = 0;     ///< frame in the file
    int track = 0;
    int rate = 48'000;
    bool is_end = false;  ///< nothing comes after the last file
    Hearing hearing{};    ///< of what is in the ring
};

// A seek that the decoder has yet to carry out; a newer one replaces it.
struct SeekCommand {
    int track = 0;
    double seconds = 0.0;
    std::uint64_t generation = 0;
};

}  // namespace

struct FilePlayer::Impl {
    Impl(std::vector<std::filesystem::path> paths, const FilePlayerConfig& config)
        : files(std::move(paths)),
          ring(2 * std::max(config.ahead_frames, kMinAheadFrames)),
          segments(kMostSegments) {}

    // Decoder thread.
    void run();
    [[nodiscard]] bool wait_for_work(std::unique_lock<std::mutex>& lock);
    void go_to(const SeekCommand& command);
    [[nodiscard]] Expected<std::unique_ptr<AudioFileReader>> open(int wanted_track) const;
    bool open_track(int wanted_track, double seconds);
    void open_next_or_end(int next_track);
    void decode_chunk();
    void push_segment(std::int64_t position, bool is_end);
    void say(std::string line);
    // A step of work writes one chunk or pushes one segment.
    [[nodiscard]] bool can_work() const {
        const bool has_room = reader && ring.writable() >= 2 * kReadFrames;
        return segments.size() + 2 < kMostSegments && (command || has_room);
    }

    // Audio thread.
    std::size_t frames_until_next_segment(std::uint64_t ready) noexcept;
    void drop(std::size_t frames) noexcept;

    const std::vector<std::filesystem::path> files;
    std::shared_ptr<std::atomic<bool>> pipe_stop;  // null: files, which never keep one waiting
    AudioFileInfo first_info;
    AudioRing ring;  // stereo
    EventQueue<Segment> segments;
    std::atomic<std::uint64_t> wanted_generation{1};
    std::atomic<std::uint64_t> played_generation{0};  // the newest whose samples were pulled
    std::atomic<std::uint64_t> underruns{0};

    std::mutex mutex;
    std::condition_variable changed;
    // Under the mutex:
    std::optional<SeekCommand> command;
    std::vector<std::string> messages;
    std::atomic<bool> is_stopping{false};  // also looked at while a decoder hangs
    bool is_idle = false;                  // all is decoded, or there is no room
    std::uint64_t frames_since_seek = 0;
    // Decoder thread only:
    std::unique_ptr<AudioFileReader> reader;
    bool is_fresh = false;  // open, and nothing was read yet
    int track = 0;
    std::uint64_t generation = 0;
    std::uint64_t frames_written = 0;
    std::uint64_t frames_before_seek = 0;
    std::vector<float> interleaved;
    std::array<float, 2 * kReadFrames> stereo{};
    // Audio thread only:
    Segment current;
    Segment next;
    bool has_next = false;
    bool is_jump = false;
    std::uint64_t frames_read = 0;
    std::array<float, 4096> dropped{};  // where samples before a seek are read to

    std::thread decoder;
};

// Keeps a message for take_messages().
void FilePlayer::Impl::say(std::string line) {
    const std::lock_guard lock(mutex);
    // A file that was given up because the player is to stop has no fault.
    if (!is_stopping) {
        messages.push_back(std::move(line));
    }
}

// Waits until there is something to do; false when the thread is to end.
bool FilePlayer::Impl::wait_for_work(std::unique_lock<std::mutex>& lock) {
    while (!is_stopping && !can_work()) {
        is_idle = true;
        changed.notify_all();
        if (reader || command) {
            changed.wait_for(lock, kLookForRoom);
        } else {
            changed.wait(lock);
        }
    }
    is_idle = false;
    return !is_stopping;
}

// The decoder thread: one seek or one chunk at a time, the mutex released while it decodes.
void FilePlayer::Impl::run() {
    std::unique_lock lock(mutex);
    while (wait_for_work(lock)) {
        const std::optional<SeekCommand> seek = std::exchange(command, std::nullopt);
        frames_since_seek = seek ? 0 : frames_since_seek;
        lock.unlock();
        if (seek) {
            go_to(*seek);
        } else {
            decode_chunk();
        }
        lock.lock();
        frames_since_seek = frames_written - frames_before_seek;
        changed.notify_all();
    }
}

// Announces what the samples written from here on are.
void FilePlayer::Impl::push_segment(std::int64_t position, bool is_end) {
    // There is room: can_work() asked for it, and each step of work pushes one.
    Segment segment{.start = frames_written,
                    .generation = generation,
                    .position = position,
                    .track = track,
                    .is_end = is_end};
    if (reader) {
        segment.rate = reader->info().rate.hertz();
        segment.hearing = after_stereo(reader->info().hearing);
    }
    segments.push(segment);
}

// A decoder that hangs does not hold stop() back.
Expected<std::unique_ptr<AudioFileReader>> FilePlayer::Impl::open(int wanted_track) const {
    return open_audio_file(files[static_cast<std::size_t>(wanted_track)], [this] {
        return is_stopping.load(std::memory_order_relaxed);  // relaxed: orders nothing
    });
}

// Opens a file, or keeps it open for a seek within it, and goes to the given time. On an error the
// reader is closed and the user told.
bool FilePlayer::Impl::open_track(int wanted_track, double seconds) {
    const bool is_same = reader && wanted_track == track;
    const bool is_at_start = std::exchange(is_fresh, false) && is_same;
    track = wanted_track;
    if (!is_same) {
        auto opened = open(track);
        if (!opened) {
            say(opened.error().message);
            reader.reset();
            return false;
        }
        reader = std::move(*opened);
    }
    const auto frame =
        static_cast<std::int64_t>(std::max(seconds, 0.0) * reader->info().rate.hertz());
    if ((is_same && !is_at_start) || frame > 0) {
        if (const auto sought = reader->seek(frame); !sought) {
            say(sought.error().message);
            reader.reset();
            return false;
        }
    }
    push_segment(frame, false);
    return true;
}

// The next file that can be opened; after the last one a segment that marks the end.
void FilePlayer::Impl::open_next_or_end(int next_track) {
    for (int i = next_track; i < static_cast<int>(files.size()); ++i) {
        if (open_track(i, 0.0)) {
            return;
        }
    }
    reader.reset();
    push_segment(0, true);
}

// Carries a seek out. Samples from here on carry its generation, which tells pull() the older ones.
void FilePlayer::Impl::go_to(const SeekCommand& seek) {
    generation = seek.generation;
    frames_before_seek = frames_written;
    if (!open_track(seek.track, seek.seconds)) {
        open_next_or_end(seek.track + 1);
    }
}

// One chunk as stereo into the ring; at the end of a file its successor is opened.
void FilePlayer::Impl::decode_chunk() {
    const auto channels = static_cast<std::size_t>(reader->info().channels);
    interleaved.resize(kReadFrames * channels);
    const std::size_t frames = reader->read(interleaved);
    if (frames == 0) {
        if (!reader->warning().empty()) {
            say(reader->warning());
        }
        open_next_or_end(track + 1);
        return;
    }
    hear_stereo(
        std::span(interleaved).first(frames * channels), channels, reader->info().hearing, stereo);
    ring.write(std::span(stereo).first(2 * frames));
    frames_written += frames;
}

// Number of ready frames of the current segment. When the next segment begins at this point, it
// becomes the current one.
std::size_t FilePlayer::Impl::frames_until_next_segment(std::uint64_t ready) noexcept {
    for (int step = 0; step < kMostStepsPerPull; ++step) {
        has_next = has_next || segments.pop(next);
        if (!has_next || next.start != frames_read) {
            break;
        }
        current = next;
        has_next = false;
        is_jump = true;
    }
    return static_cast<std::size_t>(has_next ? std::min(ready, next.start - frames_read) : ready);
}

// Discards frames from before a seek.
void FilePlayer::Impl::drop(std::size_t frames) noexcept {
    while (frames > 0) {
        const std::size_t count = std::min(frames, dropped.size() / 2);
        ring.read(std::span(dropped).first(2 * count));
        frames -= count;
        frames_read += count;
    }
}

FilePlayer::FilePlayer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

FilePlayer::~FilePlayer() { stop(); }

Expected<std::unique_ptr<FilePlayer>> FilePlayer::start(std::vector<std::filesystem::path> files,
                                                        const FilePlayerConfig& config) {
    if (files.empty()) {
        return fail("no file to play");
    }
    // Opened here, so that its head and its faults are known; the decoder thread goes on with it.
    auto impl = std::make_unique<Impl>(std::move(files), config);
    auto first = impl->open(0);
    if (!first) {
        return fail(first.error());
    }
    impl->first_info = (*first)->info();
    impl->reader = std::move(*first);
    impl->is_fresh = true;
    impl->command = SeekCommand{.track = 0, .seconds = config.start_seconds, .generation = 1};
    impl->decoder = std::thread(&Impl::run, impl.get());
    return std::unique_ptr<FilePlayer>(new FilePlayer(std::move(impl)));
}

std::unique_ptr<FilePlayer> FilePlayer::start(std::unique_ptr<PipeReader> pipe,
                                              const std::filesystem::path& name) {
    auto impl = std::make_unique<Impl>(std::vector{name}, FilePlayerConfig{});
    impl->first_info = pipe->info();
    impl->pipe_stop = pipe->stop_flag();
    // It is open at its beginning already: no command, but the segment that one would push.
    impl->generation =
        impl->wanted_generation.load(std::memory_order_relaxed);  // relaxed: no thread
    impl->reader = std::move(pipe);
    impl->push_segment(0, false);
    impl->decoder = std::thread(&Impl::run, impl.get());
    return std::unique_ptr<FilePlayer>(new FilePlayer(std::move(impl)));
}

PulledAudio FilePlayer::pull(std::span<float> stereo) noexcept RAKS_NONBLOCKING {
    Impl& me = *impl_;
    // acquire: pairs with the release in seek(): nothing older is played from here on.
    const std::uint64_t wanted = me.wanted_generation.load(std::memory_order_acquire);
    std::size_t may_drop = kMostDroppedPerPull;
    std::size_t count = 0;
    for (int step = 0; step < kMostStepsPerPull; ++step) {
        // readable() is read before the queue of segments: the segment of any sample was pushed
        // before the sample was written, so no sample is taken for the segment before it.
        count = me.frames_until_next_segment(me.ring.readable() / 2);
        if (me.current.generation == wanted || count == 0) {
            break;
        }
        count = std::min(count, may_drop);
        me.drop(count);
        may_drop -= count;
    }
    // Stale: samples of a seek's new place are not there yet; silence is no underrun then.
    const std::size_t room = stereo.size() / 2;
    const bool is_stale = me.current.generation != wanted;
    const bool stops_here = me.has_next && me.next.start == me.frames_read + count;
    const std::size_t frames = is_stale || me.current.is_end ? 0 : std::min(count, room);
    PulledAudio pulled{.frames = frames,
                       .track = me.current.track,
                       .rate = SampleRate(me.current.rate),
                       .position = me.current.position,
                       .is_jump = me.is_jump && frames > 0,
                       .is_ended = !is_stale && me.current.is_end,
                       .hearing = me.current.hearing};
    me.ring.read(stereo.first(2 * frames));
    std::fill(stereo.begin() + static_cast<std::ptrdiff_t>(2 * frames), stereo.end(), 0.0F);
    me.frames_read += frames;
    me.current.position += static_cast<std::int64_t>(frames);
    if (frames > 0) {
        me.is_jump = false;
    }
    if (frames > 0 || pulled.is_ended) {
        me.played_generation.store(wanted, std::memory_order_relaxed);  // relaxed: a statistic
    }
    if (frames < room && !is_stale && !pulled.is_ended && !stops_here) {
        me.underruns.fetch_add(1, std::memory_order_relaxed);  // relaxed: a statistic
    }
    return pulled;
}

// The generation is published last: pull() may then drop samples, while the command waits under the
// mutex for the decoder.
void FilePlayer::seek(int track, double seconds) {
    if (!can_seek()) {
        return;
    }
    const std::lock_guard lock(impl_->mutex);
    const std::uint64_t generation =
        impl_->wanted_generation.load(std::memory_order_relaxed) + 1;  // relaxed: own index
    impl_->command =
        SeekCommand{std::clamp(track, 0, track_count() - 1), std::max(seconds, 0.0), generation};
    // release: pairs with the acquire in pull().
    impl_->wanted_generation.store(generation, std::memory_order_release);
    impl_->changed.notify_all();
}

bool FilePlayer::can_seek() const noexcept { return impl_->pipe_stop == nullptr; }

void FilePlayer::stop() {
    // A decoder that waits for the writer of a pipe would never look at is_stopping.
    if (impl_->pipe_stop) {
        impl_->pipe_stop->store(true, std::memory_order_relaxed);  // relaxed: orders nothing
    }
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->is_stopping.store(true, std::memory_order_relaxed);  // relaxed: the mutex orders
        impl_->changed.notify_all();
    }
    if (impl_->decoder.joinable()) {
        impl_->decoder.join();
    }
}

std::vector<std::string> FilePlayer::take_messages() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->messages, {});
}

void FilePlayer::wait_until_ready(std::size_t frames, const std::function<bool()>& is_stopped) {
    std::unique_lock lock(impl_->mutex);
    impl_->changed.notify_all();
    const auto is_ready = [this, frames] {
        const bool is_enough = !impl_->command && impl_->frames_since_seek >= frames &&
                               impl_->ring.readable() >= 2 * frames;
        // A decoder that is idle may not have noticed yet that there is room again.
        return is_enough || (impl_->is_idle && !impl_->can_work()) || impl_->is_stopping;
    };
    while (!impl_->changed.wait_for(lock, kLookForStop, is_ready) &&
           !(is_stopped && is_stopped())) {
    }
}

int FilePlayer::track_count() const noexcept { return static_cast<int>(impl_->files.size()); }

const std::filesystem::path& FilePlayer::path_of(int track) const {
    return impl_->files.at(static_cast<std::size_t>(track));
}

const AudioFileInfo& FilePlayer::first_info() const noexcept { return impl_->first_info; }

bool FilePlayer::is_seeking() const noexcept RAKS_NONBLOCKING {
    return impl_->played_generation.load(std::memory_order_relaxed) !=
           impl_->wanted_generation.load(std::memory_order_relaxed);
}

std::uint64_t FilePlayer::underruns() const noexcept {
    return impl_->underruns.load(std::memory_order_relaxed);
}

}  // namespace raks::audio
