// Evaluates the tracks of one control over many repeats: keys through one spline, snaps, waves,
// noise.
#include <algorithm>
#include <cmath>

#include "motion/choreography/repeat_plan.hpp"
#include "motion/choreography/splines.hpp"

namespace raks::motion {
namespace {

constexpr double kFade = 0.25;      // beats over which a repeat's wave is faded into the next one's
constexpr double kKeyNoise = 0.6;   // factor of `vary` for keys
constexpr double kWaveNoise = 1.2;  // factor of `vary` for the amplitude of waves
constexpr double kLeastBack = 0.2;  // shortest time in which an overshoot is taken back, beats
constexpr double kBackShare = 1.2;  // the same as a share of the move's length
constexpr double kTwoPi = 2.0 * M_PI;

/// Which control's tracks a control takes in one repeat, and with which sign: a mirrored repeat
/// uses those of the other side.
struct Source {
    Control control = Control::hip_x;  // whose tracks are taken
    double sign = 1.0;
};

Source source_of(const RepeatPlan& plan, Control control, int repeat) {
    if (!plan.is_mirrored(repeat)) {
        return {control, 1.0};
    }
    return {mirrored(control), info_of(control).mirror_sign};
}

// Arm, elbow or hand of the left: their amplitude is reduced by the style's `asym`.
bool is_left_arm(Control control) {
    const ControlGroup group = info_of(control).group;
    return control < Control::right_shoulder_up &&
           (group == ControlGroup::arm || group == ControlGroup::elbow ||
            group == ControlGroup::hand);
}

// Arms and head have timing noise of their own (RepeatPlan::arm_beats).
bool follows_arm_clock(Control control) {
    switch (info_of(control).group) {
        case ControlGroup::arm:
        case ControlGroup::elbow:
        case ControlGroup::hand:
        case ControlGroup::fist:
        case ControlGroup::head:
            return true;
        default:
            return false;
    }
}

// Lags add up along the chain from arm to hand.
double group_lag(const DanceStyle& style, ControlGroup group) {
    switch (group) {
        case ControlGroup::chest:
            return style.lag_chest;
        case ControlGroup::head:
            return style.lag_head;
        case ControlGroup::arm:
            return style.lag_arm;
        case ControlGroup::elbow:
            return style.lag_arm + style.lag_elbow;
        case ControlGroup::hand:
            return style.lag_arm + style.lag_elbow + style.lag_hand;
        default:
            return 0.0;
    }
}

/// Deviation of the slow noise that is added, in the control's own unit. Knees and heels get none.
double wander_size(const DanceStyle& style, Control control) {
    const ControlInfo& info = info_of(control);
    if (control == Control::hip_y) {
        return 0.15 * style.vary_cm;
    }
    if (info.unit == ControlUnit::centimetres) {
        return 0.5 * style.vary_cm;
    }
    switch (info.group) {
        case ControlGroup::arm:
        case ControlGroup::elbow:
            return 2.5 * style.vary_deg;
        case ControlGroup::hand:
            return 2.0 * style.vary_deg;
        case ControlGroup::hip:
            return 0.7 * style.vary_deg;
        case ControlGroup::fist:
            return 0.04;
        case ControlGroup::heel:
        case ControlGroup::knee:
            return 0.0;
        default:
            return style.vary_deg;
    }
}

/// One slot (first track, second track, ...) of a control through all repeats.
class TrackLine {
 public:
    TrackLine(const RepeatPlan& plan, Control control, std::size_t slot)
        : plan_(plan), control_(control), slot_(slot) {}

    void add_to(std::vector<double>& values) const {
        add_splines(values);
        add_snaps(values);
        add_waves(values);
    }

    [[nodiscard]] const Track* track_of(int repeat) const {
        const auto& tracks = plan_.figure->tracks(source_of(plan_, control_, repeat).control);
        return slot_ < tracks.size() ? &tracks[slot_] : nullptr;
    }

