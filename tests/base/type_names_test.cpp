// Two types of one name in one namespace are undefined behaviour as soon as one program holds both,
// and no compiler says so: each name is defined in one header.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/base/source_tree.hpp"

namespace raks {
namespace {

namespace fs = std::filesystem;
using test::kSourceTree;
using test::source_text;

/// Names of the types that a header defines outside of other types, as "namespace::name".
std::vector<std::string> types_in(const std::string& header) {
    static const std::regex kNamespace("namespace (\\S+) \\{");
    static const std::regex kType("(struct|class|enum class) (\\w+)( final)?( :.*)? \\{.*");
    std::vector<std::string> types;
    std::string space;
    std::istringstream lines(header);
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
        if (std::regex_match(line, match, kNamespace)) {
            space = match[1];
        } else if (std::regex_match(line, match, kType)) {
            types.push_back(space + "::" + match[2].str());
        }
    }
    return types;
}

TEST(TypeNames, are_read_from_headers) {
    EXPECT_EQ(
        types_in("namespace a::b {\nstruct C {\n    class D {\n};\nclass E;\nclass F : G {\n"),
        (std::vector<std::string>{"a::b::C", "a::b::F"}));
}

TEST(TypeNames, are_defined_in_one_header_each) {
    std::map<std::string, std::string> homes;
    for (const char* const room :
         {"base", "models", "audio", "motion", "render", "training", "engine", "apps"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kSourceTree / room)) {
            if (entry.path().extension() != ".hpp") {
                continue;
            }
            const std::string file = fs::relative(entry.path(), kSourceTree).string();
            for (const std::string& type : types_in(source_text(entry.path()))) {
                const auto [home, is_new] = homes.emplace(type, file);
                EXPECT_TRUE(is_new) << type << " stands in " << home->second << " and " << file;
            }
        }
    }
    EXPECT_GT(homes.size(), 500U);
}

}  // namespace
}  // namespace raks
