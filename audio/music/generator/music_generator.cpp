#include "audio/music/generator/music_generator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "audio/music/generator/form_score.hpp"
#include "audio/music/generator/mixer.hpp"
#include "audio/music/generator/notes.hpp"
#include "audio/music/generator/played_bars.hpp"
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
    faults.require(
        plan.form.empty() || plan.silences.empty(),
        "form and silences cannot both be given: write a silence as a section, stop:BEATS");
    for (std::size_t i = 0; i < plan.form.size(); ++i) {
        faults.require(plan.form[i].beats >= 1 && plan.form[i].beats <= 10'000,
                       "form[" + std::to_string(i) + "].beats is " +
                           std::to_string(plan.form[i].beats) + ", must be 1 to 10000");
    }
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

// The sections of the form that begin inside the piece, the last one cut at its end.
std::vector<SectionSpan> played_spans(const MusicPlan& plan, const TempoCurve& curve) {
    std::vector<SectionSpan> spans = spans_of(plan.form);
    std::erase_if(spans, [&](const SectionSpan& span) {
        return curve.seconds_at(span.from) >= plan.seconds;
    });
    return spans;
}

// Stretches without sound, seconds: those of the plan, or the form's stops and all after its end.
std::vector<Silence> silences_of(const MusicPlan& plan,
                                 const TempoCurve& curve,
                                 std::span<const SectionSpan> form) {
    if (form.empty()) {
        return plan.silences;
    }
    std::vector<Silence> silences;
    for (const SectionSpan& section : form) {
        if (section.kind == SectionKind::stop) {
            silences.push_back({curve.seconds_at(section.from), curve.seconds_at(section.to)});
        }
    }
    silences.push_back({curve.seconds_at(form.back().to), plan.seconds});
    std::erase_if(silences, [](const Silence& silence) {
        return silence.to_seconds <= silence.from_seconds;
    });
    return silences;
}

// In frames, rounded as the mixer rounds the starts of notes.
std::vector<FrameRange> frames_of(std::span<const Silence> silences, SampleRate rate) {
    std::vector<FrameRange> ranges;
    for (const Silence& silence : silences) {
        ranges.push_back({std::llround(silence.from_seconds * rate.hertz()),
                          std::llround(silence.to_seconds * rate.hertz())});
    }
    return ranges;
}

// Whether a form has anything that starts at this beat.
bool is_played(int beat, std::span<const SectionSpan> form) {
    for (const SectionSpan& section : form) {
        if (beat >= section.from && beat < section.to) {
            const bool rings =
                section.kind == SectionKind::hit_stop || section.kind == SectionKind::ending;
            return rings ? beat == section.from : section.kind != SectionKind::stop;
        }
    }
    return form.empty();
}

// Beats of the tempo curve up to the end; a beat is audible when its frame is in no silence, by the
// same rounding as the mixer's.
std::vector<ReferenceBeat> reference_beats(const MusicPlan& plan,
                                           const TempoCurve& curve,
                                           const std::vector<FrameRange>& silences,
                                           std::span<const SectionSpan> form) {
    const int bar = beats_per_bar(plan.style);
    std::vector<ReferenceBeat> beats;
    for (int number = 0;; ++number) {
        const double seconds = curve.seconds_at(number);
        const std::int64_t frame = std::llround(seconds * plan.rate.hertz());
        if (seconds >= plan.seconds) {
            return beats;
        }
        bool is_audible = is_played(number, form);
        for (const FrameRange& silence : silences) {
            is_audible = is_audible && (frame < silence.from || frame >= silence.to);
        }
        beats.push_back({stream_time_from_seconds(seconds), number % bar + 1, is_audible});
    }
}

