
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/dance_folder.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/setup/settings_table.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/made_cells.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

std::shared_ptr<const motion::DanceLibrary> waltz_from(const DanceCache& cache,
                                                       const DanceForm& form = {}) {
    auto library = load_dance(installed::dances(),
                              "waltz",
                              motion::mannequin_skeleton(),
                              motion::DanceRole::lead,
                              form,
                              cache);
    EXPECT_TRUE(library) << library.error().message;
    return library ? std::move(*library) : nullptr;
}

std::vector<std::filesystem::path> kept_in(const test::TemporaryFolder& folder) {
    const auto files = list_folder(folder.path());
    return files ? *files : std::vector<std::filesystem::path>{};
}

TEST(DanceCache, gives_back_the_bits_that_were_solved) {
    const test::TemporaryFolder folder;
    const DanceCache cache(folder.path());
    const std::string solved = waltz_from(cache)->packed();
    ASSERT_EQ(kept_in(folder).size(), 1U);
    const auto time = std::filesystem::last_write_time(kept_in(folder)[0]);
    EXPECT_TRUE(waltz_from(cache)->packed() == solved);
    EXPECT_EQ(std::filesystem::last_write_time(kept_in(folder)[0]), time) << "solved once only";
    EXPECT_TRUE(waltz_from(DanceCache({}))->packed() == solved);
}

TEST(DanceCache, solves_anew_what_is_damaged) {
    const test::TemporaryFolder folder;
    const DanceCache cache(folder.path());
    const std::string solved = waltz_from(cache)->packed();
    const std::filesystem::path file = kept_in(folder).at(0);
    const std::string good = *read_file(file);
    const std::string bad[] = {"",
                               good.substr(0, 7),
                               good.substr(0, good.size() / 2),
                               good + "x",
                               test::mangled(good, {1, 1}),
                               test::mangled(good, {2, 40, 200})};
    for (const std::string& bytes : bad) {
        ASSERT_TRUE(write_file(file, bytes));
        EXPECT_EQ(DanceCache::find(file,
                                   motion::mannequin_skeleton(),
                                   installed::dances().read("waltz", {}, {})->grammar),
                  nullptr)
            << bytes.size();
    }
    EXPECT_TRUE(waltz_from(cache)->packed() == solved);
    EXPECT_TRUE(*read_file(file) == good) << "it is mended";
}

TEST(DanceCache, keeps_each_form_and_each_body_and_drops_what_is_older) {
    const test::TemporaryFolder folder;
    const DanceCache cache(folder.path());
    ASSERT_TRUE(write_file(folder / "waltz-lead-0123456789abcdef.baked", "of another version"));
    (void)waltz_from(cache);
    DanceForm frames;
    frames.generator = motion::Generator::frames;
    (void)waltz_from(cache, frames);
    ASSERT_EQ(kept_in(folder).size(), 2U);
    const auto larger = load_dance(installed::dances(),
                                   "waltz",
                                   motion::scaled(motion::mannequin_skeleton(), 1.1F),
                                   motion::DanceRole::lead,
                                   {},
                                   cache);
    ASSERT_TRUE(larger);
    EXPECT_EQ(kept_in(folder).size(), 3U);
    EXPECT_FALSE((*larger)->packed() == waltz_from(DanceCache({}))->packed());
}

/// A folder with a dance of cells, and the catalogue that has it.
class CellDances : public ::testing::Test {
 protected:
    void SetUp() override { write(0.5F); }
    void write(float energy) const {
        DanceInfo info;
        info.name = "mine";
        ASSERT_TRUE(add_to_folder(folder_.path(), info, made(energy)));
    }
    [[nodiscard]] static motion::CellDance made(float energy) {
        return motion::test::made_cells((*data_path("models/trained")).string(), "mine", energy);
    }
    [[nodiscard]] std::string packed(const DanceCache& cache,
                                     const motion::Skeleton& body = motion::mannequin_skeleton(),
                                     const DanceForm& form = {}) const {
        const auto catalogue = DanceCatalogue::load(folder_.path());
        const auto library =
            load_dance(*catalogue, "mine", body, motion::DanceRole::lead, form, cache);
        EXPECT_TRUE(library) << library.error().message;
        return library ? (*library)->packed() : std::string();
    }

