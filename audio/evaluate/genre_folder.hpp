#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// One file to learn from or to be judged by.
struct MusicFile {
    std::filesystem::path path;
    std::string name;              ///< as listed
    Genre genre = Genre::unknown;  ///< unknown: none of the dances
    std::string group;             ///< artist, or the file itself: never parted between folds
    std::string label;             ///< confidence of the genre's label ("A", "B", "C"), or empty
    bool may_train = true;         ///< the licence allows a shipped model to learn from it
    std::string credit;            ///< "artist, title (licence)", or empty
};

/// The genre that a folder or label names: one of kGenreNames, "latin", "mideast", "electronic", or
/// "other" for none of the dances.
[[nodiscard]] std::optional<Genre> genre_from_label(std::string_view label) noexcept;

/// A folder that holds one folder of music a genre; hidden files are left out; each file is its own
/// group. Ascending by path.
/// Errors: no such folder, a sub-folder that names no genre (with the nearest), no music.
[[nodiscard]] Expected<std::vector<MusicFile>> list_music(const std::filesystem::path& folder);

/// Files named by a table with a head line: columns clip (path below the folder) and genre; if
/// there, artist, title, licence, label and train_ok.
/// Errors: as a table and as list_music, with the line.
[[nodiscard]] Expected<std::vector<MusicFile>> list_music(const std::filesystem::path& folder,
                                                          const std::filesystem::path& index);

/// Errors: two files under different genres that are the same, byte by byte (names both).
[[nodiscard]] Expected<void> check_distinct(std::span<const MusicFile> files);

}  // namespace raks::audio
