#include "tests/fuzz/mutation.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <vector>

#include "audio/io/ogg_links.hpp"
#include "base/file.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace raks::fuzz {
namespace {

constexpr std::string_view kJson = R"({"name": "a", "beats": 8, "means": [1.5, 2.5]})";
constexpr std::string_view kToml = "tempo = 90\nname = \"a\"\n\n[figure.basic]\nbeats = [1, 5]\n";

std::size_t count_of(std::string_view text, std::string_view part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

/// Is any of many mutations so?
bool is_any(std::string_view text, const std::function<bool(const std::string&)>& is_so) {
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
        if (is_so(mutated(text, seed))) {
            return true;
        }
    }
    return false;
}

TEST(Mutation, puts_awkward_values_in_the_place_of_values_of_any_kind) {
    const std::vector<std::string> values = {
        "0", "-1", "2147483648", "1e308", "1e-321", "\"\"", "[]"};
    for (const std::string& value : values) {
        for (const char* before : {"\"name\": ", "\"beats\": ", "\"means\": "}) {
            EXPECT_TRUE(is_any(kJson,
                               [&](const std::string& text) {
                                   return text.find(before + value) != std::string::npos;
                               }))
                << before << value;
        }
        for (const char* before : {"name = ", "tempo = ", "beats = "}) {
            EXPECT_TRUE(is_any(kToml,
                               [&](const std::string& text) {
                                   return text.find(before + value + "\n") != std::string::npos;
                               }))
                << before << value;
        }
    }
}

TEST(Mutation, nests_brackets_tables_and_dotted_keys_deep) {
    const auto is_deep = [](std::string_view part) {
        return [part](const std::string& text) { return count_of(text, part) > 10'000; };
    };
    EXPECT_TRUE(is_any(kJson, is_deep("[[")));
    EXPECT_TRUE(is_any(kJson, is_deep("{\"a\":{")));
    EXPECT_TRUE(is_any(kToml, is_deep("{a={")));
    EXPECT_TRUE(is_any(kToml, is_deep("a.a.")));
    // Closed again, too: what reads the whole of it goes as deep.
    EXPECT_TRUE(is_any(kJson, [](const std::string& text) {
        return count_of(text, "[[") > 10'000 && count_of(text, "]]") > 10'000;
    }));
}

TEST(Mutation, gives_a_key_twice) {
    EXPECT_TRUE(is_any(kJson, [](const std::string& text) {
        return count_of(text, "\"beats\": 8") == 2 && count_of(text, "\"name\"") == 1;
    }));
    EXPECT_TRUE(
        is_any(kToml, [](const std::string& text) { return count_of(text, "tempo = 90\n") == 2; }));
    EXPECT_TRUE(is_any(
        kToml, [](const std::string& text) { return count_of(text, "[figure.basic]\n") == 2; }));
}

TEST(Mutation, of_a_text_or_bytes_is_the_same_again) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        EXPECT_EQ(mutated(kJson, seed), mutated(kJson, seed));
        EXPECT_EQ(mutated_bytes(kJson, seed), mutated_bytes(kJson, seed));
    }
}

TEST(Mutation, of_little_or_nothing_ends) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        for (const char* text : {"", "x", "[", "\"", "\"a\":", "OggS"}) {
            static_cast<void>(mutated(text, seed));
            static_cast<void>(mutated_bytes(text, seed));
        }
    }
}

// Readers pass pages with a wrong sum over: what lies in them would not be tried.
TEST(Mutation, mends_the_check_sums_of_ogg_pages) {
    const std::string good =
        read_file(RAKS_SOURCE_DIR "/tests/fuzz/corpus/sound/vorbis.ogg").value();
    int changed_and_whole = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const std::string bad = mutated_bytes(good, seed);
        const MemoryFile file(bad);
        const auto window = audio::FileWindow::adopt(dup(file.descriptor()), "x");
        const audio::OggPages pages = audio::read_ogg_pages(*window);
        const bool is_whole = pages.links.size() == 1 && !pages.links[0].has_hole && !pages.is_cut;
        changed_and_whole += bad != good && bad.size() == good.size() && is_whole ? 1 : 0;
    }
    EXPECT_GT(changed_and_whole, 5);
}

}  // namespace
}  // namespace raks::fuzz
