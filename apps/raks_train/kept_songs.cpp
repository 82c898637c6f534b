#include "apps/raks_train/kept_songs.hpp"

#include <string>

#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/printable.hpp"
#include "engine/setup/dance_corrections.hpp"

#include <fmt/format.h>

namespace raks::apps {

Expected<KeptSongs> kept_songs(const DanceList& dances) {
    const auto corrections = engine::DanceCorrections::load();
    if (!corrections) {
        return fail(corrections.error());
    }
    if (corrections->all().empty()) {
        return fail("no dance of a song was kept yet: play it, choose its dance (D) and press U");
    }
    KeptSongs songs;
    for (const engine::DanceCorrection& row : corrections->all()) {
        const std::string name = row.song.string();
        const bool is_known = dances.id_of(row.dance) != DanceId::none;
        if (!is_known || !is_there(row.song)) {
            ++songs.skipped;
            say(fmt::format(
                "skipped {}: {}",
                printable(name),
                is_known ? "is not there any more" : "dance \"" + row.dance + "\" is unknown"));
            continue;
        }
        const std::string& group = row.artist.empty() ? name : row.artist;
        songs.files.push_back({row.song, name, row.dance, group, "", true, ""});
    }
    if (songs.files.empty()) {
        return fail(fmt::format("none of the {} songs that were kept can be learnt from",
                                corrections->all().size()));
    }
    return songs;
}

}  // namespace raks::apps
