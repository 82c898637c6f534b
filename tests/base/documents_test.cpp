// The documents name only files that are there.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/base/source_tree.hpp"

namespace raks {
namespace {

namespace fs = std::filesystem;
using test::kSourceTree;
using test::source_text;

std::vector<fs::path> documents() {
    std::vector<fs::path> found = {kSourceTree / "README.md", kSourceTree / "NOTICE.md"};
    for (const fs::path& folder : {kSourceTree / "docs", kSourceTree / "models"}) {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.path().extension() == ".md") {
                found.push_back(entry.path());
            }
        }
    }
    return found;
}

std::vector<std::string> all_of(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
        found.push_back((*it)[1]);
    }
    return found;
}

TEST(Documents, link_to_what_is_there) {
    std::size_t links = 0;
    for (const fs::path& document : documents()) {
        for (const std::string& link :
             all_of(source_text(document), R"(\]\(([A-Za-z0-9_./-]+)(#[^)]*)?\))")) {
            ++links;
            EXPECT_TRUE(fs::exists(document.parent_path() / link)) << document << ": " << link;
        }
    }
    EXPECT_GT(links, 20U);
}

TEST(Documents, name_source_files_that_are_there) {
    std::size_t names = 0;
    for (const fs::path& document : documents()) {
        for (const std::string& name :
             all_of(source_text(document), R"(`([a-z_]+/[A-Za-z0-9_./-]+\.(?:cpp|hpp|sh|md))`)")) {
            ++names;
            EXPECT_TRUE(fs::exists(kSourceTree / name)) << document << ": " << name;
        }
    }
    EXPECT_GT(names, 20U);
}

}  // namespace
}  // namespace raks
