#include "training/figures/foot_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/foot_events.hpp"
#include "training/figures/phase_warp.hpp"

namespace raks::motion {
namespace {

// Offsets lie in [-0.4, 0.6): dancers land late rather than early.
constexpr double kEarliest = -0.4;  // beats from the count a landing belongs to

/// Per foot: contact by frame, landings (frames) and toe speed by frame (m/s) of one clip.
struct ClipFeet {
    std::array<std::vector<bool>, 2> contacts;
    std::array<std::vector<double>, 2> landings;
    std::array<std::vector<double>, 2> toe_speeds;
};

// Faults are bridged first: a jump in bad frames would look like a step.
ClipFeet feet_of(const TrainingClip& clip) {
    std::vector<std::array<SourceFoot, 2>> feet = clip.feet;
    bridge_faults(feet, clip.faults);
    ClipFeet result;
    for (const Side side : kSides) {
        const std::size_t s = static_cast<std::size_t>(side);
        result.contacts[s] = toe_contacts(feet, side, clip.frames_per_second);
        result.landings[s] = landings(feet, side, clip.frames_per_second);
        result.toe_speeds[s] =
            toe_speed(feet, side, clip.frames_per_second, FootRules{}.contact_low_pass_hz);
    }
    return result;
}

// Adds the repeat's weight to every phase bin in whose middle the toe rests on the floor.
void add_contacts(const std::vector<bool>& contacts,
                  const FigureRepeat& repeat,
                  const PhaseWarp& warp,
                  int beats,
                  std::array<double, kContactBins>& sums) {
    for (std::size_t bin = 0; bin < kContactBins; ++bin) {
        const double phase = (static_cast<double>(bin) + 0.5) * beats / kContactBins;
        const std::size_t frame = static_cast<std::size_t>(std::lround(warp.frame_at(phase)));
        sums[bin] += contacts[std::min(frame, contacts.size() - 1)] ? repeat.weight : 0.0;
    }
}

// Sorts landings by the count they belong to; offsets from that count in beats, late positive.
void add_landings(const std::vector<double>& moments,
                  const PhaseWarp& warp,
                  int beats,
                  std::vector<std::vector<double>>& offsets) {
    for (const double frame : moments) {
        const double beat = warp.beat_at(frame);
        const double count = std::floor(beat - kEarliest);
        if (count >= 0.0 && count < beats) {
            offsets[static_cast<std::size_t>(count)].push_back(beat - count);
        }
    }
}

/// The highest speed of the faster toe in each repeat, m/s; the median over the repeats, because
/// one badly captured repeat would dominate a maximum.
double peak_toe_speed(std::span<const TrainingClip> clips,
                      std::span<const FigureRepeat> repeats,
                      const std::vector<std::array<std::vector<double>, 2>>& speeds) {
    std::vector<double> peaks;
    for (const FigureRepeat& repeat : repeats) {
        double peak = 0.0;
        const std::size_t last = clips[repeat.clip].poses.size() - 1;
        const auto end = std::min(static_cast<std::size_t>(repeat.beat_frames.back()), last);
        for (auto i = static_cast<std::size_t>(repeat.beat_frames.front()); i <= end; ++i) {
            peak = std::max({peak, speeds[repeat.clip][0][i], speeds[repeat.clip][1][i]});
        }
        peaks.push_back(peak);
    }
    const auto middle = peaks.begin() + static_cast<std::ptrdiff_t>(peaks.size() / 2);
    std::nth_element(peaks.begin(), middle, peaks.end());
    return *middle;
}

// Median and sample standard deviation of the landings at one count.
LandingOffset summary_of(std::vector<double> offsets) {
    LandingOffset result;
    result.repeats = static_cast<int>(offsets.size());
    if (offsets.empty()) {
        return result;
    }
    std::sort(offsets.begin(), offsets.end());
    const std::size_t half = offsets.size() / 2;
    const bool is_odd = offsets.size() % 2 == 1;
    result.median = Beats(is_odd ? offsets[half] : 0.5 * (offsets[half - 1] + offsets[half]));
    double mean = 0.0;
    for (const double offset : offsets) {
        mean += offset / static_cast<double>(offsets.size());
    }
    double square = 0.0;
    for (const double offset : offsets) {
        square += (offset - mean) * (offset - mean);
    }
    // n - 1, and 1 for a single landing, whose deviation is then 0.
    const double freedom = std::max(static_cast<double>(offsets.size()) - 1.0, 1.0);
    result.deviation = Beats(std::sqrt(square / freedom));
    return result;
}

}  // namespace

void learn_feet(std::span<const TrainingClip> clips,
                std::span<const FigureRepeat> repeats,
                FigureModel& model) {
    // By clip, not by repeat: several repeats share a clip.
    std::vector<ClipFeet> feet;
    for (const TrainingClip& clip : clips) {
        feet.push_back(feet_of(clip));
    }
    std::vector<std::array<std::vector<double>, 2>> toe_speeds;
    for (const ClipFeet& one : feet) {
        toe_speeds.push_back(one.toe_speeds);
    }
    model.peak_toe_speed = peak_toe_speed(clips, repeats, toe_speeds);
    double weight_sum = 0.0;
    for (const FigureRepeat& repeat : repeats) {
        weight_sum += repeat.weight;
    }
    for (std::size_t s = 0; s < 2; ++s) {
        std::vector<std::vector<double>> offsets(static_cast<std::size_t>(model.beats));
        model.contact[s].fill(0.0);
        // Contacts are weighted; landings are not, because their summary is a median.
        for (const FigureRepeat& repeat : repeats) {
            const PhaseWarp warp(repeat.beat_frames);
            add_contacts(
                feet[repeat.clip].contacts[s], repeat, warp, model.beats, model.contact[s]);
            add_landings(feet[repeat.clip].landings[s], warp, model.beats, offsets);
        }
        // Rounding may bring the weighted mean just above 1.
        for (double& chance : model.contact[s]) {
            chance = std::min(chance / weight_sum, 1.0);
        }
        model.landings[s].clear();
        for (std::vector<double>& one : offsets) {
            model.landings[s].push_back(summary_of(std::move(one)));
        }
    }
}

}  // namespace raks::motion
