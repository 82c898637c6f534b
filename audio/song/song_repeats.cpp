#include "audio/song/song_repeats.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

namespace raks::audio {
namespace {

constexpr std::size_t kLongestLoop = 8;  // bars
constexpr std::size_t kLeastLoop = 4;    // bars that are alike those before, of a loop
constexpr std::size_t kLeastPart = 8;    // bars
constexpr std::size_t kByEachEnd = 2;    // bars fewer for each end at which the music changes
constexpr std::size_t kLeastRest = 4;    // bars that are left of a part
constexpr std::size_t kWindow = 4;       // bars whose mean distance counts

// Bars [first, end), each alike the bar `lag` bars before.
struct BarRun {
    std::size_t first = 0;
    std::size_t end = 0;
    std::size_t lag = 0;
    [[nodiscard]] std::size_t bars() const { return end - first; }
};

// Whether kWindow bars from `first` on are alike on the whole.
bool is_alike_window(std::span<const float> distances, std::size_t first) {
    float sum = 0.0F;
    for (std::size_t i = first; i < first + kWindow; ++i) {
        sum += distances[i];
        if (distances[i] > kFillDistance) {
            return false;
        }
    }
    return sum <= static_cast<float>(kWindow);
}

// Appends the runs of one diagonal. `distances`: of bar lag + i from bar i.
void add_runs(std::span<const float> distances, std::size_t lag, std::vector<BarRun>& runs) {
    for (std::size_t i = 0; i + kWindow <= distances.size(); ++i) {
        if (!is_alike_window(distances, i)) {
            continue;
        }
        std::size_t first = i;
        while (i + kWindow < distances.size() && is_alike_window(distances, i + 1)) {
            ++i;
        }
        std::size_t end = i + kWindow;
        // A run does not begin or end with a bar that is unlike.
        while (first < end && distances[first] > 1.0F) {
            ++first;
        }
        while (end > first && distances[end - 1] > 1.0F) {
            --end;
        }
        runs.push_back({lag + first, lag + end, lag});
    }
}

// All runs, by lag and place.
std::vector<BarRun> runs_of(std::span<const char> begins_part, const BarDistance& distance) {
    std::vector<BarRun> runs;
    std::vector<float> distances;
    const std::size_t bars = begins_part.size();
    for (std::size_t lag = 1; lag <= kMostLag && lag < bars; ++lag) {
        distances.clear();
        for (std::size_t bar = lag; bar < bars; ++bar) {
            distances.push_back(distance(bar - lag, bar));
        }
        add_runs(distances, lag, runs);
    }
    return runs;
}

// Which bars are of one loop, for each of its possible lengths.
class SongLoops {
 public:
    SongLoops(std::size_t bars, std::span<const BarRun> runs) {
        for (auto& loop : loops_) {
            loop.assign(bars, kNone);
        }
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const BarRun& run = runs[i];
            if (run.lag > kLongestLoop || run.bars() < std::max(run.lag, kLeastLoop)) {
                continue;
            }
            // Two runs of one lag may share bars by their first times: then they are one loop.
            std::vector<int>& loop = loops_[run.lag - 1];
            const int number = loop[run.first - run.lag] != kNone ? loop[run.first - run.lag]
                                                                  : static_cast<int>(i);
            std::fill(loop.begin() + static_cast<std::ptrdiff_t>(run.first - run.lag),
                      loop.begin() + static_cast<std::ptrdiff_t>(run.end),
                      number);
        }
    }

    // Whether both bars are of one loop.
    [[nodiscard]] bool is_one(std::size_t a, std::size_t b) const {
        return std::any_of(loops_.begin(), loops_.end(), [&](const std::vector<int>& loop) {
            return loop[a] != kNone && loop[a] == loop[b];
        });
    }
    // Number of the bar's loop of this length in bars; kNone: it is of none.
    [[nodiscard]] int loop_of(std::size_t bar, std::size_t length) const {
        return loops_[length - 1][bar];
    }

    static constexpr int kNone = -1;

 private:
    std::array<std::vector<int>, kLongestLoop> loops_;  // by length and bar
};

// Takes runs one after the other, as far as their bars are free.
class RepeatWriter {
 public:
    RepeatWriter(std::span<const char> begins_part, const SongLoops& loops)
        : begins_part_(begins_part), loops_(loops), repeats_(begins_part.size(), -1) {}

