#include "audio/song/song_sections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "audio/form/section_rules.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr double kFull = 0.75;           // share of the bars that are less full than the full band
constexpr std::size_t kLeastBeats = 4;   // of a breakdown
constexpr std::size_t kRisingBeats = 8;  // of a breakdown that can hold a build-up
constexpr double kSteadyBeat = 0.5;      // seconds, where a song has no beats
constexpr std::size_t kPhraseBeats = 16;
constexpr float kBuildUpRise = 1.2F;  // rise_of() from its first two beats to its last
constexpr double kMuchBetter = 0.6;   // of the misfit without it: a build-up
// Onsets beside the full band's: more is a roll that leads to the drop, not the drop.
constexpr float kMostOnsets = 1.35F;
constexpr float kMostLowOnsets = 1.8F;

// The song's beats with the sound between any two of them, pauses left out.
class SongStretches {
 public:
    SongStretches(std::span<const HopSound> sounds,
                  const std::vector<SongPause>& pauses,
                  std::vector<std::size_t> hops,
                  std::size_t bar)
        : hops_(std::move(hops)), bar_(bar) {
        SoundSums sums;
        std::size_t count = 0;
        std::size_t next_beat = 0;
        auto pause = pauses.begin();
        for (std::size_t hop = 0; hop <= sounds.size(); ++hop) {
            for (; next_beat < hops_.size() && hops_[next_beat] == hop; ++next_beat) {
                sums_.push_back(sums);
                counts_.push_back(count);
            }
            while (pause != pauses.end() && pause->end <= hop) {
                ++pause;
            }
            if (hop < sounds.size() && (pause == pauses.end() || hop < pause->first)) {
                sums = sums.plus(sounds[hop]);
                ++count;
            }
        }
    }
    // Beats that are compared: those of a bar, or of two of two beats.
    [[nodiscard]] std::size_t bar() const { return bar_; }
    // Beats, the end of the song included.
    [[nodiscard]] std::size_t size() const { return sums_.size(); }
    [[nodiscard]] std::size_t hop_of(std::size_t beat) const { return hops_[beat]; }
    // Whether anything sounds between two beats.
    [[nodiscard]] bool has_sound(std::size_t from, std::size_t to) const {
        return counts_[to] > counts_[from];
    }
    // Whether most of it is a pause.
    [[nodiscard]] bool is_quiet(std::size_t from, std::size_t to) const {
        return sounding_share(from, to) < 0.5;
    }
    // How much of it sounds, 0 to 1.
    [[nodiscard]] double sounding_share(std::size_t from, std::size_t to) const {
        return static_cast<double>(counts_[to] - counts_[from]) /
               static_cast<double>(std::max<std::size_t>(1, hops_[to] - hops_[from]));
    }
    [[nodiscard]] StretchSound mean(std::size_t from, std::size_t to) const {
        return sums_[to].since(sums_[from], std::max<std::size_t>(1, counts_[to] - counts_[from]));
    }
    // Of the bar that begins or ends at a beat, as much of it as there is.
    [[nodiscard]] StretchSound after(std::size_t beat) const {
        return mean(beat, std::min(size() - 1, beat + bar_));
    }
    [[nodiscard]] StretchSound before(std::size_t beat) const {
        return mean(beat - std::min(beat, bar_), beat);
    }

 private:
    std::vector<std::size_t> hops_;
    std::size_t bar_;  // beats
    std::vector<SoundSums> sums_;
    std::vector<std::size_t> counts_;  // hops that sounded before the beat
};

