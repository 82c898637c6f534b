// Every reader with every input of its corpus, with the files that Raks ships, and with mutations
// of both: none may end the program, hang or break a promise. Under the sanitizers (preset asan)
// this is where a find of the fuzzers stays found.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargest = std::size_t{64} << 20U;

/// The seeds and the corpus of a reader, in the order of their names.
std::vector<fs::path> inputs_of(const Reader& reader) {
    const fs::path root = RAKS_SOURCE_DIR;
    std::vector<fs::path> files;
    for (const std::string_view seed : reader.seeds) {
        files.push_back(root / seed);
    }
    std::error_code problem;
    for (const auto& entry :
         fs::directory_iterator(root / "tests/fuzz/corpus" / reader.name, problem)) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class Corpus : public ::testing::TestWithParam<Reader> {};

TEST_P(Corpus, ends_no_reader) {
    const Reader& reader = GetParam();
    const std::vector<fs::path> files = inputs_of(reader);
    ASSERT_FALSE(files.empty()) << "tests/fuzz/corpus/" << reader.name << " is empty";
    std::vector<std::string> texts;
    std::size_t good = 0;
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.string());
        auto text = read_file(file, kLargest);
        ASSERT_TRUE(text) << text.error().message;
        good += reader.read(*text) ? 1U : 0U;
        texts.push_back(std::move(*text));
    }
    // A corpus of nothing but refused files tries little.
    EXPECT_GT(good, 0U);
    // The mutations' number is their seed: a crash is repeated by running this test again.
    for (std::size_t i = 0; i < reader.trials; ++i) {
        static_cast<void>(reader.read(damaged(reader, texts[i % texts.size()], i)));
    }
}

INSTANTIATE_TEST_SUITE_P(Readers,
                         Corpus,
                         ::testing::ValuesIn(readers().begin(), readers().end()),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace raks::fuzz