// The sections in time. Without a form: sound, and a stop for each silence of the plan.
std::vector<PlayedSection> played_sections(const MusicPlan& plan,
                                           const TempoCurve& curve,
                                           std::span<const SectionSpan> form) {
    std::vector<PlayedSection> sections;
    const auto add = [&](SectionKind kind, double from, double to) {
        if (from < std::min(to, plan.seconds)) {
            sections.push_back({kind,
                                stream_time_from_seconds(from),
                                stream_time_from_seconds(std::min(to, plan.seconds))});
        }
    };
    for (const SectionSpan& section : form) {
        add(section.kind, curve.seconds_at(section.from), curve.seconds_at(section.to));
    }
    if (form.empty()) {
        double from = curve.seconds_at(0);
        for (const Silence& silence : plan.silences) {
            add(SectionKind::full, from, silence.from_seconds);
            from = std::max(from, silence.from_seconds);
            add(SectionKind::stop, from, silence.to_seconds);
            from = std::max(from, silence.to_seconds);
        }
        add(SectionKind::full, from, plan.seconds);
    }
    return sections;
}

// Every eighth bar of each section that sounds; without a form of the whole piece.
std::vector<StreamTime> phrase_starts(const MusicPlan& plan,
                                      const TempoCurve& curve,
                                      std::span<const SectionSpan> form) {
    const int phrase = 8 * beats_per_bar(plan.style);
    std::vector<StreamTime> starts;
    const auto add = [&](double from, double to) {
        for (double beat = from; beat < to && curve.seconds_at(beat) < plan.seconds;
             beat += phrase) {
            starts.push_back(stream_time_from_seconds(curve.seconds_at(beat)));
        }
    };
    for (const SectionSpan& section : form) {
        if (part_of(section.kind) != MusicPart::stopped) {
            add(section.from, section.to);
        }
    }
    if (form.empty()) {
        add(0.0, curve.beats_at(plan.seconds));
    }
    return starts;
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

std::vector<FormSection> song_form_of(const MusicPlan& plan) {
    const TempoCurve curve(plan.tempo, plan.first_beat_seconds);
    const int bar = beats_per_bar(plan.style);
    const double bars = curve.beats_at(plan.seconds) / bar;
    return draw_form({.bars = std::max(static_cast<int>(bars), 1),
                      .beats_per_bar = bar,
                      .bar_seconds = plan.seconds / std::max(bars, 1.0),
                      .seed = plan.seed});
}

Expected<MusicTruth> generate(const MusicPlan& plan, const MusicSink& sink) {
    if (const std::string faults = faults_of(plan); !faults.empty()) {
        return fail("music plan: " + faults);
    }
    const TempoCurve curve(plan.tempo, plan.first_beat_seconds);
    const std::vector<SectionSpan> form = played_spans(plan, curve);
    const std::vector<FrameRange> silences = frames_of(silences_of(plan, curve, form), plan.rate);
    // As many beats as fit into the piece by the tempo curve.
    Notes score = write_score(plan.style, curve.beats_at(plan.seconds), plan.seed);
    if (!form.empty()) {
        score = arrange(std::move(score), form, plan.style);
    }
    Mixer mixer(plan, curve, score, form);
    std::vector<float> mono;
    const auto to_mono = [&](std::span<const float> stereo) {
        mono.clear();
        append_mono(stereo, mono);
        return sink(mono);
    };
    if (!mixer.render(silences, plan.channels == 1 ? MusicSink(to_mono) : sink)) {
        return fail("the music was stopped before its end");
    }
    MusicTruth truth;
    truth.beats = reference_beats(plan, curve, silences, form);
    truth.sections = played_sections(plan, curve, form);
    truth.events = events_of(truth.sections);
    truth.phrases = phrase_starts(plan, curve, form);
    truth.bars = played_bars(plan, curve, score, form);
    return truth;
}

Expected<GeneratedMusic> generate(const MusicPlan& plan) {
    GeneratedMusic music;
    music.rate = plan.rate;
    music.channels = plan.channels;
    auto truth = generate(plan, [&](std::span<const float> samples) {
        music.samples.insert(music.samples.end(), samples.begin(), samples.end());
        return true;
    });
    if (!truth) {
        return fail(std::move(truth.error()));
    }
    static_cast<MusicTruth&>(music) = std::move(*truth);
    return music;
}

MusicPlan demo_plan() {
    return {.style = Style::montuno, .tempo = {{0.0, 184.0}}, .seconds = 60.0, .seed = 7};
}

}  // namespace raks::audio
