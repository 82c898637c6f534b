#include "audio/music/generator/mixer.hpp"

#include <algorithm>
#include <cmath>

#include "audio/music/generator/notes.hpp"
#include "base/realtime.hpp"

namespace raks::audio {
namespace {

constexpr double kFadeSeconds = 0.010;  // at the start of a silence and at the end
constexpr int kStrokeVariants = 3;      // of one drum: repeated strokes differ a little

// Place of a sound in the mix.
struct Strip {
    float gain;
    float pan;   ///< -1 left, 1 right
    float room;  ///< part sent to the reverb
};

// As seen from the audience: congas left, timbales and bell right, piano left, brass right.
constexpr std::array<Strip, kSoundCount> kStrips{{
    {0.80F, 0.00F, 0.00F},   // click_high
    {0.60F, 0.00F, 0.00F},   // click_low
    {0.70F, 0.00F, 0.02F},   // kick
    {0.62F, 0.00F, 0.00F},   // club_kick
    {0.60F, 0.05F, 0.12F},   // snare
    {0.50F, -0.05F, 0.16F},  // clap
    {0.32F, 0.30F, 0.03F},   // closed_hat
    {0.30F, 0.35F, 0.06F},   // open_hat
    {0.26F, 0.40F, 0.20F},   // crash
    {0.26F, 0.45F, 0.22F},   // clave
    {0.24F, 0.30F, 0.12F},   // cowbell
    {0.18F, 0.30F, 0.10F},   // cowbell_mouth
    {0.36F, -0.35F, 0.14F},  // conga_open
    {0.36F, -0.45F, 0.14F},  // conga_low
    {0.40F, -0.35F, 0.12F},  // conga_slap
    {0.24F, -0.35F, 0.05F},  // conga_heel
    {0.28F, -0.60F, 0.10F},  // guiro_long
    {0.28F, -0.60F, 0.10F},  // guiro_short
    {0.26F, 0.65F, 0.06F},   // maracas
    {0.36F, 0.35F, 0.18F},   // timbale_high
    {0.36F, 0.45F, 0.18F},   // timbale_low
    {0.24F, 0.50F, 0.12F},   // cascara
    {0.60F, 0.00F, 0.14F},   // darbuka_dum
    {0.58F, 0.12F, 0.16F},   // darbuka_tek
    {0.40F, -0.12F, 0.16F},  // darbuka_ka
    {0.36F, 0.50F, 0.16F},   // riq
    {0.36F, 0.00F, 0.02F},   // bass
    {0.26F, 0.00F, 0.00F},   // synth_bass
    {0.27F, -0.25F, 0.16F},  // piano
    {0.22F, 0.28F, 0.26F},   // brass
    {0.46F, -0.15F, 0.26F},  // oud
    {0.22F, -0.20F, 0.25F},  // stab
    {0.13F, -0.30F, 0.14F},  // guitar
    {0.11F, 0.15F, 0.30F},   // pad
}};

// Gain that brings each style to about -16 LUFS (ffmpeg's ebur128 over 60 s).
double band_gain(Style style) {
    switch (style) {
        case Style::clicks:
            return 1.0;
        case Style::drums:
            return 1.3;
        case Style::montuno:
            return 0.87;
        case Style::maqsum:
            return 1.18;
        case Style::four_on_the_floor:
            return 0.91;
        case Style::backbeat:
            return 0.95;
        case Style::boom_bap:
            return 1.25;
        case Style::oom_pah_pah:
            return 1.4;
    }
    return 1.0;
}

// Linear up to 0.7; beyond, it approaches 1 and never reaches it, so that nothing clips.
float soft_limit(float x) {
    constexpr float kKnee = 0.7F;
    const float size = std::abs(x);
    if (size <= kKnee) {
        return x;
    }
    const float over = (size - kKnee) / (1.0F - kKnee);
    return std::copysign(kKnee + (1.0F - kKnee) * over / (1.0F + over), x);
}

// MIDI note number to hertz, equal temperament.
double hertz_of(int pitch) { return 440.0 * std::pow(2.0, (pitch - 69) / 12.0); }

}  // namespace

// Unequal delays, so that the echoes of the lines do not coincide; the right side's are a little
// longer, so that the sides differ.
Reverb::Reverb(double rate) {
    constexpr std::array<double, 4> kCombs{0.0297, 0.0371, 0.0411, 0.0437};  // seconds
    constexpr std::array<double, 2> kAllPasses{0.0050, 0.0017};
    constexpr double kSpread = 0.00053;  // of the right side against the left
    for (std::size_t s = 0; s < 2; ++s) {
        const double extra = s == 0 ? 0.0 : kSpread;
        for (std::size_t i = 0; i < 4; ++i) {
            sides_[s].combs[i].memory.resize(static_cast<std::size_t>((kCombs[i] + extra) * rate) +
                                             1);
        }
        for (std::size_t i = 0; i < 2; ++i) {
            sides_[s].all_passes[i].memory.resize(
                static_cast<std::size_t>((kAllPasses[i] + extra) * rate) + 1);
        }
    }
}

// Combs with a low-pass in the loop: treble dies first, as in a room. The all-passes thicken the
// echoes.
float Reverb::step(Side& side, float in) noexcept {
    float sum = 0.0F;
    for (Line& comb : side.combs) {
        const float out = comb.memory[comb.at];
        comb.low = 0.65F * out + 0.35F * comb.low;
        comb.memory[comb.at] = in + 0.78F * comb.low;
        comb.at = comb.at + 1 == comb.memory.size() ? 0 : comb.at + 1;
        sum += 0.25F * out;
    }
    for (Line& line : side.all_passes) {
        const float delayed = line.memory[line.at];
        const float out = delayed - 0.6F * sum;
        line.memory[line.at] = sum + 0.6F * out;
        line.at = line.at + 1 == line.memory.size() ? 0 : line.at + 1;
        sum = out;
    }
    return sum;
}

void Reverb::process(std::span<const float> send, std::span<float> left, std::span<float> right) {
    for (std::size_t i = 0; i < send.size(); ++i) {
        left[i] += step(sides_[0], send[i]);
        right[i] += step(sides_[1], send[i]);
    }
}

void Reverb::clear() {
    for (Side& side : sides_) {
        for (Line& line : side.combs) {
            std::fill(line.memory.begin(), line.memory.end(), 0.0F);
            line.low = 0.0F;
        }
        for (Line& line : side.all_passes) {
            std::fill(line.memory.begin(), line.memory.end(), 0.0F);
        }
    }
}

Mixer::Mixer(const MusicPlan& plan,
             const TempoCurve& curve,
             const Notes& score,
             std::span<const SectionSpan> form)
    : plan_(plan),
      total_frames_(std::llround(plan.seconds * plan.rate.hertz())),
      reverb_(plan.rate.hertz()),
      form_sound_(form, curve, plan.rate.hertz()) {
    int stroke = 0;
    // Lengths and brightness are rounded, so that few different sounds are needed.
    for (const Note& note : score) {
        const double start = curve.seconds_at(note.beat);
        const double length = curve.seconds_at(note.beat + note.beats) - start;
        SoundKey key{note.sound, 0, 0, 8, stroke++ % kStrokeVariants};
        if (is_pitched(note.sound)) {
            const auto steps = static_cast<int>(std::lround(100.0 * length));
            const auto bright = static_cast<int>(std::lround(8.0 * note.velocity));
            key = {note.sound, note.pitch, std::clamp(steps, 3, 1000), std::clamp(bright, 1, 8), 0};
        }
        const Strip& strip = kStrips[static_cast<std::size_t>(note.sound)];
        events_.push_back({std::llround(start * plan.rate.hertz()),
                           &sound_for(key),
                           note.sound,
                           static_cast<float>(note.velocity * band_gain(plan.style)) * strip.gain});
    }
    std::stable_sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
        return a.start < b.start;
    });
}

