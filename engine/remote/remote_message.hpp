#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.hpp"
#include "base/json.hpp"
#include "base/time.hpp"
#include "engine/control/action_table.hpp"

/// What a page and Raks say to one another: docs/using/remote.md has the protocol.
namespace raks::engine {

/// Raised where a page that knows the one before would misread this one.
inline constexpr int kRemoteProtocol = 1;

/// Milliseconds of this machine's clock, as all times of the protocol are.
[[nodiscard]] double remote_time(HostTime moment) noexcept;

/// A question for the time, answered at once.
struct RemoteClock {
    double sent = 0.0;  ///< given back as it came
};
/// What a page sends.
using RemoteMessage = std::variant<RemoteClock, ActionRequest>;

/// Reads one message of a page that came at `now`. The moment `at` of a request counts where it
/// lies in the last second; else the request came now. Errors: no JSON object, neither "do" nor
/// "clock"; those of remote_request. Threads: any. Real-time: no.
[[nodiscard]] Expected<RemoteMessage> read_remote_message(std::string_view text, HostTime now);

/// The answer to a question for the time.
[[nodiscard]] std::string remote_clock_answer(const RemoteClock& asked, HostTime now);
/// The answer to a request that was refused, and to one that was carried out (no fault).
[[nodiscard]] std::string remote_answer(std::string_view action, std::string_view fault);

/// A beat that is to come.
struct RemoteBeat {
    HostTime heard_at{};  ///< when it is heard
    int count = 0;        ///< 1 to beats per bar; 0: the bar is not known
};
/// How one who is told of the music stands.
struct RemoteTarget {
    std::string name{};         ///< "--osc studio:9000"
    std::uint64_t sent = 0;     ///< messages
    std::uint64_t dropped = 0;  ///< messages that were lost
    std::string trouble{};      ///< empty: none
};
/// What a player says that it plays.
struct RemoteSong {
    std::string player{};     ///< "mpv"; empty: none is known
    std::string title{};      ///< of the song
    std::string artist{};     ///< likewise
    bool is_playing = false;  ///< false: it stands
};
/// What is heard, danced and seen.
struct RemoteState {
    HostTime now{};                       ///< when it was so
    std::string source{};                 ///< file, or device
    RemoteSong song{};                    ///< what a player says
    double bpm = 0.0;                     ///< of the music
    float confidence = 0.0F;              ///< of the beat, [0, 1]
    bool is_locked = false;               ///< beats are told
    bool is_held = false;                 ///< the tempo, by a person
    bool is_silent = true;                ///< nothing sounds
    int count = 0;                        ///< that is heard; 0: not known
    int beats_per_bar = 4;                ///< counts of a bar
    float level_dbfs = -120.0F;           ///< rms
    std::string genre{};                  ///< the dance that is heard; empty: none
    std::string dance{};                  ///< that is danced; empty: none
    std::string figure{};                 ///< likewise
    bool keeps_figure = false;            ///< it is repeated
    bool is_paused = false;               ///< the file stands
    std::string formation{};              ///< of the dancers; empty: nobody dances
    std::string camera{};                 ///< empty: no window
    std::string theme{};                  ///< empty: no window
    std::string avatar{};                 ///< empty: no window
    std::vector<RemoteBeat> beats{};      ///< the next ones, where it is locked
    std::vector<RemoteTarget> targets{};  ///< who else is told
};
/// What can be chosen by name.
struct RemoteChoices {
    std::vector<std::string> dances{};      ///< names for "dance"
    std::vector<std::string> formations{};  ///< names for "formation"
    std::vector<std::string> cameras{};     ///< names for "camera"
    std::vector<std::string> themes{};      ///< names for "theme"
    std::vector<std::string> avatars{};     ///< names for "avatar"
    friend bool operator==(const RemoteChoices&, const RemoteChoices&) = default;
};

/// The state as the protocol has it.
[[nodiscard]] std::string remote_text(const RemoteState& state);
/// The first message: version, the table of actions, and what can be chosen.
[[nodiscard]] std::string remote_text(const RemoteChoices& choices);

}  // namespace raks::engine
