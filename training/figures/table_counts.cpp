#include "training/figures/table_counts.hpp"

#include <cmath>
#include <string>

namespace raks::motion {
namespace {

/// True when the count is of this take: the same name, or the name after the take's first '_' (both
/// takes of a pair share one table of counts).
bool is_of(const CountTime& time, const std::string& take) {
    const std::size_t underscore = take.find('_');
    return time.take == take ||
           (underscore != std::string::npos && time.take == take.substr(underscore + 1));
}

}  // namespace

std::vector<double> beat_frames_of(const FigureLabel& label, std::span<const CountTime> counts) {
    const double start = static_cast<double>(label.start);
    // Frames a beat if the counts were even: the estimate that matches counts to beats.
    const double beat = (static_cast<double>(label.end) - start) / label.beats;
    std::vector<double> frames(static_cast<std::size_t>(label.beats) + 1, std::nan(""));
    for (const CountTime& time : counts) {
        const double nearest = std::round((time.frame - start) / beat);
        // A count more than half a beat from its even place may belong to the beat before or after;
        // up to one and a half beats of deviation are accepted.
        for (int b = static_cast<int>(nearest) - 1; b <= static_cast<int>(nearest) + 1; ++b) {
            const int due = (label.start_count - 1 + b) % label.beats + 1;
            if (b >= 0 && b <= label.beats && due == time.count && is_of(time, label.take) &&
                std::abs(time.frame - (start + b * beat)) < 1.5 * beat) {
                frames[static_cast<std::size_t>(b)] = time.frame;
            }
        }
    }
    if (std::isnan(frames.front())) {
        frames.front() = start;
    }
    if (std::isnan(frames.back())) {
        frames.back() = static_cast<double>(label.end);
    }
    // Linear interpolation over each run of missing beats; first and last are known by here.
    for (std::size_t known = 0; known + 1 < frames.size();) {
        std::size_t next = known + 1;
        while (std::isnan(frames[next])) {
            ++next;
        }
        for (std::size_t b = known + 1; b < next; ++b) {
            const double t = static_cast<double>(b - known) / static_cast<double>(next - known);
            frames[b] = frames[known] + t * (frames[next] - frames[known]);
        }
        known = next;
    }
    return frames;
}

}  // namespace raks::motion
