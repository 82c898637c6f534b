#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
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

    /// "osc 127.0.0.1:9000"
    [[nodiscard]] std::string text() const;
    friend bool operator==(const OutputWish&, const OutputWish&) = default;
};
/// Inverse of OutputWish::text(). Errors: there is no such option; its target cannot be read.
[[nodiscard]] Expected<OutputWish> parse_output_wish(const std::string& text);

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

    /// From now on this music is told of, in place of any before; what was heard more than a second
    /// ago is passed over. The feed may lose its writers at any time. `dances`: whose ids it has.
    void follow(std::shared_ptr<MusicFeed> feed, std::shared_ptr<const DanceList> dances);
    /// What the dancers look like from now on; nobody is told of poses before the first call. It
    /// costs nothing where they do already.
    void wear(const OutputLook& look);
    /// Whether a target is told of poses, so that wear() says something.
    [[nodiscard]] bool want_poses() const noexcept;
    /// What plays is called so: told where it is another name than before.
    void name_song(const SongName& song);
    /// Lines for the person about outputs that failed since the last call.
    [[nodiscard]] std::vector<std::string> take_lines();
    /// What was lost so far, in words, one line an output that lost anything.
    [[nodiscard]] std::vector<std::string> losses() const;
    /// How each stands, in the order of the wishes.
    [[nodiscard]] std::vector<OutputStatus> status() const;

 private:
    // Hops that targets have not heard yet: the longest lead behind the sound, and what is danced
    // ahead of it.
    static constexpr std::size_t kKeptHops = 256;

    struct Open {
        const OutputKind* kind;
        std::string target;
        std::unique_ptr<Output> output;
        std::string trouble = {};  // the last one; of mutex_
        BeatSchedule schedule = {};
        std::uint64_t scheduled = 0;  // hops that the schedule has taken
        std::uint64_t heard = 0;      // hops that the output was told
        SongName named = {};          // what it was told of the song
    };
    explicit Outputs(std::vector<Open> outputs);
    void run() noexcept;
    void turn(HostTime now);
    void take_feed(HostTime now);
    void take_look();
    void serve(Open& open, HostTime now);
    void tell_name(Open& open);
    void tell_music(Open& open, StreamTime heard);
    [[nodiscard]] const FeedHop* hop_at(std::uint64_t& number) const;
    [[nodiscard]] std::optional<HostTime> told_at(const Open& open,
                                                  std::optional<StreamTime> time) const;
    [[nodiscard]] HostTime next_turn(HostTime now) const;

    std::vector<Open> outputs_;
    std::optional<OutputLook> worn_;  // main's: as wear() was told last
    mutable std::mutex mutex_;        // of the five below, and of Open::trouble
    std::optional<OutputLook> next_look_;
    std::shared_ptr<MusicFeed> next_feed_;
    std::shared_ptr<const DanceList> next_dances_;
    std::vector<std::string> lines_;
    SongName song_;
    std::atomic<bool> is_stopping_{false};
    // Of the thread.
    std::shared_ptr<MusicFeed> feed_;
    std::shared_ptr<const DanceList> dances_;
    std::optional<OutputLook> look_;
    std::optional<HeardLine> line_;      // of feed_, as of this turn
    const StageState* stage_ = nullptr;  // likewise
    std::vector<FeedHop> hops_;          // ring
    std::uint64_t taken_ = 0;            // hops of feed_
    std::thread thread_;
};

}  // namespace raks::engine
