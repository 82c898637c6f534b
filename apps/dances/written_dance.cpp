#include "apps/dances/written_dance.hpp"

#include <cstdint>
#include <string>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_folder.hpp"
#include "engine/setup/user_folders.hpp"
#include "motion/choreography/follow_figure.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

// More than any written dance; bounds the memory for a wrong file.
constexpr std::size_t kMaxTextBytes = std::size_t{1} << 20U;
// Part of the folder's name: a program that learns the same text otherwise must not find the
// figures of the one before. To be raised with every change of the learning.
constexpr int kLearningVersion = 2;

// A folder is complete once it has its dances.toml, which add_to_folder() writes last: a run that
// was stopped left none.
bool is_whole(const fs::path& folder) {
    std::error_code ignored;
    return fs::exists(engine::dances_path(folder), ignored);  // written last
}

std::vector<motion::DanceRole> roles_of(const motion::AuthoredDance& dance) {
    using motion::DanceRole;
    return dance.couple ? std::vector{DanceRole::lead, DanceRole::follow}
                        : std::vector{DanceRole::lead};
}

// `figure` is the lead's.
Expected<motion::AuthoredTrainingResult> learn_figure(const motion::AuthoredDance& dance,
                                                      const motion::AuthoredFigure& figure,
                                                      motion::DanceRole role,
                                                      const motion::Skeleton& skeleton,
                                                      motion::AuthoredTrainingOptions options) {
    options.role = role;
    return role == motion::DanceRole::lead
               ? motion::train_authored_figure(dance, figure, skeleton, options)
               : motion::train_authored_figure(
                     dance, motion::follow_of(figure, *dance.couple), skeleton, options);
}

}  // namespace

// A written dance has no title of its own: its name stands for it.
DanceInfo info_of(const motion::AuthoredDance& dance) {
    DanceInfo info;
    info.name = info.title = dance.dance;
    info.beats_per_bar = dance.beats_per_bar;
    info.lowest = dance.slowest;
    info.highest = dance.fastest;
    // The tempo that it was written at is the likely one.
    info.likely = dance.written;
    info.roles = dance.couple ? 2 : 1;
    return info;
}

engine::NewGrammar grammar_of(const motion::AuthoredDance& dance) {
    engine::NewGrammar grammar;
    if (dance.couple) {
        grammar.couple = dance.couple->form();
        grammar.starts = motion::FigureGrammar::Starts::own;
    }
    return grammar;
}

Expected<std::vector<motion::AuthoredTrainingResult>> learn_figures(
    const motion::AuthoredDance& dance,
    std::string_view figure,
    const motion::Skeleton& skeleton,
    const motion::AuthoredTrainingOptions& options,
    const std::function<void(const motion::AuthoredFigure&, const motion::AuthoredTrainingResult&)>&
        on_learnt) {
    std::vector<motion::AuthoredTrainingResult> learnt;
    // Collected up to the end, for the suggestion when no figure has the name.
    std::vector<std::string_view> names;
    for (const motion::AuthoredFigure& one : dance.figures) {
        names.push_back(one.name);
        if (!figure.empty() && one.name != figure) {
            continue;
        }
        for (const motion::DanceRole role : roles_of(dance)) {
            auto trained = learn_figure(dance, one, role, skeleton, options);
            if (!trained) {
                return fail(std::move(trained.error()));
            }
            if (on_learnt && role == motion::DanceRole::lead) {
                on_learnt(one, *trained);
            }
            learnt.push_back(std::move(*trained));
        }
    }
    if (learnt.empty()) {
        return fail(dance.file + ": " + unknown_name("figure", figure, names));
    }
    return learnt;
}

Expected<fs::path> learn_written_dance(const fs::path& file, const motion::Skeleton& skeleton) {
    const auto text = read_text_file(file, kMaxTextBytes);
    if (!text) {
        return fail(text.error());
    }
    const auto dance = motion::parse_authored_dance(*text, file.string());
    if (!dance) {
        return fail(dance.error());
    }
    // The name becomes part of a file's name: it must not leave the folder.
    if (!is_dance_name(dance->dance)) {
        return fail(fmt::format("{}: dance: {}", dance->file, why_no_dance_name(dance->dance)));
    }
    // Same text and same way of learning, same folder.
    const std::uint64_t hash = hash_of(fmt::format("{}\n{}", kLearningVersion, *text));
    auto folder =
        engine::kept_folder(fs::path("written") / fmt::format("{}-{:016x}", dance->dance, hash));
    if (!folder || is_whole(*folder)) {
        return folder;
    }
    const auto learnt = learn_figures(*dance, {}, skeleton, {});
    if (!learnt) {
        return fail(learnt.error());
    }
    std::vector<engine::LearntFigure> figures;
    for (const motion::AuthoredTrainingResult& one : *learnt) {
        // Written, not counted: every figure has the same weight.
        figures.push_back({&one.model, 1.0});
    }
    if (auto added = engine::add_to_folder(*folder, info_of(*dance), figures, grammar_of(*dance));
        !added) {
        return fail(std::move(added.error()));
    }
    return folder;
}

}  // namespace raks::apps
