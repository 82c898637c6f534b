#include "audio/song/song_recording.hpp"

#include <utility>

#include "audio/beat/beat_tracker.hpp"

namespace raks::audio {
namespace {

// Soft for longer than a beat at this tempo lasts: the hop holds no evidence.
constexpr int kQuietHops = 55;

}  // namespace

void SongRecorder::on_state(const MusicState& state) noexcept {
    const TrackedHop& tracked = analyzer_.tracked();
    recording_.states.push_back(state);
    recording_.hops.push_back({.onset_strength = tracked.onset_strength,
                               .evidence = {},
                               .own_evidence = {},
                               .has_evidence = tracked.has_evidence,
                               .is_blind = tracked.is_silent || tracked.quiet_hops > kQuietHops});
    // The network's evidence is about an earlier hop.
    const auto lag = static_cast<std::size_t>(tracked.evidence_lag);
    if (tracked.has_evidence && recording_.hops.size() > lag) {
        SongHop& then = recording_.hops[recording_.hops.size() - 1 - lag];
        then.evidence = tracked.evidence;
        then.own_evidence = tracked.own_evidence;
    }
    recording_.mel.insert(
        recording_.mel.end(), tracked.mel_magnitudes.begin(), tracked.mel_magnitudes.end());
    recording_.sounds.push_back(analyzer_.sound());
    if (const GenreRecognizer* const genres = analyzer_.genres()) {
        record_genre(static_cast<std::size_t>(state.hop), *genres);
    }
}

// What is new since the hop before.
void SongRecorder::record_genre(std::size_t hop, const GenreRecognizer& genres) {
    const GenreRecognizer::Moment& said = genres.moment();
    if (said.number > 0 &&
        (recording_.moments.empty() || recording_.moments.back().said.number != said.number)) {
        recording_.moments.push_back({hop, said});
    }
    const SongJudgement::Patch& patch = genres.patch();
    if (patch.number > 0 &&
        (recording_.patches.empty() || recording_.patches.back().number != patch.number)) {
        recording_.patches.push_back(patch);
    }
}

SongRecording SongRecorder::take(std::size_t hops) {
    recording_.states.resize(hops);
    recording_.hops.resize(hops);
    recording_.mel.resize(hops * SongRecording::kMelBands);
    recording_.sounds.resize(hops);
    return std::exchange(recording_, {});
}

}  // namespace raks::audio