 private:
    /// Standard normal number `which` of a repeat, for this control and slot.
    [[nodiscard]] double normal(int repeat, std::uint64_t which) const {
        return plan_.random(Draw::repeat, 64 * index_of(control_) + slot_)
            .normal(RepeatPlan::number_of(repeat, which));
    }
    /// Relative noise of a track.
    [[nodiscard]] double vary(const Track& track) const {
        return plan_.noise * plan_.figure->style.vary * track.vary;
    }
    /// Share of the amplitude that this control dances.
    [[nodiscard]] double arm_share() const {
        return is_left_arm(control_) ? 1.0 - plan_.figure->style.asym : 1.0;
    }
    /// Beats by which the track follows the music.
    [[nodiscard]] double lag(const Track& track) const {
        return track.lag.value_or(group_lag(plan_.figure->style, info_of(control_).group));
    }
    [[nodiscard]] double beat_at(std::size_t frame) const {
        return follows_arm_clock(control_) ? plan_.arm_beats[frame] : plan_.beats[frame];
    }

    /// The keys of one repeat with its noise; beats count through all repeats. Only the distance
    /// from the keys' mean is scaled, so that the posture stays.
    [[nodiscard]] std::vector<TrackKey> keys_of(int repeat, const Track& track) const {
        double mean = 0.0;
        for (const TrackKey& key : track.keys) {
            mean += key.value / static_cast<double>(track.keys.size());
        }
        const double range = track.highest() - track.lowest();
        const double sign = source_of(plan_, control_, repeat).sign;
        std::vector<TrackKey> keys;
        for (std::size_t k = 0; k < track.keys.size(); ++k) {
            const double noise = kKeyNoise * vary(track) * range * normal(repeat, k + 1);
            const double value = mean + arm_share() * (track.keys[k].value - mean) + noise;
            keys.push_back({track.keys[k].beat + repeat * plan_.figure->beats, sign * value});
        }
        return keys;
    }

    static bool is_spline(const Track* track) {
        return track != nullptr && track->has_keys() && track->snap == 0.0;
    }
    static bool is_snap(const Track* track) {
        return track != nullptr && track->has_keys() && track->snap > 0.0;
    }
    static bool is_wave(const Track* track) { return track != nullptr && !track->has_keys(); }

    /// One spline through the keys of all repeats, so that they join smoothly.
    void add_splines(std::vector<double>& values) const {
        std::vector<double> at;
        std::vector<double> knots;
        const Track* written = nullptr;
        for (int repeat = plan_.first_repeat; repeat <= plan_.last_repeat; ++repeat) {
            const Track* const track = track_of(repeat);
            // Where a mirrored repeat has another kind, it adds nothing here
            if (!is_spline(track)) {
                at.push_back(repeat * plan_.figure->beats);
                knots.push_back(0.0);
                continue;
            }
            written = track;
            for (const TrackKey& key : keys_of(repeat, *track)) {
                at.push_back(key.beat);
                knots.push_back(key.value);
            }
        }
        if (written == nullptr) {
            return;
        }
        const Spline spline(std::move(at), std::move(knots));
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] += spline(beat_at(i) - lag(*written));
        }
    }