    void take(const BarRun& run) {
        for (std::size_t bar = run.first; bar < run.end;) {
            std::size_t end = bar;
            while (end < run.end && is_free(end, run.lag)) {
                ++end;
            }
            BarRun part{bar, end, run.lag};
            if (part.bars() < least_bars(part)) {
                cut_to_borders(part);
            }
            if (part.bars() >= least_bars(part)) {
                write(part);
            }
            bar = std::max(end, bar + 1);
        }
    }

    // Chains followed to their first bars, without short rests.
    [[nodiscard]] std::vector<int> finish() {
        for (int& repeats : repeats_) {
            if (repeats >= 0 && repeats_[static_cast<std::size_t>(repeats)] >= 0) {
                repeats = repeats_[static_cast<std::size_t>(repeats)];
            }
        }
        for (std::size_t bar = 0; bar < repeats_.size();) {
            std::size_t end = bar + 1;
            while (end < repeats_.size() && repeats_[bar] >= 0 &&
                   repeats_[end] == repeats_[end - 1] + 1) {
                ++end;
            }
            if (end - bar < kLeastRest) {
                std::fill(repeats_.begin() + static_cast<std::ptrdiff_t>(bar),
                          repeats_.begin() + static_cast<std::ptrdiff_t>(end),
                          -1);
            }
            bar = end;
        }
        return std::move(repeats_);
    }

 private:
    [[nodiscard]] bool is_free(std::size_t bar, std::size_t lag) const {
        if (repeats_[bar] >= 0 || loops_.is_one(bar - lag, bar)) {
            return false;
        }
        for (std::size_t length = 1; length <= kLongestLoop; ++length) {
            const int loop = loops_.loop_of(bar, length);
            if (loop != SongLoops::kNone && used_.count({length, loop, first_of(bar - lag)}) > 0) {
                return false;
            }
        }
        return true;
    }
    // The bar that a bar repeats as far as is known, or itself.
    [[nodiscard]] std::size_t first_of(std::size_t bar) const {
        return repeats_[bar] >= 0 ? static_cast<std::size_t>(repeats_[bar]) : bar;
    }
    [[nodiscard]] bool is_border(std::size_t bar) const {
        return bar >= begins_part_.size() || begins_part_[bar] != 0;
    }
    [[nodiscard]] std::size_t least_bars(const BarRun& run) const {
        const auto count = [&](std::size_t end) {
            return is_border(end) || is_border(end - run.lag) ? kByEachEnd : 0;
        };
        return kLeastPart - count(run.first) - count(run.end);
    }
    // To what lies between the first border and the last one in it, if anything does.
    void cut_to_borders(BarRun& run) const {
        const auto is_end = [&](std::size_t bar) {
            return is_border(bar) || is_border(bar - run.lag);
        };
        while (run.first < run.end && !is_end(run.first)) {
            ++run.first;
        }
        while (run.end > run.first && !is_end(run.end)) {
            --run.end;
        }
    }
    void write(const BarRun& run) {
        for (std::size_t bar = run.first; bar < run.end; ++bar) {
            repeats_[bar] = static_cast<int>(bar - run.lag);
            for (std::size_t length = 1; length <= kLongestLoop; ++length) {
                if (const int loop = loops_.loop_of(bar, length); loop != SongLoops::kNone) {
                    used_.insert({length, loop, first_of(bar - run.lag)});
                }
            }
        }
    }

    std::span<const char> begins_part_;
    const SongLoops& loops_;
    std::vector<int> repeats_;
    // Length and number of a loop, and a bar that one of its bars repeats.
    std::set<std::tuple<std::size_t, int, std::size_t>> used_;
};

}  // namespace

std::vector<int> find_repeats(std::span<const char> begins_part, const BarDistance& distance) {
    std::vector<BarRun> runs = runs_of(begins_part, distance);
    const SongLoops loops(begins_part.size(), runs);
    // The longer one first, then the one whose first time is earlier.
    std::erase_if(runs, [](const BarRun& run) { return run.bars() < kLeastRest; });
    std::stable_sort(runs.begin(), runs.end(), [](const BarRun& a, const BarRun& b) {
        return std::tuple(b.bars(), a.first - a.lag, a.first) <
               std::tuple(a.bars(), b.first - b.lag, b.first);
    });
    RepeatWriter writer(begins_part, loops);
    for (const BarRun& run : runs) {
        writer.take(run);
    }
    return writer.finish();
}

}  // namespace raks::audio
