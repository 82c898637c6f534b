#include "training/cells/grid_proposal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "base/statistics.hpp"
#include "training/cells/take_likeness.hpp"

namespace raks::motion {
namespace {

// Tempi that are tried: an octave and a little, in equal steps of their logarithm.
constexpr std::size_t kTempi = 64;
constexpr double kSlowest = 80.0;
constexpr double kFastest = 166.0;

// From a prototype; likeness, kTempoChange and kUneven were tried on the 17 stretches of twelve
// takes whose repeats are known: these give 8, those beside them 7 to 9.
constexpr double kWindow = 8.0;          // seconds
constexpr double kSecondHarmonic = 0.6;  // its weight beside the first
constexpr double kLikenessWeight = 4.0;  // beside that of the periods, which is 1 on average
constexpr double kUnlike = 0.6;          // distance from which on nothing repeats
constexpr double kLongWeight = 0.7;      // of eight beats beside four
constexpr double kTempoChange = 20.0;    // cost of a second in which the tempo's logarithm changes
constexpr double kUsualTempo = 122.0;
constexpr double kPriorWeight = 0.15;
constexpr double kPriorOctaves = 0.5;  // its deviation
constexpr double kUneven = 16.0;       // cost of beats that leave the tempo

double tempo_of(std::size_t index) {
    const double share = static_cast<double>(index) / static_cast<double>(kTempi - 1);
    return kSlowest * std::pow(kFastest / kSlowest, share);
}

using TempoScores = std::array<double, kTempi>;

// How strongly the cues around a row come at each tempo and at its half beats.
TempoScores periodicity(const std::vector<double>& impulse, std::ptrdiff_t middle) {
    constexpr auto kRows = static_cast<std::ptrdiff_t>(kWindow * kCueRate);
    TempoScores scores{};
    for (std::size_t tempo = 0; tempo < kTempi; ++tempo) {
        const double step = 2.0 * M_PI * tempo_of(tempo) / 60.0 / kCueRate;
        const std::complex<double> turn = std::polar(1.0, -step);
        std::complex<double> phase(1.0, 0.0);
        std::complex<double> first{};
        std::complex<double> second{};
        for (std::ptrdiff_t i = 0; i < kRows; ++i, phase *= turn) {
            const std::ptrdiff_t row = middle - kRows / 2 + i;
            if (row < 0 || row >= static_cast<std::ptrdiff_t>(impulse.size())) {
                continue;
            }
            const double window =
                0.5 - 0.5 * std::cos(2.0 * M_PI * static_cast<double>(i) / (kRows - 1));
            const double value = window * impulse[static_cast<std::size_t>(row)];
            first += value * phase;
            second += value * phase * phase;
        }
        scores[tempo] = std::abs(first) + kSecondHarmonic * std::abs(second);
    }
    return scores;
}

// How alike the motion before a moment is to what follows it, over four or eight beats, whichever
// are more so; 0 to 1.
double likeness_at(const TakeLikeness& likeness, double second, double tempo) {
    double best = 0.0;
    for (const auto& [beats, weight] : {std::pair{4.0, 1.0}, std::pair{8.0, kLongWeight}}) {
        const double lag = beats * 60.0 / tempo;
        if (second < lag) {
            continue;
        }
        const double distance =
            likeness.distance(static_cast<std::size_t>((second - lag) * kLikenessRate),
                              static_cast<std::size_t>(second * kLikenessRate),
                              lag);
        best = std::max(best, weight * (kUnlike - distance) / kUnlike);
    }
    return best;
}

// Scores of each second.
std::vector<TempoScores> tempogram(const GridCues& cues, const TakeLikeness& likeness) {
    std::vector<TempoScores> scores;
    double sum = 0.0;
    for (double second = 0.0; second <= cues.seconds(); second += 1.0) {
        scores.push_back(periodicity(cues.impulse, static_cast<std::ptrdiff_t>(second * kCueRate)));
        for (const double score : scores.back()) {
            sum += score;
        }
    }
    const double mean = sum / static_cast<double>(scores.size() * kTempi);
    for (std::size_t second = 0; second < scores.size(); ++second) {
        for (std::size_t tempo = 0; tempo < kTempi; ++tempo) {
            const double octaves = std::log2(tempo_of(tempo) / kUsualTempo) / kPriorOctaves;
            scores[second][tempo] =
                scores[second][tempo] / std::max(mean, 1e-9) +
                kLikenessWeight *
                    likeness_at(likeness, static_cast<double>(second), tempo_of(tempo)) -
                0.5 * kPriorWeight * octaves * octaves;
        }
    }
    return scores;
}

// The best path through the tempi of each second (Viterbi), BPM.
std::vector<double> tempo_path(const std::vector<TempoScores>& scores) {
    std::vector<std::array<std::size_t, kTempi>> from(scores.size());
    TempoScores best = scores[0];
    for (std::size_t second = 1; second < scores.size(); ++second) {
        TempoScores next{};
        for (std::size_t to = 0; to < kTempi; ++to) {
            double most = -std::numeric_limits<double>::infinity();
            for (std::size_t at = 0; at < kTempi; ++at) {
                const double change = std::log(tempo_of(to) / tempo_of(at));
                const double value = best[at] - kTempoChange * change * change;
                if (value > most) {
                    most = value;
                    from[second][to] = at;
                }
            }
            next[to] = most + scores[second][to];
        }
        best = next;
    }
    auto tempo =
        static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
    std::vector<double> path(scores.size());
    for (std::size_t second = scores.size(); second-- > 0;) {
        path[second] = tempo_of(tempo);
        tempo = from[second][tempo];
    }
    return path;
}

// Rows of a beat at a row, from the tempi of the seconds around it.
double beat_rows(const std::vector<double>& path, std::size_t row) {
    const double at =
        std::min(static_cast<double>(row) / kCueRate, static_cast<double>(path.size() - 1));
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, path.size() - 1);
    const double t = at - static_cast<double>(below);
    return 60.0 * kCueRate / ((1.0 - t) * path[below] + t * path[above]);
}

// The rows that meet most of the cues at distances of a beat (Ellis 2007).
std::vector<std::size_t> beats_along(const std::vector<double>& impulse,
                                     const std::vector<double>& path) {
    constexpr double kShort = 0.67;  // of a beat, at least
    constexpr double kLong = 1.5;    // at most
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    double squares = 0.0;
    for (const double value : impulse) {
        squares += value * value;
    }
    const double deviation =
        std::max(std::sqrt(squares / static_cast<double>(impulse.size())), 1e-9);
    std::vector<double> score(impulse.size());
    std::vector<std::size_t> before(impulse.size(), kNone);
    for (std::size_t row = 0; row < impulse.size(); ++row) {
        score[row] = impulse[row] / deviation;
        const double beat = beat_rows(path, row);
        const auto nearest = static_cast<std::size_t>(kShort * beat);
        if (row < nearest) {
            continue;
        }
        double most = 0.0;
        const auto farthest = std::min(row, static_cast<std::size_t>(kLong * beat));
        for (std::size_t back = nearest; back <= farthest; ++back) {
            const double uneven = std::log(static_cast<double>(back) / beat);
            const double value = score[row - back] - kUneven * uneven * uneven;
            if (value > most) {
                most = value;
                before[row] = row - back;
            }
        }
        score[row] += most;
    }
    // The best of the last beat's rows, and back from there.
    const auto last =
        std::min(static_cast<std::size_t>(beat_rows(path, impulse.size() - 1)), impulse.size());
    const auto begin = score.end() - static_cast<std::ptrdiff_t>(last);
    auto row = static_cast<std::size_t>(std::max_element(begin, score.end()) - score.begin());
    std::vector<std::size_t> rows{row};
    while (before[row] != kNone) {
        row = before[row];
        rows.push_back(row);
    }
    std::reverse(rows.begin(), rows.end());
    return rows;
}

bool is_active(const std::vector<ActiveRows>& stretches, std::size_t from, std::size_t to) {
    return std::any_of(stretches.begin(), stretches.end(), [&](const ActiveRows& rows) {
        return rows.first <= from && to <= rows.last;
    });
}

// Every other beat is the 1 of half a bar: those of a stretch that more of the cues fall on.
void set_halves(const std::vector<double>& impulse,
                const std::vector<std::size_t>& rows,
                std::vector<GridBeat>& beats) {
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        sums[i % 2] += beats[i].is_used ? impulse[rows[i]] : 0.0;
    }
    const std::size_t first = sums[1] > sums[0] ? 1 : 0;
    for (std::size_t i = 0; i < beats.size(); ++i) {
        beats[i].half = i % 2 == first ? 1 : 2;
    }
}

