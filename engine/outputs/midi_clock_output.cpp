#include "engine/outputs/midi_clock_output.hpp"

#include <array>
#include <chrono>
#include <utility>

#include "engine/midi/midi_port.hpp"

namespace raks::engine {
namespace {

constexpr Nanos kStaleGrid = std::chrono::milliseconds(500);

struct MidiClockTarget {
    std::string port;
    OutputTiming timing;
};

Expected<MidiClockTarget> read_midi_clock(const std::string& target) {
    TargetReader reader(target);
    MidiClockTarget read{reader.place(), reader.timing()};
    if (read.port.empty()) {
        reader.complain("it needs a part of a port's name, such as the device's");
    }
    if (auto done = reader.finish(); !done) {
        return fail(done.error());
    }
    return read;
}

int clocks_per_beat(BeatSchedule::Pace pace) {
    constexpr std::array kClocks = {12, 24, 48};  // in the order of Pace
    return kClocks[static_cast<std::size_t>(pace)];
}

class MidiClockOutput final : public Output {
 public:
    MidiClockOutput(std::unique_ptr<MidiClockPort> port, const MidiClockTarget& target)
        : Output(target.timing), port_(std::move(port)), name_(target.port) {}

    // The port counts beats by itself, so that each clock stands where it belongs.
    void tell(const OutputMoment& /*moment*/) override {}

    void hear(const OutputHop& hop) override {
        const BeatGrid& grid = hop.music.grid;
        grid_ = grid;
        beats_.beat = (grid.anchor_beat - grid.bar_origin).count();
        beats_.beats_per_second = grid.tempo.beats_per_second();
        beats_.beats_per_bar = grid.beats_per_bar;
        beats_.is_held = hop.music.is_tempo_held;
        is_known_ = beats_.is_held || grid.confidence >= BeatGrid::kDanceable;
    }

    void turn(const OutputTurn& turn) override {
        beats_.is_followed = is_known_ && turn.line && is_of_now(*turn.line, turn.now);
        if (beats_.is_followed) {
            beats_.anchor = turn.line->heard_at(grid_.anchor_time) - timing().lead;
        }
        port_->follow(beats_);
        port_->turn(turn.now);
        for (auto sent = port_->take_sent(); sent > 0; --sent) {
            count_sent();
        }
    }

    [[nodiscard]] std::optional<HostTime> due() const override { return port_->due(); }

    std::optional<std::string> take_trouble() override {
        auto trouble = port_->take_trouble();
        return trouble ? std::optional(name_ + ": " + *trouble) : std::nullopt;
    }

 private:
    // Of another song, or from before a gap, the grid says nothing any more.
    [[nodiscard]] bool is_of_now(const HeardLine& line, HostTime now) const {
        const Nanos old = line.heard_by(now + timing().lead) - grid_.anchor_time;
        return line.clock.is_running && std::chrono::abs(old) < kStaleGrid;
    }

    std::unique_ptr<MidiClockPort> port_;
    std::string name_;
    BeatGrid grid_;  // as heard last
    MidiClockBeats beats_;
    bool is_known_ = false;
};

}  // namespace

Expected<std::unique_ptr<Output>> open_midi_clock(const std::string& target) {
    const auto read = read_midi_clock(target);
    if (!read) {
        return fail("--midi-clock " + target + ": " + read.error().message);
    }
    auto port = open_midi_clock_port(read->port, clocks_per_beat(read->timing.pace));
    if (!port) {
        return fail("--midi-clock " + target + ": " + port.error().message);
    }
    return std::make_unique<MidiClockOutput>(std::move(*port), *read);
}

Expected<void> check_midi_clock(const std::string& target) {
    const auto read = read_midi_clock(target);
    return read ? Expected<void>() : fail(read.error());
}

}  // namespace raks::engine