    test::TemporaryFolder folder_;
    test::TemporaryFolder kept_;
};

TEST_F(CellDances, are_solved_once_and_given_back_to_the_bit) {
    const DanceCache cache(kept_.path());
    const std::string solved = packed(cache);
    ASSERT_EQ(kept_in(kept_).size(), 1U);
    const std::filesystem::path file = kept_in(kept_)[0];
    EXPECT_EQ(file.filename().string().rfind("mine-cells-", 0), 0U) << file;
    const auto time = std::filesystem::last_write_time(file);
    EXPECT_TRUE(packed(cache) == solved);
    EXPECT_EQ(std::filesystem::last_write_time(file), time) << "solved once only";
    EXPECT_TRUE(packed(DanceCache({})) == solved);
}

TEST_F(CellDances, are_solved_anew_for_other_cells_and_another_body) {
    const DanceCache cache(kept_.path());
    const std::string solved = packed(cache);
    const std::filesystem::path before = kept_in(kept_).at(0);
    write(0.6F);
    EXPECT_FALSE(packed(cache) == solved);
    ASSERT_EQ(kept_in(kept_).size(), 1U) << "the older one is dropped";
    EXPECT_NE(kept_in(kept_)[0], before);
    const auto larger = motion::scaled(motion::mannequin_skeleton(), 1.1F);
    EXPECT_FALSE(packed(cache, larger) == packed(cache));
    EXPECT_EQ(kept_in(kept_).size(), 2U);
}

TEST_F(CellDances, are_solved_anew_where_the_kept_file_is_damaged) {
    const DanceCache cache(kept_.path());
    const std::string solved = packed(cache);
    const std::filesystem::path file = kept_in(kept_).at(0);
    const std::string good = *read_file(file);
    const std::string bad[] = {"",
                               good.substr(0, 7),
                               good.substr(0, good.size() / 2),
                               good + "x",
                               test::mangled(good, {1, 1}),
                               test::mangled(good, {2, 40, 200}),
                               waltz_from(DanceCache({}))->packed()};
    for (const std::string& bytes : bad) {
        ASSERT_TRUE(write_file(file, bytes));
        EXPECT_EQ(DanceCache::find(file, motion::mannequin_skeleton(), motion::DanceHabits()),
                  nullptr)
            << bytes.size();
        EXPECT_TRUE(packed(cache) == solved);
        EXPECT_TRUE(*read_file(file) == good) << "it is mended";
    }
}

TEST_F(CellDances, may_have_a_file_that_says_what_hands_do) {
    const auto notes_of = [&](const std::string& text) {
        EXPECT_TRUE(write_file(folder_ / "mine.toml", text));
        const auto catalogue = DanceCatalogue::load(folder_.path());
        EXPECT_FALSE(catalogue->find("mine")->has_figures);
        EXPECT_FALSE(packed(DanceCache({})).empty()) << "it is danced";
        std::vector<std::string> notes;
        for (const std::string& note : catalogue->notes()) {
            if (note.find("mine.toml") != std::string::npos) {
                notes.push_back(note);
            }
        }
        return notes;
    };
    EXPECT_TRUE(notes_of("[hands]\nshapes = { fist = 1 }\n").empty());
    const auto notes = notes_of("[hands]\nshapes = { fsit = 1 }\n");
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("line 2: hands: "), std::string::npos) << notes[0];
}

/// The same dance with a figure, too.
class DancesOfBoth : public CellDances {
 protected:
    void SetUp() override {
        CellDances::SetUp();
        auto figure = motion::load_figure(*data_path("models/trained/salsa_basic_lead.json"));
        ASSERT_TRUE(figure) << figure.error().message;
        figure->dance = "mine";
        const LearntFigure learnt{&*figure};
        DanceInfo info;
        info.name = "mine";
        ASSERT_TRUE(add_to_folder(folder_.path(), info, {&learnt, 1}));
        settings_.dance = "mine";
    }
    [[nodiscard]] DanceCatalogue catalogue() const { return *DanceCatalogue::load(folder_.path()); }
    [[nodiscard]] bool is_danced_of_cells(const DanceForm& form,
                                          motion::DanceRole role = motion::DanceRole::lead) const {
        const auto library = load_dance(catalogue(),
                                        "mine",
                                        motion::mannequin_skeleton(),
                                        role,
                                        form,
                                        DanceCache(kept_.path()));
        EXPECT_TRUE(library) << library.error().message;
        return library && (*library)->cells() != nullptr;
    }
    Settings settings_;
};

