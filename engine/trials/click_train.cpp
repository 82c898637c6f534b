#include "engine/trials/click_train.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/statistics.hpp"
#include "engine/trials/best_match.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr double kFirstClick = 2.5;   // seconds
constexpr double kAfterClicks = 0.1;  // until the last one has faded
constexpr double kClickSeconds = 0.012;
constexpr double kLowHz = 1000.0;
constexpr double kHighHz = 6000.0;
constexpr double kAmplitude = 0.7;
// Offsets that a loop is searched for.
constexpr int kLeastMs = -100;
constexpr int kMostMs = 2100;
// The coarse search is off by a click's length at most.
constexpr double kFineSeconds = 0.02;
// Below this a click is lost in noise or in the echo of a room.
constexpr double kLeastLikeness = 0.5;
constexpr Nanos kLoopSpread = std::chrono::milliseconds(20);
constexpr Nanos kTapSpread = std::chrono::milliseconds(60);

double ms(Nanos span) { return 1e3 * to_seconds(span); }

// Median and quartiles; there is at least one.
MeasuredOffset measured(const std::vector<double>& seconds) {
    return {nanos_from_seconds(percentile(seconds, 0.5)),
            nanos_from_seconds(percentile(seconds, 0.75) - percentile(seconds, 0.25)),
            static_cast<int>(seconds.size())};
}

// The strength of each millisecond of a recording. Differences of neighbours take rumble out; what
// is louder than all but a hundredth counts as that, so that one bang is not taken for many clicks.
std::vector<double> strengths(std::span<const float> samples, SampleRate rate) {
    const double per_ms = rate.hertz() * 1e-3;
    std::vector<double> strengths(
        static_cast<std::size_t>(static_cast<double>(samples.size()) / per_ms) + 1);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double step = static_cast<double>(samples[i]) - static_cast<double>(samples[i - 1]);
        strengths[static_cast<std::size_t>(static_cast<double>(i) / per_ms)] += step * step;
    }
    const double loud = percentile(strengths, 0.99);
    for (double& strength : strengths) {
        strength = std::sqrt(std::min(strength, loud));
    }
    return strengths;
}

// The offset at which most clicks meet sound, in whole milliseconds. `expected`: where in the
// recording each click would be with the offset 0, in milliseconds.
int coarse_offset(const std::vector<double>& expected, const std::vector<double>& strengths) {
    int best = 0;
    double best_sum = -1.0;
    for (int offset = kLeastMs; offset <= kMostMs; ++offset) {
        double sum = 0.0;
        for (const double place : expected) {
            const auto at = static_cast<std::int64_t>(std::floor(place)) + offset;
            sum += at >= 0 && at < std::ssize(strengths) ? strengths[static_cast<std::size_t>(at)]
                                                         : 0.0;
        }
        if (sum > best_sum) {
            best = offset;
            best_sum = sum;
        }
    }
    return best;
}

}  // namespace

ClickTrain irregular_clicks(int count) {
    constexpr CounterRandom kDistances(1);
    ClickTrain train;
    double at = kFirstClick;
    for (int i = 0; i < count; ++i) {
        train.clicks.push_back(at);
        at += 0.3 + 0.3 * kDistances.uniform(static_cast<std::uint64_t>(i));
    }
    train.seconds = train.clicks.back() + kAfterClicks;
    return train;
}

ClickTrain regular_clicks(int count, double distance) {
    ClickTrain train;
    for (int i = 0; i < count; ++i) {
        train.clicks.push_back(kFirstClick + i * distance);
    }
    train.seconds = train.clicks.back() + kAfterClicks;
    return train;
}

