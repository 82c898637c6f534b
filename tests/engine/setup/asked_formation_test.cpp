#include "engine/setup/asked_formation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engine/setup/settings_table.hpp"

namespace raks::engine {
namespace {

using motion::Formation;

Settings settings_of(const std::string& formation, std::int64_t dancers, std::size_t avatars) {
    Settings settings;
    settings.formation = formation;
    settings.dancers = dancers;
    settings.avatars.assign(avatars, "mannequin");
    return settings;
}

TEST(AskedFormation, is_the_one_that_is_named_and_a_grid_of_several_without_a_name) {
    const struct {
        const char* formation;
        std::int64_t dancers;
        std::size_t avatars;
        Formation is;
        std::size_t has;
    } cases[] = {
        {"solo", 0, 1, Formation::solo, 1},
        {"solo", 1, 3, Formation::solo, 1},
        {"solo", 12, 1, Formation::grid, 12},
        {"solo", 0, 2, Formation::grid, 2},
        {"solo", 5, 2, Formation::grid, 5},
        {"couple", 0, 1, Formation::couple, 2},
        {"couple", 12, 3, Formation::couple, 2},
        {"unison", 0, 1, Formation::unison, 3},
        {"unison", 0, 2, Formation::unison, 3},
        {"unison", 0, 5, Formation::unison, 5},
        {"v", 32, 1, Formation::v, 32},
        {"ring", 2, 5, Formation::ring, 2},
    };
    for (const auto& c : cases) {
        const Settings settings = settings_of(c.formation, c.dancers, c.avatars);
        const Formation formation = asked_formation(settings);
        EXPECT_EQ(name_of(formation), name_of(c.is)) << c.formation << " of " << c.dancers;
        EXPECT_EQ(asked_dancers(settings, formation), c.has) << c.formation << " of " << c.dancers;
    }
}

TEST(AskedFormation, is_known_by_every_word_of_the_setting) {
    const auto words = row_of(&Settings::formation).words.all();
    EXPECT_TRUE(std::equal(words.begin(),
                           words.end(),
                           motion::kFormationNames.begin(),
                           motion::kFormationNames.end()));
}

}  // namespace
}  // namespace raks::engine