    /// Snaps, as moves that add up: each rests for a share of its time, moves, overshoots and comes
    /// back.
    void add_snaps(std::vector<double>& values) const {
        struct Move {
            double end;
            double length;
            double by;
            double over;
        };
        std::vector<Move> moves;
        double last_value = 0.0;
        double last_beat = plan_.first_repeat * plan_.figure->beats - 1.0;
        bool has_any = false;
        for (int repeat = plan_.first_repeat; repeat <= plan_.last_repeat; ++repeat) {
            const Track* const track = track_of(repeat);
            std::vector<TrackKey> keys;
            double snap = 0.5;
            double over = 0.0;
            if (is_snap(track)) {
                keys = keys_of(repeat, *track);
                snap = track->snap;
                over = track->over;
                has_any = true;
            } else {
                keys = {{static_cast<double>(repeat * plan_.figure->beats), 0.0}};
            }
            for (const TrackKey& key : keys) {
                const double length = (1.0 - snap) * (key.beat - last_beat);
                moves.push_back({key.beat, length, key.value - last_value, over});
                last_value = key.value;
                last_beat = key.beat;
            }
        }
        if (!has_any) {
            return;
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
            for (const Move& move : moves) {
                const double since = beat_at(i) - (move.end - move.length);
                if (since <= 0.0) {
                    break;  // moves begin in order
                }
                const double back = std::max(kLeastBack, kBackShare * move.length);
                values[i] += move.by * ((1.0 + move.over) * ease(since / move.length) -
                                        move.over * ease((beat_at(i) - move.end) / back));
            }
        }
    }

    /// The value of one repeat's wave at a frame. The skew shifts the phase so that peaks get
    /// shorter than troughs.
    [[nodiscard]] double wave_of(int repeat, std::size_t frame) const {
        const Track* const track = track_of(repeat);
        if (!is_wave(track)) {
            return 0.0;
        }
        const double sign = source_of(plan_, control_, repeat).sign;
        if (track->wave == 0.0) {
            return sign * track->rest;
        }
        // Phase counts within the figure: a wave begins anew with each repeat. A wave faster than
        // the beat gets less of the timing noise; otherwise repeats of a shimmy would lose their
        // common phase.
        const double music = plan_.music_beats[frame];
        const double beat = music + std::min(1.0, track->every) * (beat_at(frame) - music);
        const double local = beat - repeat * plan_.figure->beats;
        const double p = kTwoPi * (local - lag(*track) - track->peak) / track->every;
        const double varied = 1.0 + kWaveNoise * vary(*track) * normal(repeat, 0);
        return sign * (track->rest + plan_.size * arm_share() * varied * track->wave *
                                         std::cos(p + track->skew * std::sin(p)));
    }

    /// Each repeat's own wave, cross-faded with the next one's over kFade beats.
    void add_waves(std::vector<double>& values) const {
        const double beats = plan_.figure->beats;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double beat = beat_at(i);
            const int repeat = static_cast<int>(std::floor((beat + kFade / 2) / beats));
            const double into = beat - repeat * beats + kFade / 2;
            const double share = ease(into / kFade);
            values[i] += share * wave_of(repeat, i);
            if (share < 1.0) {
                values[i] += (1.0 - share) * wave_of(repeat - 1, i);
            }
        }
    }

    const RepeatPlan& plan_;
    Control control_;
    std::size_t slot_;
};

// Slow noise over the whole evaluation, with a knot every three quarters of a figure or 3 beats,
// whichever is longer.
void add_wander(const RepeatPlan& plan, Control control, std::vector<double>& values) {
    const double size = plan.noise * wander_size(plan.figure->style, control);
    if (size == 0.0) {
        return;
    }
    const std::vector<Track>& tracks = plan.figure->tracks(control);
    const double vary = tracks.empty() ? 1.0 : tracks.front().vary;
    const double period = std::max(3.0, 0.75 * plan.figure->beats);
    const Spline noise = wander(plan.random(Draw::track, index_of(control)),
                                period,
                                plan.beats.front() - 1.0,
                                plan.beats.back() + 1.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] += vary * size * noise(plan.beats[i]);
    }
}

}  // namespace

std::vector<double> control_values(const RepeatPlan& plan, Control control) {
    std::vector<double> values(plan.frames(), 0.0);
    // The mirror image may have more tracks.
    const std::size_t slots = std::max(plan.figure->tracks(control).size(),
                                       plan.figure->tracks(mirrored(control)).size());
    for (std::size_t slot = 0; slot < slots; ++slot) {
        TrackLine(plan, control, slot).add_to(values);
    }
    add_wander(plan, control, values);
    return values;
}

}  // namespace raks::motion
