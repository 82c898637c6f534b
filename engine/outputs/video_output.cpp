#include "engine/outputs/video_output.hpp"

#include <algorithm>
#include <utility>

#include "base/sleep_until.hpp"
#include "base/thread_priority.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// Drawn ahead of the one that is sent next: reading back takes one.
constexpr std::int64_t kMostAhead = 2;
constexpr std::size_t kMostWaiting = 4;

}  // namespace

Expected<std::unique_ptr<VideoOutput>> VideoOutput::open(const std::vector<VideoWish>& wishes,
                                                         const VideoFormat& format) {
    std::vector<Named> sinks;
    for (const VideoWish& wish : wishes) {
        auto sink = open_video_sink(wish, format);
        if (!sink) {
            return fail(sink.error());
        }
        sinks.push_back({wish.target, std::move(*sink)});
    }
    return std::make_unique<VideoOutput>(std::move(sinks), format);
}

VideoOutput::VideoOutput(std::vector<Named> sinks, const VideoFormat& format)
    : format_(format),
      sinks_(std::move(sinks)),
      begun_(std::chrono::time_point_cast<Nanos>(HostClock::now())),
      thread_([this] { run(); }) {}

VideoOutput::~VideoOutput() {
    is_stopping_ = true;
    thread_.join();
}

HostTime VideoOutput::due_of(std::int64_t number) const noexcept {
    return begun_ + format_.time_of(number);
}

std::optional<HostTime> VideoOutput::wanted(HostTime now) {
    while (due_of(next_wanted_) <= now) {
        ++next_wanted_;
    }
    const HostTime due = due_of(next_wanted_);
    return due - now <= format_.time_of(kMostAhead) ? std::optional(due) : std::nullopt;
}

void VideoOutput::give(HostTime due, std::span<const std::uint8_t> rgba) {
    Picture picture;
    {
        const std::lock_guard lock(mutex_);
        if (!spare_.empty()) {
            picture = std::move(spare_.back());
            spare_.pop_back();
        }
    }
    picture.due = due;
    picture.rgba.assign(rgba.begin(), rgba.end());
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(picture));
    // Where the thread is held up, the oldest go.
    if (waiting_.size() > kMostWaiting) {
        waiting_.pop_front();
    }
    while (due_of(next_wanted_) <= due) {
        ++next_wanted_;
    }
}

// The newest picture for this moment or one before it. False: there is none but the last.
bool VideoOutput::take(HostTime due) {
    const std::lock_guard lock(mutex_);
    bool is_new = false;
    while (!waiting_.empty() && waiting_.front().due <= due) {
        std::swap(shown_, waiting_.front().rgba);
        spare_.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
        is_new = true;
    }
    return is_new;
}

void VideoOutput::send(bool is_new) {
    ++moments_;
    repeated_ += is_new ? 0 : 1;
    for (const Named& named : sinks_) {
        named.sink->send(shown_);
        if (auto trouble = named.sink->take_trouble()) {
            const std::lock_guard lock(mutex_);
            lines_.push_back(std::move(*trouble));
        }
    }
}

void VideoOutput::run() noexcept {
    prefer_this_thread(RealtimeThread::outputs);
    std::int64_t number = 1;
    while (!is_stopping_) {
        const HostTime due = due_of(number);
        sleep_until(due);
        const bool is_new = take(due);
        // Nothing before the first picture.
        if (!shown_.empty()) {
            send(is_new);
        }
        // Moments that passed meanwhile are not made up for: the rate is the clock's.
        const HostTime now = HostClock::now();
        do {
            ++number;
        } while (due_of(number) <= now);
    }
}

std::vector<std::string> VideoOutput::take_lines() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lines_, {});
}

std::vector<std::string> VideoOutput::losses() const {
    std::vector<std::string> lines;
    if (const std::uint64_t again = repeated(); again > 0) {
        lines.push_back(fmt::format(
            "--video-out: {} of {} pictures were the one before again", again, moments()));
    }
    for (const auto& [name, sink] : sinks_) {
        if (const std::uint64_t dropped = sink->dropped(); dropped > 0) {
            lines.push_back(fmt::format(
                "--video-out {}: {} of {} pictures were dropped, as its reader was slow",
                name,
                dropped,
                sink->sent() + dropped));
        }
    }
    return lines;
}

}  // namespace raks::engine
