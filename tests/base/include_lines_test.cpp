// The walls of the house: reads every #include line and fails on an arrow that the design does
// not allow, and on a cycle between folders. The picture is in docs/how_it_works/architecture.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/base/source_tree.hpp"

namespace {

namespace fs = std::filesystem;
using raks::test::kSourceTree;
using Graph = std::map<std::string, std::set<std::string>>;

/// What a room may include besides itself. A file belongs to the room of the longest prefix; a room
/// inside another one is a room of its own, which the outer one may include only if it says so.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"base", {}},
    {"base/channels", {"base"}},
    {"base/gltf", {"base"}},
    {"models", {"base"}},

    {"audio/resample", {"base"}},
    {"audio/io", {"base", "base/channels", "audio/resample"}},
    {"audio/features", {"base", "models", "audio/resample"}},
    {"audio/beat/network", {"base", "models", "audio/features"}},
    {"audio/beat", {"base", "models", "audio/features", "audio/beat/network"}},
    {"audio/genre", {"base", "models", "audio/features"}},
    {"audio/sync", {"base", "audio/resample"}},
    {"audio", {"base", "audio/resample", "audio/features", "audio/beat", "audio/genre"}},
    {"audio/song",
     {"base",
      "models",
      "audio",
      "audio/features",
      "audio/beat",
      "audio/beat/network",
      "audio/genre"}},
    {"audio/evaluate",
     {"base",
      "models",
      "audio",
      "audio/features",
      "audio/genre",
      "audio/song",
      "audio/music/generator"}},
    {"audio/music/styles", {"base"}},
    {"audio/music/score", {"base", "audio/music/styles"}},
    {"audio/music/generator", {"base"}},
    {"audio/music/instruments",
     {"base", "audio/music/generator", "audio/music/score", "audio/music/styles"}},
    {"audio/music/damage", {"base", "audio/io", "audio/resample"}},

    {"motion/skeleton", {"base"}},
    {"motion/skeleton/formats", {"base", "base/gltf", "motion/skeleton"}},
    {"motion/figures", {"base", "models", "motion/skeleton"}},
    {"motion/evaluate", {"base", "motion/skeleton", "motion/skeleton/formats", "motion/figures"}},
    {"motion/choreography", {"base", "motion/skeleton", "motion/figures", "motion/evaluate"}},
    {"motion/cells", {"base", "motion/skeleton", "motion/figures"}},
    {"motion/dance/body", {"base", "motion/skeleton"}},
    {"motion/dance/baking", {"base", "motion/skeleton", "motion/figures", "motion/dance/body"}},
    {"motion/dance",
     {"base",
      "motion/skeleton",
      "motion/figures",
      "motion/cells",
      "motion/dance/body",
      "motion/dance/baking"}},
    {"motion/capture/camera", {"base"}},
    {"motion/capture/markers", {"base", "motion/skeleton", "motion/skeleton/formats"}},
    {"motion/capture/pictures", {"base", "motion/capture/markers"}},
    {"motion/capture/keypoints",
     {"base", "motion/skeleton/formats", "motion/capture/calibration", "motion/capture/pictures"}},
    {"motion/capture/triangulation", {"base", "motion/capture/camera"}},
    {"motion/capture/markerless",
     {"base",
      "motion/skeleton",
      "motion/capture/camera",
      "motion/capture/keypoints",
      "motion/capture/markers",
      "motion/capture/solving",
      "motion/capture/triangulation"}},
    {"motion/capture/dancer_rig",
     {"base",
      "motion/capture/calibration",
      "motion/capture/camera",
      "motion/capture/keypoints",
      "motion/capture/markerless",
      "motion/capture/markers",
      "motion/capture/triangulation"}},
    {"motion/capture/tracking",
     {"base",
      "motion/skeleton",
      "motion/skeleton/formats",
      "motion/capture/camera",
      "motion/capture/markers",
      "motion/capture/triangulation"}},
    {"motion/capture/calibration",
     {"base", "motion/capture/camera", "motion/capture/triangulation"}},
    {"motion/capture/angles",
     {"base",
      "models",
      "motion/skeleton",
      "motion/skeleton/formats",
      "motion/capture/camera",
      "motion/capture/markers",
      "motion/capture/solving",
      "motion/capture/tracking",
      "motion/capture/triangulation"}},
    {"motion/capture/solving",
     {"base", "motion/skeleton", "motion/choreography", "motion/capture/markers"}},
    {"motion/capture/studio",
     {"base", "motion/skeleton", "motion/capture/camera", "motion/capture/markers"}},
    {"motion", {"base", "motion/skeleton", "motion/figures", "motion/dance", "motion/dance/body"}},

