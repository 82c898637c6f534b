#include "engine/outputs/os2l_output.hpp"

#include <cmath>
#include <deque>
#include <string_view>

#include "base/json.hpp"
#include "engine/outputs/tcp_peer.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::uint16_t kUsualPort = 9996;
// Receivers take one read for one object, so that two must never come together.
constexpr Nanos kLeastGap = std::chrono::milliseconds(60);
constexpr Nanos kButtonWaits = std::chrono::seconds(1);  // then it says nothing any more
constexpr Nanos kDropLasts = std::chrono::seconds(2);
constexpr std::size_t kMostButtons = 16;

struct Os2lTarget {
    HostPort place;
    OutputTiming timing;
};

Expected<Os2lTarget> read_target(const std::string& target) {
    TargetReader reader(target);
    Os2lTarget read{reader.host_port(kUsualPort), reader.timing()};
    if (auto done = reader.finish(); !done) {
        return fail(done.error());
    }
    return read;
}

class Os2lOutput final : public Output {
 public:
    explicit Os2lOutput(const Os2lTarget& target) : Output(target.timing), peer_(target.place) {}

    void tell(const OutputMoment& moment) override {
        const Notice& notice = moment.notice;
        if (notice.kind == Notice::Kind::event && notice.event == MusicEvent::Kind::drop) {
            press("drop", true);
            drop_ends_ = moment.heard_at + kDropLasts;
        }
        if (notice.kind != Notice::Kind::beat) {
            return;
        }
        is_change_ = is_change_ || notice.is_change;
        if (notice.is_paced) {
            owed_beat_ = beat_of(notice);
            is_change_ = false;
        }
    }

    void hear(const OutputHop& hop) override {
        hold("breakdown", hop.music.part == MusicPart::breakdown, is_breakdown_);
        hold("stop", hop.music.part == MusicPart::stopped, is_stopped_);
        // What is danced; without a dancer what is heard.
        const DanceId dance =
            hop.figure.dance != DanceId::none ? hop.figure.dance : hop.music.genre;
        if (dance != dance_) {
            press_dance(hop.dances, dance_, false);
            press_dance(hop.dances, dance, true);
            dance_ = dance;
        }
    }

    void turn(const OutputTurn& turn) override {
        now_ = turn.now;
        peer_.turn(turn.now);
        if (drop_ends_ && turn.now >= *drop_ends_) {
            press("drop", false);
            drop_ends_.reset();
        }
        if (turn.now < free_from_) {
            return;
        }
        if (owed_beat_) {
            send(*owed_beat_, turn.now);
            owed_beat_.reset();
        } else {
            send_button(turn);
        }
    }

    // Right behind tell() there is a turn anyway; a beat that had to wait is due when it may go.
    [[nodiscard]] std::optional<HostTime> due() const override {
        return owed_beat_ || !buttons_.empty() ? std::optional(free_from_) : std::nullopt;
    }

    std::optional<std::string> take_trouble() override { return peer_.take_trouble(); }

 private:
    struct Button {
        std::string message;
        HostTime since;
    };

    std::string beat_of(const Notice& notice) {
        Json line = Json::object();
        line["evt"] = "beat";
        line["change"] = is_change_;
        line["pos"] = position_++;
        line["bpm"] = std::round(notice.paced_tempo.bpm() * 100.0) / 100.0;
        line["strength"] = std::round(static_cast<double>(notice.confidence) * 100.0) / 100.0;
        return line.text() + "\n";
    }

    void press(std::string_view name, bool is_on) {
        Json line = Json::object();
        line["evt"] = "btn";
        line["name"] = fmt::format("raks-{}", name);
        line["state"] = is_on ? "on" : "off";
        if (buttons_.size() == kMostButtons) {
            buttons_.pop_front();
            count_dropped();
        }
        buttons_.push_back({line.text() + "\n", now_});
    }

    void press_dance(const DanceList& dances, DanceId dance, bool is_on) {
        if (dances.find(dance) != nullptr) {
            press(dances.name_of(dance), is_on);
        }
    }

    void hold(std::string_view name, bool is_held, bool& was_held) {
        if (is_held != was_held) {
            was_held = is_held;
            press(name, is_held);
        }
    }

    // Never so near before a beat that the beat would have to wait.
    void send_button(const OutputTurn& turn) {
        while (!buttons_.empty() && turn.now - buttons_.front().since > kButtonWaits) {
            buttons_.pop_front();
            count_dropped();
        }
        if (!buttons_.empty() && (!turn.next_beat || *turn.next_beat - turn.now >= kLeastGap)) {
            send(buttons_.front().message, turn.now);
            buttons_.pop_front();
        }
    }

    void send(const std::string& message, HostTime now) {
        count(peer_.send(message, now));
        free_from_ = now + kLeastGap;
    }

    TcpPeer peer_;
    HostTime now_ = host_now();  // of the last turn
    HostTime free_from_{};
    std::optional<std::string> owed_beat_;
    std::deque<Button> buttons_;
    std::int64_t position_ = 0;
    bool is_change_ = false;
    bool is_breakdown_ = false;
    bool is_stopped_ = false;
    DanceId dance_ = DanceId::none;
    std::optional<HostTime> drop_ends_;
};

}  // namespace

Expected<std::unique_ptr<Output>> open_os2l(const std::string& target) {
    const auto read = read_target(target);
    if (!read) {
        return fail("--os2l " + target + ": " + read.error().message);
    }
    return std::make_unique<Os2lOutput>(*read);
}

Expected<void> check_os2l(const std::string& target) {
    const auto read = read_target(target);
    return read ? Expected<void>() : fail(read.error());
}

}  // namespace raks::engine
