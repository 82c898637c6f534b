#include "audio/song/song_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "audio/form/section_rules.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr double kAroundSeconds = 60.0;  // to either side: the bars that make the full band
constexpr std::size_t kBandBeats = 8;    // between two looks at the full band
constexpr std::size_t kLeastBeats = 3;   // of a breakdown
// calmness() of a breakdown as a whole.
constexpr float kLeastCalm = 0.4F;
// A beat counts so much at most, and a change between calm and full costs so much.
constexpr float kMostOfABeat = 2.0F;
constexpr float kChange = 3.0F;
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

// The full band around each beat: a song may have a thin half and a thick one.
std::vector<FullBand> full_bands(const SongStretches& beats) {
    struct Bar {
        double time = 0.0;
        StretchSound sound;
    };
    std::vector<Bar> bars;
    for (std::size_t beat = 0; beat + beats.bar() < beats.size(); ++beat) {
        if (beats.has_sound(beat, beat + beats.bar())) {
            bars.push_back(
                {static_cast<double>(beats.hop_of(beat)) / kHopsPerSecond, beats.after(beat)});
        }
    }
    std::vector<FullBand> bands;
    std::size_t first = 0;
    std::size_t end = 0;
    for (std::size_t beat = 0; beat < beats.size(); ++beat) {
        if (beat % kBandBeats != 0) {
            bands.push_back(bands.back());
            continue;
        }
        const std::size_t middle = std::min(beats.size() - 1, beat + kBandBeats / 2);
        const double time = static_cast<double>(beats.hop_of(middle)) / kHopsPerSecond;
        while (first < bars.size() && bars[first].time < time - kAroundSeconds) {
            ++first;
        }
        while (end < bars.size() && bars[end].time <= time + kAroundSeconds) {
            ++end;
        }
        bands.push_back(FullBand::of([&](double share, float StretchSound::*part) {
            std::vector<double> values;
            for (std::size_t i = first; i < end; ++i) {
                values.push_back(static_cast<double>(bars[i].sound.*part));
            }
            return static_cast<float>(percentile(values, share));
        }));
    }
    return bands;
}

// Finds the parts of a song beat by beat.
class SectionFinder {
 public:
    SectionFinder(const SongStretches& song, std::vector<char> downbeats)
        : song_(song),
          bar_(song.bar()),
          downbeats_(std::move(downbeats)),
          full_(full_bands(song)) {}

    [[nodiscard]] std::vector<SongBreakdown> find() const {
        std::vector<SongBreakdown> breakdowns;
        const std::vector<char> calm = calm_beats();
        for (std::size_t beat = 0; beat < calm.size();) {
            std::size_t end = beat;
            while (end < calm.size() && calm[end] != 0) {
                ++end;
            }
            if (end == beat) {
                ++beat;
                continue;
            }
            const auto found = breakdown_in(beat, end);
            if (found) {
                breakdowns.push_back(breakdown_of(found->first, found->second));
            }
            beat = std::max(end, found ? found->second : 0);
        }
        return breakdowns;
    }

 private:
    // Beats from the fall to the return.
    using Beats = std::pair<std::size_t, std::size_t>;

    // Of a stretch of calm beats: where the rhythm section leaves and is back, if it does.
    [[nodiscard]] std::optional<Beats> breakdown_in(std::size_t from, std::size_t to) const {
        // A song may begin calm; a pickup is nothing yet.
        const bool begins_it = !song_.has_sound(0, from - std::min(from, bar_));
        if (begins_it && to < kRisingBeats) {
            return std::nullopt;
        }
        const std::size_t first = begins_it ? 0 : place_of_fall(from);
        const std::size_t last = to + 1 < song_.size() ? place_of_rise(to) : song_.size() - 1;
        const bool has_steps = (first == 0 || step_at(first) >= kLeastStep) &&
                               (last >= first + 2 * bar_ || -step_at(last) >= kLeastStep);
        if (last < first + kLeastBeats || !has_steps ||
            calmness(song_.mean(first, last), full_[first]) < kLeastCalm) {
            return std::nullopt;
        }
        if (first == 0 && last + 1 < song_.size()) {
            // What grows has no return.
            return has_come_in(last) ? std::optional<Beats>({first, last}) : std::nullopt;
        }
        const std::size_t back = place_of_return(first, last);
        return Beats{first, back};
    }

    // Whether the band of a song that began calm comes in at a beat.
    [[nodiscard]] bool has_come_in(std::size_t beat) const {
        return comes_in(song_.mean(beat - std::min(beat, 2 * bar_), beat),
                        song_.mean(beat, std::min(song_.size() - 1, beat + 2)));
    }

    // Calmness of the bar around a beat.
    [[nodiscard]] float calmness_at(std::size_t beat) const {
        const std::size_t from = beat - std::min(beat, bar_ / 2);
        const std::size_t to = std::min(song_.size() - 1, beat + bar_ / 2);
        return song_.is_quiet(from, to) ? 0.0F : calmness(song_.mean(from, to), full_[beat]);
    }

