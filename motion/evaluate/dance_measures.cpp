#include "motion/evaluate/dance_measures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.hpp"
#include "motion/evaluate/published_metrics.hpp"

namespace raks::motion {
namespace {

/// Frames [first, last) of a track.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
};

// From the first counted frame to the last.
Stretch counted_stretch(const BodyTrack& track, const MetricFrames& frames) {
    Stretch stretch{0, track.frames()};
    while (stretch.first < stretch.last && !frames.is_counted(stretch.first)) {
        ++stretch.first;
    }
    while (stretch.last > stretch.first && !frames.is_counted(stretch.last - 1)) {
        --stretch.last;
    }
    return stretch;
}

// A track of these frames alone.
BodyTrack cut(const BodyTrack& track, const Stretch& stretch) {
    const auto first = static_cast<std::ptrdiff_t>(stretch.first);
    const auto last = static_cast<std::ptrdiff_t>(stretch.last);
    return {track.frames_per_second,
            {track.joints.begin() + first, track.joints.begin() + last},
            {track.feet.begin() + first, track.feet.begin() + last}};
}

// The measures of a figure, added at the end when there are none yet.
FigureMeasures& measures_of(std::vector<FigureMeasures>& figures, const std::string& name) {
    const auto found = std::find_if(
        figures.begin(), figures.end(), [&](const auto& figure) { return figure.figure == name; });
    return found != figures.end() ? *found : figures.emplace_back(FigureMeasures{name, {}, {}});
}

// Adds one repeat, unless it reaches beyond the track or holds a frame that does not count.
void add_repeat(const BodyTrack& track,
                const MetricFrames& frames,
                const FigureRepeatTimes& repeat,
                std::vector<FigureMeasures>& figures) {
    // None where the repeat reaches beyond the track.
    auto shape = figure_shape(track, repeat.count_times);
    if (!shape) {
        return;
    }
    const auto first =
        static_cast<std::size_t>(repeat.count_times.front() * track.frames_per_second);
    const auto last = static_cast<std::size_t>(repeat.count_times.back() * track.frames_per_second);
    for (std::size_t f = first; f <= last; ++f) {
        if (!frames.is_counted(f)) {
            return;
        }
    }
    FigureMeasures& measures = measures_of(figures, repeat.figure);
    measures.shapes.push_back(*shape);
    measures.amplitudes.push_back(amplitude_of(track, first, last + 1, frames));
}

}  // namespace

DanceMeasures measure_dance(const BodyTrack& track, const DanceSubject& subject) {
    DanceMeasures measures;
    measures.jerk = jerk_of(track, subject.frames);
    measures.contacts = contacts_of(track, subject.floor_height, subject.frames);
    measures.peak_toe_speed = peak_toe_speed(track, subject.frames);
    const Stretch stretch = counted_stretch(track, subject.frames);
    // The metrics that cannot skip frames get the counted stretch alone.
    const BodyTrack danced = cut(track, stretch);
    std::vector<double> beats = subject.beat_times;
    // Beats count from the cut track's first frame.
    for (double& beat : beats) {
        beat -= static_cast<double>(stretch.first) / track.frames_per_second;
    }
    measures.bas_motion = motion_beat_alignment(danced, beats);
    measures.bas_music = music_beat_alignment(danced, beats);
    measures.pfc = physical_foot_contact(danced);
    measures.skating_ratio = foot_skating_ratio(danced);
    for (const FigureRepeatTimes& repeat : subject.repeats) {
        add_repeat(track, subject.frames, repeat, measures.figures);
    }
    return measures;
}

DanceMeasures pooled(std::span<const DanceMeasures> dances) {
    DanceMeasures all;
    std::vector<double> jerks;
    std::vector<double> pfcs;
    ContactReport& contacts = all.contacts;
    const auto n = static_cast<double>(dances.size());
    if (!dances.empty()) {
        contacts.lowest_toe = dances.front().contacts.lowest_toe;
    }
    for (const DanceMeasures& dance : dances) {
        const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
            to.insert(to.end(), from.begin(), from.end());
        };
        append(jerks, dance.jerk.samples);
        append(contacts.slips, dance.contacts.slips);
        append(contacts.toe_speeds, dance.contacts.toe_speeds);
        // Shares and scores are averaged over the dances, not weighted by their length.
        contacts.share += dance.contacts.share / n;
        contacts.standing += dance.contacts.standing;
        contacts.lowest_toe = std::min(contacts.lowest_toe, dance.contacts.lowest_toe);
        all.peak_toe_speed = std::max(all.peak_toe_speed, dance.peak_toe_speed);
        all.bas_motion += dance.bas_motion / n;
        all.bas_music += dance.bas_music / n;
        all.skating_ratio += dance.skating_ratio / n;
        pfcs.push_back(dance.pfc);
        for (const FigureMeasures& figure : dance.figures) {
            FigureMeasures& sum = measures_of(all.figures, figure.figure);
            sum.amplitudes.insert(
                sum.amplitudes.end(), figure.amplitudes.begin(), figure.amplitudes.end());
            sum.shapes.insert(sum.shapes.end(), figure.shapes.begin(), figure.shapes.end());
        }
    }
    // Statistics are computed from the joined samples, not averaged.
    all.jerk = jerk_of_samples(std::move(jerks));
    all.pfc = percentile(pfcs, 0.5);
    summarize(contacts);
    return all;
}

}  // namespace raks::motion
