#include "training/discovery/clip_discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "training/discovery/phrase_discovery.hpp"
#include "training/figures/training_clip.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

// Compares the repeats of all clips.
void judge(DiscoveredClips& discovered) {
    std::vector<FoundIn> all;
    for (DiscoveredClip& clip : discovered.clips) {
        all.push_back({&clip.clip, &clip.found});
    }
    judge_repeats(all);
}

// Phrases of one dance have tempi of one octave.
void agree(DiscoveredClips& discovered) {
    std::vector<FoundRepeats*> phrases;
    for (DiscoveredClip& clip : discovered.clips) {
        phrases.push_back(&clip.found);
    }
    agree_on_octaves(phrases);
}

}  // namespace

std::size_t DiscoveredClips::good() const noexcept {
    std::size_t good = 0;
    for (const DiscoveredClip& clip : clips) {
        good += clip.found.good();
    }
    return good;
}

std::vector<FigureLabel> DiscoveredClips::labels(const FigureTrainingPlan& plan) const {
    std::vector<FigureLabel> all;
    for (const DiscoveredClip& clip : clips) {
        const auto own = labels_of(clip.found, clip.take, plan.figure, plan.role);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

namespace {

// Reads one clip and searches it. Errors: with its name.
Expected<DiscoveredClip> discover_clip(const std::pair<const std::string, fs::path>& file,
                                       const FigureTrainingPlan& plan,
                                       Discovery what,
                                       const DiscoveryOptions& options,
                                       std::vector<std::string>& warnings) {
    Expected<TrainingClip> clip = load_clip(file.second, units_of(plan), warnings);
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    const std::string name = file.second.filename().string();
    Expected<FoundRepeats> found =
        what == Discovery::repeats ? find_repeats(*clip, options) : whole_phrase(*clip, options);
    if (!found) {
        return fail(std::move(found.error()).in(name));
    }
    for (const std::string& warning : found->warnings) {
        warnings.push_back(fmt::format("{}: {}", name, warning));
    }
    return DiscoveredClip{file.first, file.second, std::move(*clip), std::move(*found)};
}

}  // namespace

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
    for (const auto& file : *files) {
        auto clip = discover_clip(file, plan, what, options, discovered.warnings);
        if (clip) {
            discovered.clips.push_back(std::move(*clip));
        } else if (what == Discovery::whole_phrase && files->size() > 1) {
            discovered.skipped.push_back(std::move(clip.error().message));
        } else {
            return fail(std::move(clip.error()));
        }
    }
    if (discovered.clips.empty()) {
        return fail(discovered.skipped.front());
    }
    if (what == Discovery::repeats) {
        judge(discovered);
    } else {
        agree(discovered);
    }
    const auto has_none = [](const DiscoveredClip& clip) { return clip.found.repeats.empty(); };
    if (std::all_of(discovered.clips.begin(), discovered.clips.end(), has_none)) {
        const DiscoveredClip& first = discovered.clips.front();
        return fail(Error{first.found.none_because}.in(first.file.filename().string()));
    }
    for (const DiscoveredClip& clip : discovered.clips) {
        if (has_none(clip)) {
            discovered.warnings.push_back(clip.take + ": " + clip.found.none_because);
        }
    }
    return discovered;
}

}  // namespace raks::motion
