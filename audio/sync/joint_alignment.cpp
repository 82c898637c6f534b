#include "audio/sync/joint_alignment.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>

#include "base/assert.hpp"
#include "base/parallel.hpp"

namespace raks::audio {
namespace {

// Two tracks and how the second lies against the first; the reference is always the first.
struct Pair {
    std::size_t first = 0;
    std::size_t second = 0;
    Expected<TrackAlignment> alignment;
};

std::vector<Pair> align_pairs(std::span<const SyncTrack> tracks,
                              std::size_t reference,
                              const JointOptions& options,
                              const std::function<bool(std::size_t, std::size_t)>& progress) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < tracks.size(); ++a) {
        for (std::size_t b = a + 1; b < tracks.size(); ++b) {
            const auto [first, second] = b == reference ? std::pair(b, a) : std::pair(a, b);
            pairs.push_back({first, second, fail(tracks[second].name() + ": not aligned yet")});
        }
    }
    std::mutex reporting;
    std::size_t done = 0;
    std::atomic<bool> is_stopped{false};
    run_parallel(pairs.size(), options.threads, [&](std::size_t i) {
        if (is_stopped.load()) {
            return;
        }
        Pair& pair = pairs[i];
        const bool has_song = options.song == pair.first || options.song == pair.second;
        pair.alignment =
            align_tracks(tracks[pair.first],
                         tracks[pair.second],
                         has_song ? std::numeric_limits<double>::infinity() : options.most_offset);
        const std::lock_guard lock(reporting);
        ++done;
        if (progress && !progress(done, pairs.size())) {
            is_stopped.store(true);
        }
    });
    return pairs;
}

// The surest pair between a track that has joined and one that has not.
const Pair* surest_way(const std::vector<Pair>& pairs, const std::vector<bool>& has_joined) {
    const Pair* best = nullptr;
    for (const Pair& pair : pairs) {
        if (pair.alignment && has_joined[pair.first] != has_joined[pair.second] &&
            (best == nullptr || pair.alignment->confidence > best->alignment->confidence)) {
            best = &pair;
        }
    }
    return best;
}

// How far a pair's own line is off what the joint clocks say, in the middle of its shorter track.
double disagreement(const Pair& pair,
                    const std::vector<Expected<JointClock>>& clocks,
                    std::span<const SyncTrack> tracks) {
    const double middle =
        0.5 * std::min(tracks[pair.first].seconds(), tracks[pair.second].seconds());
    const double direct = clocks[pair.first]->line.at(pair.alignment->line.at(middle));
    return std::abs(direct - clocks[pair.second]->line.at(middle));
}

// Why a track stays apart: what its pair with the reference says.
const Error& why_apart(const std::vector<Pair>& pairs, std::size_t track, std::size_t reference) {
    return std::find_if(
               pairs.begin(),
               pairs.end(),
               [&](const Pair& pair) { return pair.first == reference && pair.second == track; })
        ->alignment.error();
}

}  // namespace

std::vector<Expected<JointClock>> align_jointly(
    std::span<const SyncTrack> tracks,
    std::size_t reference,
    const JointOptions& options,
    const std::function<bool(std::size_t, std::size_t)>& progress) {
    RAKS_ASSERT(reference < tracks.size());
    const auto pairs = align_pairs(tracks, reference, options, progress);
    std::vector<Expected<JointClock>> clocks(tracks.size());
    std::vector<bool> has_joined(tracks.size());
    clocks[reference] = JointClock{{}, 1.0, reference, 0, 0, 0.0};
    has_joined[reference] = true;
    while (const Pair* const pair = surest_way(pairs, has_joined)) {
        const bool is_forward = has_joined[pair->first];
        const std::size_t known = is_forward ? pair->first : pair->second;
        const std::size_t joins = is_forward ? pair->second : pair->first;
        const TrackAlignment& found = *pair->alignment;
        const ClockLine line = is_forward ? found.line : found.line.inverse();
        clocks[joins] = JointClock{line.then(clocks[known]->line),
                                   std::min(found.confidence, clocks[known]->confidence),
                                   known,
                                   found.used,
                                   found.compared,
                                   0.0};
        has_joined[joins] = true;
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (!has_joined[i]) {
            clocks[i] = fail(why_apart(pairs, i, reference));
        }
    }
    for (const Pair& pair : pairs) {
        if (pair.alignment && has_joined[pair.first] && has_joined[pair.second]) {
            const double off = disagreement(pair, clocks, tracks);
            for (const std::size_t i : {pair.first, pair.second}) {
                clocks[i]->disagreement = std::max(clocks[i]->disagreement, off);
            }
        }
    }
    return clocks;
}

void correct_sound_way(std::span<Expected<JointClock>> clocks,
                       std::span<const std::optional<double>> distances,
                       std::size_t reference) {
    RAKS_ASSERT(clocks.size() == distances.size() && reference < clocks.size());
    if (!distances[reference]) {
        return;
    }
    for (std::size_t i = 0; i < clocks.size(); ++i) {
        if (clocks[i] && distances[i]) {
            clocks[i]->line.offset += (*distances[i] - *distances[reference]) / kSpeedOfSound;
        }
    }
}

}  // namespace raks::audio
