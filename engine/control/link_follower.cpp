#include "engine/control/link_follower.hpp"

#include <chrono>
#include <cmath>

namespace raks::engine {
namespace {

using LinkKind = audio::AnalyzerCommand::Kind;

// Until the tracker has done what it was told, and it is heard.
constexpr Nanos kOrdersApart = std::chrono::milliseconds(500);
constexpr double kSameTempo = 1e-4;    // of it
constexpr double kSamePhase = 0.3e-3;  // s
constexpr double kSameCount = 0.5;     // beats

// Beats of the music for one of the session.
double factor_of(double bpm) noexcept {
    double factor = 1.0;
    while (bpm * factor > audio::kFastestTempo.bpm()) {
        factor *= 0.5;
    }
    while (bpm * factor < audio::kSlowestTempo.bpm()) {
        factor *= 2.0;
    }
    return factor;
}

}  // namespace

double LinkFollower::session_bar(double bpm, int beats_per_bar) noexcept {
    return beats_per_bar / factor_of(bpm);
}

std::vector<LinkFollower::Order> LinkFollower::follow(const Look& look) {
    if (look.peers == 0) {
        const bool was_following = is_following_;
        is_following_ = false;
        next_order_ = look.now;
        return was_following ? std::vector<Order>{{LinkKind::release_tempo, 0.0, look.now}}
                             : std::vector<Order>();
    }
    const double factor = factor_of(look.bpm);
    const Bpm tempo(look.bpm * factor);
    const double bar = look.grid.beats_per_bar;
    const double wanted = look.beat * factor;
    const double ahead = std::remainder(wanted - look.grid.bar_position(look.heard), bar);
    const double within_beat = std::remainder(ahead, 1.0);
    behind_ = nanos_from_seconds(within_beat * tempo.seconds_per_beat());
    if (look.now < next_order_) {
        return {};
    }
    const auto when = [&](double beat) {
        return look.now - nanos_from_seconds((wanted - beat) * tempo.seconds_per_beat());
    };
    std::vector<Order> orders;
    const bool has_tempo = look.is_held && is_following_ &&
                           std::abs(look.grid.tempo.bpm() / tempo.bpm() - 1.0) < kSameTempo;
    if (!has_tempo) {
        orders.push_back({LinkKind::set_tempo, tempo.bpm(), look.now});
    }
    const double off = std::abs(within_beat) * tempo.seconds_per_beat();
    if (!has_tempo || off > kSamePhase) {
        orders.push_back({LinkKind::set_beat, 0.0, when(std::floor(wanted))});
    } else if (std::abs(ahead) > kSameCount) {
        orders.push_back({LinkKind::resync_bar, 0.0, when(0.0)});
    }
    is_following_ = true;
    if (!orders.empty()) {
        next_order_ = look.now + kOrdersApart;
    }
    return orders;
}

}  // namespace raks::engine
