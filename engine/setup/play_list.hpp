#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::engine {

/// What was left out of a set of files, one line each: which file, and why. Of many only the first
/// are kept as lines, all are counted. Threads: one.
class SkippedFiles {
 public:
    /// Lines that are kept.
    static constexpr std::size_t kMostLines = 20;

    /// `line`: "NAME: why".
    void add(std::string line);
    /// All that was added.
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// The first lines, in the order in which they were added.
    [[nodiscard]] const std::vector<std::string>& lines() const noexcept { return lines_; }
    /// For people: how many were skipped, then the lines, then how many more there are. Empty when
    /// nothing was skipped.
    [[nodiscard]] std::vector<std::string> report() const;

 private:
    std::vector<std::string> lines_;
    std::size_t count_ = 0;
};

/// Files to play, in order.
struct PlayList {
    std::vector<std::filesystem::path> files;  ///< at most kMostFiles
    SkippedFiles skipped;                      ///< what was found and is not among them
};
/// Longest set of files.
inline constexpr std::size_t kMostFiles = 1'000'000;

/// The files that a person means by these names:
///
/// - a folder stands for the music in it and in the folders below: a folder's own files first, then
///   its sub-folders, each in natural order (2 before 10). Hidden files (and so the "._x" of macOS)
///   and files whose ending is none of music or films are left out without a word. A folder is
///   walked once, whatever links lead to it.
/// - a playlist (.m3u, .m3u8, .pls, .xspf) stands for its entries: files, folders, playlists;
///   relative names count from where the list lies. A list is read once, even if it names itself.
/// - any other name stands for itself, is not looked at, and may be "-" (standard input) or a pipe.
///
/// What cannot be played is skipped, and the reason kept: a folder that cannot be listed, a damaged
/// list, an entry that is not there, an address in the network (nothing is loaded from there).
/// Errors: nothing is left to play; the line says why, or the first reason of several.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<PlayList> read_play_list(const std::vector<std::filesystem::path>& names);

/// The endings of music and of films, in small letters: ".mp3".
[[nodiscard]] std::span<const std::string_view> music_endings() noexcept;
/// Whether a file's ending is one of music or of films, in any case.
[[nodiscard]] bool looks_like_music(const std::filesystem::path& path);

/// Natural order: numbers count by their value, letters in any case alike; names that differ in
/// case or leading zeros alone are ordered by their bytes.
[[nodiscard]] bool comes_before(std::string_view a, std::string_view b) noexcept;

/// Whether a name stands for sound that comes through a pipe: "-", or what is a FIFO.
[[nodiscard]] bool is_pipe(const std::filesystem::path& path) noexcept;

}  // namespace raks::engine
