#include "audio/music/generator/music_generator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "audio/music/generator/mixer.hpp"
#include "audio/music/generator/notes.hpp"
#include "base/suggest.hpp"

namespace raks::audio {
namespace {

// In the order of Style.
constexpr std::array<std::string_view, 8> kStyleNames{"clicks",
                                                      "drums",
                                                      "montuno",
                                                      "maqsum",
                                                      "four-on-the-floor",
                                                      "backbeat",
                                                      "boom-bap",
                                                      "oom-pah-pah"};
constexpr double kMaxSeconds = 3600.0;

// Collects the faults of a plan in one line, so that a user sees all of them at once.
class Faults {
 public:
    void require(bool is_fine, const std::string& otherwise) {
        if (!is_fine) {
            text_ += (text_.empty() ? "" : "; ") + otherwise;
        }
    }
    [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
    std::string text_;
};

bool is_in(double value, double low, double high) {  // false for NaN
    return value >= low && value <= high;
}

// Every point of the tempo curve, and that their times do not go back.
void check_tempo(const std::vector<TempoPoint>& tempo, Faults& faults) {
    faults.require(!tempo.empty(), "tempo has no point");
    for (std::size_t i = 0; i < tempo.size(); ++i) {
        const std::string name = "tempo[" + std::to_string(i) + "]";
        faults.require(is_in(tempo[i].bpm, 20.0, 400.0),
                       name + ".bpm is " + std::to_string(tempo[i].bpm) + ", must be 20 to 400");
        faults.require(is_in(tempo[i].seconds, -kMaxSeconds, 2 * kMaxSeconds) &&
                           (i == 0 || tempo[i].seconds >= tempo[i - 1].seconds),
                       name + ".seconds is " + std::to_string(tempo[i].seconds) +
                           ", must not lie before the point before it");
    }
}

// Each silence begins after the end of the one before.
void check_silences(const std::vector<Silence>& silences, Faults& faults) {
    double end = 0.0;
    for (std::size_t i = 0; i < silences.size(); ++i) {
        faults.require(is_in(silences[i].from_seconds, end, kMaxSeconds) &&
                           is_in(silences[i].to_seconds, silences[i].from_seconds, kMaxSeconds),
                       "silences[" + std::to_string(i) + "] must be ascending and not overlap");
        end = silences[i].to_seconds;
    }
}

// All faults of a plan; empty: it can be played.
std::string faults_of(const MusicPlan& plan) {
    Faults faults;
    check_tempo(plan.tempo, faults);
    check_silences(plan.silences, faults);
    faults.require(
        plan.seconds > 0.0 && plan.seconds <= kMaxSeconds,
        "seconds is " + std::to_string(plan.seconds) + ", must be above 0, at most 3600");
    faults.require(plan.rate.is_supported(),
                   "rate is " + std::to_string(plan.rate.hertz()) + " Hz, must be 8000 to 192000");
    faults.require(plan.channels == 1 || plan.channels == 2,
                   "channels is " + std::to_string(plan.channels) + ", must be 1 or 2");
    faults.require(is_in(plan.first_beat_seconds, 0.0, kMaxSeconds),
                   "first_beat_seconds must be 0 to 3600");
    return faults.text();
}

// The notes of a style; clicks have nothing to draw.
Notes write_score(Style style, double beats, std::uint64_t seed) {
    switch (style) {
        case Style::clicks:
            return write_clicks(beats);
        case Style::drums:
            return write_drums(beats, seed);
        case Style::montuno:
            return write_montuno(beats, seed);
        case Style::maqsum:
            return write_maqsum(beats, seed);
        case Style::four_on_the_floor:
            return write_four_on_the_floor(beats, seed);
        case Style::backbeat:
            return write_backbeat(beats, seed);
        case Style::boom_bap:
            return write_boom_bap(beats, seed);
        case Style::oom_pah_pah:
            return write_oom_pah_pah(beats, seed);
    }
    return {};
}

// In frames, rounded as the mixer rounds the starts of notes.
std::vector<FrameRange> silent_frames(const MusicPlan& plan) {
    std::vector<FrameRange> ranges;
    for (const Silence& silence : plan.silences) {
        ranges.push_back({std::llround(silence.from_seconds * plan.rate.hertz()),
                          std::llround(silence.to_seconds * plan.rate.hertz())});
    }
    return ranges;
}

// Beats of the tempo curve up to the end; a beat is audible when its frame is in no silence, by the
// same rounding as the mixer's.
std::vector<ReferenceBeat> reference_beats(const MusicPlan& plan,
                                           const TempoCurve& curve,
                                           const std::vector<FrameRange>& silences) {
    const int bar = beats_per_bar(plan.style);
    std::vector<ReferenceBeat> beats;
    for (int number = 0;; ++number) {
        const double seconds = curve.seconds_at(number);
        const std::int64_t frame = std::llround(seconds * plan.rate.hertz());
        if (seconds >= plan.seconds) {
            return beats;
        }
        bool is_audible = true;
        for (const FrameRange& silence : silences) {
            is_audible = is_audible && (frame < silence.from || frame >= silence.to);
        }
        beats.push_back({stream_time_from_seconds(seconds), number % bar + 1, is_audible});
    }
}

}  // namespace

std::span<const std::string_view> style_names() noexcept { return kStyleNames; }

Expected<Style> style_from_name(std::string_view name) {
    const auto* const found = std::find(kStyleNames.begin(), kStyleNames.end(), name);
    if (found == kStyleNames.end()) {
        return fail(unknown_name("style", name, kStyleNames));
    }
    return static_cast<Style>(found - kStyleNames.begin());
}

std::string_view name_of(Style style) noexcept {
    return kStyleNames[static_cast<std::size_t>(style)];
}

namespace {

void append_mono(std::span<const float> stereo, std::vector<float>& out) {
    for (std::size_t i = 0; i + 1 < stereo.size(); i += 2) {
        out.push_back(0.5F * (stereo[i] + stereo[i + 1]));
    }
}

}  // namespace

std::vector<float> GeneratedMusic::mono() const {
    if (channels == 1) {
        return samples;
    }
    std::vector<float> out;
    out.reserve(samples.size() / 2);
    append_mono(samples, out);
    return out;
}

std::int64_t frames_of(const MusicPlan& plan) noexcept {
    return std::llround(plan.seconds * plan.rate.hertz());
}

Expected<std::vector<ReferenceBeat>> generate(const MusicPlan& plan, const MusicSink& sink) {
    if (const std::string faults = faults_of(plan); !faults.empty()) {
        return fail("music plan: " + faults);
    }
    const TempoCurve curve(plan.tempo, plan.first_beat_seconds);
    const std::vector<FrameRange> silences = silent_frames(plan);
    // As many beats as fit into the piece by the tempo curve.
    const Notes score = write_score(plan.style, curve.beats_at(plan.seconds), plan.seed);
    Mixer mixer(plan, curve, score);
    std::vector<float> mono;
    const auto to_mono = [&](std::span<const float> stereo) {
        mono.clear();
        append_mono(stereo, mono);
        return sink(mono);
    };
    if (!mixer.render(silences, plan.channels == 1 ? MusicSink(to_mono) : sink)) {
        return fail("the piece was ended before its end");
    }
    return reference_beats(plan, curve, silences);
}

Expected<GeneratedMusic> generate(const MusicPlan& plan) {
    GeneratedMusic music{.rate = plan.rate, .channels = plan.channels, .samples = {}, .beats = {}};
    auto beats = generate(plan, [&](std::span<const float> samples) {
        music.samples.insert(music.samples.end(), samples.begin(), samples.end());
        return true;
    });
    if (!beats) {
        return fail(beats.error());
    }
    music.beats = std::move(*beats);
    return music;
}

MusicPlan demo_plan() {
    return {.style = Style::montuno, .tempo = {{0.0, 184.0}}, .seconds = 60.0, .seed = 7};
}

}  // namespace raks::audio
