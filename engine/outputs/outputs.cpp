#include "engine/outputs/outputs.hpp"

#include <algorithm>
#include <utility>

#include "base/sleep_until.hpp"
#include "base/suggest.hpp"
#include "base/thread_priority.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// States come every 10 ms, and a grid may move the next beat nearer.
constexpr Nanos kLongestNap = std::chrono::milliseconds(5);
// Beats are known so far ahead. What is known earlier, as of a song that is known, waits: a song
// that will end is not unlocked yet.
constexpr Nanos kScheduledAhead = std::chrono::milliseconds(100);
// Of music that has begun before it is followed: the beginning of a song is not lost.
constexpr Nanos kStillNew = std::chrono::seconds(1);

}  // namespace

std::string OutputWish::text() const { return fmt::format("{} {}", kind->option, target); }

Expected<OutputWish> parse_output_wish(const std::string& text) {
    const std::size_t space = std::min(text.find(' '), text.size());
    std::vector<std::string_view> options;
    for (const OutputKind& kind : output_kinds()) {
        options.push_back(kind.option);
        if (text.substr(0, space) != kind.option) {
            continue;
        }
        OutputWish wish{&kind, text.substr(std::min(space + 1, text.size()))};
        if (auto checked = kind.check(wish.target); !checked) {
            return fail(fmt::format("--{}: {}", kind.option, checked.error().message));
        }
        return wish;
    }
    return fail(unknown_name("output", text.substr(0, space), options));
}

Expected<std::unique_ptr<Outputs>> Outputs::open(const std::vector<OutputWish>& wishes) {
    std::vector<Open> outputs;
    for (const OutputWish& wish : wishes) {
        auto output = wish.kind->open(wish.target);
        if (!output) {
            return fail(output.error());
        }
        const BeatSchedule schedule((*output)->timing().pace);
        outputs.push_back({wish.kind, wish.target, std::move(*output), {}, schedule});
    }
    return std::unique_ptr<Outputs>(new Outputs(std::move(outputs)));
}

Outputs::Outputs(std::vector<Open> outputs) : outputs_(std::move(outputs)) {
    if (!outputs_.empty()) {
        hops_.resize(kKeptHops);
        thread_ = std::thread([this] { run(); });
    }
}

Outputs::~Outputs() {
    is_stopping_ = true;
    if (thread_.joinable()) {
        thread_.join();
    }
}

void Outputs::follow(std::shared_ptr<MusicFeed> feed, std::shared_ptr<const DanceList> dances) {
    if (want_poses()) {
        feed->ask_for_stage();
    }
    const std::lock_guard lock(mutex_);
    next_feed_ = std::move(feed);
    next_dances_ = std::move(dances);
}

bool Outputs::want_poses() const noexcept {
    return std::any_of(outputs_.begin(), outputs_.end(), [](const Open& open) {
        return open.output->wants_poses();
    });
}

void Outputs::wear(const OutputLook& look) {
    if (look == worn_) {
        return;
    }
    worn_ = look;
    const std::lock_guard lock(mutex_);
    next_look_ = look;
}

void Outputs::name_song(const SongName& song) {
    const std::lock_guard lock(mutex_);
    song_ = song;
}

std::vector<std::string> Outputs::take_lines() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lines_, {});
}

std::vector<std::string> Outputs::losses() const {
    std::vector<std::string> lines;
    for (const Open& open : outputs_) {
        if (const auto dropped = open.output->dropped(); dropped > 0) {
            lines.push_back(fmt::format("--{} {}: {} of {} messages were lost",
                                        open.kind->option,
                                        open.target,
                                        dropped,
                                        dropped + open.output->sent()));
        }
    }
    return lines;
}

std::vector<OutputStatus> Outputs::status() const {
    const std::lock_guard lock(mutex_);
    std::vector<OutputStatus> all;
    for (const Open& open : outputs_) {
        all.push_back({fmt::format("--{} {}", open.kind->option, open.target),
                       open.output->sent(),
                       open.output->dropped(),
                       open.trouble});
    }
    return all;
}