// Makes a sound at its first use. The map's elements keep their addresses, which events hold.
const std::vector<float>& Mixer::sound_for(const SoundKey& key) {
    auto [place, is_new] = sounds_.try_emplace(key);
    if (is_new) {
        place->second = synthesize({.sound = key.sound,
                                    .hertz = hertz_of(key.pitch),
                                    .seconds = 0.01 * key.length,
                                    .brightness = 0.125 * key.brightness,
                                    .variant = key.variant,
                                    .rate = static_cast<double>(plan_.rate.hertz())});
    }
    return place->second;
}

// Stretches of sound between the silences; the score runs on inside a silence.
bool Mixer::render(std::span<const FrameRange> silences, const MusicSink& sink) {
    const FlushToZeroScope flush_to_zero;
    std::int64_t at = 0;
    for (const FrameRange& silence : silences) {
        const std::int64_t end = std::min(silence.to, total_frames_);
        const std::int64_t begin = std::clamp(silence.from, at, end);
        if (!render_stretch(at, begin, sink) || !render_silence(end - begin, sink)) {
            return false;
        }
        at = end;
    }
    return render_stretch(at, total_frames_, sink);
}

bool Mixer::render_silence(std::int64_t frames, const MusicSink& sink) {
    constexpr std::array<float, 2 * kBlock> kZeros{};
    bool goes_on = true;
    while (frames > 0 && goes_on) {
        const std::int64_t count = std::min(frames, static_cast<std::int64_t>(kBlock));
        goes_on = sink(std::span(kZeros).first(2 * static_cast<std::size_t>(count)));
        frames -= count;
    }
    return goes_on;
}