// Hops of the beats, and of the end; for each whether it is a downbeat.
std::vector<std::size_t> beat_hops(const std::vector<SongBeat>& beats,
                                   std::size_t hops,
                                   std::vector<char>& downbeats) {
    std::vector<std::size_t> result;
    for (const SongBeat& beat : beats) {
        const double hop = std::round(to_seconds(beat.time) * kHopsPerSecond);
        const auto at = static_cast<std::size_t>(std::max(0.0, hop));
        if (at < hops && (result.empty() || at > result.back())) {
            result.push_back(at);
            downbeats.push_back(beat.place.position == 0 ? 1 : 0);
        }
    }
    if (result.size() < 2) {
        result.clear();
        const auto step = static_cast<std::size_t>(kSteadyBeat * kHopsPerSecond);
        for (std::size_t hop = 0; hop < hops; hop += step) {
            result.push_back(hop);
        }
    }
    result.push_back(hops);
    downbeats.resize(result.size(), 0);
    return result;
}

// The full band: the higher values of all bars.
StretchSound full_band(const SongStretches& beats) {
    std::vector<double> low;
    std::vector<double> level;
    std::vector<double> low_onsets;
    std::vector<double> onsets;
    for (std::size_t beat = 0; beat + beats.bar() < beats.size(); ++beat) {
        if (!beats.has_sound(beat, beat + beats.bar())) {
            continue;
        }
        const StretchSound bar = beats.after(beat);
        low.push_back(static_cast<double>(bar.low));
        level.push_back(static_cast<double>(bar.level));
        low_onsets.push_back(static_cast<double>(bar.low_onsets));
        onsets.push_back(static_cast<double>(bar.onsets));
    }
    const auto high = [](const std::vector<double>& values) {
        return static_cast<float>(percentile(values, kFull));
    };
    return {high(low), high(level), high(low_onsets), high(onsets), 0.0F};
}

// Finds the parts of a song beat by beat.
class SectionFinder {
 public:
    SectionFinder(const SongStretches& song, std::vector<char> downbeats)
        : song_(song), bar_(song.bar()), downbeats_(std::move(downbeats)), full_(full_band(song)) {}

    [[nodiscard]] std::vector<SongBreakdown> find() const {
        std::vector<SongBreakdown> breakdowns;
        for (std::size_t beat = 0; beat + 1 < song_.size();) {
            std::size_t end = beat;
            while (end + 1 < song_.size() && is_fallen(end)) {
                ++end;
            }
            if (end - beat < kLeastBeats) {
                beat = end + 1;
                continue;
            }
            // A song may begin calm; a pickup is nothing yet.
            if (beat == 0 && end < kRisingBeats) {
                beat = end + 1;
                continue;
            }
            const std::size_t first = beat == 0 ? 0 : place_of_fall(beat);
            if (first > 0 && step_at(first) < kLeastStepDown) {
                beat = end + 1;  // it fades
                continue;
            }
            const std::size_t back = place_of_return(std::max(first + kLeastBeats / 2, end));
            if (!fades(first, back)) {
                breakdowns.push_back(breakdown_of(first, back));
            }
            beat = std::max(back, end) + 1;
        }
        return breakdowns;
    }

 private:
    [[nodiscard]] bool is_fallen(std::size_t beat) const {
        const std::size_t from = beat - std::min(beat, bar_ / 2);
        const std::size_t to = std::min(song_.size() - 1, beat + bar_ / 2);
        return song_.has_sound(from, to) && fall_of(song_.mean(from, to), full_).is_breakdown();
    }

    // Whether the whole band plays between two beats, without a roll.
    [[nodiscard]] bool is_full(std::size_t from, std::size_t to) const {
        const StretchSound now = song_.mean(from, to);
        return song_.sounding_share(from, to) > 0.9 && fall_of(now, full_).is_full() &&
               now.onsets < kMostOnsets * full_.onsets + 0.05F &&
               now.low_onsets < kMostLowOnsets * full_.low_onsets + 0.05F;
    }

    // Whether the song becomes softer from a beat on until it is over.
    [[nodiscard]] bool fades(std::size_t first, std::size_t back) const {
        if (back + 1 < song_.size() || first + 2 * bar_ >= song_.size()) {
            return false;
        }
        std::size_t end = back;
        while (end > first + bar_ && song_.is_quiet(end - 1, end)) {
            --end;
        }
        return song_.before(end).level < song_.after(first).level - 5.0F;
    }

