#include "training/discovery/proposal_check.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kSamePeriod = 0.04;  // relative
constexpr double kSameBorder = 0.5;   // beats

bool is_hit(const FigureLabel& label, const FoundRepeats& found) {
    const double start = static_cast<double>(label.start);
    const double end = static_cast<double>(label.end);
    const double reach = kSameBorder * (end - start) / std::max(label.beats, 1);
    return std::any_of(found.repeats.begin(), found.repeats.end(), [&](const FoundRepeat& repeat) {
        return std::abs(repeat.start - start) <= reach && std::abs(repeat.end - end) <= reach;
    });
}

TakeCheck check_of(const DiscoveredClip& clip,
                   std::span<const FigureLabel> labels,
                   const FigureTrainingPlan& plan) {
    TakeCheck check;
    check.take = clip.take;
    check.found_seconds = clip.found.repeats.empty() ? 0.0 : clip.found.seconds;
    for (const FigureLabel& label : labels) {
        const bool is_judged = label.take == clip.take && label.role == plan.role &&
                               (plan.split.empty() || label.split == plan.split) &&
                               label.confidence >= plan.min_confidence && label.figure != "idle";
        if (!is_judged) {
            continue;
        }
        check.true_seconds.push_back(static_cast<double>(label.end - label.start) /
                                     clip.clip.frames_per_second);
        const int hit = is_hit(label, clip.found) ? 1 : 0;
        check.all_labelled += 1;
        check.all_hit += hit;
        if (label.figure == plan.figure) {
            check.labelled += 1;
            check.hit += hit;
        }
    }
    check.is_period_right =
        std::any_of(check.true_seconds.begin(), check.true_seconds.end(), [&](double seconds) {
            return std::abs(check.found_seconds / seconds - 1.0) <= kSamePeriod;
        });
    return check;
}

}  // namespace

std::vector<TakeCheck> check_proposal(const DiscoveredClips& found,
                                      std::span<const FigureLabel> labels,
                                      const FigureTrainingPlan& plan) {
    std::vector<TakeCheck> checks;
    for (const DiscoveredClip& clip : found.clips) {
        checks.push_back(check_of(clip, labels, plan));
    }
    return checks;
}

}  // namespace raks::motion