TEST_F(DancesOfBoth, are_danced_of_takes_unless_something_else_is_asked_for) {
    EXPECT_TRUE(is_danced_of_cells({}));
    EXPECT_FALSE(is_danced_of_cells({.material = Material::written}));
    EXPECT_FALSE(is_danced_of_cells({.generator = motion::Generator::frames}));
    EXPECT_FALSE(is_danced_of_cells({.features = motion::FigureFeatures::positions}));
    EXPECT_FALSE(is_danced_of_cells({.company = Company::couple}));
    EXPECT_TRUE(material_notes(settings_, catalogue()).empty());
    settings_.material = "written";
    EXPECT_TRUE(material_notes(settings_, catalogue()).empty());
}

TEST_F(DancesOfBoth, say_in_a_line_why_they_are_danced_of_figures) {
    settings_.formation = "couple";
    EXPECT_EQ(material_notes(settings_, catalogue()),
              std::vector<std::string>{
                  "material: mine is danced of figures: takes of people are for one dancer"});
    settings_.formation = "solo";
    settings_.generator = "frames";
    EXPECT_EQ(material_notes(settings_, catalogue()),
              std::vector<std::string>{"material: mine is danced of figures: takes of people are "
                                       "not of --generator frames"});
    // Which dance will be shown is not known then.
    settings_.dance = "auto";
    settings_.generator = Settings().generator;
    settings_.formation = "couple";
    EXPECT_TRUE(material_notes(settings_, catalogue()).empty());
}

TEST_F(DancesOfBoth, are_danced_of_both_in_turn) {
    settings_.material = "both";
    settings_.formation = "grid";
    settings_.dancers = 5;
    const auto larger = motion::scaled(motion::mannequin_skeleton(), 1.1F);
    for (const bool has_two_bodies : {false, true}) {
        std::vector<motion::Skeleton> bodies = {motion::mannequin_skeleton()};
        if (has_two_bodies) {
            bodies.push_back(larger);
        }
        const auto dancers = Dancers::load(settings_, catalogue(), bodies);
        ASSERT_TRUE(dancers) << dancers.error().message;
        ASSERT_EQ(dancers->cast().size(), 5U);
        std::set<std::pair<bool, float>> seen;  // cells, height
        for (const motion::EnsembleMember& member : dancers->cast()) {
            const auto& repertoire = *member.body.repertoire;
            seen.emplace(repertoire.of(repertoire.first())->cells() != nullptr,
                         member.body.skeleton.hips_height());
        }
        EXPECT_EQ(seen.size(), 2U * bodies.size()) << "every body dances both";
    }
    // The first dancer by the seed.
    EXPECT_EQ(form_of(settings_).material, Material::people);
    settings_.seed = 2;
    EXPECT_EQ(form_of(settings_).material, Material::written);
}

TEST_F(CellDances, have_the_mood_of_the_dances_file_and_go_on_without_one_that_is_mangled) {
    const auto with_mood = [&](const std::string& mood) {
        EXPECT_TRUE(write_file(folder_.path() / "mine.toml",
                               "format = \"raks-dance\"\nversion = 1\ndance = \"mine\"\n" + mood +
                                   "\n[[figure]]\nname = \"step\"\n"));
        return *DanceCatalogue::load(folder_.path());
    };
    const DanceCatalogue own = with_mood("mood = { base = \"sad\" }");
    EXPECT_EQ(own.find("mine")->mood.base, motion::Emotion::sad);
    EXPECT_TRUE(own.notes().empty());
    const DanceCatalogue mangled = with_mood("mood = { base = \"sadd\" }");
    EXPECT_EQ(mangled.find("mine")->mood, motion::DanceMood());
    ASSERT_EQ(mangled.notes().size(), 1U);
    EXPECT_NE(mangled.notes()[0].find("did you mean \"sad\"?; faces go without it"),
              std::string::npos)
        << mangled.notes()[0];
}

