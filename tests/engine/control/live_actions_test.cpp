#include "engine/control/live_actions.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace raks::engine {
namespace {

using AnalyzerKind = audio::AnalyzerCommand::Kind;
using DancerKind = motion::DancerCommand::Kind;
using std::chrono::milliseconds;

/// Keeps what was asked of it.
class Recorder final : public LiveTarget {
 public:
    bool command(AnalyzerKind kind, double value, HostTime came) override {
        music.emplace_back(kind, value);
        moments.push_back(came);
        return has_room;
    }
    bool command(DancerKind kind, double value) override {
        dance.emplace_back(kind, value);
        return has_room;
    }
    [[nodiscard]] bool has_dancers() const override { return has_somebody; }
    Bpm tempo() override { return Bpm(120.0); }
    Nanos latency_offset() override { return latency; }
    void set_latency_offset(Nanos offset) override { latency = offset; }
    [[nodiscard]] bool plays_file() const override { return has_file; }
    void toggle_pause() override { ++pauses; }
    void seek_by(double seconds) override { seeks.push_back(seconds); }
    void set_volume(float value) override { volumes.push_back(value); }

    std::vector<std::pair<AnalyzerKind, double>> music;
    std::vector<HostTime> moments;  // of those of music
    std::vector<std::pair<DancerKind, double>> dance;
    std::vector<double> seeks;
    std::vector<float> volumes;
    Nanos latency{};
    int pauses = 0;
    bool has_room = true;
    bool has_file = true;
    bool has_somebody = true;
};

class Live : public ::testing::Test {
 protected:
    void SetUp() override {
        live_.attach(target_);
        live_.bind(actions_);
    }
    void ask(Action action, double value = 0.0) {
        const auto done = actions_.dispatch({action, value});
        EXPECT_TRUE(done) << done.error().message;
    }
    [[nodiscard]] std::string last_said() const { return said_.empty() ? "" : said_.back(); }

    std::vector<std::string> said_;
    SayLine say_ = [this](const std::string& line) { said_.push_back(line); };
    Recorder target_;
    ActionDispatcher actions_{say_};
    LiveActions live_{1.0F, say_};
};

TEST_F(Live, one_request_is_one_command_to_the_analyzer) {
    struct Case {
        Action action;
        double value;
        AnalyzerKind kind;
        double given;
        const char* said;
    };
    const std::vector<Case> cases = {
        {Action::tap_tempo, 0.0, AnalyzerKind::tap, 0.0, ""},
        {Action::half_tempo, 0.0, AnalyzerKind::half_tempo, 0.0, ""},
        {Action::double_tempo, 0.0, AnalyzerKind::double_tempo, 0.0, ""},
        {Action::hold_tempo,
         0.0,
         AnalyzerKind::hold_tempo,
         0.0,
         "tempo held (R follows the music)"},
        {Action::release_tempo, 0.0, AnalyzerKind::release_tempo, 0.0, "tempo follows the music"},
        {Action::nudge_beats,
         -10.0,
         AnalyzerKind::nudge,
         -0.01,
         "beats 10 ms earlier (-10 ms in all)"},
        {Action::nudge_beats,
         25.0,
         AnalyzerKind::nudge,
         0.025,
         "beats 25 ms later (+15 ms in all)"},
        {Action::resync_bar, 0.0, AnalyzerKind::resync_bar, 0.0, "this beat is count 1"},
        {Action::change_tempo,
         1.0,
         AnalyzerKind::set_tempo,
         121.0,
         "tempo held at 121.0 BPM (R follows the music)"},
    };
    for (const Case& row : cases) {
        target_.music.clear();
        said_.clear();
        ask(row.action, row.value);
        ASSERT_EQ(target_.music.size(), 1U) << row_of(row.action).name;
        EXPECT_EQ(target_.music[0].first, row.kind) << row_of(row.action).name;
        EXPECT_DOUBLE_EQ(target_.music[0].second, row.given) << row_of(row.action).name;
        EXPECT_EQ(last_said(), row.said);
    }
    EXPECT_TRUE(target_.dance.empty());
}

TEST_F(Live, commands_to_the_tracker_have_the_moment_at_which_they_came) {
    const HostTime came = HostClock::now() - milliseconds(70);
    for (const Action action : {Action::tap_tempo, Action::nudge_beats, Action::resync_bar}) {
        ASSERT_TRUE(actions_.dispatch({.action = action, .value = 10.0, .came = came}));
        EXPECT_EQ(target_.moments.back(), came) << row_of(action).name;
    }
}

TEST_F(Live, a_set_tempo_is_held_and_steps_go_on_from_it) {
    ask(Action::set_tempo, 96.5);
    EXPECT_EQ(target_.music.back(), std::pair(AnalyzerKind::set_tempo, 96.5));
    EXPECT_EQ(last_said(), "tempo held at 96.5 BPM (R follows the music)");
    ask(Action::change_tempo, 1.0);
    EXPECT_EQ(target_.music.back().second, 97.5);
    const auto refused = actions_.dispatch({Action::set_tempo, 300.0});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "action set-tempo: 300 BPM must be 40 to 230 BPM");
}

TEST_F(Live, where_nobody_dances_figures_are_not_asked_for) {
    target_.has_somebody = false;
    ActionDispatcher actions(say_);
    live_.bind(actions);
    EXPECT_FALSE(actions.handles(Action::keep_figure));
    EXPECT_TRUE(actions.handles(Action::tap_tempo));
}

