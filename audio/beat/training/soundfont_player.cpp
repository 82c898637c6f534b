#include "audio/beat/training/soundfont_player.hpp"

#include <fluidsynth.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace raks::audio {
namespace {

constexpr std::size_t kDelay = 110;  // samples: measured on clicks

constexpr int kNoBend = 8'192;  // MIDI's middle; the whole way up is two semitones
constexpr double kBendOfCent = 8'192 / 200.0;

/// A note starts or ends.
struct PlayerEvent {
    std::size_t sample = 0;
    bool is_on = false;
    PlayedNote note;
};

std::vector<PlayerEvent> events_of(const Performance& performance) {
    const auto sample_of = [](double seconds) {
        return static_cast<std::size_t>(std::max(0.0, seconds) * SoundfontPlayer::kRate);
    };
    std::vector<PlayerEvent> events;
    for (const PlayedNote& note : performance.notes) {
        events.push_back({sample_of(note.time), true, note});
        events.push_back({sample_of(note.time + note.length), false, note});
    }
    std::stable_sort(events.begin(), events.end(), [](const auto& a, const auto& b) {
        return a.sample != b.sample ? a.sample < b.sample : a.is_on < b.is_on;
    });
    return events;
}

}  // namespace

struct SoundfontPlayer::Synth {
    fluid_settings_t* settings = new_fluid_settings();
    fluid_synth_t* synth = nullptr;

    Synth() {
        // A reset ends more voices at once than its list holds: said for each, and harmless.
        fluid_set_log_function(FLUID_ERR, nullptr, nullptr);
        fluid_set_log_function(FLUID_WARN, nullptr, nullptr);
        fluid_set_log_function(FLUID_INFO, nullptr, nullptr);
        fluid_settings_setnum(settings, "synth.sample-rate", kRate);
        fluid_settings_setint(settings, "synth.dynamic-sample-loading", 1);
        fluid_settings_setint(settings, "synth.chorus.active", 0);
        fluid_settings_setint(settings, "synth.polyphony", 256);
        fluid_settings_setnum(settings, "synth.gain", 0.4);
        synth = new_fluid_synth(settings);
    }
    ~Synth() {
        delete_fluid_synth(synth);
        delete_fluid_settings(settings);
    }
    Synth(const Synth&) = delete;
    Synth& operator=(const Synth&) = delete;

    void render(std::size_t frames, std::vector<float>& mono) {
        std::array<float, 1024> left{};
        std::array<float, 1024> right{};
        while (frames > 0) {
            const std::size_t count = std::min(frames, left.size());
            fluid_synth_write_float(
                synth, static_cast<int>(count), left.data(), 0, 1, right.data(), 0, 1);
            for (std::size_t i = 0; i < count; ++i) {
                mono.push_back(0.5F * (left[i] + right[i]));
            }
            frames -= count;
        }
    }
};

SoundfontPlayer::SoundfontPlayer(std::unique_ptr<Synth> synth) : synth_(std::move(synth)) {}
SoundfontPlayer::SoundfontPlayer(SoundfontPlayer&&) noexcept = default;
SoundfontPlayer& SoundfontPlayer::operator=(SoundfontPlayer&&) noexcept = default;
SoundfontPlayer::~SoundfontPlayer() = default;

Expected<SoundfontPlayer> SoundfontPlayer::open(const std::filesystem::path& soundfont) {
    // The first synthesizer fills FluidSynth's tables, and a second thread's would play before they
    // are full: now and then a run's first pieces differed.
    [[maybe_unused]] static const bool are_tables_full = [] {
        const Synth first;
        return first.synth != nullptr;
    }();
    auto synth = std::make_unique<Synth>();
    if (synth->synth == nullptr ||
        fluid_synth_sfload(synth->synth, soundfont.c_str(), 1) == FLUID_FAILED) {
        return fail(soundfont.string() + ": not a soundfont that FluidSynth can load");
    }
    return SoundfontPlayer(std::move(synth));
}

std::vector<float> SoundfontPlayer::play(const Performance& performance, const PlayerRoom& room) {
    fluid_synth_t* const synth = synth_->synth;
    fluid_synth_system_reset(synth);
    fluid_synth_reverb_on(synth, -1, room.level > 0.0 ? 1 : 0);
    fluid_synth_set_reverb_group_roomsize(synth, -1, room.size);
    fluid_synth_set_reverb_group_level(synth, -1, room.level);
    std::array<int, 16> programs{};
    programs.fill(-1);
    std::array<int, 16> bends{};
    bends.fill(kNoBend);
    const auto total = static_cast<std::size_t>(performance.seconds * kRate);
    std::vector<float> mono;
    mono.reserve(total + kDelay);
    for (const PlayerEvent& event : events_of(performance)) {
        const std::size_t at = std::min(event.sample, total + kDelay);
        if (at > mono.size()) {
            synth_->render(at - mono.size(), mono);
        }
        const PlayedNote& note = event.note;
        int& program = programs[static_cast<std::size_t>(note.channel)];
        if (program != note.program) {
            fluid_synth_program_change(synth, note.channel, note.program);
            fluid_synth_cc(synth, note.channel, 91, static_cast<int>(127 * room.level));
            program = note.program;
        }
        int& bend = bends[static_cast<std::size_t>(note.channel)];
        const int wanted = kNoBend + static_cast<int>(std::lround(kBendOfCent * note.cents));
        if (event.is_on && bend != wanted) {
            fluid_synth_pitch_bend(synth, note.channel, wanted);
            bend = wanted;
        }
        if (event.is_on) {
            fluid_synth_noteon(synth, note.channel, note.key, note.velocity);
        } else {
            fluid_synth_noteoff(synth, note.channel, note.key);
        }
    }
    if (mono.size() < total + kDelay) {
        synth_->render(total + kDelay - mono.size(), mono);
    }
    mono.erase(mono.begin(), mono.begin() + kDelay);
    mono.resize(total);
    float peak = 1e-6F;
    for (const float sample : mono) {
        peak = std::max(peak, std::abs(sample));
    }
    for (float& sample : mono) {
        sample *= 0.7F / peak;
    }
    return mono;
}

}  // namespace raks::audio
