#include "engine/show/stage_drop.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "base/printable.hpp"
#include "engine/setup/dance_folder.hpp"
#include "engine/setup/play_list.hpp"
#include "motion/skeleton/formats/motion_format.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kListEndings = {".m3u", ".m3u8", ".pls", ".xspf"};
constexpr std::size_t kMostLines = 3;

std::string ending_of(const fs::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return ending;
}

bool is_list(const std::string& ending) {
    return std::find(kListEndings.begin(), kListEndings.end(), ending) != kListEndings.end();
}

// Puts one path where it belongs; false: nowhere.
bool sort(const fs::path& path, StageDrop& files) {
    std::error_code ignored;
    const std::string ending = ending_of(path);
    if (fs::is_directory(path, ignored)) {
        const bool has_dances = fs::exists(dances_path(path), ignored);
        (has_dances ? files.dances : files.music).push_back(path);
    } else if (ending == ".toml") {
        files.dances.push_back(path);
        // A model with a clip of its own is worn; a .vrma is a model's container with motion alone.
    } else if (ending != ".vrma" && render::is_model_name(path)) {
        files.models.push_back(path.string());
    } else if (motion::is_clip_name(path)) {
        files.clips.push_back(path);
    } else if (looks_like_music(path) || is_list(ending)) {
        files.music.push_back(path);
    } else {
        return false;
    }
    return true;
}

}  // namespace

StageDrop sort_drop(const std::vector<std::string>& paths) {
    StageDrop files;
    std::size_t useless = 0;
    for (const std::string& name : paths) {
        std::error_code ignored;
        const bool is_there = fs::exists(name, ignored);
        if (is_there && sort(name, files)) {
            continue;
        }
        if (++useless <= kMostLines) {
            files.lines.push_back(printable(name) +
                                  (is_there
                                       ? ": is no music, model, dance or motion that Raks reads"
                                       : ": is not there"));
        }
    }
    if (useless > kMostLines) {
        files.lines.push_back(fmt::format("and {} more of no use", useless - kMostLines));
    }
    return files;
}

}  // namespace raks::engine
