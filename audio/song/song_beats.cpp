#include "audio/song/song_beats.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "audio/beat/beat_confidence.hpp"
#include "audio/beat/beat_limits.hpp"
#include "audio/song/song_margins.hpp"
#include "audio/song/song_pulses.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kRatedBeats = 4;  // over which the evidence is averaged, on either side

// Evidence around a beat: of two hops on either side.
struct BeatRating {
    float beat = 0.0F;      // greatest
    float own = 0.0F;       // greatest of our own networks
    float downbeat = 0.0F;  // greatest
    float strength = 0.0F;  // mean onset strength
};

BeatRating rate(const SongRecording& song, double hop) {
    constexpr std::int64_t kAround = 2;
    BeatRating rating;
    const std::int64_t centre = std::llround(hop);
    for (std::int64_t at = centre - kAround; at <= centre + kAround; ++at) {
        if (at < 0 || at >= static_cast<std::int64_t>(song.hops.size())) {
            continue;
        }
        const SongHop& here = song.hops[static_cast<std::size_t>(at)];
        rating.beat = std::max(rating.beat, here.evidence.beat);
        rating.own = std::max(rating.own, here.own_evidence.beat);
        rating.downbeat = std::max(rating.downbeat, here.evidence.downbeat);
        rating.strength += here.onset_strength / (2 * kAround + 1);
    }
    return rating;
}

float share_of(float value, float least, float full) {
    return std::clamp((value - least) / (full - least), 0.0F, 1.0F);
}

// Judges how sure the evidence of a beat is, [0, 1]: by the network where there is one. In a
// sound's first seconds a recurrent network knows too little, and the onset strength counts, too.
class Certainty {
 public:
    explicit Certainty(const SongRecording& song)
        : has_network_(!song.hops.empty() && song.hops.front().has_evidence) {
        const auto first = std::find_if(song.states.begin(),
                                        song.states.end(),
                                        [](const MusicState& state) { return !state.is_silent; });
        warm_from_ = static_cast<double>(first - song.states.begin()) + kColdHops;
    }

    [[nodiscard]] float of(const BeatRating& rating, double hop) const {
        const float by_network = share_of(rating.own, kLeastEvidence, kFullEvidence);
        const float by_onset = share_of(rating.strength, kLeastStrength, kFullStrength);
        if (!has_network_) {
            return by_onset;
        }
        return hop < warm_from_ ? std::max(by_network, by_onset) : by_network;
    }

 private:
    static constexpr double kColdHops = 400.0;
    bool has_network_;
    double warm_from_ = 0.0;  // hop
};

// Collects the sound of each beat, as BeatTracker does: what the bar network says of it, and how
// much the sound changed at its beginning.
class BeatSounds {
 public:
    BeatSounds(const SongRecording& song, std::shared_ptr<const BarNetwork> bars) : song_(song) {
        if (bars) {
            stream_.emplace(std::move(bars));
        }
    }

    // The sound from one beat to the next, in hops.
    [[nodiscard]] BarLikelihood next(double from, double to) {
        // A window shows a sound before its centre reaches it.
        const double begin = from - BarInput::kAheadHops;
        const double end = to - BarInput::kAheadHops;
        for (auto hop = std::max<std::int64_t>(0, std::llround(std::ceil(begin)));
             static_cast<double>(hop) < end && hop < static_cast<std::int64_t>(song_.hops.size());
             ++hop) {
            const auto at = static_cast<std::size_t>(hop);
            changes_.add(song_.mel_of(at));
            input_.add_hop(song_.mel_of(at),
                           (static_cast<double>(hop) - begin) / (end - begin),
                           song_.hops[at].own_evidence);
        }
        BarLikelihood likelihood = BarLikelihood::of_change(changes_.next_beat());
        if (stream_ && song_.hops.front().has_evidence) {
            likelihood *= BarLikelihood::of_bar(stream_->next(input_.next_beat()));
        }
        return likelihood;
    }

 private:
    const SongRecording& song_;
    BeatChange changes_;
    BarInput input_;
    std::optional<BarNetworkStream> stream_;
};

