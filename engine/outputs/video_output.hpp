#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/outputs/video_sink.hpp"

namespace raks::engine {

/// Pictures of the show on their way to their sinks. Whoever draws asks which picture is wanted
/// next, draws the moment when it will be sent, and gives it; a thread of its own sends one picture
/// at each due moment of the clock, the last one again where none came in time.
///
///     while (const auto due = output.wanted(now)) {
///         draw(moment_at(*due));  output.give(*due, rgba);
///     }
///
/// Threads: main, for all methods.
class VideoOutput {
 public:
    /// A sink, and what it is called in lines for the person.
    struct Named {
        std::string name;                 ///< its target
        std::unique_ptr<VideoSink> sink;  ///< never null
    };

    /// Opens all and starts the thread. Errors: those of open_video_sink of the first that cannot
    /// be opened.
    [[nodiscard]] static Expected<std::unique_ptr<VideoOutput>> open(
        const std::vector<VideoWish>& wishes, const VideoFormat& format);
    /// The same with sinks of one's own.
    VideoOutput(std::vector<Named> sinks, const VideoFormat& format);
    ~VideoOutput();                                       ///< joins the thread and closes the sinks
    VideoOutput(const VideoOutput&) = delete;             ///< the thread refers to it
    VideoOutput& operator=(const VideoOutput&) = delete;  ///< likewise

    /// Of its pictures.
    [[nodiscard]] const VideoFormat& format() const noexcept { return format_; }
    /// When the next picture that was not given yet is sent, where it is time to draw it: at most
    /// two pictures ahead. Pictures that are too late to be drawn are passed over.
    [[nodiscard]] std::optional<HostTime> wanted(HostTime now);
    /// The picture for `due`, which wanted() has told. Real-time: no.
    void give(HostTime due, std::span<const std::uint8_t> rgba);

    /// Lines for the person since the last call.
    [[nodiscard]] std::vector<std::string> take_lines();
    /// Moments at which a picture was sent, and at how many of them it was the one before again.
    [[nodiscard]] std::uint64_t moments() const noexcept { return moments_.load(); }
    /// See moments().
    [[nodiscard]] std::uint64_t repeated() const noexcept { return repeated_.load(); }
    /// What was repeated or dropped, in words, one line a sink that lost anything.
    [[nodiscard]] std::vector<std::string> losses() const;

 private:
    struct Picture {
        HostTime due{};
        std::vector<std::uint8_t> rgba;
    };

    void run() noexcept;
    void send(bool is_new);
    [[nodiscard]] bool take(HostTime due);
    [[nodiscard]] HostTime due_of(std::int64_t number) const noexcept;

    VideoFormat format_;
    std::vector<Named> sinks_;
    HostTime begun_;
    std::int64_t next_wanted_ = 0;  // number of the next picture to be drawn
    std::atomic<std::uint64_t> moments_{0};
    std::atomic<std::uint64_t> repeated_{0};
    std::atomic<bool> is_stopping_{false};
    std::mutex mutex_;             // of the three below
    std::deque<Picture> waiting_;  // by their due times
    std::vector<Picture> spare_;   // whose storage is used again
    std::vector<std::string> lines_;
    std::vector<std::uint8_t> shown_;  // the thread's
    std::thread thread_;
};

}  // namespace raks::engine
