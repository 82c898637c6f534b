// A dance is data: no source file of the product names one, in a text or as an enumerator.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/base/source_tree.hpp"
#include "tests/support/dances.hpp"

namespace raks {
namespace {

namespace fs = std::filesystem;

/// Where a word that is also a dance's names a part of the body, or is a tag of music.
const std::set<std::string> kOtherWords = {"render/mannequin/trunk_primitives.cpp",
                                           "audio/genre/tagger_network.hpp"};

/// The words of a line of code that are in quotes, and the line itself where it may be an
/// enumerator.
std::vector<std::string> names_in(const std::string& line) {
    static const std::regex kText("\"((?:[^\"\\\\]|\\\\.)*)\"");
    static const std::regex kEnumerator("^\\s*(\\w+)\\s*(=[^=].*)?,?\\s*$");
    const std::string code = line.substr(0, line.find("//"));
    std::vector<std::string> names;
    if (code.find("#include") != std::string::npos) {
        return names;
    }
    for (std::sregex_iterator it(code.begin(), code.end(), kText), end; it != end; ++it) {
        names.push_back((*it)[1]);
    }
    std::smatch enumerator;
    if (std::regex_match(code, enumerator, kEnumerator)) {
        names.push_back(enumerator[1]);
    }
    return names;
}

/// Whether a text has this word: letters around it make it another one.
bool has_word(const std::string& text, const std::string& word) {
    const auto is_letter = [&](std::size_t at) {
        return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
    };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        if (!(at > 0 && is_letter(at - 1)) && !is_letter(at + word.size())) {
            return true;
        }
    }
    return false;
}

TEST(DanceNames, are_in_no_source_file) {
    const auto dances = test::shipped_dances();
    int files = 0;
    for (const char* const room :
         {"base", "models", "audio", "motion", "render", "training", "engine", "apps"}) {
        for (const auto& entry : fs::recursive_directory_iterator(test::kSourceTree / room)) {
            const std::string file = fs::relative(entry.path(), test::kSourceTree).generic_string();
            const std::string extension = entry.path().extension().string();
            if ((extension != ".cpp" && extension != ".hpp") || kOtherWords.contains(file)) {
                continue;
            }
            ++files;
            std::ifstream stream(entry.path());
            std::string line;
            for (int number = 1; std::getline(stream, line); ++number) {
                for (const std::string& text : names_in(line)) {
                    for (const DanceInfo& dance : dances->all()) {
                        EXPECT_FALSE(has_word(text, dance.name))
                            << file << ":" << number << ": " << text;
                    }
                }
            }
        }
    }
    EXPECT_GT(files, 500);
}

TEST(DanceNames, would_be_found) {
    EXPECT_TRUE(has_word(names_in("    load(\"tango\");").front(), "tango"));
    EXPECT_TRUE(has_word(names_in("    tango,").front(), "tango"));
    EXPECT_TRUE(has_word(names_in("    tango = 3,").front(), "tango"));
    EXPECT_TRUE(names_in("    // \"tango\"").empty());
    EXPECT_FALSE(has_word("tangos", "tango"));
}

}  // namespace
}  // namespace raks