    [[nodiscard]] float step_at(std::size_t beat) const {
        return step_down(song_.before(beat), song_.after(beat), full_);
    }

    // The beat within a bar of `border` at which the sound falls most; rather on a downbeat.
    [[nodiscard]] std::size_t place_of_fall(std::size_t border) const {
        const std::size_t first = std::max<std::size_t>(1, border - std::min(border, bar_));
        const std::size_t last = std::min(song_.size() - 2, border + bar_);
        std::size_t best = border;
        float greatest = -1e9F;
        for (std::size_t beat = first; beat <= last; ++beat) {
            const float step = step_at(beat) * (downbeats_[beat] != 0 ? kDownbeat : 1.0F);
            if (step > greatest) {
                greatest = step;
                best = beat;
            }
        }
        return best;
    }

    // Whether the band plays for a bar from this beat on, and goes on to.
    [[nodiscard]] bool is_back(std::size_t beat) const {
        const std::size_t last = song_.size() - 1;
        return beat + bar_ < last && is_full(beat, beat + bar_) &&
               is_full(beat + bar_ / 2, std::min(last, beat + bar_ + bar_ / 2));
    }

    // The first beat from `from` on at which the band is back; the end: there is none. A build-up
    // may sound full before its end: what comes out of a stop soon after is the return.
    [[nodiscard]] std::size_t place_of_return(std::size_t from) const {
        const std::size_t last = song_.size() - 1;
        for (std::size_t beat = from; beat < last; ++beat) {
            if (!is_back(beat)) {
                continue;
            }
            for (std::size_t at = beat - std::min(beat - from, bar_);
                 at < std::min(last, beat + kPhraseBeats);
                 ++at) {
                const bool comes_out = at > 0 && song_.is_quiet(at - 1, at);
                if (comes_out && !song_.is_quiet(at, at + 1) && (at <= beat || is_back(at))) {
                    return at;
                }
            }
            return steepest_near(beat);
        }
        return last;
    }

    // Within two beats: rather out of a stop, or on a downbeat.
    [[nodiscard]] std::size_t steepest_near(std::size_t beat) const {
        std::size_t best = beat;
        float greatest = -1e9F;
        const std::size_t last = std::min(song_.size() - 2, beat + 2);
        for (std::size_t at = beat - std::min<std::size_t>(beat, 2); at <= last; ++at) {
            const float step = song_.is_quiet(at, at + 1) ? -1e8F : rise_at(at);
            if (step > greatest) {
                greatest = step;
                best = at;
            }
        }
        return best;
    }

    // How likely everything comes in at a beat.
    [[nodiscard]] float rise_at(std::size_t beat) const {
        const std::size_t before = beat - std::min<std::size_t>(beat, 1);
        const StretchSound after = song_.mean(beat, std::min(song_.size() - 1, beat + 2));
        const StretchSound last = song_.before(beat);
        const float step = (after.low - last.low) / 8.0F + (after.level - last.level) / 6.0F;
        const bool is_entry = beat > 0 && song_.is_quiet(before, beat);
        return step + (downbeats_[beat] != 0 ? 0.5F : 0.0F) + (is_entry ? 2.0F : 0.0F);
    }

    [[nodiscard]] SongBreakdown breakdown_of(std::size_t first, std::size_t back) const {
        SongBreakdown found;
        found.first = song_.hop_of(first);
        found.build_up = found.end = song_.hop_of(back);
        found.drops = back + 1 < song_.size();
        if (found.drops && back - first >= kRisingBeats) {
            if (const auto knee = knee_of(first, back)) {
                found.build_up = song_.hop_of(*knee);
            }
        }
        return found;
    }