// Lags at which a stretch is most like itself.
std::vector<FoundLag> found_lags(const TakeLikeness& likeness,
                                 const std::vector<ActiveRows>& stretches) {
    constexpr double kShortest = 1.2;  // seconds
    constexpr double kLongest = 5.0;
    constexpr double kMostDistance = 0.45;  // distance
    std::vector<FoundLag> lags;
    for (const ActiveRows& rows : stretches) {
        const double end = static_cast<double>(rows.last) / kCueRate;
        for (double start = static_cast<double>(rows.first) / kCueRate; start < end;) {
            FoundLag best{start, start, 0.0, kMostDistance};
            for (double lag = kShortest; lag <= kLongest && start + 2.0 * lag <= end; lag += 0.05) {
                const double distance =
                    likeness.distance(static_cast<std::size_t>(start * kLikenessRate),
                                      static_cast<std::size_t>((start + lag) * kLikenessRate),
                                      lag);
                if (distance < best.distance) {
                    best = {start, start + 2.0 * lag, lag, distance};
                }
            }
            if (best.seconds > 0.0) {
                lags.push_back(best);
            }
            start = best.seconds > 0.0 ? best.start + best.seconds : start + 0.25;
        }
    }
    return lags;
}

}  // namespace

double GridProposal::tempo() const {
    std::vector<double> intervals;
    for (std::size_t i = 0; i + 1 < grid.beats.size(); ++i) {
        if (grid.beats[i].is_used) {
            intervals.push_back(grid.beats[i + 1].time - grid.beats[i].time);
        }
    }
    return intervals.empty() ? 0.0 : 60.0 / upper_median(std::move(intervals));
}

