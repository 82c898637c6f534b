#include "audio/song/form_states.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "audio/form/accent_detector.hpp"
#include "audio/form/last_chord.hpp"
#include "audio/song/song_bars.hpp"
#include "audio/song/song_energy.hpp"
#include "audio/song/song_pauses.hpp"
#include "audio/song/song_sections.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kAccentReach = 1500;  // hops to either side among which an accent is strong
constexpr std::size_t kFirstBar = 200;      // hops
constexpr std::size_t kBeforeEnd = 200;     // hops

// An event at the hop at which it is told.
struct FormEvent {
    std::size_t hop = 0;
    MusicEvent::Kind kind = MusicEvent::Kind::none;
};

// By hop: the strength of its onset, 0 where it is not the greatest of five.
std::vector<float> peaks_of(std::span<const HopSound> sounds) {
    std::vector<float> weights(sounds.size());
    std::transform(sounds.begin(), sounds.end(), weights.begin(), AccentDetector::weight);
    std::vector<float> peaks(sounds.size(), 0.0F);
    for (std::size_t i = 2; i + 2 < weights.size(); ++i) {
        const bool is_peak = weights[i] > weights[i + 1] && weights[i] > weights[i + 2] &&
                             weights[i] >= weights[i - 1] && weights[i] >= weights[i - 2];
        peaks[i] = is_peak && weights[i] >= AccentDetector::kLeast ? weights[i] : 0.0F;
    }
    return peaks;
}

// The strongest onset within kAccentReach of each hop (a sliding maximum over blocks).
std::vector<float> strongest_around(const std::vector<float>& peaks) {
    constexpr std::size_t kPeakBlock = 100;
    std::vector<float> blocks(peaks.size() / kPeakBlock + 1, 0.0F);
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        blocks[i / kPeakBlock] = std::max(blocks[i / kPeakBlock], peaks[i]);
    }
    std::vector<float> strongest(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const std::size_t first = i - std::min(i, kAccentReach / kPeakBlock);
        const std::size_t end = std::min(blocks.size(), i + kAccentReach / kPeakBlock + 1);
        strongest[i] = *std::max_element(blocks.begin() + static_cast<std::ptrdiff_t>(first),
                                         blocks.begin() + static_cast<std::ptrdiff_t>(end));
    }
    std::vector<float> result(peaks.size());
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        result[i] = strongest[i / kPeakBlock];
    }
    return result;
}

void write_accents(std::span<const HopSound> sounds,
                   const std::vector<float>& peaks,
                   const std::vector<float>& strongest,
                   std::vector<MusicState>& states) {
    HopIndex last = -AccentDetector::kApart;
    for (std::size_t i = 0; i < states.size(); ++i) {
        states[i].accent = {};
        const auto hop = static_cast<HopIndex>(i);
        if (peaks[i] > 0.0F && peaks[i] >= AccentDetector::kStrong * strongest[i] &&
            hop - last >= AccentDetector::kApart) {
            last = hop;
            states[i].accent =
                AccentDetector::accent(hop, sounds[i], peaks[i] / strongest[i], states[i].grid);
        }
    }
}

// Hop of the first sound.
std::size_t first_sound(const std::vector<SongPause>& pauses) {
    return !pauses.empty() && pauses.front().first == 0 ? pauses.front().end : 0;
}

void write_parts(const std::vector<SongPause>& pauses,
                 const std::vector<SongBreakdown>& breakdowns,
                 std::vector<MusicState>& states) {
    const auto fill = [&](std::size_t first, std::size_t end, MusicPart part) {
        for (std::size_t hop = first; hop < end; ++hop) {
            states[hop].part = part;
        }
    };
    fill(0, states.size(), MusicPart::playing);
    for (const SongBreakdown& breakdown : breakdowns) {
        fill(breakdown.first, breakdown.build_up, MusicPart::breakdown);
        fill(breakdown.build_up, breakdown.end, MusicPart::build_up);
    }
    for (const SongPause& pause : pauses) {
        fill(pause.first, pause.end, MusicPart::stopped);
    }
}

// Its last chord or beat.
std::size_t end_of_song(std::span<const HopSound> sounds, const std::vector<float>& peaks) {
    LastChord chord;
    for (std::size_t i = 0; i < sounds.size(); ++i) {
        chord.advance(static_cast<HopIndex>(i), sounds[i], peaks[i]);
    }
    return static_cast<std::size_t>(chord.hop());
}