TEST_F(CellDances, are_not_begun_with_where_they_cannot_be_what_is_asked_for) {
    Settings settings;
    settings.fallback_dance = "mine";
    const auto catalogue = DanceCatalogue::load(folder_.path());
    const auto has = [](const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    EXPECT_EQ(dance_to_load(settings, *catalogue), "mine");
    settings.fallback_dance = "first";
    EXPECT_EQ(dance_to_load(settings, *catalogue), catalogue->entries().front().info.name);
    EXPECT_TRUE(has(other_dances_to_load(settings, *catalogue), "mine"));
    settings.fallback_dance = "mine";
    settings.generator = "frames";
    EXPECT_NE(dance_to_load(settings, *catalogue), "mine");
    EXPECT_FALSE(has(other_dances_to_load(settings, *catalogue), "mine"));
    const auto said_of_mine = [&] {
        std::string said;
        for (const std::string& note : material_notes(settings, *catalogue)) {
            said += note.find("mine") != std::string::npos ? note : "";
        }
        return said;
    };
    EXPECT_NE(said_of_mine().find("left out: takes of people are not of --generator frames"),
              std::string::npos)
        << said_of_mine();
    settings.generator = "trajectories";
    settings.formation = "couple";
    EXPECT_EQ(catalogue->find(dance_to_load(settings, *catalogue))->info.roles, 2);
    EXPECT_FALSE(has(other_dances_to_load(settings, *catalogue), "mine"));
    EXPECT_EQ(said_of_mine(), "");
    // Who names it is told why not.
    settings.dance = "mine";
    EXPECT_EQ(dance_to_load(settings, *catalogue), "mine");
}

TEST_F(CellDances, are_danced_of_takes_where_they_have_no_figures) {
    Settings settings;
    settings.dance = "mine";
    settings.material = "written";
    const auto catalogue = DanceCatalogue::load(folder_.path());
    EXPECT_EQ(
        material_notes(settings, *catalogue),
        std::vector<std::string>{"material: mine has no figures: takes of people are danced"});
    EXPECT_FALSE(packed(DanceCache({}), motion::mannequin_skeleton(), form_of(settings)).empty());
    DanceForm couple;
    couple.company = Company::couple;
    const auto follow = load_dance(*catalogue,
                                   "mine",
                                   motion::mannequin_skeleton(),
                                   motion::DanceRole::follow,
                                   couple,
                                   DanceCache({}));
    ASSERT_FALSE(follow);
    EXPECT_EQ(follow.error().message.find("mine is danced alone; a couple dances "), 0U)
        << follow.error().message;
}

TEST(DanceCache, does_without_a_folder_that_cannot_be_written) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "file", "no folder"));
    EXPECT_NE(waltz_from(DanceCache(folder / "file")), nullptr);
    EXPECT_EQ(*read_file(folder / "file"), "no folder");
}

/// Whether what `look_at` finds is another for each word of a setting.
template <typename Look>
bool differs_by_every_word(std::string Settings::*field, const Look& look_at) {
    std::set<decltype(look_at(Settings()))> found;
    const auto words = row_of(field).words.all();
    for (const std::string_view word : words) {
        Settings settings;
        settings.*field = word;
        found.insert(look_at(settings));
    }
    return words.size() > 1 && found.size() == words.size();
}

TEST(DanceForm, is_another_by_every_word_of_the_settings) {
    EXPECT_TRUE(differs_by_every_word(&Settings::figures,
                                      [](const Settings& s) { return form_of(s).features; }));
    EXPECT_TRUE(differs_by_every_word(&Settings::generator,
                                      [](const Settings& s) { return form_of(s).generator; }));
    EXPECT_TRUE(differs_by_every_word(&Settings::dynamics,
                                      [](const Settings& s) { return dynamics_of(s); }));
    EXPECT_TRUE(differs_by_every_word(&Settings::tagger,
                                      [](const Settings& s) { return genre_aids_of(s).tagger; }));
}

}  // namespace
}  // namespace raks::engine
