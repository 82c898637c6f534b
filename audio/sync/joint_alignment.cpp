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

// Two tracks and how the second lies against the first.
struct Pair {
    std::size_t first = 0;
    std::size_t second = 0;
    Expected<TrackAlignment> alignment;

    [[nodiscard]] bool has(std::size_t track) const { return first == track || second == track; }
};

std::vector<Pair> align_pairs(std::span<const SyncTrack> tracks,
                              const JointOptions& options,
                              const std::function<bool(std::size_t, std::size_t)>& progress) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < tracks.size(); ++a) {
        for (std::size_t b = a + 1; b < tracks.size(); ++b) {
            pairs.push_back({a, b, fail(tracks[b].name() + ": not aligned yet")});
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
        const bool has_song = options.song && pair.has(*options.song);
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

// The tracks that join this one, by whatever ways.
std::vector<bool> group_of(std::size_t track, const std::vector<Pair>& pairs, std::size_t count) {
    std::vector<bool> group(count);
    group[track] = true;
    for (bool has_grown = true; has_grown;) {
        has_grown = false;
        for (const Pair& pair : pairs) {
            if (pair.alignment && group[pair.first] != group[pair.second]) {
                group[pair.first] = true;
                group[pair.second] = true;
                has_grown = true;
            }
        }
    }
    return group;
}

// The first track, but the song, of the largest group.
std::size_t choose_reference(const std::vector<Pair>& pairs,
                             std::size_t count,
                             std::optional<std::size_t> song) {
    std::size_t best = 0;
    std::ptrdiff_t most = 0;
    for (std::size_t track = 0; track < count; ++track) {
        const auto group = group_of(track, pairs, count);
        const auto size = std::count(group.begin(), group.end(), true);
        if (track != song && size > most) {
            best = track;
            most = size;
        }
    }
    return best;
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

// Joins track after track to the reference.
void join(const std::vector<Pair>& pairs, JointAlignment& joint) {
    std::vector<bool> has_joined(joint.clocks.size());
    joint.clocks[joint.reference] = JointClock{{}, 1.0, joint.reference, 0, 0, 0.0, false};
    has_joined[joint.reference] = true;
    while (const Pair* const pair = surest_way(pairs, has_joined)) {
        const bool is_forward = has_joined[pair->first];
        const std::size_t known = is_forward ? pair->first : pair->second;
        const std::size_t joins = is_forward ? pair->second : pair->first;
        const TrackAlignment& found = *pair->alignment;
        const ClockLine line = is_forward ? found.line : found.line.inverse();
        JointClock clock;
        clock.line = line.then(joint.clocks[known]->line);
        clock.confidence = std::min(found.confidence, joint.clocks[known]->confidence);
        clock.through = known;
        clock.used = found.used;
        clock.compared = found.compared;
        joint.clocks[joins] = clock;
        has_joined[joins] = true;
    }
}

// How far a pair's own line is off what the joint clocks say, in the middle of its shorter track.
double disagreement(const Pair& pair,
                    const JointAlignment& joint,
                    std::span<const SyncTrack> tracks) {
    const double middle =
        0.5 * std::min(tracks[pair.first].seconds(), tracks[pair.second].seconds());
    const double direct = joint.clocks[pair.first]->line.at(pair.alignment->line.at(middle));
    return std::abs(direct - joint.clocks[pair.second]->line.at(middle));
}

// Why a track stays apart: what its pair with the reference says.
Error why_apart(const std::vector<Pair>& pairs,
                std::span<const SyncTrack> tracks,
                std::size_t track,
                std::size_t reference) {
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& one) {
        return one.has(track) && one.has(reference);
    });
    // The line begins with the name of the pair's second track.
    const Error& error = pair->alignment.error();
    return pair->second == track ? error : Error(error).in(tracks[track].name() + " stays apart");
}

}  // namespace

JointAlignment align_jointly(std::span<const SyncTrack> tracks,
                             const JointOptions& options,
                             const std::function<bool(std::size_t, std::size_t)>& progress) {
    RAKS_ASSERT(!tracks.empty() && options.reference.value_or(0) < tracks.size());
    const auto pairs = align_pairs(tracks, options, progress);
    JointAlignment joint;
    joint.reference =
        options.reference.value_or(choose_reference(pairs, tracks.size(), options.song));
    joint.clocks.assign(tracks.size(), fail(std::string()));
    join(pairs, joint);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (!joint.clocks[i]) {
            joint.clocks[i] = fail(why_apart(pairs, tracks, i, joint.reference));
        }
    }
    for (const Pair& pair : pairs) {
        if (!pair.alignment || !joint.clocks[pair.first] || !joint.clocks[pair.second]) {
            continue;
        }
        const double off = disagreement(pair, joint, tracks);
        for (const std::size_t i : {pair.first, pair.second}) {
            JointClock& clock = *joint.clocks[i];
            clock.disagreement = std::max(clock.disagreement, off);
            clock.hears_song = clock.hears_song || (options.song && pair.has(*options.song));
        }
    }
    return joint;
}

void correct_sound_way(JointAlignment& alignment,
                       std::span<const std::optional<double>> distances) {
    RAKS_ASSERT(alignment.clocks.size() == distances.size());
    const auto from_reference = distances[alignment.reference];
    if (!from_reference) {
        return;
    }
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (alignment.clocks[i] && distances[i]) {
            alignment.clocks[i]->line.offset += (*distances[i] - *from_reference) / kSpeedOfSound;
        }
    }
}

}  // namespace raks::audio
