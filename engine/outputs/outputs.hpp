#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/expected.hpp"
#include "engine/live/music_feed.hpp"
#include "engine/outputs/beat_schedule.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {

/// One output that a person asks for.
struct OutputWish {
    const OutputKind* kind = nullptr;  ///< a row of output_kinds()
    std::string target;                ///< as given
};

/// The outputs of `play` and `live`, on a thread of their own that sleeps until the next moment is
/// heard. They outlive a song: each one's feed is followed in turn.
///
/// Threads: main, for all methods.
class Outputs {
 public:
    /// Opens all, and starts the thread; without a wish there is none, and nothing is done later.
    /// Errors: those of the first that cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<Outputs>> open(
        const std::vector<OutputWish>& wishes);
    ~Outputs();                                   ///< joins the thread and closes all
    Outputs(const Outputs&) = delete;             ///< the thread refers to it
    Outputs& operator=(const Outputs&) = delete;  ///< likewise

    /// From now on this music is told of, in place of any before; what waits in it is old and is
    /// passed over. The feed may lose its writers at any time.
    void follow(std::shared_ptr<MusicFeed> feed);
    /// Lines for the person about outputs that failed since the last call.
    [[nodiscard]] std::vector<std::string> take_lines();
    /// What was lost so far, in words, one line an output that lost anything.
    [[nodiscard]] std::vector<std::string> losses() const;

 private:
    struct Open {
        const OutputKind* kind;
        std::unique_ptr<Output> output;
    };
    explicit Outputs(std::vector<Open> outputs);
    void run() noexcept;
    void turn(HostTime now);
    void tell(const Notice& notice, const HeardLine& line);
    [[nodiscard]] HostTime next_turn(HostTime now);

    std::vector<Open> outputs_;
    std::mutex mutex_;  // of the two below
    std::shared_ptr<MusicFeed> next_feed_;
    std::vector<std::string> lines_;
    std::atomic<bool> is_stopping_{false};
    // Of the thread.
    std::shared_ptr<MusicFeed> feed_;
    BeatSchedule schedule_;
    std::thread thread_;
};

}  // namespace raks::engine