// Most of a beat, so that one is missed, and a quarter of a second at least.
std::size_t least_stop(const std::vector<SongBeat>& beats) {
    constexpr double kLeastHops = 25.0;
    constexpr double kOfABeat = 0.9;
    if (beats.size() < 2) {
        return static_cast<std::size_t>(kLeastHops);
    }
    std::vector<double> lengths;
    for (std::size_t i = 1; i < beats.size(); ++i) {
        lengths.push_back(to_seconds(beats[i].time - beats[i - 1].time) * kHopsPerSecond);
    }
    return static_cast<std::size_t>(
        std::max(kLeastHops, kOfABeat * upper_median(std::move(lengths))));
}

// All events, ascending.
std::vector<FormEvent> events_of(const std::vector<SongPause>& pauses,
                                 const std::vector<SongBreakdown>& breakdowns,
                                 std::size_t end,
                                 std::size_t hops) {
    using Kind = MusicEvent::Kind;
    std::vector<FormEvent> events;
    const bool begins_quiet = !pauses.empty() && pauses.front().first == 0;
    if (begins_quiet && pauses.front().end == hops) {
        return events;  // nothing but silence
    }
    if (!begins_quiet) {
        events.push_back({0, Kind::entry});
    }
    for (const SongPause& pause : pauses) {
        if (pause.first > 0 && pause.end < hops) {
            events.push_back({pause.first, Kind::stop});
        }
        if (pause.end < hops) {
            events.push_back({pause.end, Kind::entry});
        }
    }
    for (const SongBreakdown& breakdown : breakdowns) {
        if (breakdown.first > 0) {
            events.push_back({breakdown.first, Kind::breakdown});
        }
        if (breakdown.build_up < breakdown.end) {
            events.push_back({breakdown.build_up, Kind::build_up});
        }
        if (breakdown.drops) {
            events.push_back({breakdown.end, Kind::drop});
        }
    }
    // What is told right before the last chord is of the chord.
    std::erase_if(events, [end](const FormEvent& event) {
        return event.hop + (event.kind == Kind::breakdown ? kBeforeEnd : 0) >= end;
    });
    events.push_back({end, Kind::end});
    std::stable_sort(events.begin(), events.end(), [](const FormEvent& a, const FormEvent& b) {
        return a.hop < b.hop;
    });
    return events;
}

// Each event at its hop, or at the next that has none; and what comes, at all hops before.
void write_events(const std::vector<FormEvent>& events, std::vector<MusicState>& states) {
    for (MusicState& state : states) {
        state.event = {};
        state.ahead.events = {};
    }
    for (const FormEvent& event : events) {
        std::size_t hop = event.hop;
        while (hop < states.size() && states[hop].event.kind != MusicEvent::Kind::none) {
            ++hop;
        }
        if (hop < states.size()) {
            states[hop].event = {event.kind, time_of_hop(static_cast<HopIndex>(event.hop))};
        }
    }
    std::array<MusicEvent, 2> next{};
    for (std::size_t i = states.size(); i-- > 0;) {
        states[i].ahead.events = next;
        if (states[i].event.kind != MusicEvent::Kind::none) {
            next = {states[i].event, next[0]};
        }
    }
}

}  // namespace

void write_form(const SongRecording& song,
                const std::vector<SongBeat>& beats,
                std::vector<MusicState>& states) {
    const std::vector<SongPause> pauses = find_pauses(song.sounds, least_stop(beats));
    std::vector<SongBreakdown> breakdowns = find_breakdowns(song.sounds, pauses, beats);
    if (!breakdowns.empty() && breakdowns.front().first < first_sound(pauses) + kFirstBar) {
        breakdowns.front().first = 0;  // it begins calm: nothing breaks down
    }
    const std::vector<MusicEnergy> energies = measure_energy(song.sounds, pauses);
    for (std::size_t i = 0; i < states.size(); ++i) {
        states[i].energy = energies[i];
    }
    const std::vector<float> peaks = peaks_of(song.sounds);
    const std::vector<float> strongest = strongest_around(peaks);
    write_accents(song.sounds, peaks, strongest, states);
    write_parts(pauses, breakdowns, states);
    write_events(events_of(pauses, breakdowns, end_of_song(song.sounds, peaks), states.size()),
                 states);
    write_bars(song, beats, states);
}

}  // namespace raks::audio
