
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/settings_table.hpp"
#include "tests/engine/installed.hpp"
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
}

}  // namespace
}  // namespace raks::engine
