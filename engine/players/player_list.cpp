#include "engine/players/player_list.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/printable.hpp"

namespace raks::engine {
namespace {

constexpr std::string_view kPrefix = "org.mpris.MediaPlayer2.";
// It says again what another player says.
constexpr std::string_view kSpokesman = "playerctld";
constexpr std::size_t kLongestName = 40;  // bytes
// What belongs to the beginning of a song comes so soon.
constexpr Nanos kBeginning = std::chrono::seconds(1);
// A player that came so short ago and plays has begun now.
constexpr Nanos kFirstAnswer = std::chrono::seconds(3);

bool is_same_music(const audio::AudioTags& a, const audio::AudioTags& b) {
    return !a.title.empty() && a.title == b.title && a.artist == b.artist;
}

bool says_nothing(const PlayerSong& song) { return song == PlayerSong{}; }

// Radio stations change titles and nothing else.
bool is_other_song(const PlayerSong& before, const PlayerSong& song) {
    if (says_nothing(before)) {
        return false;
    }
    const bool has_other_title = !before.tags.title.empty() && !song.tags.title.empty() &&
                                 before.tags.title != song.tags.title;
    return before.key != song.key || has_other_title;
}

}  // namespace

std::string player_name(std::string_view bus_name) {
    if (bus_name.starts_with(kPrefix)) {
        bus_name.remove_prefix(kPrefix.size());
    }
    return printable(bus_name.substr(0, bus_name.find('.')), kLongestName);
}

bool PlayerList::arrive(std::string_view name, Arrival how, HostTime now) {
    leave(name);
    if (players_.size() >= kMostPlayers || player_name(name) == kSpokesman) {
        return false;
    }
    Player& player = players_[std::string(name)];
    player.arrived = now;
    player.is_new = how == Arrival::came;
    return true;
}

void PlayerList::leave(std::string_view name) {
    const auto left = players_.find(name);
    if (left == players_.end()) {
        return;
    }
    players_.erase(left);
    if (followed_ == name) {
        followed_.clear();
        const bool was_playing = now_.status == PlayStatus::playing;
        now_ = {};
        choose({}, true);
        if (followed_.empty() && was_playing) {
            happen(PlayerEvent::Kind::stop);
        }
    }
}

void PlayerList::take(std::string_view name, const PlayerNews& news, HostTime now) {
    const auto found = players_.find(name);
    if (found == players_.end()) {
        return;
    }
    Player& player = found->second;
    const Player before = player;
    // The first answer says what may have been so for long.
    const bool is_witnessed =
        player.has_spoken || (player.is_new && now - player.arrived < kFirstAnswer);
    player.has_spoken = true;
    // Between two songs some say nothing of either.
    if (news.song && !says_nothing(*news.song)) {
        player.song = *news.song;
    }
    player.status = news.status.value_or(player.status);
    if (player.status == PlayStatus::playing && before.status != PlayStatus::playing) {
        player.started = ++starts_;
    }
    if (followed_ == name) {
        go_on(before, player, now);
    }
    choose(now, is_witnessed);
}

void PlayerList::jump(std::string_view name, HostTime now) {
    if (followed_ == name && now_.status == PlayStatus::playing && !is_beginning(now)) {
        happen(PlayerEvent::Kind::jump);
    }
}

// Another player is followed from now on. Two that say the same are one that speaks twice.
void PlayerList::follow(const std::string& name,
                        const Player& player,
                        bool is_witnessed,
                        HostTime now) {
    const bool is_same =
        now_.status == PlayStatus::playing && is_same_music(now_.tags, player.song.tags);
    followed_ = name;
    heard_ = player.song;
    now_ = {player_name(name), player.status, player.song.tags, player.song.file};
    if (is_witnessed && !is_same) {
        began_ = now;
        happen(PlayerEvent::Kind::begins);
    } else {
        happen(PlayerEvent::Kind::told);
    }
}

// What the player that is followed says more.
void PlayerList::go_on(const Player& before, const Player& player, HostTime now) {
    now_.status = player.status;
    now_.tags = player.song.tags;
    now_.file = player.song.file;
    const bool plays = player.status == PlayStatus::playing;
    const bool played = before.status == PlayStatus::playing;
    const bool is_other = plays && is_other_song(heard_, player.song);
    heard_ = plays ? player.song : heard_;
    if (is_other && !is_beginning(now)) {
        began_ = now;
        happen(PlayerEvent::Kind::begins);
    } else if (plays && !played) {
        happen(PlayerEvent::Kind::jump);
    } else if (!plays && played) {
        happen(PlayerEvent::Kind::stop);
    } else if (before.song != player.song) {
        happen(PlayerEvent::Kind::told);
    }
}

void PlayerList::choose(HostTime now, bool is_witnessed) {
    const auto latest =
        std::max_element(players_.begin(), players_.end(), [](const auto& a, const auto& b) {
            const auto rank = [](const Player& player) {
                return player.status == PlayStatus::playing ? player.started : 0;
            };
            return rank(a.second) < rank(b.second);
        });
    if (latest != players_.end() && latest->second.status == PlayStatus::playing &&
        latest->first != followed_) {
        // One that goes on where another has stopped is other music, too.
        follow(latest->first, latest->second, is_witnessed || !followed_.empty(), now);
    }
}

bool PlayerList::is_beginning(HostTime now) const noexcept {
    return began_ && now - *began_ < kBeginning;
}

void PlayerList::happen(PlayerEvent::Kind kind) {
    if (events_.size() == kMostEvents) {
        events_.erase(events_.begin());
    }
    events_.push_back({kind, now_});
}

std::vector<PlayerEvent> PlayerList::take_events() { return std::exchange(events_, {}); }

}  // namespace raks::engine
