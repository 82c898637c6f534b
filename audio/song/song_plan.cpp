#include "audio/song/song_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "audio/beat/beat_limits.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "audio/genre/genre_model.hpp"
#include "audio/song/form_states.hpp"

namespace raks::audio {
namespace {

// Energy: loudness of the next two bars or so against the whole song's.
constexpr std::size_t kAheadHops = 250;
constexpr float kQuietest = -60.0F;   // LUFS
constexpr float kEnergySpan = 10.0F;  // LU between the calmest and the liveliest

std::size_t hop_at(StreamTime time, std::size_t hops) {
    const std::int64_t hop = time.time_since_epoch() / kHop - (time < StreamTime{} ? 1 : 0);
    return static_cast<std::size_t>(
        std::clamp<std::int64_t>(hop, 0, static_cast<std::int64_t>(hops) - 1));
}

// Grid, beats and predictions of every hop.
void write_beats(const std::vector<SongBeat>& beats, std::vector<MusicState>& states) {
    for (MusicState& state : states) {
        state.has_beat = state.has_predicted = false;
        if (beats.size() >= 2) {
            state.grid = grid_at(beats, state.time);
            const auto& beat = beats[static_cast<std::size_t>(state.grid.anchor_beat.count())];
            state.rival = beat.rival;
            state.beat_parts = beat.parts;
        } else {
            state.grid.confidence = 0.0F;
            state.rival = {};
            state.beat_parts = MusicState().beat_parts;
        }
    }
    StreamTime last{std::chrono::seconds(-10)};
    for (const SongBeat& beat : beats) {
        const std::size_t hop = hop_at(beat.time, states.size());
        const double gap = kLeastGap * states[hop].grid.tempo.seconds_per_beat();
        if (beat.confidence <= kAnnounceConfidence || states[hop].is_silent ||
            to_seconds(beat.time - last) < gap) {
            continue;
        }
        last = beat.time;
        states[hop].has_beat = true;
        states[hop].beat = {
            beat.time, beat.place.position + 1, beat.confidence, beat.place.confidence};
        MusicState& before = states[hop_at(beat.time - kPredictedLead, states.size())];
        before.has_predicted = true;
        before.predicted = beat.time;
    }
}

// When the dance may begin and must end. Without any danceable beat: at the end.
void write_foresight(const std::vector<SongBeat>& beats, std::vector<MusicState>& states) {
    const StreamTime end = states.back().time;
    const auto is_danceable = [](const SongBeat& beat) {
        return beat.confidence >= BeatGrid::kDanceable;
    };
    const auto first = std::find_if(beats.begin(), beats.end(), [&](const SongBeat& beat) {
        return is_danceable(beat) && beat.place.position == 0;
    });
    const auto last = std::find_if(beats.rbegin(), beats.rend(), is_danceable);
    for (MusicState& state : states) {
        state.ahead.is_known = true;
        state.ahead.begins = first == beats.end() ? end : first->time;
        state.ahead.ends = last == beats.rend() ? end : last->time;
    }
}

// Bars are counted from the first that can be danced to.
std::vector<StreamTime> joins_of(const std::vector<SongBeat>& beats, StreamTime begins) {
    constexpr std::size_t kFirst = 5;
    constexpr std::size_t kEvery = 8;
    std::vector<StreamTime> joins;
    std::size_t bar = 0;
    for (const SongBeat& beat : beats) {
        if (beat.place.position == 0 && beat.time >= begins) {
            ++bar;
            if (bar == kFirst || bar % kEvery == 0) {
                joins.push_back(beat.time);
            }
        }
    }
    return joins;
}

// Mean loudness of the hops ahead against the mean of the song, silence left out of both.
void write_energy(std::vector<MusicState>& states) {
    // Running sums from the end: of loudness, and of the hops that count.
    std::vector<double> sums(states.size() + 1);
    std::vector<std::size_t> counts(states.size() + 1);
    for (std::size_t i = states.size(); i-- > 0;) {
        const bool counts_here = !states[i].is_silent && states[i].loudness_lufs >= kQuietest;
        sums[i] = sums[i + 1] + (counts_here ? static_cast<double>(states[i].loudness_lufs) : 0.0);
        counts[i] = counts[i + 1] + (counts_here ? 1 : 0);
    }
    const double usual = counts[0] > 0 ? sums[0] / static_cast<double>(counts[0]) : 0.0;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::size_t end = std::min(states.size(), i + kAheadHops);
        const std::size_t count = counts[i] - counts[end];
        const double ahead = count > 0 ? (sums[i] - sums[end]) / static_cast<double>(count) : usual;
        states[i].ahead.energy =
            std::clamp(0.5F + static_cast<float>(ahead - usual) / kEnergySpan, 0.0F, 1.0F);
    }
}

// The dance of each section, under the class's number in the program's list.
void write_dances(const std::vector<SongSection>& sections,
                  const std::vector<DanceId>& dances,
                  std::span<MusicState> states) {
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const SongSection& section = sections[i];
        const std::size_t end = i + 1 < sections.size() ? sections[i + 1].first_hop : states.size();
        for (MusicState& state : states.subspan(section.first_hop, end - section.first_hop)) {
            state.genre_log_probability = section.log_chances;
            state.genre_class = section.genre_class;
            state.genre = dances[section.genre_class];
            state.is_genre_told = section.is_told;
        }
    }
}

