#include "engine/outputs/osc_output.hpp"

#include <gtest/gtest.h>
#include <oscpack/osc/OscReceivedElements.h>

#include <optional>
#include <sstream>
#include <vector>

#include "engine/outputs/osc_packet.hpp"
#include "tests/support/peers.hpp"

namespace raks::engine {
namespace {

struct OscMessage {
    std::string text;        // "/raks/beat iiff 1 17 120 0.9"
    std::uint64_t time = 0;  // of its bundle; 0: it is by itself
};

std::string text_of(const osc::ReceivedMessage& message) {
    std::ostringstream text;
    text << message.AddressPattern() << ' ' << message.TypeTags();
    for (auto argument = message.ArgumentsBegin(); argument != message.ArgumentsEnd(); ++argument) {
        text << ' ';
        if (argument->IsFloat()) {
            text << argument->AsFloat();
        } else if (argument->IsInt32()) {
            text << argument->AsInt32();
        } else {
            text << argument->AsString();
        }
    }
    return text.str();
}

/// Hears what a target says.
class OscPeer {
 public:
    [[nodiscard]] std::string place() const { return receiver_.place(); }
    std::vector<OscMessage> take() {
        std::vector<OscMessage> all;
        for (const std::string& bytes : receiver_.take_all()) {
            EXPECT_LE(bytes.size(), OscPacket::kRoom);
            const osc::ReceivedPacket packet(
                bytes.data(), static_cast<osc::osc_bundle_element_size_t>(bytes.size()));
            if (packet.IsMessage()) {
                all.push_back({text_of(osc::ReceivedMessage(packet))});
                continue;
            }
            const osc::ReceivedBundle bundle(packet);
            for (auto each = bundle.ElementsBegin(); each != bundle.ElementsEnd(); ++each) {
                all.push_back({text_of(osc::ReceivedMessage(*each)), bundle.TimeTag()});
            }
        }
        return all;
    }
    std::vector<std::string> take_texts() {
        std::vector<std::string> texts;
        for (OscMessage& message : take()) {
            texts.push_back(std::move(message.text));
        }
        return texts;
    }

 private:
    test::UdpReceiver receiver_;
};

OutputMoment beat_of(int count, std::int64_t bar, double bpm = 120.0) {
    OutputMoment moment;
    moment.notice.count = count;
    moment.notice.bar = bar;
    moment.notice.tempo = moment.notice.paced_tempo = Bpm(bpm);
    moment.notice.confidence = 0.5F;
    moment.heard_at = host_now();
    return moment;
}

class OscOutputs : public ::testing::Test {
 protected:
    void open(const std::string& options = "") {
        auto opened = open_osc(peer_.place() + options);
        ASSERT_TRUE(opened) << opened.error().message;
        output_ = std::move(*opened);
    }
    void hear(const MusicState& music, const FeedFigure& figure = {}) {
        output_->hear({music, figure, dances_});
    }
    static DanceList one_dance() {
        DanceInfo info;
        info.name = "polka";
        return DanceList({info});
    }

