#include "engine/outputs/outputs.hpp"

#include <algorithm>
#include <utility>

#include "base/sleep_until.hpp"
#include "base/thread_priority.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// States come every 10 ms, and a grid may move the next beat nearer.
constexpr Nanos kLongestNap = std::chrono::milliseconds(5);

}  // namespace

Expected<std::unique_ptr<Outputs>> Outputs::open(const std::vector<OutputWish>& wishes) {
    std::vector<Open> outputs;
    for (const OutputWish& wish : wishes) {
        auto output = wish.kind->open(wish.target);
        if (!output) {
            return fail(output.error());
        }
        outputs.push_back({wish.kind, std::move(*output)});
    }
    return std::unique_ptr<Outputs>(new Outputs(std::move(outputs)));
}

Outputs::Outputs(std::vector<Open> outputs) : outputs_(std::move(outputs)) {
    if (!outputs_.empty()) {
        thread_ = std::thread([this] { run(); });
    }
}

Outputs::~Outputs() {
    is_stopping_ = true;
    if (thread_.joinable()) {
        thread_.join();
    }
}

void Outputs::follow(std::shared_ptr<MusicFeed> feed) {
    const std::lock_guard lock(mutex_);
    next_feed_ = std::move(feed);
}

std::vector<std::string> Outputs::take_lines() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lines_, {});
}

std::vector<std::string> Outputs::losses() const {
    std::vector<std::string> lines;
    for (const Open& open : outputs_) {
        if (const auto dropped = open.output->dropped(); dropped > 0) {
            lines.push_back(fmt::format("--{}: {} of {} messages were dropped: the reader was slow",
                                        open.kind->option,
                                        dropped,
                                        dropped + open.output->sent()));
        }
    }
    return lines;
}

void Outputs::run() noexcept {
    prefer_this_thread(RealtimeThread::outputs);
    while (!is_stopping_) {
        turn(host_now());
        sleep_until(next_turn(host_now()));
    }
}

void Outputs::turn(HostTime now) {
    MusicState state;
    {
        const std::lock_guard lock(mutex_);
        if (next_feed_) {
            feed_ = std::exchange(next_feed_, nullptr);
            schedule_ = {};
            while (feed_->take(state)) {
            }
        }
    }
    if (!feed_) {
        return;
    }
    while (feed_->take(state)) {
        schedule_.take(state);
    }
    const HeardLine line = feed_->heard_line();
    while (const auto notice = schedule_.next(line.heard_by(now))) {
        tell(*notice, line);
    }
}

void Outputs::tell(const Notice& notice, const HeardLine& line) {
    for (Open& open : outputs_) {
        open.output->tell({notice, line.heard_at(notice.time)});
        if (auto trouble = open.output->take_trouble()) {
            const std::lock_guard lock(mutex_);
            lines_.push_back(std::move(*trouble));
        }
    }
}

HostTime Outputs::next_turn(HostTime now) {
    const HostTime latest = now + kLongestNap;
    const auto next = schedule_.next_time();
    if (!feed_ || !next) {
        return latest;
    }
    const HeardLine line = feed_->heard_line();
    return line.clock.is_running ? std::clamp(line.heard_at(*next), now, latest) : latest;
}

}  // namespace raks::engine
