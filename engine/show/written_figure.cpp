#include "engine/show/written_figure.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "base/suggest.hpp"
#include "motion/choreography/figure_check.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

Expected<motion::AuthoredDance> load_written_dance(const std::filesystem::path& path) {
    auto dance = motion::load_authored_dance(path);
    if (!dance) {
        return dance;
    }
    for (const motion::AuthoredFigure& figure : dance->figures) {
        const auto faults = motion::faults_in_motion(*dance, figure, motion::mannequin_skeleton());
        if (!faults.empty()) {
            return fail(faults.front());
        }
    }
    return dance;
}

Expected<std::size_t> find_figure(const motion::AuthoredDance& dance, const std::string& name) {
    if (name.empty()) {
        return 0;
    }
    if (const motion::AuthoredFigure* const wanted = dance.figure(name)) {
        return static_cast<std::size_t>(wanted - dance.figures.data());
    }
    std::vector<std::string_view> names;
    for (const motion::AuthoredFigure& one : dance.figures) {
        names.push_back(one.name);
    }
    return fail(dance.file + ": " + unknown_name("figure", name, names));
}

motion::EvaluatedFigure danced_figure(const motion::AuthoredDance& dance,
                                      std::size_t figure,
                                      Bpm tempo) {
    // Fewer of long figures, so that they are there in a moment and take a few megabytes; two show
    // both sides of a mirrored one.
    constexpr int kRepeats = 8;
    constexpr int kFewestRepeats = 2;
    constexpr int kMostBeats = 64;  // of all repeats
    const motion::AuthoredFigure& one = dance.figures[figure];
    motion::EvaluationOptions options;
    options.written = dance.written;
    options.tempo = tempo;
    options.repeats = std::clamp(kMostBeats / one.beats, kFewestRepeats, kRepeats);
    return motion::evaluate_figure(one, motion::mannequin_skeleton(), options);
}

}  // namespace raks::engine
