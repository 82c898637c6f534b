#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/live/music_feed.hpp"
#include "engine/live/stage_state.hpp"
#include "engine/outputs/beat_schedule.hpp"
#include "engine/outputs/output_target.hpp"
#include "engine/show/dancer_face.hpp"

namespace raks::render {
struct Avatar;
}

namespace raks::engine {

/// Something that others are told, and when.
struct OutputMoment {
    Notice notice;        ///< what
    HostTime heard_at{};  ///< when it is heard
};

/// What is heard at a hop.
struct OutputHop {
    const MusicState& music;   ///< what is known at it
    const FeedFigure& figure;  ///< what is danced to it
    const DanceList& dances;   ///< whose ids both have
};

/// What the dancers look like, for targets that are told of poses.
struct OutputLook {
    /// Worn in turn: dancer k wears avatar k modulo their number; none: the mannequin.
    std::vector<std::shared_ptr<const render::Avatar>> avatars;
    FaceHabits face;  ///< how faces behave

    friend bool operator==(const OutputLook&, const OutputLook&) = default;
};

/// Who dances, for the same.
struct OutputDancers {
    const StageState& stage;  ///< the newest
    const OutputLook& look;   ///< as it is worn now
};

/// What somebody plays, in one line each; both empty: nothing that is known.
struct SongName {
    std::string title;
    std::string artist;
    friend bool operator==(const SongName&, const SongName&) = default;
};

/// A look of the outputs' thread at one target.
struct OutputTurn {
    HostTime now{};                      ///< as CLOCK_MONOTONIC has it
    std::optional<HeardLine> line = {};  ///< nothing: no music is followed
    /// When the target is told the next beat, as far as is known.
    std::optional<HostTime> next_beat = {};
    /// Of a target that wants poses; nothing: nobody has danced yet.
    std::optional<OutputDancers> dancers = {};
};

/// How a target stands.
struct OutputStatus {
    std::string name;           ///< "--osc 127.0.0.1:9000"
    std::uint64_t sent = 0;     ///< messages
    std::uint64_t dropped = 0;  ///< messages, as the other side was slow or not there
    std::string trouble;        ///< what went wrong last; empty: nothing did
};

/// One target outside of the program that is told what the music does. It owns one descriptor or
/// port, which never blocks, and its counters; it sees nothing else.
///
/// Threads: the constructor on main, counters from any, all else on the outputs' thread alone.
class Output {
 public:
    /// `timing`: as the target asks for it.
    explicit Output(const OutputTiming& timing = {}) : timing_(timing) {}
    virtual ~Output() = default;                ///< says goodbye where its protocol has one
    Output(const Output&) = delete;             ///< owns a descriptor
    Output& operator=(const Output&) = delete;  ///< likewise

    /// Tells of a moment that is heard now, or `lead` from now. What cannot be sent at once is
    /// dropped and counted.
    virtual void tell(const OutputMoment& moment) = 0;
    /// Each hop, in order, when it is heard; before the moments that are due then.
    virtual void hear(const OutputHop& /*hop*/) {}
    /// Another song plays now, as its player says.
    virtual void name_song(const SongName& /*song*/) {}
    /// Connects, sends what waits; every 5 ms or oftener, also where nothing is heard.
    virtual void turn(const OutputTurn& /*turn*/) {}
    /// Whether its turns must know who dances.
    [[nodiscard]] virtual bool wants_poses() const { return false; }
    /// When a turn is wanted to the point; nothing: whenever it comes.
    [[nodiscard]] virtual std::optional<HostTime> due() const { return std::nullopt; }
    /// A line for the person where it has failed since the last call.
    [[nodiscard]] virtual std::optional<std::string> take_trouble() { return std::nullopt; }

    /// When it is told, and how many beats.
    [[nodiscard]] const OutputTiming& timing() const noexcept { return timing_; }
    /// Messages that were sent.
    [[nodiscard]] std::uint64_t sent() const noexcept { return sent_.load(); }
    /// Messages that were not, as the other side was slow or not there.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }

 protected:
    void count_sent() noexcept { ++sent_; }        ///< one message
    void count_dropped() noexcept { ++dropped_; }  ///< one message
    /// One or the other.
    void count(bool is_sent) noexcept { is_sent ? count_sent() : count_dropped(); }

 private:
    OutputTiming timing_;
    std::atomic<std::uint64_t> sent_{0};
    std::atomic<std::uint64_t> dropped_{0};
};

/// A kind of output: a row of the table. To add one, write its file pair and its row in
/// output_table.cpp; option, help and manual follow from the row.
struct OutputKind {
    std::string_view option;  ///< of play and live, without "--"
    std::string_view target;  ///< what stands behind it, for the help: "FILE"
    std::string_view help;    ///< one line
    bool is_kept = true;      ///< a preset keeps it; not where a file is written
    /// Whether the target can be read (output_target.hpp); nothing is opened. Errors: what is
    /// wrong with it.
    Expected<void> (*check)(const std::string& target);
    /// Opens it. Errors: the target is none, or cannot be opened.
    Expected<std::unique_ptr<Output>> (*open)(const std::string& target);
    bool needs_dancers = false;  ///< it tells of poses
};

/// Outputs of one kind, at most.
inline constexpr std::size_t kMostOutputs = 16;

/// All kinds, in the order of the help.
[[nodiscard]] std::span<const OutputKind> output_kinds() noexcept;

}  // namespace raks::engine