TEST_F(Live, steps_of_the_tempo_add_up_before_the_tracker_has_followed) {
    ask(Action::change_tempo, 1.0);
    ask(Action::change_tempo, 1.0);
    ask(Action::change_tempo, -5.0);
    EXPECT_EQ(target_.music.back().second, 117.0);
    ask(Action::release_tempo);
    ask(Action::change_tempo, 1.0);
    EXPECT_EQ(target_.music.back().second, 121.0) << "from the music's tempo again";
    ask(Action::change_tempo, 100.0);
    ask(Action::change_tempo, 100.0);
    EXPECT_EQ(target_.music.back().second, 230.0);
}

TEST_F(Live, figures_are_counted_from_1_and_for_the_dancer_from_0) {
    ask(Action::next_figure);
    ask(Action::select_figure, 3.0);
    const std::vector<std::pair<DancerKind, double>> expected = {{DancerKind::next_figure, 0.0},
                                                                 {DancerKind::select_figure, 2.0}};
    EXPECT_EQ(target_.dance, expected);
    EXPECT_TRUE(target_.music.empty());
}

TEST_F(Live, keeping_a_figure_is_told_to_dancers_who_take_over) {
    live_.brief_dancers();
    EXPECT_TRUE(target_.dance.empty());
    ask(Action::keep_figure);
    EXPECT_EQ(last_said(), "keeping to this figure (K lets go)");
    live_.brief_dancers();
    ask(Action::keep_figure);
    EXPECT_EQ(last_said(), "figures as they come");
    live_.brief_dancers();
    const std::vector<std::pair<DancerKind, double>> expected = {{DancerKind::lock_figure, 1.0},
                                                                 {DancerKind::lock_figure, 1.0},
                                                                 {DancerKind::lock_figure, 0.0}};
    EXPECT_EQ(target_.dance, expected);
}

TEST_F(Live, the_file_is_paused_sought_and_made_louder) {
    ask(Action::pause);
    ask(Action::seek, -30.0);
    ask(Action::volume, 0.05);
    ask(Action::volume, -0.05);
    EXPECT_EQ(target_.pauses, 1);
    EXPECT_EQ(target_.seeks, std::vector{-30.0});
    EXPECT_EQ(target_.volumes, (std::vector{1.0F, 1.0F, 0.95F})) << "at the start, then each step";
    EXPECT_EQ(live_.volume(), 0.95F);
}

TEST(LiveInputActions, leave_out_what_only_a_file_has) {
    const auto bound_with = [](bool has_file) {
        Recorder target;
        target.has_file = has_file;
        LiveActions live(1.0F, [](const std::string&) {});
        live.attach(target);
        ActionDispatcher actions([](const std::string&) {});
        live.bind(actions);
        std::vector<Action> bound;
        for (const ActionRow& row : action_table()) {
            if (actions.handles(row.action)) {
                bound.push_back(row.action);
            }
        }
        return bound;
    };
    std::vector<Action> of_a_file = bound_with(true);
    const std::vector<Action> of_an_input = bound_with(false);
    std::erase_if(of_a_file, [](Action action) {
        return action == Action::pause || action == Action::seek || action == Action::volume;
    });
    EXPECT_EQ(of_an_input, of_a_file);
    EXPECT_EQ(of_an_input.size() + 3, bound_with(true).size());
}

TEST_F(Live, the_latency_offset_moves_by_steps_and_stops_at_half_a_second) {
    target_.latency = milliseconds(30);
    ask(Action::latency, 5.0);
    EXPECT_EQ(target_.latency, milliseconds(35));
    EXPECT_EQ(last_said(), "latency offset +35 ms");
    ask(Action::latency, -500.0);
    ask(Action::latency, -500.0);
    EXPECT_EQ(target_.latency, milliseconds(-500));
    EXPECT_EQ(last_said(), "latency offset -500 ms");
}

TEST(LiveVolume, above_the_files_own_stays_when_louder_is_asked_for) {
    Recorder target;
    LiveActions live(1.5F, [](const std::string&) {});
    live.attach(target);
    ActionDispatcher actions([](const std::string&) {});
    live.bind(actions);
    ASSERT_TRUE(actions.dispatch({Action::volume, 0.05}));
    EXPECT_EQ(live.volume(), 1.5F);
    ASSERT_TRUE(actions.dispatch({Action::volume, -0.25}));
    EXPECT_EQ(live.volume(), 1.25F);
}

TEST_F(Live, the_next_file_gets_the_volume_and_the_latency_that_were_set) {
    Recorder untouched;
    untouched.latency = milliseconds(7);
    live_.attach(untouched);
    EXPECT_EQ(untouched.latency, milliseconds(7)) << "nobody changed it";
    ask(Action::latency, 5.0);
    ask(Action::volume, -0.5);
    Recorder next;
    live_.attach(next);
    EXPECT_EQ(next.latency, milliseconds(12));
    EXPECT_EQ(next.volumes, std::vector{0.5F});
}

TEST(ChosenDance, is_said_to_stay_where_it_is_danced_already) {
    EXPECT_EQ(chosen_dance_line("salsa", false), "dancing salsa (D: another dance)");
    EXPECT_EQ(chosen_dance_line("salsa", true),
              "dancing salsa already: it stays (D: another dance)");
    EXPECT_EQ(chosen_dance_line("", false), "dancing what is heard (D: another dance)");
}

TEST_F(Live, a_full_queue_is_said) {
    target_.has_room = false;
    ask(Action::resync_bar);
    EXPECT_EQ(said_, std::vector<std::string>{"too many commands at once: this one is left out"});
}

}  // namespace
}  // namespace raks::engine
