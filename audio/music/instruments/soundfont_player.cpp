#include "audio/music/instruments/soundfont_player.hpp"

#include <fluidsynth.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>

namespace raks::audio {
namespace {

constexpr std::size_t kDelay = 110;  // samples: measured on clicks

// FluidSynth's MIDI channels: the score's, then one for each drummer of a band.
constexpr int kChannels = 32;
constexpr int kFirstDrummer = 16;
// The bank under which soundfonts have their drum kits.
constexpr int kDrumBank = 128;

constexpr int kNoBend = 8'192;  // MIDI's middle; the whole way up is two semitones
constexpr double kBendOfCent = 8'192 / 200.0;

/// A note starts or ends.
struct PlayerEvent {
    std::size_t sample = 0;
    bool is_on = false;
    PlayedNote note;
};

/// Starts and ends in order of time. At one sample ends come first, so that a note that is struck
/// again is not ended by the note before it.
std::vector<PlayerEvent> events_of(const Performance& performance) {
    const auto sample_of = [](double seconds) {
        return static_cast<std::size_t>(std::max(0.0, seconds) * kPerformanceRate);
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

// FluidSynth opens a soundfont again whenever it needs samples, which a cage would refuse. So it
// reads by these from the descriptor that its name says.

constexpr std::string_view kNowhere = "/dev/null/";  // no file can be below it

/// A place in a soundfont, and what was read ahead: FluidSynth asks for two bytes at a time.
struct Reading {
    int descriptor = -1;
    fluid_long_long_t at = 0;  // bytes, as are the next two
    fluid_long_long_t ahead_from = 0;
    std::size_t ahead_size = 0;
    std::array<char, 16'384> ahead{};

    /// Copies what was read ahead from here, at most `count` bytes; how many.
    std::size_t take(char* to, std::size_t count) {
        const fluid_long_long_t inside = at - ahead_from;
        if (inside < 0 || inside >= static_cast<fluid_long_long_t>(ahead_size)) {
            return 0;
        }
        const auto first = static_cast<std::size_t>(inside);
        const std::size_t taken = std::min(count, ahead_size - first);
        std::copy_n(ahead.data() + first, taken, to);
        at += static_cast<fluid_long_long_t>(taken);
        return taken;
    }
    /// Reads ahead from here; false at the end and where it cannot be read.
    bool read_ahead() {
        const ssize_t got = ::pread(descriptor, ahead.data(), ahead.size(), at);
        ahead_from = at;
        ahead_size = got > 0 ? static_cast<std::size_t>(got) : 0;
        return got > 0;
    }
    /// Reads at once into `to`; false as above.
    bool read(char*& to, std::size_t& count) {
        const ssize_t got = ::pread(descriptor, to, count, at);
        if (got <= 0) {
            return false;
        }
        at += got;
        to += got;
        count -= static_cast<std::size_t>(got);
        return true;
    }
};

std::string name_of(int descriptor) { return std::string(kNowhere) + std::to_string(descriptor); }

void* open_reading(const char* name) {
    const std::string_view number = std::string_view(name).substr(kNowhere.size());
    auto reading = std::make_unique<Reading>();
    std::from_chars(number.data(), number.data() + number.size(), reading->descriptor);
    return reading.release();  // close_reading() takes it back
}

int close_reading(void* handle) {
    const std::unique_ptr<Reading> owned(static_cast<Reading*>(handle));
    return FLUID_OK;
}

int read_reading(void* to, fluid_long_long_t count, void* handle) {
    auto* const reading = static_cast<Reading*>(handle);
    auto* next = static_cast<char*>(to);
    auto left = static_cast<std::size_t>(count);
    while (left > 0) {
        const std::size_t taken = reading->take(next, left);
        next += taken;
        left -= taken;
        // Samples are long: they go to their place without a copy.
        const bool is_long = left >= reading->ahead.size();
        if (left > 0 && !(is_long ? reading->read(next, left) : reading->read_ahead())) {
            return FLUID_FAILED;
        }
    }
    return FLUID_OK;
}

int seek_reading(void* handle, fluid_long_long_t offset, int origin) {
    auto* const reading = static_cast<Reading*>(handle);
    struct stat status {};
    if (::fstat(reading->descriptor, &status) != 0) {
        return FLUID_FAILED;
    }
    const fluid_long_long_t from = origin == SEEK_SET   ? 0
                                   : origin == SEEK_CUR ? reading->at
                                                        : status.st_size;
    if (offset < -from || offset > status.st_size - from) {
        return FLUID_FAILED;
    }
    reading->at = from + offset;
    return FLUID_OK;
}

fluid_long_long_t tell_reading(void* handle) { return static_cast<Reading*>(handle)->at; }

}  // namespace

struct SoundfontPlayer::Synth {
    fluid_settings_t* settings = new_fluid_settings();
    fluid_synth_t* synth = nullptr;
    std::vector<int> soundfonts;  // FluidSynth's numbers

    Synth() {
        // A reset ends more voices at once than FluidSynth's list holds. It logs each of them
        // although nothing is wrong, so its log is off.
        fluid_set_log_function(FLUID_ERR, nullptr, nullptr);
        fluid_set_log_function(FLUID_WARN, nullptr, nullptr);
        fluid_set_log_function(FLUID_INFO, nullptr, nullptr);
        fluid_settings_setnum(settings, "synth.sample-rate", kPerformanceRate);
        // Only the samples of instruments that play are read.
        fluid_settings_setint(settings, "synth.dynamic-sample-loading", 1);
        fluid_settings_setint(settings, "synth.chorus.active", 0);
        fluid_settings_setint(settings, "synth.polyphony", 256);
        fluid_settings_setint(settings, "synth.midi-channels", kChannels);
        fluid_settings_setnum(settings, "synth.gain", 0.4);
        synth = new_fluid_synth(settings);
        if (synth != nullptr) {
            fluid_sfloader_t* const loader = new_fluid_defsfloader(settings);
            fluid_sfloader_set_callbacks(
                loader, open_reading, read_reading, seek_reading, tell_reading, close_reading);
            fluid_synth_add_sfloader(synth, loader);  // which owns it
        }
    }
    ~Synth() {
        delete_fluid_synth(synth);
        delete_fluid_settings(settings);
    }
    Synth(const Synth&) = delete;
    Synth& operator=(const Synth&) = delete;

    /// Mono samples of the performance; `band` null: the first soundfont plays everything as it is.
    std::vector<float> play(const Performance& performance,
                            const PlayerRoom& room,
                            const PlayerBand* band) {
        fluid_synth_system_reset(synth);
        fluid_synth_reverb_on(synth, -1, room.level > 0.0 ? 1 : 0);
        fluid_synth_set_reverb_group_roomsize(synth, -1, room.size);
        fluid_synth_set_reverb_group_level(synth, -1, room.level);
        states.fill({});
        const auto total = static_cast<std::size_t>(performance.seconds * kPerformanceRate);
        std::vector<float> mono;
        mono.reserve(total + kDelay);
        for (const PlayerEvent& event : events_of(performance)) {
            // FluidSynth has no clock: samples are rendered up to an event, then it is sent.
            const std::size_t at = std::min(event.sample, total + kDelay);
            if (at > mono.size()) {
                render(at - mono.size(), mono);
            }
            send(event, room, band);
        }
        if (mono.size() < total + kDelay) {
            render(total + kDelay - mono.size(), mono);
        }
        // Taking the delay off puts onsets where the performance's beats are.
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

 private:
    /// What a channel was told last.
    struct ChannelState {
        int program = -1;
        int bend = kNoBend;
    };

    /// Sends one event to its channel, with the program and pitch bend that it needs before it.
    void send(const PlayerEvent& event, const PlayerRoom& room, const PlayerBand* band) {
        const PlayedNote& note = event.note;
        const bool is_drum = note.channel == kDrumChannel;
        const auto key = static_cast<std::size_t>(note.key);
        // In a band each drummer has a channel, because a channel has one kit and one sound.
        const std::size_t drummer = band != nullptr && is_drum ? band->drummer_of_key[key] : 0;
        const int channel =
            band != nullptr && is_drum ? kFirstDrummer + static_cast<int>(drummer) : note.channel;
        ChannelState& state = states[static_cast<std::size_t>(channel)];
        if (state.program != note.program) {
            if (band == nullptr) {
                fluid_synth_program_change(synth, channel, note.program);
            } else {
                const BandPlayer& player = is_drum
                                               ? band->drummers[drummer]
                                               : band->channels[static_cast<std::size_t>(channel)];
                select(channel,
                       player.soundfont,
                       is_drum ? kDrumBank : 0,
                       player.kit.value_or(note.program));
                set_sound(channel, player);
            }
            // Controller 91 is the reverb send.
            fluid_synth_cc(synth, channel, 91, static_cast<int>(127 * room.level));
            state.program = note.program;
        }
        // A bend holds for the whole channel; it is sent with a note's start only.
        const int wanted = kNoBend + static_cast<int>(std::lround(kBendOfCent * note.cents));
        if (event.is_on && state.bend != wanted) {
            fluid_synth_pitch_bend(synth, channel, wanted);
            state.bend = wanted;
        }
        if (event.is_on) {
            fluid_synth_noteon(synth, channel, note.key, note.velocity);
        } else {
            fluid_synth_noteoff(synth, channel, note.key);
        }
    }

    /// Selects the instrument of this soundfont, or of the next that has it, else program 0. Kits
    /// that the soundfont lacks become its standard kit.
    void select(int channel, std::size_t soundfont, int bank, int program) const {
        // Drums do not move on to another soundfont: a kit of its own is what makes a drummer
        // differ.
        for (const int wanted : {program, 0}) {
            for (std::size_t i = 0; i < soundfonts.size(); ++i) {
                const int from = soundfonts[(soundfont + i) % soundfonts.size()];
                if (fluid_synth_program_select(synth, channel, from, bank, wanted) == FLUID_OK) {
                    return;
                }
                if (bank == kDrumBank) {
                    break;
                }
            }
        }
    }

    /// SoundFont generators of a channel: cents for tuning and times, centibels for the level.
    void set_sound(int channel, const BandPlayer& player) const {
        constexpr double kCentsOfOctave = 1'200.0;
        constexpr double kCentibelsOfDecibel = 10.0;
        const auto set = [&](int generator, double value) {
            fluid_synth_set_gen(synth, channel, generator, static_cast<float>(value));
        };
        set(GEN_COARSETUNE, player.semitones);
        set(GEN_FILTERFC, kCentsOfOctave * player.brightness);
        set(GEN_VOLENVDECAY, kCentsOfOctave * player.decay);
        set(GEN_VOLENVRELEASE, kCentsOfOctave * player.decay);
        set(GEN_ATTENUATION, -kCentibelsOfDecibel * player.level);
    }

    /// Appends `frames` samples, both channels mixed.
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

    std::array<ChannelState, kChannels> states{};
};

SoundfontPlayer::SoundfontPlayer() {
    // The first synthesizer fills FluidSynth's global tables. One is made here, once, before any
    // other thread plays: with tables half full the samples would differ between runs.
    [[maybe_unused]] static const bool are_tables_full = [] {
        const Synth first;
        return first.synth != nullptr;
    }();
    synth_ = std::make_unique<Synth>();
}

SoundfontPlayer::~SoundfontPlayer() = default;

Expected<void> SoundfontPlayer::load(std::span<const SoundfontFile> soundfonts) {
    // FluidSynth looks an instrument up in the soundfont that was loaded last, so the first one is
    // loaded last.
    for (std::size_t i = soundfonts.size(); i-- > 0;) {
        const std::string name = name_of(soundfonts[i].descriptor);
        const int number = synth_->synth == nullptr
                               ? FLUID_FAILED
                               : fluid_synth_sfload(synth_->synth, name.c_str(), 1);
        if (number == FLUID_FAILED) {
            return fail(soundfonts[i].name + ": is not a soundfont that FluidSynth can load");
        }
        synth_->soundfonts.insert(synth_->soundfonts.begin(), number);
    }
    return {};
}

std::vector<float> SoundfontPlayer::play(const Performance& performance, const PlayerRoom& room) {
    return synth_->play(performance, room, nullptr);
}

std::vector<float> SoundfontPlayer::play(const Performance& performance,
                                         const PlayerRoom& room,
                                         const PlayerBand& band) {
    return synth_->play(performance, room, &band);
}

}  // namespace raks::audio
