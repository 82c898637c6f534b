#include "motion/capture/markerless/standing_cameras.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "motion/capture/camera/calibrated_camera.hpp"
#include "motion/capture/markerless/dancer_limbs.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kFewestSeconds = 6;
constexpr std::size_t kFewestAtOnce = 3;   // seconds on each side of a move
constexpr std::size_t kFewestSights = 40;  // pairs of joints that make a second count
constexpr double kSurelySeen = 0.5;        // visibility
// In usual errors of a joint. Measured on drawn films of two dances and networks of 10 to 20
// seconds: still cameras wander by 0.12 to 0.17 from second to second, a bump of 1 degree leaves
// 1.2 behind.
constexpr double kLeastMove = 0.5;
constexpr double kLeastWander = 0.38;
// Change of size over the take. Still cameras: up to 0.02.
constexpr double kLeastZoom = 0.08;

/// What one second says of two cameras.
struct PairSecond {
    double time = 0.0;    // its middle, capture time
    double offset = 0.0;  // of the joints from the lines, pixels
    double growth = 0.0;  // of that offset with the height in the picture; a share
};

/// Joints of one second: their distance from the line of the other camera, and their height.
struct LineOffsets {
    std::vector<double> distances;
    std::vector<double> heights;
};

double middle_number(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

// The slope of a line through places, by least squares.
double slope_of(const std::vector<double>& at, const std::vector<double>& values) {
    const auto count = static_cast<double>(at.size());
    double mean_at = 0.0;
    double mean_value = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        mean_at += at[i] / count;
        mean_value += values[i] / count;
    }
    double product = 0.0;
    double square = 1e-12;
    for (std::size_t i = 0; i < at.size(); ++i) {
        product += (at[i] - mean_at) * (values[i] - mean_value);
        square += (at[i] - mean_at) * (at[i] - mean_at);
    }
    return product / square;
}

void add_offsets(const Rig& rig,
                 const KeypointTake& take,
                 std::size_t frame,
                 std::size_t from,
                 std::size_t to,
                 LineOffsets& offsets) {
    const glm::dmat3 epipolar = epipolar_matrix(rig.cameras[from], rig.cameras[to]);
    const Lens& lens = rig.cameras[to].lens;
    for (const BodyPoint point : kMainPoints) {
        const Keypoint& one = take.point(frame, from, point);
        const Keypoint& other = take.point(frame, to, point);
        if (one.visibility < kSurelySeen || other.visibility < kSurelySeen) {
            continue;
        }
        const glm::dvec3 line =
            epipolar * glm::dvec3(direction_of(rig.cameras[from].lens, one.pixel), 1.0);
        const glm::dvec3 place(direction_of(lens, other.pixel), 1.0);
        // Downwards, whichever way the line is written.
        const double length = std::copysign(std::hypot(line.x, line.y), line.y);
        offsets.distances.push_back(lens.fy * glm::dot(line, place) / length);
        offsets.heights.push_back(lens.fy * place.y);
    }
}

std::vector<PairSecond> seconds_of(const Rig& rig,
                                   const KeypointTake& take,
                                   std::size_t from,
                                   std::size_t to) {
    const auto window =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(take.frames_per_second)));
    std::vector<PairSecond> seconds;
    for (std::size_t first = 0; first + window <= take.frame_count; first += window) {
        LineOffsets offsets;
        for (std::size_t frame = first; frame < first + window; ++frame) {
            add_offsets(rig, take, frame, from, to, offsets);
        }
        if (offsets.distances.size() >= kFewestSights) {
            seconds.push_back({take.time_of(first + window / 2),
                               middle_number(offsets.distances),
                               slope_of(offsets.heights, offsets.distances)});
        }
    }
    return seconds;
}

std::vector<double> offsets_of(const std::vector<PairSecond>& seconds,
                               std::size_t first,
                               std::size_t end) {
    std::vector<double> offsets;
    for (std::size_t i = first; i < end; ++i) {
        offsets.push_back(seconds[i].offset);
    }
    return offsets;
}

double mean_square_off(const std::vector<double>& numbers, double middle) {
    double squares = 0.0;
    for (const double number : numbers) {
        squares += (number - middle) * (number - middle);
    }
    return squares / static_cast<double>(numbers.size());
}

enum class StandingFault { moved, zoomed, wanders, clocks };

/// What is wrong with two cameras.
struct PairFault {
    StandingFault fault{};
    std::size_t from = 0;
    std::size_t to = 0;
    double amount = 0.0;  // pixels; of a zoom the share
    double time = 0.0;    // of a move; capture time
};

// A moment that cuts the seconds into two halves which each agree, but not with one another.
std::optional<PairFault> find_move(const std::vector<PairSecond>& seconds, double error) {
    constexpr double kClearly = 3.0;  // times what seconds differ within the halves
    std::optional<PairFault> found;
    double least = 0.0;
    for (std::size_t cut = kFewestAtOnce; cut + kFewestAtOnce <= seconds.size(); ++cut) {
        const auto before = offsets_of(seconds, 0, cut);
        const auto after = offsets_of(seconds, cut, seconds.size());
        const double one = middle_number(before);
        const double other = middle_number(after);
        const double spread = (mean_square_off(before, one) * static_cast<double>(before.size()) +
                               mean_square_off(after, other) * static_cast<double>(after.size())) /
                              static_cast<double>(seconds.size());
        if (!found || spread < least) {
            least = spread;
            found = PairFault{StandingFault::moved,
                              0,
                              0,
                              std::abs(other - one),
                              0.5 * (seconds[cut - 1].time + seconds[cut].time)};
        }
    }
    const bool is_clear = found && found->amount >= kLeastMove * error &&
                          found->amount >= kClearly * std::sqrt(least);
    return is_clear ? found : std::nullopt;
}

