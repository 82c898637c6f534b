#include "apps/raks_capture/learning_line.hpp"

#include <fmt/format.h>

#include <string_view>

#include "training/discovery/clip_discovery.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::apps {
namespace {

// A word of a command line that a shell takes as one.
std::string shell_word(const std::string& word) {
    constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+./,:@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
        return word;
    }
    std::string quoted = "'";
    for (const char c : word) {
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return quoted + "'";
}

}  // namespace

Learnable what_can_be_learnt(const std::filesystem::path& clip,
                             const std::optional<motion::DancedMusic>& music) {
    motion::FigureTrainingPlan plan;
    plan.clips = {clip};
    plan.music = music;
    const auto found = motion::discover_clips(plan, motion::Discovery::repeats, {});
    return found && found->good() >= motion::kFewestRepeats ? Learnable::figure : Learnable::take;
}

std::string learning_line(const std::filesystem::path& clip,
                          const std::optional<FilmedSong>& song,
                          Learnable what) {
    const std::string motion = shell_word(clip.string());
    if (!song) {
        return fmt::format(
            "raks train figure {}{} -o mine", motion, what == Learnable::take ? " --once" : "");
    }
    return fmt::format("raks train {} {} --music {} --offset {:.4f} -o mine",
                       what == Learnable::take ? "take" : "figure",
                       motion,
                       shell_word(song->file.string()),
                       song->music.offset);
}

}  // namespace raks::apps
