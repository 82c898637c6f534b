#include "tests/motion/dance/stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "motion/dance_library.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::test {

const FigureModel& basic_step() {
    static const FigureModel model = [] {
        auto loaded =
            load_figure(std::string(RAKS_SOURCE_DIR) + "/models/trained/salsa_basic_lead.json");
        EXPECT_TRUE(loaded) << loaded.error().message;
        return *loaded;
    }();
    return model;
}

const FigureGrammar& couple_grammar() {
    static const FigureGrammar grammar = [] {
        auto loaded = load_grammar(std::string(RAKS_SOURCE_DIR) + "/models/trained/salsa.toml");
        EXPECT_TRUE(loaded) << loaded.error().message;
        return *loaded;
    }();
    return grammar;
}

const FigureGrammar& salsa_grammar() {
    static const FigureGrammar grammar = [] {
        FigureGrammar alone = couple_grammar();
        for (FigureGrammar::Rule& rule : alone.rules) {
            rule.aside = {};
        }
        return alone;
    }();
    return grammar;
}

namespace {

/// salsa_FIGURE_NAME.json of all figures.
std::vector<FigureModel> load_figures(std::string_view name) {
    std::vector<FigureModel> models;
    for (const FigureGrammar::Rule& rule : salsa_grammar().rules) {
        auto loaded = load_figure(std::string(RAKS_SOURCE_DIR) + "/models/trained/salsa_" +
                                  rule.figure + "_" + std::string(name) + ".json");
        EXPECT_TRUE(loaded) << loaded.error().message;
        models.push_back(*loaded);
    }
    return models;
}

}  // namespace

const std::vector<FigureModel>& salsa_figures(DanceRole role) {
    static const std::array<std::vector<FigureModel>, 2> figures = {load_figures(kRoleNames[0]),
                                                                    load_figures(kRoleNames[1])};
    return figures[static_cast<std::size_t>(role)];
}

std::shared_ptr<const DanceLibrary> salsa_library(DanceRole role) {
    static std::array<std::shared_ptr<const DanceLibrary>, 2> libraries;
    auto& library = libraries[static_cast<std::size_t>(role)];
    if (!library) {
        auto built =
            DanceLibrary::build(salsa_figures(role), mannequin_skeleton(), &salsa_grammar());
        EXPECT_TRUE(built) << built.error().message;
        library = *built;
    }
    return library;
}

std::shared_ptr<const DanceLibrary> couple_library(DanceRole role) {
    static std::array<std::shared_ptr<const DanceLibrary>, 2> libraries;
    auto& library = libraries[static_cast<std::size_t>(role)];
    if (!library) {
        auto built =
            DanceLibrary::build(salsa_figures(role), mannequin_skeleton(), &couple_grammar());
        EXPECT_TRUE(built) << built.error().message;
        library = *built;
    }
    return library;
}

std::shared_ptr<const DanceLibrary> position_library() {
    static const std::shared_ptr<const DanceLibrary> library = [] {
        auto built = DanceLibrary::build(
            load_figures("lead_positions"), mannequin_skeleton(), &salsa_grammar());
        EXPECT_TRUE(built) << built.error().message;
        return *built;
    }();
    return library;
}

DanceContent written_dance(const std::string& name) {
    const std::string trained = std::string(RAKS_SOURCE_DIR) + "/models/trained/" + name;
    const auto grammar = load_grammar(trained + ".toml");
    EXPECT_TRUE(grammar) << grammar.error().message;
    std::vector<FigureModel> models;
    for (const FigureGrammar::Rule& rule : grammar->rules) {
        auto loaded = load_figure(trained + "_" + rule.figure + "_lead.json");
        EXPECT_TRUE(loaded) << loaded.error().message;
        models.push_back(std::move(*loaded));
    }
    auto made = make_content(models, mannequin_skeleton(), &*grammar);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
}

std::shared_ptr<const DanceLibrary> library_of(const FigureModel& model) {
    auto library = DanceLibrary::build(std::span(&model, 1), mannequin_skeleton());
    EXPECT_TRUE(library) << library.error().message;
    return *library;
}

MusicState sure_state(HopIndex hop, const BeatGrid& grid) {
    MusicState state;
    state.hop = hop;
    state.time = state.audio_end = time_of_hop(hop);
    state.grid = grid;
    state.grid.confidence = 1.0F;
    state.is_silent = false;
    state.level_dbfs = -15.0F;
    state.loudness_lufs = -15.0F;
    return state;
}

BeatGrid steady_grid(double bpm) {
    BeatGrid grid;
    grid.tempo = Bpm(bpm);
    grid.confidence = 1.0F;
    return grid;
}

Music steady_music(double bpm) {
    return [grid = steady_grid(bpm)](HopIndex hop) { return sure_state(hop, grid); };
}

std::vector<Pose> dance_to(const Music& music, HopIndex hops, const FigureModel& model) {
    Dancer dancer;
    EXPECT_TRUE(dancer.prepare(library_of(model), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    std::vector<Pose> poses;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        dancer.advance(music(hop), *track);
        poses.push_back(track->at_hop(hop));
    }
    return poses;
}

double largest_step(const std::vector<Pose>& poses, HopIndex from, HopIndex to) {
    double largest = 0.0;
    for (HopIndex hop = from + 1; hop < to; ++hop) {
        const WorldPose a =
            world_pose(mannequin_skeleton(), poses[static_cast<std::size_t>(hop - 1)]);
        const WorldPose b = world_pose(mannequin_skeleton(), poses[static_cast<std::size_t>(hop)]);
        for (std::size_t i = 0; i < a.positions.size(); ++i) {
            largest = std::max(largest,
                               static_cast<double>(glm::length(a.positions[i] - b.positions[i])));
        }
    }
    return largest;
}

bool are_same(const Pose& a, const Pose& b) {
    for (std::size_t i = 0; i < a.local_rotations.size(); ++i) {
        if (a.local_rotations[i] != b.local_rotations[i]) {
            return false;
        }
    }
    return a.hips_position == b.hips_position;
}

}  // namespace raks::motion::test
