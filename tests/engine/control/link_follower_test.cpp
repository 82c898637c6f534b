#include "engine/control/link_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

namespace raks::engine {
namespace {

using std::chrono::milliseconds;
using LinkKind = audio::AnalyzerCommand::Kind;

HostTime session_time(double seconds) { return HostTime(nanos_from_seconds(50.0 + seconds)); }

/// A beat tracker that hears its commands late, and whose stream time is the host's.
class LateTracker {
 public:
    explicit LateTracker(double bpm) { grid_.tempo = Bpm(bpm); }

    void tell(const LinkFollower::Order& order, HostTime now) {
        waiting_.push_back({now + milliseconds(120), order});
    }
    const BeatGrid& grid_at(HostTime now) {
        for (; !waiting_.empty() && waiting_.front().first <= now; waiting_.pop_front()) {
            apply(waiting_.front().second);
        }
        return grid_;
    }
    [[nodiscard]] bool is_held() const { return is_held_; }
    static StreamTime stream(HostTime time) { return StreamTime(time.time_since_epoch()); }

 private:
    void apply(const LinkFollower::Order& order) {
        const StreamTime time = stream(order.heard_at);
        const Beats there = grid_.beats_at(time);
        grid_.anchor_time = time;
        grid_.anchor_beat = there;
        switch (order.kind) {
            case LinkKind::set_tempo:
                grid_.tempo = Bpm(order.value);
                is_held_ = true;
                break;
            case LinkKind::set_beat:
                grid_.anchor_beat = Beats(std::round(there.count()));
                break;
            case LinkKind::resync_bar:
                grid_.bar_origin = Beats(std::round(there.count()));
                break;
            default:
                is_held_ = false;
        }
    }

    BeatGrid grid_;
    bool is_held_ = false;
    std::deque<std::pair<HostTime, LinkFollower::Order>> waiting_;
};

/// What a session of others does.
struct Session {
    double bpm = 128.0;
    double one = 0.37;  // s, of a count 1
    std::size_t peers = 1;

    [[nodiscard]] double beat_at(double now, double bar) const {
        const double beats = (now - one) * bpm / 60.0;
        return beats - bar * std::floor(beats / bar);
    }
};

class Following : public ::testing::Test {
 protected:
    /// Looks 50 times a second, for so long. Returns how many orders were given.
    std::size_t run(const Session& session, double length) {
        std::size_t orders = 0;
        for (const double end = now_ + length; now_ < end; now_ += 0.02) {
            const HostTime now = session_time(now_);
            const BeatGrid grid = tracker_.grid_at(now);
            const double bar = LinkFollower::session_bar(session.bpm, grid.beats_per_bar);
            const auto told = follower_.follow({.now = now,
                                                .peers = session.peers,
                                                .bpm = session.bpm,
                                                .beat = session.beat_at(now_, bar),
                                                .grid = grid,
                                                .heard = grid.beats_at(LateTracker::stream(now)),
                                                .is_held = tracker_.is_held()});
            for (const auto& order : told) {
                EXPECT_LE(order.heard_at, now);
                tracker_.tell(order, now);
            }
            orders += told.size();
        }
        return orders;
    }
    /// The tracker's place in the bar now, in beats.
    double place() {
        const BeatGrid& grid = tracker_.grid_at(session_time(now_));
        return grid.bar_position(grid.beats_at(LateTracker::stream(session_time(now_))));
    }

    double now_ = 0.0;
    LateTracker tracker_{101.0};
    LinkFollower follower_;
};

TEST_F(Following, takes_tempo_phase_and_count_and_asks_no_more_then) {
    const Session session;
    run(session, 3.0);
    EXPECT_EQ(tracker_.grid_at(session_time(now_)).tempo.bpm(), 128.0);
    EXPECT_NEAR(std::remainder(place() - session.beat_at(now_, 4.0), 4.0), 0.0, 1e-6);
    EXPECT_EQ(run(session, 20.0), 0U);
    EXPECT_LT(std::abs(to_seconds(follower_.behind())), 1e-6);
}

TEST_F(Following, follows_a_session_that_changes) {
    run({}, 3.0);
    for (const Session& session : {Session{131.5, 1.0}, Session{90.0, 0.2}, Session{90.0, 0.25}}) {
        run(session, 3.0);
        EXPECT_EQ(tracker_.grid_at(session_time(now_)).tempo.bpm(), session.bpm);
        EXPECT_NEAR(std::remainder(place() - session.beat_at(now_, 4.0), 4.0), 0.0, 1e-6);
    }
}

TEST_F(Following, takes_a_multiple_of_what_cannot_be_danced_to) {
    struct Row {
        double session;
        double followed;
        double bar;  // in beats of the session
    };
    for (const auto& [bpm, followed, bar] : {Row{30.0, 60.0, 2.0},
                                             Row{20.0, 40.0, 2.0},
                                             Row{300.0, 150.0, 8.0},
                                             Row{999.0, 124.875, 32.0}}) {
        const Session session{bpm};
        run(session, 4.0);
        EXPECT_EQ(tracker_.grid_at(session_time(now_)).tempo.bpm(), followed);
        EXPECT_EQ(LinkFollower::session_bar(bpm, 4), bar);
        const double wanted = session.beat_at(now_, bar) * followed / bpm;
        EXPECT_NEAR(std::remainder(place() - wanted, 4.0), 0.0, 1e-6);
    }
}

TEST_F(Following, lets_the_music_lead_while_nobody_else_is_there) {
    Session session;
    session.peers = 0;
    EXPECT_EQ(run(session, 3.0), 0U);
    session.peers = 1;
    run(session, 3.0);
    EXPECT_TRUE(tracker_.is_held());
    session.peers = 0;
    EXPECT_EQ(run(session, 3.0), 1U) << "one release";
    EXPECT_FALSE(tracker_.is_held());
}

}  // namespace
}  // namespace raks::engine