void Outputs::run() noexcept {
    prefer_this_thread(RealtimeThread::outputs);
    while (!is_stopping_) {
        turn(host_now());
        sleep_until(next_turn(host_now()));
    }
}

void Outputs::turn(HostTime now) {
    take_feed(now);
    take_look();
    if (feed_) {
        while (feed_->take(hops_[taken_ % kKeptHops])) {
            ++taken_;
        }
        line_ = feed_->heard_line();
        stage_ = feed_->stage();
    }
    for (Open& open : outputs_) {
        serve(open, now);
    }
}

void Outputs::take_feed(HostTime now) {
    const std::lock_guard lock(mutex_);
    if (!next_feed_) {
        return;
    }
    feed_ = std::exchange(next_feed_, nullptr);
    dances_ = std::exchange(next_dances_, nullptr);
    taken_ = 0;
    line_ = feed_->heard_line();
    const StreamTime oldest = line_->heard_by(now) - kStillNew;
    while (feed_->take(hops_[taken_ % kKeptHops])) {
        taken_ += hops_[taken_ % kKeptHops].music.time >= oldest ? 1U : 0U;
    }
    for (Open& open : outputs_) {
        open.schedule = BeatSchedule(open.output->timing().pace);
        open.scheduled = open.heard = 0;
    }
}

void Outputs::take_look() {
    const std::lock_guard lock(mutex_);
    if (next_look_) {
        look_ = std::exchange(next_look_, std::nullopt);
    }
}

void Outputs::serve(Open& open, HostTime now) {
    if (line_) {
        tell_music(open, line_->heard_by(now + open.output->timing().lead));
    }
    tell_name(open);
    OutputTurn turn{now, line_, told_at(open, open.schedule.next_beat_time())};
    if (stage_ != nullptr && look_ && open.output->wants_poses()) {
        turn.dancers.emplace(OutputDancers{*stage_, *look_});
    }
    open.output->turn(turn);
    if (auto trouble = open.output->take_trouble()) {
        const std::lock_guard lock(mutex_);
        open.trouble = *trouble;
        lines_.push_back(fmt::format("--{} {}", open.kind->option, *trouble));
    }
}

void Outputs::tell_name(Open& open) {
    {
        const std::lock_guard lock(mutex_);
        if (open.named == song_) {
            return;
        }
        open.named = song_;
    }
    open.output->name_song(open.named);
}

// Everything up to `heard`, in the order of an output's contract.
void Outputs::tell_music(Open& open, StreamTime heard) {
    const FeedHop* hop = nullptr;
    for (; (hop = hop_at(open.scheduled)) != nullptr && hop->music.time <= heard + kScheduledAhead;
         ++open.scheduled) {
        open.schedule.take(hop->music);
    }
    for (; (hop = hop_at(open.heard)) != nullptr && hop->music.time <= heard; ++open.heard) {
        open.output->hear({hop->music, hop->figure, *dances_});
    }
    while (const auto notice = open.schedule.next(heard)) {
        open.output->tell({*notice, line_->heard_at(notice->time)});
    }
}

// The hop of this number, or the oldest that is kept; null: it has not come yet.
const FeedHop* Outputs::hop_at(std::uint64_t& number) const {
    number = std::max(number, taken_ - std::min<std::uint64_t>(taken_, kKeptHops));
    return number < taken_ ? &hops_[number % kKeptHops] : nullptr;
}

// When a target is told of what sounds at `time`.
std::optional<HostTime> Outputs::told_at(const Open& open, std::optional<StreamTime> time) const {
    return line_ && line_->clock.is_running && time
               ? std::optional(line_->heard_at(*time) - open.output->timing().lead)
               : std::nullopt;
}

HostTime Outputs::next_turn(HostTime now) const {
    HostTime next = now + kLongestNap;
    for (const Open& open : outputs_) {
        for (const auto& due : {told_at(open, open.schedule.next_time()), open.output->due()}) {
            next = due ? std::min(next, *due) : next;
        }
    }
    return std::max(next, now);
}

}  // namespace raks::engine