std::optional<PairFault> find_zoom(const std::vector<PairSecond>& seconds) {
    constexpr double kClearly = 2.0;  // times what seconds differ from an even change
    std::vector<double> times;
    std::vector<double> growths;
    for (const PairSecond& second : seconds) {
        times.push_back(second.time);
        growths.push_back(second.growth);
    }
    const double rate = slope_of(times, growths);
    const double change = rate * (times.back() - times.front());
    std::vector<double> rest;
    for (std::size_t i = 0; i < times.size(); ++i) {
        rest.push_back(growths[i] - rate * (times[i] - times.front()));
    }
    const double spread = std::sqrt(mean_square_off(rest, middle_number(rest)));
    const bool is_clear = std::abs(change) >= kLeastZoom && std::abs(change) >= kClearly * spread;
    return is_clear ? std::optional(PairFault{StandingFault::zoomed, 0, 0, std::abs(change), 0.0})
                    : std::nullopt;
}

// Of two that stood still only the clocks are asked about: who leaves the picture looks like a
// zoom.
std::optional<PairFault> find_fault(const std::vector<PairSecond>& seconds,
                                    double error,
                                    bool are_still) {
    if (seconds.size() < kFewestSeconds) {
        return std::nullopt;
    }
    if (!are_still) {
        if (auto moved = find_move(seconds, error)) {
            return moved;
        }
        if (auto zoomed = find_zoom(seconds)) {
            return zoomed;
        }
    }
    const auto offsets = offsets_of(seconds, 0, seconds.size());
    const double wander = std::sqrt(mean_square_off(offsets, middle_number(offsets)));
    const StandingFault fault = are_still ? StandingFault::clocks : StandingFault::wanders;
    return wander >= kLeastWander * error ? std::optional(PairFault{fault, 0, 0, wander, 0.0})
                                          : std::nullopt;
}

std::string words_of_fault(const PairFault& fault, const std::string& who) {
    switch (fault.fault) {
        case StandingFault::moved:
            return fmt::format(
                "{} was moved at {:.1f} s (capture time): what it sees is {:.0f} pixels elsewhere "
                "from there on; use the films before or after it alone, or film again",
                who,
                fault.time,
                fault.amount);
        case StandingFault::zoomed:
            return fmt::format(
                "{} zooms: sizes change by {:.0f} % in the take; switch zoom and stabilising off, "
                "and film again",
                who,
                100.0 * fault.amount);
        case StandingFault::wanders:
            return fmt::format(
                "{} does not stand still, or its clock is off: what it sees wanders by {:.0f} "
                "pixels; fix the phones, and switch off what stabilises the picture",
                who,
                fault.amount);
        case StandingFault::clocks:
            return fmt::format(
                "{} stood still, but what one of them sees wanders by {:.0f} pixels beside the "
                "other: a film misses pictures, or a clock is off; film again without pauses",
                who,
                fault.amount);
    }
    return {};
}

// Of a pair the one that is not known to have stood still; of neither or both: nothing.
std::optional<std::size_t> culprit_of(const PairFault& fault, const std::vector<bool>& are_still) {
    if (are_still[fault.from] == are_still[fault.to]) {
        return std::nullopt;
    }
    return are_still[fault.from] ? fault.to : fault.from;
}

// The camera that has part in all faults of several; nothing: there is none, or two.
std::optional<std::size_t> culprit_of(const std::vector<PairFault>& faults, std::size_t cameras) {
    for (std::size_t camera = 0; faults.size() > 1 && camera < cameras; ++camera) {
        if (std::all_of(faults.begin(), faults.end(), [camera](const PairFault& fault) {
                return fault.from == camera || fault.to == camera;
            })) {
            return camera;
        }
    }
    return std::nullopt;
}

}  // namespace

std::vector<std::string> standing_doubts(const Rig& rig,
                                         const KeypointTake& take,
                                         const std::vector<bool>& are_still) {
    std::vector<PairFault> faults;
    for (std::size_t from = 0; from < rig.cameras.size(); ++from) {
        for (std::size_t to = from + 1; to < rig.cameras.size(); ++to) {
            auto fault = find_fault(seconds_of(rig, take, from, to),
                                    usual_error(take, to),
                                    are_still[from] && are_still[to]);
            if (fault) {
                fault->from = from;
                fault->to = to;
                faults.push_back(*fault);
            }
        }
    }
    if (const auto culprit = culprit_of(faults, rig.cameras.size())) {
        return {words_of_fault(faults.front(), rig.cameras[*culprit].name)};
    }
    std::vector<std::string> lines;
    lines.reserve(faults.size());
    for (const PairFault& fault : faults) {
        const auto culprit = culprit_of(fault, are_still);
        const char* const joined = fault.fault == StandingFault::clocks ? "and" : "or";
        lines.push_back(words_of_fault(fault,
                                       culprit ? rig.cameras[*culprit].name
                                               : fmt::format("{} {} {}",
                                                             rig.cameras[fault.from].name,
                                                             joined,
                                                             rig.cameras[fault.to].name)));
    }
    return lines;
}

}  // namespace raks::capture
