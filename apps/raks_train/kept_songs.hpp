#pragma once

#include <cstddef>
#include <vector>

#include "audio/evaluate/genre_folder.hpp"
#include "base/dance_list.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// The songs whose dance a person kept (engine/setup/dance_corrections.hpp), to learn from.
struct KeptSongs {
    std::vector<audio::MusicFile> files;  ///< group: the artist, or the song where none is named
    std::size_t skipped = 0;              ///< that are gone, or of dances that there are not
};
/// Reads the person's file. A song that is skipped is named on stderr. Errors: those of reading; no
/// song can be learnt from.
[[nodiscard]] Expected<KeptSongs> kept_songs(const DanceList& dances);

}  // namespace raks::apps