GridProposal propose_grid(const std::string& take, const GridCues& cues) {
    constexpr double kShortestClip = 2.0;  // seconds
    GridProposal proposal;
    proposal.grid.take = take;
    proposal.idle_seconds = cues.seconds();
    const std::vector<ActiveRows> stretches = active_rows(cues);
    if (stretches.empty() || cues.seconds() < kShortestClip) {
        return proposal;
    }
    for (const ActiveRows& rows : stretches) {
        proposal.idle_seconds -= static_cast<double>(rows.last - rows.first) / kCueRate;
    }
    proposal.idle_seconds = std::max(proposal.idle_seconds, 0.0);
    const TakeLikeness likeness(cues, 8.0 * 60.0 / kSlowest);
    proposal.tempi = tempo_path(tempogram(cues, likeness));
    const std::vector<std::size_t> rows = beats_along(cues.impulse, proposal.tempi);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool is_used = i + 1 < rows.size() && is_active(stretches, rows[i], rows[i + 1]);
        const double time = static_cast<double>(rows[i]) / kCueRate;
        proposal.grid.beats.push_back({std::round(1000.0 * time) / 1000.0, 1, is_used});
    }
    set_halves(cues.impulse, rows, proposal.grid.beats);
    proposal.lags = found_lags(likeness, stretches);
    return proposal;
}

}  // namespace raks::motion
