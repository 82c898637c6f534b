#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// One file to learn from or to be judged by.
struct MusicFile {
    std::filesystem::path path;
    std::string name;       ///< as listed
    std::string genre;      ///< name of a dance; empty: none of them
    std::string group;      ///< artist, or the file itself: never parted between folds
    std::string label;      ///< confidence of the genre's label ("A", "B", "C"), or empty
    bool may_train = true;  ///< the licence allows a shipped model to learn from it
    std::string credit;     ///< "artist, title (licence)", or empty
};

/// The dance whose music a folder or label names: by its name or one of its labels; "" for
/// "other": none of the dances. Nothing: no such dance.
[[nodiscard]] std::optional<std::string> genre_from_label(std::string_view label,
                                                          const DanceList& dances);

/// A folder that holds one folder of music a genre; hidden files are left out; each file is its own
/// group. Ascending by path.
/// Errors: no such folder, a sub-folder that names no genre (with the nearest), no music.
[[nodiscard]] Expected<std::vector<MusicFile>> list_music(const std::filesystem::path& folder,
                                                          const DanceList& dances);

/// Files named by a table with a head line: columns clip (path below the folder) and genre; if
/// there, artist, title, licence, label and train_ok.
/// Errors: as a table and as list_music, with the line.
[[nodiscard]] Expected<std::vector<MusicFile>> list_music(const std::filesystem::path& folder,
                                                          const std::filesystem::path& index,
                                                          const DanceList& dances);

/// Errors: two files under different genres that are the same, byte by byte (names both).
[[nodiscard]] Expected<void> check_distinct(std::span<const MusicFile> files);

}  // namespace raks::audio
