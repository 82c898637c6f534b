// The walls of the house: reads every #include line and fails on an arrow that the design does
// not allow, and on a cycle between folders. The picture is in docs/architecture.md.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Graph = std::map<std::string, std::set<std::string>>;

const fs::path kRoot = RAKS_SOURCE_DIR;

/// What a room (the longest matching prefix) may include besides itself.
const std::map<std::string, std::vector<std::string>> kAllowed = {
    {"base", {}},
    {"models", {"base"}},
    {"audio", {"base", "models"}},
    {"motion", {"base", "models"}},
    {"motion/skeleton", {"base"}},
    {"render", {"base", "motion/skeleton"}},
    {"engine", {"base", "models", "audio", "motion", "render"}},
};

bool is_inside(const std::string& path, const std::string& folder) {
    return path == folder || path.rfind(folder + "/", 0) == 0;
}

std::string room_of(const std::string& path) {
    std::string best;
    for (const auto& [room, allowed] : kAllowed) {
        if (is_inside(path, room) && room.size() > best.size()) {
            best = room;
        }
    }
    return best;
}

bool is_allowed(const std::string& from, const std::string& to) {
    const std::string room = room_of(from);
    if (is_inside(to, room)) {
        return true;
    }
    for (const std::string& other : kAllowed.at(room)) {
        if (is_inside(to, other)) {
            return true;
        }
    }
    return false;
}

/// file -> files of ours that it includes, both relative to the root.
std::map<std::string, std::vector<std::string>> include_lines() {
    const std::regex pattern("^\\s*#\\s*include\\s+\"([^\"]+)\"");
    std::map<std::string, std::vector<std::string>> lines;
    for (const char* room : {"base", "models", "audio", "motion", "render", "engine"}) {
        if (!fs::exists(kRoot / room)) {
            continue;
        }
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / room)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".hpp" && extension != ".cpp") {
                continue;
            }
            const std::string file = fs::relative(entry.path(), kRoot).generic_string();
            lines[file];
            std::ifstream stream(entry.path());
            std::string line;
            std::smatch match;
            while (std::getline(stream, line)) {
                if (std::regex_search(line, match, pattern)) {
                    lines[file].push_back(match[1]);
                }
            }
        }
    }
    return lines;
}

TEST(IncludeLines, go_only_where_the_design_allows) {
    for (const auto& [file, includes] : include_lines()) {
        for (const std::string& include : includes) {
            ASSERT_TRUE(fs::exists(kRoot / include))
                << file << " includes \"" << include << "\": not a full path from the root";
            EXPECT_TRUE(is_allowed(file, include)) << file << " may not include " << include;
        }
    }
}

TEST(IncludeLines, have_no_cycle_between_folders) {
    Graph graph;
    for (const auto& [file, includes] : include_lines()) {
        const std::string from = fs::path(file).parent_path().generic_string();
        for (const std::string& include : includes) {
            const std::string to = fs::path(include).parent_path().generic_string();
            if (from != to) {
                graph[from].insert(to);
            }
        }
    }
    std::set<std::string> done;
    std::vector<std::string> path;
    const std::function<void(const std::string&)> visit = [&](const std::string& folder) {
        const auto seen = std::find(path.begin(), path.end(), folder);
        if (seen != path.end()) {
            std::string cycle;
            for (auto it = seen; it != path.end(); ++it) {
                cycle += *it + " -> ";
            }
            ADD_FAILURE() << "cycle: " << cycle << folder;
            return;
        }
        if (done.count(folder) > 0) {
            return;
        }
        path.push_back(folder);
        for (const std::string& next : graph[folder]) {
            visit(next);
        }
        path.pop_back();
        done.insert(folder);
    };
    const Graph roots = graph;
    for (const auto& [folder, targets] : roots) {
        visit(folder);
    }
}

TEST(IncludeLines, the_rule_itself_refuses_forbidden_arrows) {
    EXPECT_TRUE(is_allowed("render/gl/x.cpp", "motion/skeleton/pose.hpp"));
    EXPECT_FALSE(is_allowed("render/gl/x.cpp", "motion/dance/y.hpp"));
    EXPECT_FALSE(is_allowed("audio/beat/x.cpp", "motion/skeleton/pose.hpp"));
    EXPECT_FALSE(is_allowed("motion/dance/x.cpp", "audio/beat/y.hpp"));
    EXPECT_FALSE(is_allowed("motion/skeleton/x.cpp", "models/hmm.hpp"));
    EXPECT_FALSE(is_allowed("base/x.cpp", "models/hmm.hpp"));
}

}  // namespace
