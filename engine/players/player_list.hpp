#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audio/io/audio_tags.hpp"
#include "base/time.hpp"

/// What other programs on this desktop play: MPRIS, https://specifications.freedesktop.org/mpris/.
namespace raks::engine {

/// MPRIS' PlaybackStatus.
enum class PlayStatus : std::uint8_t { stopped, paused, playing };

/// What a player says of a song.
struct PlayerSong {
    std::uint64_t key =
        0;               ///< hash of what the player calls it and where it lies; 0: it does not say
    std::string file{};  ///< path, where it says that it plays a local file; nobody has looked
    audio::AudioTags tags{};  ///< cleaned and cut, as those of a file

    friend bool operator==(const PlayerSong&, const PlayerSong&) = default;
};

/// What one message of a player says.
struct PlayerNews {
    std::optional<PlayStatus> status{};  ///< none: it does not say
    std::optional<PlayerSong> song{};    ///< likewise
};

/// What is followed.
struct NowPlaying {
    std::string player{};                     ///< "mpv"; empty: none
    PlayStatus status = PlayStatus::stopped;  ///< of it
    audio::AudioTags tags{};                  ///< of its song
    std::string file{};                       ///< likewise

    friend bool operator==(const NowPlaying&, const NowPlaying&) = default;
};

/// What has happened to what is followed.
struct PlayerEvent {
    /// Which it is.
    enum class Kind : std::uint8_t {
        begins,  ///< another song begins
        told,    ///< more is known of the song that plays, which may have begun long ago
        jump,    ///< the song goes on elsewhere, or behind a pause
        stop,    ///< it was paused or stopped, or the player has left
    };
    Kind kind = Kind::told;  ///< see Kind
    NowPlaying now{};        ///< as it is then
};

/// The player that is followed, among all: the one that plays, and of several the one that has
/// begun last. While none plays it stays the one that played last.
///
/// Players tell one change in several messages and out of order: what comes within a second of a
/// song's beginning belongs to that. It believes nothing about lengths, positions or files.
/// Pure; bounded. Threads: one. Real-time: no.
class PlayerList {
 public:
    /// Players that are known at once; more are passed over.
    static constexpr std::size_t kMostPlayers = 64;
    /// Events that wait to be taken; then the oldest are lost.
    static constexpr std::size_t kMostEvents = 64;
    /// Whether a player was there before anybody looked.
    enum class Arrival { was_there, came };

    /// A player by the name that it has on the bus, "org.mpris.MediaPlayer2.mpv"; one that is known
    /// begins anew. False: there are too many, or it is one that only speaks for others.
    bool arrive(std::string_view name, Arrival how, HostTime now);
    /// It has left.
    void leave(std::string_view name);
    /// It says something.
    void take(std::string_view name, const PlayerNews& news, HostTime now);
    /// It has gone to another place in its song.
    void jump(std::string_view name, HostTime now);

    /// What is followed.
    [[nodiscard]] const NowPlaying& now() const noexcept { return now_; }
    /// What has happened since the last call, in order.
    [[nodiscard]] std::vector<PlayerEvent> take_events();

 private:
    struct Player {
        HostTime arrived{};
        bool is_new = false;  // it came while others looked, and has said nothing yet
        bool has_spoken = false;
        PlayStatus status = PlayStatus::stopped;
        std::uint64_t started = 0;  // the greater, the later it began to play
        PlayerSong song{};
    };

    void follow(const std::string& name, const Player& player, bool is_witnessed, HostTime now);
    void go_on(const Player& before, const Player& player, HostTime now);
    void choose(HostTime now, bool is_witnessed);
    void happen(PlayerEvent::Kind kind);
    [[nodiscard]] bool is_beginning(HostTime now) const noexcept;

    std::map<std::string, Player, std::less<>> players_;
    std::string followed_;  // key of players_, or empty
    PlayerSong heard_;      // that it played last
    std::uint64_t starts_ = 0;
    std::optional<HostTime> began_;  // the song that is followed, where that was seen
    NowPlaying now_;
    std::vector<PlayerEvent> events_;
};

/// "mpv" of "org.mpris.MediaPlayer2.mpv.instance42"; fit for one line.
[[nodiscard]] std::string player_name(std::string_view bus_name);

}  // namespace raks::engine