    // The beat from which it rises, if it does: as it is before that beat, on a straight line after
    // it, as well as can be (least squares over level, brightness and onsets).
    [[nodiscard]] std::optional<std::size_t> knee_of(std::size_t first, std::size_t end) const {
        // A stop before the drop, and the last chord before that, do not rise.
        for (std::size_t beat = end - std::min(end - first, kPhraseBeats); beat < end; ++beat) {
            if (song_.sounding_share(beat, beat + 1) < 0.9) {
                end = std::max(first + 1, beat - std::min<std::size_t>(beat, 1));
            }
        }
        std::vector<StretchSound> beats;
        for (std::size_t beat = first; beat < end; ++beat) {
            beats.push_back(song_.mean(beat, beat + 1));
        }
        std::optional<std::size_t> best;
        double least = kMuchBetter * misfit(beats, beats.size());
        for (std::size_t knee = kLeastBeats / 2; knee + bar_ <= beats.size(); ++knee) {
            const StretchSound begin = song_.mean(first + knee, first + knee + 2);
            const StretchSound last = song_.mean(end - 2, end);
            const double error = misfit(beats, knee) - (downbeats_[first + knee] != 0 ? 0.3 : 0.0);
            if (error < least && rise_of(begin, last, full_) > kBuildUpRise) {
                least = error;
                best = first + knee;
            }
        }
        return best;
    }

    // Sum of squares of what is left of the beats: a mean before the knee, a line from it on.
    [[nodiscard]] double misfit(const std::vector<StretchSound>& beats, std::size_t knee) const {
        const auto value = [&](std::size_t i, int part) {
            switch (part) {
                case 0:
                    return static_cast<double>(std::max(beats[i].level, full_.level - 40.0F)) / 6.0;
                case 1:
                    return static_cast<double>(std::max(beats[i].low, full_.low - 40.0F)) / 8.0;
                case 2:
                    return static_cast<double>(beats[i].brightness) / 20.0;
                default:
                    return static_cast<double>(beats[i].onsets / (full_.onsets + 1e-3F));
            }
        };
        double error = 0.0;
        for (int part = 0; part < 4; ++part) {
            for (const bool is_line : {false, true}) {
                const std::size_t from = is_line ? knee : 0;
                const std::size_t to = is_line ? beats.size() : knee;
                double n = 0.0, x = 0.0, xx = 0.0, y = 0.0, xy = 0.0, yy = 0.0;
                for (std::size_t i = from; i < to; ++i) {
                    const double place = is_line ? static_cast<double>(i - from) : 0.0;
                    const double height = value(i, part);
                    n += 1.0;
                    x += place;
                    xx += place * place;
                    y += height;
                    xy += place * height;
                    yy += height * height;
                }
                const double spread = n * xx - x * x;
                const double slope = spread > 1e-9 ? (n * xy - x * y) / spread : 0.0;
                const double base = n > 0.0 ? (y - slope * x) / n : 0.0;
                error += yy - base * y - slope * xy;
            }
        }
        return error;
    }

    static constexpr float kDownbeat = 1.3F;  // by which a downbeat is likelier

    const SongStretches& song_;
    std::size_t bar_;
    std::vector<char> downbeats_;  // by beat
    StretchSound full_;
};

}  // namespace

std::vector<SongBreakdown> find_breakdowns(std::span<const HopSound> sounds,
                                           const std::vector<SongPause>& pauses,
                                           const std::vector<SongBeat>& beats) {
    std::vector<char> downbeats;
    // The metre of most songs does not change; four beats where bars are short.
    const bool is_in_three = !beats.empty() && beats[beats.size() / 2].place.beats_per_bar == 3;
    const std::size_t bar = is_in_three ? 3 : 4;
    const SongStretches song(sounds, pauses, beat_hops(beats, sounds.size(), downbeats), bar);
    if (song.size() < 2 * bar) {
        return {};
    }
    return SectionFinder(song, std::move(downbeats)).find();
}

}  // namespace raks::audio