// By class of the model; its last class is none of them.
std::vector<DanceId> dances_of(const GenreModel& model, const DanceList* known) {
    std::vector<DanceId> dances;
    for (const std::string& genre : model.genres) {
        dances.push_back(known == nullptr ? DanceId::none : known->id_of(genre));
    }
    dances.push_back(DanceId::none);
    return dances;
}

}  // namespace

MusicState SongPlan::at(StreamTime place, HopIndex hop) const noexcept RAKS_NONBLOCKING {
    MusicState state;
    if (states.empty()) {
        return state;
    }
    state = states[hop_at(place, states.size())];
    if (place < StreamTime{} || place > states.back().time + kHop) {
        // They belong to the song's own hop.
        state.has_beat = state.has_predicted = false;
        state.event = {};
        state.accent = {};
        state.part = MusicPart::stopped;
        state.energy.now = 0.0F;
    }
    state.move_by(time_of_hop(hop) - place);
    state.hop = hop;
    state.time = time_of_hop(hop);
    return state;
}

struct SongAnalyzer::State {
    AnalyzerConfig config;
    MusicAnalyzer analyzer;
    std::optional<SongRecorder> recorder;
    std::int64_t samples = 0;
};

SongAnalyzer::SongAnalyzer() : state_(std::make_unique<State>()) {}
SongAnalyzer::~SongAnalyzer() = default;
SongAnalyzer::SongAnalyzer(SongAnalyzer&&) noexcept = default;
SongAnalyzer& SongAnalyzer::operator=(SongAnalyzer&&) noexcept = default;

Expected<void> SongAnalyzer::prepare(const AnalyzerConfig& config) {
    state_ = std::make_unique<State>();
    state_->config = config;
    state_->recorder.emplace(state_->analyzer);
    return state_->analyzer.prepare(config);
}

void SongAnalyzer::process(std::span<const float> mono) {
    state_->analyzer.process(mono, *state_->recorder);
    state_->samples += static_cast<std::int64_t>(mono.size());
}

SongPlan SongAnalyzer::finish() {
    State& state = *state_;
    // Hops before the end; silence brings the last of them out.
    const StreamTime end = state.config.sample_rate.time_of(state.samples);
    const auto hops = static_cast<std::size_t>(std::ceil(to_seconds(end) * kHopsPerSecond - 1e-9));
    const std::array<float, 256> silence{};
    while (state.recorder->hops() < hops) {
        state.analyzer.process(silence, *state.recorder);
    }
    SongRecording song = state.recorder->take(hops);
    SongPlan plan;
    if (hops == 0) {
        return plan;
    }
    const auto& network = state.config.beat_network;
    plan.beats = track_song(song, network.get(), state.config.told_bpm);
    plan.states = std::move(song.states);
    write_beats(plan.beats, plan.states);
    write_foresight(plan.beats, plan.states);
    plan.joins = joins_of(plan.beats, plan.states.front().ahead.begins);
    write_energy(plan.states);
    write_form(song, plan.beats, plan.states);
    if (const auto& model = state.config.genre_model) {
        const std::vector<DanceId> dances = dances_of(*model, state.config.dances.get());
        plan.sections = find_sections({.states = plan.states,
                                       .beats = plan.beats,
                                       .moments = song.moments,
                                       .patches = song.patches},
                                      *state.analyzer.genres(),
                                      state.config.genre_prior);
        write_dances(plan.sections, dances, plan.states);
    }
    return plan;
}

}  // namespace raks::audio