std::vector<float> click_sound(SampleRate rate) {
    std::vector<float> click(static_cast<std::size_t>(kClickSeconds * rate.hertz()));
    for (std::size_t i = 0; i < click.size(); ++i) {
        const double t = static_cast<double>(i) / rate.hertz();
        const double window = std::sin(M_PI * t / kClickSeconds);
        // The phase of a tone whose frequency rises evenly.
        const double phase =
            2.0 * M_PI * (kLowHz * t + 0.5 * (kHighHz - kLowHz) * t * t / kClickSeconds);
        click[i] = static_cast<float>(kAmplitude * window * window * std::sin(phase));
    }
    return click;
}

std::vector<float> sound_of(const ClickTrain& train, SampleRate rate) {
    std::vector<float> sound(static_cast<std::size_t>(train.seconds * rate.hertz()));
    const std::vector<float> click = click_sound(rate);
    for (const double at : train.clicks) {
        const auto first = static_cast<std::ptrdiff_t>(std::llround(at * rate.hertz()));
        std::copy(click.begin(), click.end(), sound.begin() + first);
    }
    return sound;
}

Expected<MeasuredOffset> loop_offset(const ClickTrain& train,
                                     const BlockClock& sent,
                                     const LoopRecording& heard) {
    const SampleRate rate = heard.rate();
    std::vector<HostTime> due;
    std::vector<double> expected;  // milliseconds into the recording
    for (const double click : train.clicks) {
        due.push_back(sent.heard_at(std::llround(click * sent.rate().hertz())));
        expected.push_back(1e3 * static_cast<double>(heard.clock().frame_near(due.back())) /
                           rate.hertz());
    }
    const int coarse = coarse_offset(expected, strengths(heard.samples(), rate));
    const std::vector<float> click = click_sound(rate);
    const std::int64_t reach = std::llround(kFineSeconds * rate.hertz());
    std::vector<double> offsets;
    for (std::size_t i = 0; i < due.size(); ++i) {
        const std::int64_t near = std::llround(1e-3 * (expected[i] + coarse) * rate.hertz());
        const Match match = best_match(heard.samples(), click, near - reach, near + reach + 1);
        if (match.correlation >= kLeastLikeness) {
            offsets.push_back(to_seconds(heard.heard_at(match.place) - due[i]));
        }
    }
    if (2 * offsets.size() < train.clicks.size()) {
        return fail(fmt::format(
            "only {} of {} clicks came back: turn the loudspeaker up, or bring the microphone "
            "nearer",
            offsets.size(),
            train.clicks.size()));
    }
    const MeasuredOffset result = measured(offsets);
    if (result.quartiles > kLoopSpread) {
        return fail(fmt::format(
            "the clicks came back at times {:.0f} ms apart (quartiles): the machine is busy, or "
            "the room too loud",
            ms(result.quartiles)));
    }
    return result;
}

Expected<MeasuredOffset> tap_offset(std::span<const HostTime> clicks,
                                    std::span<const HostTime> taps) {
    std::vector<double> offsets;
    for (const HostTime tap : clicks.empty() ? std::span<const HostTime>() : taps) {
        const auto after = std::lower_bound(clicks.begin(), clicks.end(), tap);
        const auto next = after == clicks.end() ? after - 1 : after;
        const auto before = after == clicks.begin() ? after : after - 1;
        const double late = to_seconds(tap - *before);
        const double early = to_seconds(tap - *next);
        const double offset = std::abs(late) <= std::abs(early) ? late : early;
        const double distance = clicks.size() > 1 ? to_seconds(clicks[1] - clicks[0]) : 1.0;
        if (std::abs(offset) <= 0.5 * distance) {
            offsets.push_back(offset);
        }
    }
    if (offsets.size() < kTaps) {
        return fail(
            fmt::format("{} taps to the clicks are needed, {} came", kTaps, offsets.size()));
    }
    const MeasuredOffset result = measured(offsets);
    if (result.quartiles > kTapSpread) {
        return fail(fmt::format(
            "the taps lie {:.0f} ms apart (quartiles; 60 at most): tap on the clicks themselves, "
            "once each",
            ms(result.quartiles)));
    }
    return result;
}

}  // namespace raks::engine
