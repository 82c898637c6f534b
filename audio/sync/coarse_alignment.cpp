#include "audio/sync/coarse_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "audio/resample/interpolation.hpp"
#include "audio/sync/phase_correlator.hpp"
#include "audio/sync/sync_track.hpp"

namespace raks::audio {
namespace {

constexpr double kCoarse = SyncTrack::kCoarseRate;
constexpr std::size_t kChunk = std::size_t{10} * SyncTrack::kCoarseRate;
constexpr std::size_t kShortestChunk = std::size_t{5} * SyncTrack::kCoarseRate;
constexpr std::size_t kMostChunks = 12;
constexpr std::size_t kBlock = std::size_t{1} << 18U;  // of the whole that is searched at once
// A drift smears a peak; low frequencies bear more of it. Above, rooms differ more anyway.
constexpr PhaseCorrelator::Band kChunkBand{150.0, 1'500.0};
// Trials lie so close that the nearest smears a chunk's peak over 1 ms at most.
constexpr double kTrialStep = 200.0;  // ppm
constexpr int kTrials = 6;            // to each side
// Among a million lags and hundreds of chunks noise reaches 6.3 deviations.
constexpr double kCertain = 8.0;
// Another drift than the true one does not reach this, even where the music repeats itself.
constexpr double kBeyondDoubt = 25.0;
constexpr double kPlausible = 6.5;
constexpr std::size_t kPeaksPerChunk = 5;
constexpr auto kApart = static_cast<std::size_t>(0.1 * kCoarse);  // a room's reflections lie nearer
constexpr std::size_t kMostAlignments = 4;

// Where a chunk was found.
struct Sighting {
    std::size_t chunk = 0;
    std::size_t block = 0;
    ClockPoint point;
};

class CoarseSearch {
 public:
    CoarseSearch(std::span<const float> part, std::span<const float> whole)
        : part_(part),
          whole_(whole),
          size_(std::min(std::clamp(part.size() / 3, kShortestChunk, kChunk), part.size())),
          correlator_(SyncTrack::kCoarseRate, kChunkBand, std::min(kBlock, whole.size())) {
        const std::size_t room = part.size() - size_;
        const std::size_t count = std::min(kMostChunks, 1 + room / (size_ / 2));
        for (std::size_t i = 0; i < count; ++i) {
            chunks_.push_back(count > 1 ? i * room / (count - 1) : room / 2);
        }
        for (std::size_t from = 0; from == 0 || from + size_ < whole.size();
             from += kBlock - size_) {
            blocks_.push_back(from);
        }
    }

    // The peaks of every `stride`-th chunk at a drift.
    std::vector<Sighting> look(double drift_ppm,
                               std::size_t stride,
                               std::size_t peaks,
                               double least) {
        std::vector<Sighting> sightings;
        for (std::size_t block = 0; block < blocks_.size(); ++block) {
            enter(block);
            for (std::size_t chunk = 0; chunk < chunks_.size(); chunk += stride) {
                look_for(chunk, block, drift_ppm, peaks, least, sightings);
            }
        }
        return sightings;
    }

    // Climbs from a drift to that at which the chunk of this sighting stands out most.
    double best_drift(double drift_ppm, const Sighting& sighting) {
        enter(sighting.block);
        double best = sighting.point.height;
        for (double step = kTrialStep / 2; step > 20.0; step /= 2) {
            for (const double trial : {drift_ppm - step, drift_ppm + step}) {
                std::vector<Sighting> found;
                look_for(sighting.chunk, sighting.block, trial, 1, 0.0, found);
                if (!found.empty() && found.front().point.height > best) {
                    best = found.front().point.height;
                    drift_ppm = trial;
                }
            }
        }
        return drift_ppm;
    }

 private:
    void enter(std::size_t block) {
        const std::size_t from = blocks_[block];
        correlator_.set_whole(whole_.subspan(from, std::min(kBlock, whole_.size() - from)));
    }
    // `block`: the one entered.
    void look_for(std::size_t chunk,
                  std::size_t block,
                  double drift_ppm,
                  std::size_t peaks,
                  double least,
                  std::vector<Sighting>& sightings) {
        const double step = 1.0 / (1.0 + drift_ppm * 1e-6);
        const auto first = static_cast<double>(chunks_[chunk]);
        const auto sound = read_between(part_, first, step, size_);
        const auto heights = correlator_.correlate(sound);
        const double half = 0.5 * static_cast<double>(size_);
        for (const CorrelationPeak& peak : highest_peaks(heights, peaks, kApart, least)) {
            const double other = static_cast<double>(blocks_[block]) + peak.lag + half;
            sightings.push_back(
                {chunk,
                 block,
                 {(first + half * step) / kCoarse, other / kCoarse, peak.height, peak.deviations}});
        }
    }

    std::span<const float> part_;
    std::span<const float> whole_;
    std::size_t size_;  // of a chunk
    PhaseCorrelator correlator_;
    std::vector<std::size_t> chunks_;  // first samples in the part
    std::vector<std::size_t> blocks_;  // first samples in the whole
};

const Sighting* highest(const std::vector<Sighting>& sightings) {
    const auto best = std::max_element(
        sightings.begin(), sightings.end(), [](const Sighting& a, const Sighting& b) {
            return a.point.deviations < b.point.deviations;
        });
    return best == sightings.end() ? nullptr : &*best;
}

// The drift at which some chunk stands out most: small ones first, as they are usual and mostly
// end the search. Nothing where no chunk is found for certain.
std::optional<double> find_drift(CoarseSearch& search) {
    double best = 0.0;
    double best_drift = 0.0;
    Sighting best_sighting;
    for (int trial = 0; trial <= 2 * kTrials && best < kBeyondDoubt; ++trial) {
        // 0, 1, -1, 2, -2 and so on.
        const int step = trial % 2 == 1 ? (trial + 1) / 2 : -trial / 2;
        const double drift = step * kTrialStep;
        // Chunks overlap by half: for drifts that are seldom every second one does.
        const auto sightings = search.look(drift, trial == 0 ? 1 : 2, 1, kCertain);
        const Sighting* const top = highest(sightings);
        if (top != nullptr && top->point.deviations > best) {
            best = top->point.deviations;
            best_drift = drift;
            best_sighting = *top;
        }
    }
    if (best == 0.0) {
        return std::nullopt;
    }
    return search.best_drift(best_drift, best_sighting);
}

// Those sightings, one a chunk, that lie on a line of this drift through the seed.
std::vector<ClockPoint> agreeing(const std::vector<Sighting>& sightings,
                                 const Sighting& seed,
                                 double drift_ppm) {
    const double shift = seed.point.other - (1.0 + drift_ppm * 1e-6) * seed.point.time;
    const ClockLine line{shift, drift_ppm};
    std::array<std::optional<ClockPoint>, kMostChunks> nearest;
    for (const Sighting& sighting : sightings) {
        const ClockPoint& point = sighting.point;
        // The drift is known to some 50 ppm.
        const double reach = 0.005 + 1e-4 * std::abs(point.time - seed.point.time);
        const double off = std::abs(point.other - line.at(point.time));
        auto& kept = nearest[sighting.chunk];
        if (off <= reach && (!kept || off < std::abs(kept->other - line.at(kept->time)))) {
            kept = point;
        }
    }
    std::vector<ClockPoint> points;
    for (const auto& point : nearest) {
        if (point) {
            points.push_back(*point);
        }
    }
    return points;
}

// Where chunks lie far enough apart they tell the drift better than one of them does, unless some
// of them were found by reflections.
ClockLine line_of(const std::vector<ClockPoint>& points, const Sighting& seed, double drift_ppm) {
    if (points.size() >= 3 && points.back().time - points.front().time >= 15.0) {
        if (const auto fit = fit_clock_line(points, 0.002);
            fit && fit->used >= 3 &&
            std::abs(fit->line.drift_ppm - drift_ppm) <= 0.5 * kTrialStep) {
            return fit->line;
        }
    }
    return {seed.point.other - (1.0 + drift_ppm * 1e-6) * seed.point.time, drift_ppm};
}

}  // namespace

std::vector<CoarseAlignment> find_coarse_alignments(std::span<const float> part,
                                                    std::span<const float> whole) {
    CoarseSearch search(part, whole);
    const auto drift = find_drift(search);
    if (!drift) {
        return {};
    }
    const auto sightings = search.look(*drift, 1, kPeaksPerChunk, kPlausible);
    std::vector<CoarseAlignment> all;
    for (const Sighting& seed : sightings) {
        const auto points = agreeing(sightings, seed, *drift);
        double score = 0.0;
        for (const ClockPoint& point : points) {
            score += point.deviations;
        }
        all.push_back({line_of(points, seed, *drift), score});
    }
    std::stable_sort(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
    // Seeds of one alignment differ by milliseconds in the middle of the part.
    const double middle = 0.5 * static_cast<double>(part.size()) / kCoarse;
    std::vector<CoarseAlignment> best;
    for (const CoarseAlignment& one : all) {
        const bool is_known = std::any_of(best.begin(), best.end(), [&](const auto& other) {
            return std::abs(one.line.at(middle) - other.line.at(middle)) < 0.1;
        });
        if (!is_known && best.size() < kMostAlignments) {
            best.push_back(one);
        }
    }
    return best;
}

}  // namespace raks::audio