// Mean certainty of the beats on the surer side: a beat belongs to the music from the first to the
// last of a row.
std::vector<float> confidences(const std::vector<float>& certain) {
    std::vector<float> result(certain.size());
    const auto mean = [&](std::size_t first, std::size_t end) {
        float sum = 0.0F;
        for (std::size_t i = first; i < end; ++i) {
            sum += certain[i];
        }
        return sum / static_cast<float>(end - first);
    };
    for (std::size_t i = 0; i < certain.size(); ++i) {
        const float before = mean(i - std::min(i, kRatedBeats - 1), i + 1);
        const float after = mean(i, std::min(certain.size(), i + kRatedBeats));
        // A beat that is not heard itself belongs to a row only where both sides of it are sure.
        result[i] = certain[i] > 0.0F ? std::max(before, after) : std::min(before, after);
    }
    return result;
}

}  // namespace

std::vector<SongBeat> track_song(const SongRecording& song,
                                 const BeatNetwork* network,
                                 double told_bpm) {
    const PointerStates states({.told_bpm = told_bpm});
    std::vector<PathBeat> path = find_beats(song.hops, states);
    smooth_beats(path);
    const std::vector<float> right = correct_pulse(
        song, network != nullptr && told_bpm <= 0.0 ? network->pulses() : nullptr, path);
    BeatSounds sounds(song, network != nullptr ? network->bars() : nullptr);
    const ConfidenceModel confidence =
        network != nullptr ? network->confidence() : ConfidenceModel();
    const Certainty certainty(song);
    std::vector<BarLikelihood> likelihoods;
    std::vector<float> certain;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const double end =
            i + 1 < path.size() ? path[i + 1].hop : static_cast<double>(song.hops.size());
        BarLikelihood likelihood = sounds.next(path[i].hop, end);
        const BeatRating rating = rate(song, path[i].hop);
        // A beat with little evidence says nothing about the bar.
        if (rating.beat > kLeastEvidence) {
            likelihood *= BarLikelihood::of_downbeat(rating.downbeat / rating.beat);
        }
        likelihoods.push_back(likelihood);
        certain.push_back(certainty.of(rating, path[i].hop));
    }
    const std::vector<BarPlace> places = find_bars(likelihoods);
    const std::vector<float> sure = confidences(certain);
    const bool has_network = !song.hops.empty() && song.hops.front().has_evidence;
    const SongMargins song_margins(song, path);
    std::vector<SongBeat> beats;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const double hop = std::max(0.0, path[i].hop + kOnsetLagHops);
        SongBeat beat{.time = stream_time_from_seconds(hop / kHopsPerSecond),
                      .place = places[i],
                      .confidence = sure[i],
                      .rival = {},
                      .parts = 2,
                      .is_restart = path[i].is_restart};
        if (has_network && path.size() > 1) {
            const PulseMargins margins = song_margins.around(i);
            const BeatVerdict verdict =
                judge_beat(confidence, margins, right[i], song_margins.bpm(i), sure[i]);
            beat.confidence = verdict.confidence;
            beat.rival = {verdict.rival_rate * song_margins.bpm(i), verdict.rival};
            beat.parts = margins.for_three() > 0.0F ? 3 : 2;
        }
        beats.push_back(beat);
    }
    return beats;
}

BeatGrid grid_at(const std::vector<SongBeat>& beats, StreamTime time) {
    const auto after = std::upper_bound(
        beats.begin(), beats.end(), time, [](StreamTime moment, const SongBeat& beat) {
            return moment < beat.time;
        });
    // The beat before, but one that has a next one.
    const auto number = std::clamp<std::ptrdiff_t>(
        after - beats.begin() - 1, 0, static_cast<std::ptrdiff_t>(beats.size()) - 2);
    const SongBeat& beat = beats[static_cast<std::size_t>(number)];
    const SongBeat& next = beats[static_cast<std::size_t>(number + 1)];
    BeatGrid grid;
    grid.anchor_time = beat.time;
    grid.anchor_beat = Beats(static_cast<double>(number));
    grid.tempo = Bpm::from_period(std::max(0.2, to_seconds(next.time - beat.time)));
    grid.beats_per_bar = beat.place.beats_per_bar;
    grid.bar_origin = Beats(static_cast<double>(number - beat.place.position));
    grid.confidence = beat.confidence;
    grid.bar_confidence = beat.place.confidence;
    return grid;
}

}  // namespace raks::audio
