#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// What the files of playlists say, as text: nothing here looks at a disk. Threads: any.
/// Real-time: no.
namespace raks::engine {

/// Forms of playlists. `m3u` is also .m3u8: how the text is encoded is found out from the text.
enum class ListForm { m3u, pls, xspf };

/// The form that a file's ending names (in any case); nothing for other files.
[[nodiscard]] std::optional<ListForm> list_form_of(const std::filesystem::path& path);

/// One entry of a playlist: the names under which its file may lie, the likeliest first. There is
/// more than one where the encoding is not sure, or where a track names several places.
using ListEntry = std::vector<std::string>;

/// Entries of a playlist, in its order.
struct ListEntries {
    std::vector<ListEntry> entries;  ///< none is empty, and no name in it is
    bool is_cut = false;             ///< it has more than kMostListEntries: the rest is left out
};
/// Longest playlist that is read to its end.
inline constexpr std::size_t kMostListEntries = 1'000'000;

/// Reads a playlist. The text may be UTF-8 (with or without a byte-order mark), UTF-16 with one, or
/// bytes of an older encoding, which are tried as they are and as Windows-1252. Comments and empty
/// lines are no entries.
/// Errors, without the file's name: it is not of this form, with the line where it shows; it is
/// damaged; it is a list of pieces of a stream (HLS).
[[nodiscard]] Expected<ListEntries> parse_list(std::string_view text, ListForm form);

/// The scheme of a network address: "https" of "https://x/y.mp3". Empty for a file's name, a
/// `file:` address and a drive letter.
[[nodiscard]] std::string_view scheme_of(std::string_view name);

/// The file's name that a `file:` address stands for ("file:///a%20b" is "/a b"); any other name is
/// returned as it is.
[[nodiscard]] std::string file_of_address(std::string_view name);

/// Text with %XX replaced by the bytes that they stand for; a % without two digits stays.
[[nodiscard]] std::string percent_decoded(std::string_view text);

}  // namespace raks::engine
