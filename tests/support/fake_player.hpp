#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::test {

/// A session bus of our own. Changes this process's environment for good.
class SessionBus {
 public:
    SessionBus();
    /// Empty when it answers; else why not.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
    /// Ends it at once.
    void kill();
    /// Starts it again at the same address.
    void start();

 private:
    TemporaryFolder folder_;
    std::string problem_;
    std::unique_ptr<ChildProcess> process_;
};

/// A song as a player tells it: of `xesam:` and `mpris:` names; a number stands in `bpm`.
struct FakeSong {
    std::string track = "/org/mpris/track/1";  ///< mpris:trackid
    std::string title;
    std::string artist = "somebody";
    std::string genre = {};
    int bpm = 0;                        ///< 0: it does not say
    std::string url = {};               ///< empty: it does not say
    std::int64_t length = 200'000'000;  ///< microseconds
};

/// A player of music on the session bus, by sd-bus, on a thread of its own; it plays nothing that
/// can be heard. Everything that it says is on its way when a method returns.
class FakePlayer {
 public:
    /// When it answers what it is asked.
    enum class Answers { at_once, never };
    /// "org.mpris.MediaPlayer2.NAME"
    explicit FakePlayer(const std::string& name, Answers answers = Answers::at_once);
    ~FakePlayer();  ///< it leaves the bus
    FakePlayer(const FakePlayer&) = delete;
    FakePlayer& operator=(const FakePlayer&) = delete;

    /// Says and keeps "Playing", "Paused" or "Stopped".
    void set_status(const std::string& status);
    /// Says and keeps a song.
    void set_song(const FakeSong& song);
    /// Both in one message.
    void play(const FakeSong& song);
    /// Says that it has gone elsewhere in its song.
    void seek();
    /// Says its status so many times at once.
    void flood(int messages);
    /// Answers all that it was asked, and from now on.
    void answer();

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace raks::test
