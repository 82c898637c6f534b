#pragma once

#include <string>
#include <vector>

#include <filesystem>

namespace raks::engine {

/// What was dropped on the window, by what it is for.
struct StageDrop {
    std::vector<std::filesystem::path>
        music;                        ///< files, folders and playlists to play, in their order
    std::vector<std::string> models;  ///< to be worn in turn
    std::vector<std::filesystem::path> dances;  ///< written dances, and folders with a dances.toml
    std::vector<std::filesystem::path> clips;   ///< to be performed
    std::vector<std::string> lines;             ///< of what is none of these, or is not there, why
};

/// Sorts what was dropped: by names, and by what lies there where the name does not say enough. Of
/// many that are of no use the first are named and the others counted. Threads: any. Real-time: no.
[[nodiscard]] StageDrop sort_drop(const std::vector<std::string>& paths);

}  // namespace raks::engine