    // By beat, whether the rhythm section is gone: the likeliest path of the two, where each change
    // costs (Viterbi).
    [[nodiscard]] std::vector<char> calm_beats() const {
        const std::size_t count = song_.size() - 1;
        std::array<float, 2> score{};
        std::vector<std::array<std::uint8_t, 2>> from(count);
        for (std::size_t beat = 0; beat < count; ++beat) {
            const float gain = 0.5F * std::clamp(calmness_at(beat), -kMostOfABeat, kMostOfABeat);
            const std::array<float, 2> before = score;
            for (std::size_t state = 0; state < 2; ++state) {
                const bool changes = before[1 - state] - 0.5F * kChange > before[state];
                from[beat][state] = static_cast<std::uint8_t>(changes ? 1 - state : state);
                score[state] = (changes ? before[1 - state] - 0.5F * kChange : before[state]) +
                               (state == 1 ? gain : -gain);
            }
        }
        std::vector<char> calm(count);
        auto state = static_cast<std::size_t>(score[1] > score[0]);
        for (std::size_t beat = count; beat-- > 0;) {
            calm[beat] = static_cast<char>(state);
            state = from[beat][state];
        }
        return calm;
    }

    // Whether the whole band plays between two beats, without a roll.
    [[nodiscard]] bool is_full(std::size_t from, std::size_t to) const {
        const StretchSound now = song_.mean(from, to);
        const FullBand& full = full_[from];
        return song_.sounding_share(from, to) > 0.9 && calmness(now, full) < kFullBelow &&
               now.onsets < kMostOnsets * full.usual.onsets + 0.05F &&
               now.low_onsets < kMostLowOnsets * full.usual.low_onsets + 0.05F;
    }

    // How much calmer the bar after a beat is than the bar before it.
    [[nodiscard]] float step_at(std::size_t beat) const {
        return calmness(song_.after(beat), full_[beat]) - calmness(song_.before(beat), full_[beat]);
    }

    // The beat within a bar of `border` at which the sound falls most; rather on a downbeat.
    [[nodiscard]] std::size_t place_of_fall(std::size_t border) const {
        return steepest(border, 1.0F);
    }
    [[nodiscard]] std::size_t place_of_rise(std::size_t border) const {
        return steepest(border, -1.0F);
    }
    [[nodiscard]] std::size_t steepest(std::size_t border, float sign) const {
        const std::size_t first = std::max<std::size_t>(1, border - std::min(border, bar_));
        const std::size_t last = std::min(song_.size() - 2, border + bar_);
        std::size_t best = border;
        float greatest = -1e9F;
        for (std::size_t beat = first; beat <= last; ++beat) {
            const float step = sign * step_at(beat) * (downbeats_[beat] != 0 ? kDownbeat : 1.0F);
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

    // The beat at which the band is back, near where it is no longer calm; the end: there is none.
    // A build-up may sound full before its end: a roll is not the return, and what comes out of a
    // stop soon after is.
    [[nodiscard]] std::size_t place_of_return(std::size_t first, std::size_t risen) const {
        const std::size_t last = song_.size() - 1;
        const std::size_t from = std::max(first + 2, risen - std::min<std::size_t>(risen, 1));
        for (std::size_t beat = from; beat < std::min(last, risen + kPhraseBeats); ++beat) {
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
            return beat <= risen + 1 ? risen : steepest_near(beat);
        }
        return risen;
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
        // A song that begins calm grows: that is no build-up.
        if (found.drops && first > 0 && back - first >= kRisingBeats) {
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
        const FullBand& full = full_[first];
        std::vector<StretchSound> beats;
        for (std::size_t beat = first; beat < end; ++beat) {
            beats.push_back(song_.mean(beat, beat + 1));
        }
        std::optional<std::size_t> best;
        double least = kMuchBetter * misfit(beats, beats.size(), full.usual);
        for (std::size_t knee = kLeastBeats / 2; knee + bar_ <= beats.size(); ++knee) {
            const StretchSound begin = song_.mean(first + knee, first + knee + 2);
            const StretchSound last = song_.mean(end - 2, end);
            const double error =
                misfit(beats, knee, full.usual) - (downbeats_[first + knee] != 0 ? 0.3 : 0.0);
            if (error < least && rise_of(begin, last, full.usual) > kBuildUpRise) {
                least = error;
                best = first + knee;
            }
        }
        return best;
    }

    // Sum of squares of what is left of the beats: a mean before the knee, a line from it on.
    [[nodiscard]] static double misfit(const std::vector<StretchSound>& beats,
                                       std::size_t knee,
                                       const StretchSound& full) {
        const auto value = [&](std::size_t i, int part) {
            switch (part) {
                case 0:
                    return static_cast<double>(std::max(beats[i].level, full.level - 40.0F)) / 6.0;
                case 1:
                    return static_cast<double>(std::max(beats[i].low, full.low - 40.0F)) / 8.0;
                case 2:
                    return static_cast<double>(beats[i].brightness) / 20.0;
                default:
                    return static_cast<double>(beats[i].onsets / (full.onsets + 1e-3F));
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
    std::vector<FullBand> full_;   // by beat
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