    OscPeer peer_;
    DanceList dances_ = one_dance();
    std::unique_ptr<Output> output_;
};

using Texts = std::vector<std::string>;

TEST_F(OscOutputs, tell_what_a_desk_maps_first_and_the_rest_in_a_bundle_of_the_beats_time) {
    open();
    const OutputMoment first = beat_of(1, 9);
    output_->tell(first);
    const std::vector<OscMessage> got = peer_.take();
    ASSERT_EQ(got.size(), 4U);
    EXPECT_EQ(got[0].text, "/raks/trigger/beat f 1");
    EXPECT_EQ(got[1].text, "/raks/trigger/bar f 1");
    EXPECT_EQ(got[2].text, "/raks/trigger/phrase f 1") << "from the first count 1 on";
    EXPECT_EQ(got[3].text, "/raks/beat iiff 1 9 120 0.5");
    EXPECT_EQ(got[0].time, 0U);
    const auto apart = static_cast<std::int64_t>(got[3].time - osc_time(first.heard_at));
    EXPECT_LT(std::abs(static_cast<double>(apart)), 0.05 * 4294967296.0);
    output_->tell(beat_of(2, 9));
    EXPECT_EQ(peer_.take_texts(), (Texts{"/raks/trigger/beat f 1", "/raks/beat iiff 2 9 120 0.5"}));
    EXPECT_EQ(output_->sent(), 6U);
}

TEST_F(OscOutputs, tell_a_phrase_every_eight_bars_and_anew_when_the_beat_is_found_again) {
    open();
    std::string phrases;
    for (const int bar : {2, 3, 9, 10, 11, 18, 1, 2, 9}) {
        output_->tell(beat_of(1, bar));
        for (const std::string& text : peer_.take_texts()) {
            phrases += text.starts_with("/raks/trigger/phrase") ? std::to_string(bar) + " " : "";
        }
    }
    EXPECT_EQ(phrases, "2 10 18 1 9 ");
}

TEST_F(OscOutputs, tell_events_and_accents) {
    open(",prefix=");
    OutputMoment moment;
    moment.notice.kind = Notice::Kind::event;
    moment.notice.event = MusicEvent::Kind::build_up;
    output_->tell(moment);
    moment.notice.kind = Notice::Kind::accent;
    moment.notice.accent = {.time = {}, .strength = 0.75F, .band = MusicAccent::Band::high};
    output_->tell(moment);
    EXPECT_EQ(peer_.take_texts(), (Texts{"/trigger/build-up f 1", "/trigger/hat f 0.75"}));
}

TEST_F(OscOutputs, count_down_to_what_is_known_ahead) {
    open();
    MusicState music;
    music.ahead.is_known = true;
    music.ahead.events[0] = {MusicEvent::Kind::drop, StreamTime(std::chrono::seconds(20))};
    hear(music);
    peer_.take();
    Texts counted;
    for (int beat = 0; beat < 41; ++beat) {
        OutputMoment moment = beat_of(1 + beat % 4, 1 + beat / 4);
        moment.notice.time = StreamTime(std::chrono::milliseconds(500 * beat));
        output_->tell(moment);
        for (const std::string& text : peer_.take_texts()) {
            if (text.starts_with("/raks/next")) {
                counted.push_back(text);
            }
        }
    }
    ASSERT_EQ(counted.size(), 32U);
    for (int i = 0; i < 32; ++i) {
        EXPECT_EQ(counted[static_cast<std::size_t>(i)],
                  "/raks/next sf drop " + std::to_string(32 - i));
    }
}

TEST_F(OscOutputs, tell_what_changes_when_it_does_and_numbers_once_a_second) {
    open();
    MusicState music;
    music.grid.confidence = 0.9F;
    music.grid.tempo = Bpm(128.0);
    music.is_silent = false;
    music.part = MusicPart::playing;
    music.genre = DanceId{0};
    music.genre_log_probability[0] = std::log(0.25F);
    hear(music, {{"basic"}, 8, DanceId{0}});
    EXPECT_EQ(peer_.take_texts(),
              (Texts{"/raks/bpm f 128",
                     "/raks/energy f 0.5",
                     "/raks/part s playing",
                     "/raks/lock i 1",
                     "/raks/silence i 0",
                     "/raks/genre sf polka 0.25",
                     "/raks/figure si basic 8"}));
    int numbers = 0;
    for (music.hop = 1; music.hop <= 200; ++music.hop) {
        hear(music, {{"basic"}, 8, DanceId{0}});
        numbers += static_cast<int>(peer_.take().size());
    }
    EXPECT_EQ(numbers, 4) << "tempo and energy, twice";
    music.grid.tempo = Bpm(128.2);
    hear(music, {{"turn"}, 4, DanceId{0}});
    EXPECT_EQ(peer_.take_texts(), (Texts{"/raks/bpm f 128.2", "/raks/figure si turn 4"}));
    music.grid.tempo = Bpm(90.0);
    music.grid.confidence = 0.1F;
    hear(music, {{"turn"}, 4, DanceId{0}});
    EXPECT_EQ(peer_.take_texts(), (Texts{"/raks/lock i 0"})) << "no tempo while it is sought";
}

TEST_F(OscOutputs, tell_phases_and_levels_only_at_a_rate) {
    open(",rate=10");
    MusicState music;
    music.level_dbfs = -30.0F;
    music.spectrum.bands.fill(255);
    hear(music);
    peer_.take();
    HeardLine line;
    line.clock.is_running = true;
    line.clock.host_anchor = HostTime(std::chrono::seconds(1000));
    line.clock.stream_anchor = StreamTime(std::chrono::milliseconds(250));
    HostTime now = line.clock.host_anchor;
    output_->turn({now, line});
    EXPECT_EQ(peer_.take_texts(),
              (Texts{"/raks/phase ff 0.5 0.125", "/raks/level f 0.5", "/raks/bands fff 1 1 1"}));
    std::size_t count = 0;
    for (int turn = 0; turn < 200; ++turn) {
        now += std::chrono::milliseconds(5);
        output_->turn({now, line});
        count += peer_.take().size();
    }
    EXPECT_EQ(count, 30U) << "10 in a second";
}

TEST_F(OscOutputs, half_and_twice_the_beats_leave_the_bars_alone) {
    open(",factor=0.5");
    OutputMoment moment = beat_of(1, 3);
    moment.notice.is_paced = false;
    output_->tell(moment);
    EXPECT_EQ(peer_.take_texts(), (Texts{"/raks/trigger/bar f 1", "/raks/trigger/phrase f 1"}));
    moment.notice.is_paced = true;
    moment.notice.is_counted = false;
    moment.notice.paced_tempo = Bpm(240.0);
    output_->tell(moment);
    EXPECT_EQ(peer_.take_texts(), (Texts{"/raks/trigger/beat f 1", "/raks/beat iiff 1 3 240 0.5"}));
}

TEST_F(OscOutputs, say_goodbye) {
    open();
    output_.reset();
    EXPECT_EQ(peer_.take_texts(), (Texts{"/raks/goodbye i 1"}));
}

TEST_F(OscOutputs, speak_as_other_senders_do) {
    open(",preset=plain");
    output_->tell(beat_of(1, 1));
    output_->tell(beat_of(2, 1));
    EXPECT_EQ(peer_.take_texts(), (Texts{"/beat f 1", "/bar f 1", "/bpm f 120", "/beat f 1"}));
    open(",preset=resolume");
    OutputMoment first = beat_of(3, 1, 140.0);
    first.notice.is_change = true;
    output_->tell(first);
    EXPECT_EQ(peer_.take_texts(), (Texts{"/composition/tempocontroller/tempo f 0.25"}));
    output_->tell(beat_of(1, 2, 140.0));
    EXPECT_EQ(peer_.take_texts(), (Texts{"/composition/tempocontroller/resync i 1"}));
    output_->tell(beat_of(1, 3, 140.0));
    EXPECT_TRUE(peer_.take().empty());
}

TEST_F(OscOutputs, tell_what_a_player_plays) {
    open();
    output_->name_song({"Quimbara", "Celia Cruz, Johnny Pacheco"});
    output_->name_song({});
    EXPECT_EQ(peer_.take_texts(),
              (Texts{"/raks/now ss Quimbara Celia Cruz, Johnny Pacheco", "/raks/now ss  "}));
    open(",preset=plain");
    output_->name_song({"Quimbara", "Celia Cruz"});
    EXPECT_EQ(peer_.take_texts(), (Texts{"/raks/goodbye i 1"})) << "others know no such thing";
}

}  // namespace
}  // namespace raks::engine