    {"render/gl", {"base"}},
    {"render/video", {"base"}},
    {"render/model", {"base", "motion/skeleton"}},
    {"render/import", {"base", "motion/skeleton", "render/model"}},
    {"render/export", {"base", "base/gltf", "motion/skeleton", "render/model"}},
    {"render/scene", {"base", "motion/skeleton"}},
    {"render/avatar", {"base", "motion/skeleton", "render/model"}},
    {"render/mannequin", {"base", "motion/skeleton", "render/avatar", "render/model"}},
    {"render/overlay", {"base", "render/gl"}},
    {"render/panes", {"base", "render/gl", "render/overlay"}},
    {"render",
     {"base", "motion/skeleton", "render/gl", "render/scene", "render/avatar", "render/model"}},

    {"training/hmm", {"base", "models"}},
    {"training/networks", {"base", "models", "audio/features"}},
    {"training/beat", {"base", "models", "audio", "audio/**", "training/networks"}},
    {"training/genre",
     {"base", "models", "audio", "audio/**", "training/beat", "training/hmm", "training/networks"}},
    {"training/figures", {"base", "models", "motion", "motion/**", "training/hmm"}},
    {"training/cells", {"base", "motion", "motion/**", "training/figures"}},
    {"training/discovery",
     {"base", "models", "motion", "motion/**", "training/figures", "training/hmm"}},

    {"engine/decode", {"base", "audio/io"}},
    {"engine/import",
     {"base",
      "base/gltf",
      "motion/skeleton",
      "render/model",
      "render/import",
      "render/export",
      "engine/decode"}},
    {"engine/soundfont", {"base", "audio/music/instruments", "audio/music/score", "engine/decode"}},
    {"engine/unpack", {"base", "render/model", "render/import", "engine/decode"}},
    {"engine/films", {"base", "audio/io"}},
    {"engine/setup", {"base", "audio", "audio/**", "motion", "motion/**"}},
    {"engine/live",
     {"base", "base/channels", "audio", "audio/**", "motion", "motion/**", "engine/setup"}},
    {"engine/offline", {"base", "audio", "audio/**", "motion", "motion/**", "engine/setup"}},
    {"engine/control", {"base", "audio", "audio/beat", "motion", "engine/live", "engine/setup"}},
    {"engine/midi", {"base", "base/channels", "audio/io", "engine/control", "engine/setup"}},
    {"engine/outputs",
     {"base", "motion/skeleton", "render/avatar", "engine/live", "engine/midi", "engine/show"}},
    {"engine/players",
     {"base",
      "audio/io",
      "audio/resample",
      "audio/song",
      "audio/sync",
      "engine/live",
      "engine/offline",
      "engine/setup"}},
    {"engine/remote", {"base", "engine/control"}},
    {"engine/show",
     {"base", "motion", "motion/**", "render", "render/**", "engine/setup", "engine/control"}},
    {"engine/trials",
     {"base",
      "audio",
      "audio/**",
      "motion",
      "motion/**",
      "render/avatar",
      "engine/setup",
      "engine/live",
      "engine/offline"}},

    {"apps/terminal", {"base"}},
    {"apps/clips",
     {"base",
      "motion/skeleton",
      "motion/skeleton/body",
      "motion/skeleton/formats",
      "render/import",
      "apps/terminal"}},
    {"apps/dances",
     {"base",
      "motion",
      "motion/**",
      "engine/setup",
      "engine/offline",
      "training/figures",
      "training/hmm"}},
    {"apps/reports",
     {"base",
      "audio",
      "audio/**",
      "motion",
      "motion/**",
      "render/video",
      "engine/**",
      "training/**",
      "apps/terminal"}},
    {"apps/grid",
     {"base",
      "motion/figures",
      "motion/skeleton",
      "motion/skeleton/body",
      "motion/skeleton/formats",
      "render",
      "render/**",
      "engine/**",
      "training/cells",
      "training/figures",
      "apps/dances"}},
    {"apps/xbody", {"base", "motion/skeleton", "render", "render/**", "engine/**"}},
    {"apps/raks",
     {"base",
      "models",
      "audio",
      "audio/**",
      "motion",
      "motion/**",
      "render",
      "render/**",
      "engine/**",
      "training/hmm",
      "apps/clips",
      "apps/dances",
      "apps/grid",
      "apps/terminal",
      "apps/xbody",
      "apps/reports"}},
    {"apps/raks_capture",
     {"base",
      "audio/io",
      "audio/music/damage",
      "audio/sync",
      "motion/skeleton",
      "motion/skeleton/body",
      "motion/skeleton/formats",
      "motion/capture/**",
      "motion/choreography",
      "motion/evaluate",
      "render",
      "render/**",
      "engine/**",
      "training/discovery",
      "training/figures",
      "apps/clips",
      "apps/dances",
      "apps/terminal",
      "apps/reports"}},
    {"apps/raks_train",
     {"base",
      "models",
      "audio",
      "audio/**",
      "motion",
      "motion/**",
      "engine/setup",
      "engine/offline",
      "training/**",
      "apps/clips",
      "apps/dances",
      "apps/grid",
      "apps/terminal",
      "apps/reports"}},
};

