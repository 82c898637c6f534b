// What players of music may say on the session bus.
#include <string_view>

#include "base/printable.hpp"
#include "engine/players/player_message.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/support/bus_peer.hpp"

namespace raks::fuzz {

bool read_player_message(std::string_view bytes) {
    bool is_good = false;
    test::with_player_message(bytes, [&](sd_bus_message* message) {
        const auto news = engine::read_player_properties(message);
        if (!news) {
            must(!news.error().message.empty());
            return;
        }
        static_cast<void>(engine::names_player_property(message));
        is_good = news->status.has_value() || news->song.has_value();
        if (news->song) {
            const audio::AudioTags& tags = news->song->tags;
            for (const std::string* text : {&tags.title, &tags.artist, &tags.album, &tags.genre}) {
                must(text->size() <= 200 && *text == printable(*text));
            }
            must(!tags.bpm || (*tags.bpm >= 20.0 && *tags.bpm <= 400.0));
        }
        engine::PlayerList list;
        must(list.arrive("org.mpris.MediaPlayer2.x", engine::PlayerList::Arrival::came, {}));
        list.take("org.mpris.MediaPlayer2.x", *news, {});
    });
    return is_good;
}

}  // namespace raks::fuzz
