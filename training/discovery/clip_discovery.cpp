#include "training/discovery/clip_discovery.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "training/figures/training_clip.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kFew = 3;  // repeats: fewer hardly tell what varies

// Compares the repeats of all clips, and warns where few are alike.
void judge(DiscoveredClips& discovered) {
    std::vector<FoundIn> all;
    std::size_t repeats = 0;
    for (DiscoveredClip& clip : discovered.clips) {
        all.push_back({&clip.clip, &clip.found});
        repeats += clip.found.repeats.size();
    }
    judge_repeats(all);
    std::size_t good = 0;
    for (const DiscoveredClip& clip : discovered.clips) {
        good += clip.found.good();
    }
    if (repeats > 0 && good < kFew) {
        discovered.warnings.push_back(fmt::format(
            "{} of {} repeats are alike; six make a figure. --propose X.tsv shows which",
            good,
            repeats));
    }
}

}  // namespace

std::vector<FigureLabel> DiscoveredClips::labels(const FigureTrainingPlan& plan) const {
    std::vector<FigureLabel> all;
    for (const DiscoveredClip& clip : clips) {
        const auto own = labels_of(clip.found, clip.take, plan.figure, plan.role);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

Expected<DiscoveredClips> discover_clips(const FigureTrainingPlan& plan,
                                         Discovery what,
                                         DiscoveryOptions options) {
    const auto files = clips_by_take(plan);
    if (!files) {
        return fail(files.error());
    }
    options.role = plan.role;
    options.music = plan.music;
    DiscoveredClips discovered;
    for (const auto& [take, path] : *files) {
        Expected<TrainingClip> clip = load_clip(path,
                                                {.reading = plan.reading,
                                                 .metres_per_unit = plan.metres_per_unit,
                                                 .height = plan.height,
                                                 .up = plan.up,
                                                 .joints = plan.joints},
                                                discovered.warnings);
        if (!clip) {
            return fail(std::move(clip.error()));
        }
        Expected<FoundRepeats> found = what == Discovery::repeats ? find_repeats(*clip, options)
                                                                  : whole_phrase(*clip, options);
        const std::string name = path.filename().string();
        if (!found) {
            return fail(std::move(found.error()).in(name));
        }
        for (const std::string& warning : found->warnings) {
            discovered.warnings.push_back(name + ": " + warning);
        }
        discovered.clips.push_back({take, std::move(*clip), std::move(*found)});
    }
    if (what == Discovery::repeats) {
        judge(discovered);
    }
    const auto has_none = [](const DiscoveredClip& clip) { return clip.found.repeats.empty(); };
    if (std::all_of(discovered.clips.begin(), discovered.clips.end(), has_none)) {
        const DiscoveredClip& first = discovered.clips.front();
        return fail(Error{first.found.none_because}.in(files->at(first.take).filename().string()));
    }
    for (const DiscoveredClip& clip : discovered.clips) {
        if (has_none(clip)) {
            discovered.warnings.push_back(clip.take + ": " + clip.found.none_because);
        }
    }
    return discovered;
}

}  // namespace raks::motion