/// Rooms of DESIGN that never see one another, whatever a line above says.
const std::vector<std::pair<std::string, std::string>> kStrangers = {
    {"audio", "motion"},
    {"motion", "audio"},
    {"render", "audio"},
    {"audio", "render"},
    {"motion", "render"},
    {"engine", "training"},
    {"training", "engine"},
    {"training", "render"},
    {"audio/io", "audio/music"},
    {"audio/beat", "audio/music"},
    {"audio/genre", "audio/music"},
    {"render/avatar", "render/mannequin"},
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

/// "audio/**" stands for all rooms inside audio.
bool names(const std::string& pattern, const std::string& room) {
    const auto stars = pattern.find("/**");
    return stars == std::string::npos
               ? pattern == room
               : room.size() > stars && is_inside(room, pattern.substr(0, stars));
}

bool is_allowed(const std::string& from, const std::string& to) {
    const std::string room = room_of(from);
    const std::string other = room_of(to);
    for (const auto& [here, there] : kStrangers) {
        if (is_inside(room, here) && is_inside(other, there)) {
            return false;
        }
    }
    const std::set<std::string>& allowed = kAllowed.at(room);
    return room == other || std::any_of(allowed.begin(), allowed.end(), [&](const auto& pattern) {
               return names(pattern, other);
           });
}

/// file -> files of ours that it includes, both relative to the root.
std::map<std::string, std::vector<std::string>> include_lines() {
    constexpr const char* kRooms[] = {
        "base", "models", "audio", "motion", "render", "training", "engine", "apps"};
    const std::regex pattern("^\\s*#\\s*include\\s+\"([^\"]+)\"");
    std::map<std::string, std::vector<std::string>> lines;
    for (const char* room : kRooms) {
        for (const auto& entry : fs::recursive_directory_iterator(kSourceTree / room)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".hpp" && extension != ".cpp") {
                continue;
            }
            const std::string file = fs::relative(entry.path(), kSourceTree).generic_string();
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

TEST(IncludeLines, every_file_belongs_to_a_room) {
    for (const auto& [file, includes] : include_lines()) {
        EXPECT_NE(room_of(file), "") << file << ": name its folder in the table above";
    }
}

TEST(IncludeLines, go_only_where_the_design_allows) {
    for (const auto& [file, includes] : include_lines()) {
        for (const std::string& include : includes) {
            ASSERT_TRUE(fs::exists(kSourceTree / include))
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
    EXPECT_TRUE(is_allowed("render/gl/x.cpp", "base/y.hpp"));
    EXPECT_TRUE(is_allowed("render/x.cpp", "motion/skeleton/pose.hpp"));
    EXPECT_TRUE(is_allowed("training/genre/x.cpp", "audio/music/score/y.hpp"));
    EXPECT_TRUE(is_allowed("apps/reports/x.cpp", "training/figures/y.hpp"));
    EXPECT_FALSE(is_allowed("render/gl/x.cpp", "motion/dance/y.hpp"));
    EXPECT_FALSE(is_allowed("audio/beat/x.cpp", "motion/skeleton/pose.hpp"));
    EXPECT_FALSE(is_allowed("audio/beat/x.cpp", "audio/music/score/y.hpp"));
    EXPECT_FALSE(is_allowed("audio/music_analyzer.cpp", "audio/music/score/y.hpp"));
    EXPECT_FALSE(is_allowed("motion/dance/x.cpp", "audio/beat/y.hpp"));
    EXPECT_FALSE(is_allowed("motion/dance/x.cpp", "training/figures/y.hpp"));
    EXPECT_FALSE(is_allowed("motion/dance/baking/x.cpp", "motion/dance/y.hpp"));
    EXPECT_FALSE(is_allowed("motion/skeleton/x.cpp", "models/hmm.hpp"));
    EXPECT_FALSE(is_allowed("base/x.cpp", "models/hmm.hpp"));
    EXPECT_FALSE(is_allowed("engine/trials/x.cpp", "training/figures/y.hpp"));
    EXPECT_FALSE(is_allowed("training/beat/x.cpp", "engine/setup/y.hpp"));
    EXPECT_FALSE(is_allowed("engine/live/x.cpp", "apps/terminal/say.hpp"));
    EXPECT_FALSE(is_allowed("engine/live/x.cpp", "engine/control/y.hpp"));
    EXPECT_FALSE(is_allowed("engine/control/x.cpp", "engine/show/y.hpp"));
    EXPECT_FALSE(is_allowed("engine/control/x.cpp", "render/gl/window.hpp"));
    EXPECT_FALSE(is_allowed("render/overlay/x.cpp", "engine/control/y.hpp"));
    EXPECT_FALSE(is_allowed("render/avatar/x.cpp", "render/mannequin/y.hpp"));
}

}  // namespace
