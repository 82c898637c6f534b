#include "engine/show/picture.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/setup/settings_table.hpp"
#include "render/scene/camera.hpp"
#include "render/scene/theme.hpp"

namespace raks::engine {
namespace {

using Texts = std::vector<std::string_view>;

Texts words_of(std::string Settings::*field) {
    const auto words = row_of(field).words.all();
    return {words.begin(), words.end()};
}

// The looks of all words of a setting.
std::vector<Look> looks_of(std::string Settings::*field) {
    std::vector<Look> looks;
    for (const std::string_view word : words_of(field)) {
        Settings settings;
        settings.*field = word;
        auto look = read_look(settings);
        EXPECT_TRUE(look) << word;
        looks.push_back(look.value_or(Look{}));
    }
    return looks;
}

TEST(Look, has_another_dress_and_quality_by_every_word) {
    std::set<std::tuple<render::Dress, render::Costume, bool>> dresses;
    for (const Look& look : looks_of(&Settings::dress)) {
        dresses.emplace(look.scene.dress, look.costume, look.dresses_by_dance);
    }
    EXPECT_EQ(dresses.size(), words_of(&Settings::dress).size());
    std::set<render::Quality> qualities;
    for (const Look& look : looks_of(&Settings::quality)) {
        qualities.insert(look.quality);
    }
    EXPECT_EQ(qualities.size(), words_of(&Settings::quality).size());
}

TEST(Look, is_of_sticks_by_that_word_and_when_danced_by_positions) {
    Settings settings;
    EXPECT_EQ(read_look(settings)->scene.view, render::View::skin);
    settings.view = "stick";
    EXPECT_EQ(read_look(settings)->scene.view, render::View::stick);
    settings.view = "auto";
    settings.figures = "positions";
    EXPECT_EQ(read_look(settings)->scene.view, render::View::stick);
    settings.view = "skin";
    EXPECT_EQ(read_look(settings)->scene.view, render::View::skin);
}

TEST(Look, has_the_director_or_one_of_the_cameras_that_there_are) {
    Texts known = {kDirector};
    const auto presets = render::camera_names();
    known.insert(known.end(), presets.begin(), presets.end());
    EXPECT_EQ(words_of(&Settings::camera), known);
}

}  // namespace
}  // namespace raks::engine
