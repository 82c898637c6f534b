#include "audio/music/instruments/synthesizers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "audio/music/generator/notes.hpp"
#include "audio/music/instruments/drawn_drum.hpp"
#include "audio/music/instruments/drawn_tone.hpp"
#include "audio/music/styles/general_midi_drums.hpp"

namespace raks::audio {
namespace {

constexpr double kToneLevel = 0.25;  // of a note, beside a drum's stroke of 1

/// Deals instruments (channel and program) and drums (keys) to synthesizers or to others.
class Dealer {
 public:
    Dealer(double share, Dice& dice) : share_(share), dice_(dice) {}

    /// Drawn once for each instrument, when its first note is met, then the same for all its notes.
    bool is_synthesized(const PlayedNote& note) {
        const bool is_drum = note.channel == kDrumChannel;
        const std::pair instrument(note.channel, is_drum ? note.key : note.program);
        const auto known = dealt_.find(instrument);
        if (known != dealt_.end()) {
            return known->second;
        }
        return dealt_.emplace(instrument, dice_.chance(share_)).first->second;
    }

 private:
    double share_;
    Dice& dice_;
    std::map<std::pair<int, int>, bool> dealt_;
};

/// Moves the notes of the dealt instruments out of the performance.
std::vector<PlayedNote> take_notes(double share, Performance& performance, Dice& dice) {
    Dealer dealer(share, dice);
    std::vector<PlayedNote> taken;
    std::vector<PlayedNote> left;
    for (const PlayedNote& note : performance.notes) {
        (dealer.is_synthesized(note) ? taken : left).push_back(note);
    }
    performance.notes = std::move(left);
    return taken;
}

/// Adds the strokes of all drums. Each key's stroke is synthesized once and then only scaled.
void play_drums(std::span<const PlayedNote> notes, int rate, std::vector<float>& out, Dice& dice) {
    std::map<int, std::pair<double, std::vector<float>>> strokes;
    for (const PlayedNote& note : notes) {
        const auto begin = static_cast<std::size_t>(std::max(0.0, note.time) * rate);
        if (note.channel != kDrumChannel || begin >= out.size()) {
            continue;
        }
        auto known = strokes.find(note.key);
        if (known == strokes.end()) {
            const DrawnDrum drum = draw_drum(note.key, dice);
            known = strokes.emplace(note.key, std::pair(drum.level, strike(drum, rate))).first;
        }
        const auto& [level, stroke] = known->second;
        const auto gain = static_cast<float>(level * note.velocity / 127.0);
        const std::size_t count = std::min(stroke.size(), out.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            out[begin + i] += gain * stroke[i];
        }
    }
}

/// Adds all notes that have a pitch; each instrument's sound is drawn when its first note is met.
void play_tones(std::span<const PlayedNote> notes, int rate, std::vector<float>& out, Dice& dice) {
    std::map<std::pair<int, int>, DrawnTone> tones;
    for (const PlayedNote& note : notes) {
        if (note.channel == kDrumChannel) {
            continue;
        }
        const std::pair instrument(note.channel, note.program);
        auto known = tones.find(instrument);
        if (known == tones.end()) {
            known = tones.emplace(instrument, draw_tone(note.program, dice)).first;
        }
        // MIDI key 69 is 440 Hz.
        const double semitones = note.key - 69 + note.cents / 100.0;
        add_note(known->second,
                 {note.time,
                  note.length,
                  440.0 * std::exp2(semitones / 12.0),
                  kToneLevel * note.velocity / 127.0},
                 rate,
                 out);
    }
}

/// Every stroke of the kick pulls the rest down for a moment.
void duck(std::span<const PlayedNote> notes, int rate, std::vector<float>& out, Dice& dice) {
    const double depth = dice.uniform(0.3, 0.9);
    const double time = dice.log_uniform(0.06, 0.25);  // s until 1/e
    // In samples; ascending, as the notes are by time.
    std::vector<std::size_t> kicks;
    for (const PlayedNote& note : notes) {
        if (note.channel == kDrumChannel && note.key == drum_named("kick")) {
            kicks.push_back(static_cast<std::size_t>(std::max(0.0, note.time) * rate));
        }
    }
    std::size_t next = 0;
    for (std::size_t i = kicks.empty() ? out.size() : kicks.front(); i < out.size(); ++i) {
        while (next + 1 < kicks.size() && kicks[next + 1] <= i) {
            ++next;
        }
        const double since = static_cast<double>(i - kicks[next]) / rate;
        out[i] *= static_cast<float>(1.0 - depth * std::exp(-since / time));
    }
}

/// Scales the samples so that the largest has this amplitude.
void scale_to_peak(float peak, std::vector<float>& samples) {
    float most = 1e-6F;
    for (const float sample : samples) {
        most = std::max(most, std::abs(sample));
    }
    for (float& sample : samples) {
        sample *= peak / most;
    }
}

}  // namespace

std::vector<float> play_synthesizers(double share, int rate, Performance& performance, Dice& dice) {
    constexpr float kPeak = 0.7F;
    constexpr double kDucked = 0.25;  // of the pieces
    const std::vector<PlayedNote> notes = take_notes(share, performance, dice);
    if (notes.empty()) {
        return {};
    }
    std::vector<float> tones(static_cast<std::size_t>(performance.seconds * rate));
    play_tones(notes, rate, tones, dice);
    const auto beside_drums = static_cast<float>(dice.log_uniform(0.5, 2.0));
    for (float& sample : tones) {
        sample *= beside_drums;
    }
    if (dice.chance(kDucked)) {
        // Before the drums are added: the kick must not duck itself.
        duck(notes, rate, tones, dice);
    }
    play_drums(notes, rate, tones, dice);
    scale_to_peak(kPeak, tones);
    return tones;
}

std::vector<float> play_oud(std::span<const OudNote> notes, int rate, std::size_t samples) {
    std::vector<float> sum(samples);
    for (const OudNote& note : notes) {
        const auto begin = static_cast<std::size_t>(std::max(0.0, note.time) * rate);
        if (begin >= samples) {
            continue;
        }
        // A hard pluck is brighter as well as louder.
        const std::vector<float> pluck = synthesize_tone({.sound = Sound::oud,
                                                          .hertz = note.hertz,
                                                          .seconds = std::max(0.1, note.length),
                                                          .brightness = 0.4 + 0.6 * note.strength,
                                                          .rate = static_cast<double>(rate)});
        const std::size_t count = std::min(pluck.size(), samples - begin);
        for (std::size_t i = 0; i < count; ++i) {
            sum[begin + i] += static_cast<float>(note.strength) * pluck[i];
        }
    }
    // Not 0, so that silence is not divided by zero.
    float peak = 1e-6F;
    for (const float sample : sum) {
        peak = std::max(peak, std::abs(sample));
    }
    for (float& sample : sum) {
        sample /= peak;
    }
    return sum;
}

}  // namespace raks::audio
