#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"

/// Lists music for genre training and evaluation, from folders or from a table.
/// Threads: any. Real-time: no.
namespace raks::audio {

/// One file of music for training or evaluation.
struct MusicFile {
    std::filesystem::path path;  ///< where it can be opened
    std::string name;            ///< path below the folder, as listed
    std::string genre;           ///< name of a dance; empty: none of them
    std::string group;           ///< its artist or source, or its own name; stays in one fold
    std::string label;           ///< confidence of the genre's label ("A", "B", "C"), or empty
    bool may_train = true;       ///< the licence allows a shipped model to be trained on it
    std::string credit;          ///< "artist, title (licence)", or empty
};

/// Name of the dance that a folder's name or a table's label means: the dance's own name or one of
/// its labels. "" for "other", which is music for none of the dances. Empty optional: no such
/// dance.
[[nodiscard]] std::optional<std::string> genre_from_label(std::string_view label,
                                                          const DanceList& dances);

/// The music of a folder that holds one sub-folder a genre, at any depth below these; hidden files
/// are left out; each file is its own group. Ascending by path.
/// Errors: no such folder; a sub-folder that names no genre (says which names there are); no music.
[[nodiscard]] Expected<std::vector<MusicFile>> list_music(const std::filesystem::path& folder,
                                                          const DanceList& dances);

/// Files named by a tab-separated table with a head line: columns clip (path below the folder) and
/// genre; where they exist, artist, group (else the artist is the group), title, licence, label and
/// train_ok ("yes": may_train).
/// Errors: the table cannot be read; a column is missing; a row has another number of columns or an
/// unknown genre (with the line); no rows.
[[nodiscard]] Expected<std::vector<MusicFile>> list_music(const std::filesystem::path& folder,
                                                          const std::filesystem::path& index,
                                                          const DanceList& dances);

/// Errors: two files under different genres whose bytes are the same (names both). Files that
/// cannot be read are passed over.
[[nodiscard]] Expected<void> check_distinct(std::span<const MusicFile> files);

}  // namespace raks::audio