// One stretch from silence to silence: notes from before are not continued in it.
bool Mixer::render_stretch(std::int64_t from, std::int64_t to, const MusicSink& sink) {
    reverb_.clear();
    form_sound_.begin(from);
    playing_.clear();
    while (next_event_ < events_.size() && events_[next_event_].start < from) {
        ++next_event_;  // would have started inside the silence
    }
    // A fade instead of a cut, which would click.
    const std::int64_t fade =
        std::min(static_cast<std::int64_t>(kFadeSeconds * plan_.rate.hertz()), to - from);
    bool goes_on = true;
    for (std::int64_t at = from; at < to && goes_on;) {
        const auto frames =
            static_cast<std::size_t>(std::min(to - at, static_cast<std::int64_t>(kBlock)));
        mix_events(at, frames);
        reverb_.process(std::span(send_).first(frames), left_, right_);
        form_sound_.process(at, std::span(left_).first(frames), std::span(right_).first(frames));
        const std::span<float> block = limited(frames);
        for (std::size_t i = 0; i < frames; ++i) {
            const std::int64_t left = to - 1 - at - static_cast<std::int64_t>(i);
            if (left < fade) {
                const float gain = static_cast<float>(left) / static_cast<float>(fade);
                block[2 * i] *= gain;
                block[2 * i + 1] *= gain;
            }
        }
        goes_on = sink(block);
        at += static_cast<std::int64_t>(frames);
    }
    return goes_on;
}

// All sounds that overlap this block, into both sides and the room's input.
void Mixer::mix_events(std::int64_t from, std::size_t frames) {
    left_.fill(0.0F);
    right_.fill(0.0F);
    send_.fill(0.0F);
    const std::int64_t to = from + static_cast<std::int64_t>(frames);
    while (next_event_ < events_.size() && events_[next_event_].start < to) {
        playing_.push_back(events_[next_event_++]);
    }
    for (const Event& event : playing_) {
        const Strip& strip = kStrips[static_cast<std::size_t>(event.sound)];
        // Equal-power panning; factor sqrt(2): a sound in the middle keeps its gain.
        const float angle = 0.7853982F * (strip.pan + 1.0F);
        const float left = 1.4142136F * event.gain * std::cos(angle);
        const float right = 1.4142136F * event.gain * std::sin(angle);
        const float send = event.gain * strip.room;
        const std::vector<float>& samples = *event.samples;
        const std::int64_t first = std::max(event.start, from);
        const std::int64_t last =
            std::min(to, event.start + static_cast<std::int64_t>(samples.size()));
        for (std::int64_t t = first; t < last; ++t) {
            const float sample = samples[static_cast<std::size_t>(t - event.start)];
            const auto i = static_cast<std::size_t>(t - from);
            left_[i] += left * sample;
            right_[i] += right * sample;
            send_[i] += send * sample;
        }
    }
    // Ended sounds are dropped, so a block costs what sounds in it.
    std::erase_if(playing_, [to](const Event& event) {
        return event.start + static_cast<std::int64_t>(event.samples->size()) <= to;
    });
}

// The sum of all may exceed 1: limited sample by sample.
// Both sides of the block, interleaved.
std::span<float> Mixer::limited(std::size_t frames) noexcept {
    for (std::size_t i = 0; i < frames; ++i) {
        limited_[2 * i] = soft_limit(left_[i]);
        limited_[2 * i + 1] = soft_limit(right_[i]);
    }
    return std::span(limited_).first(2 * frames);
}

}  // namespace raks::audio
