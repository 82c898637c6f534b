#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "motion/choreography/controls.hpp"

#include <glm/vec2.hpp>

/// A dance as a dancer writes it down ("raks-choreography", TOML; docs/reference/choreography.md):
/// figures of steps, weight and body tracks. evaluate_figure() makes poses of one.
///
/// Beats count from 0 within a figure. Centimetres and degrees, seen by the dancer: x to the left,
/// y up, z to the front; turns are positive to the left.
namespace raks::motion {

/// A value at a beat.
struct TrackKey {
    double beat = 0.0;
    double value = 0.0;
};

/// One movement of one control: keys joined by a spline (or by snaps), or a wave; a still number is
/// a wave of no amplitude.
struct Track {
    std::vector<TrackKey> keys;  ///< beats rise within [0, the figure's); empty: a wave
    double snap = 0.0;           ///< share of each gap spent still before moving on; 0: a spline
    double over = 0.0;           ///< how far a snap overshoots; share of the move

    double wave = 0.0;   ///< amplitude, half the range
    double every = 4.0;  ///< period, beats
    double peak = 0.0;   ///< beat of the maximum
    double rest = 0.0;   ///< mean
    double skew = 0.0;   ///< > 0: short peak, long trough

    std::optional<double> lag;  ///< beats, instead of the style's
    double vary = 1.0;          ///< times the noise

    [[nodiscard]] bool has_keys() const noexcept { return !keys.empty(); }
    /// Least and greatest value that it can take, without noise.
    [[nodiscard]] double lowest() const noexcept;
    [[nodiscard]] double highest() const noexcept;
};

/// Which part of the foot lands, and what it does then.
enum class FootLanding : std::uint8_t {
    ball,        ///< the ball first, then the heel comes down
    flat,        ///< all at once
    heel,        ///< the heel first, then the ball comes down
    touch,       ///< the ball; the heel stays up
    heel_touch,  ///< the heel; the toes stay up
};

struct FootStep {
    Side foot = Side::left;
    double at = 0.0;               ///< beat of landing
    std::optional<glm::dvec2> to;  ///< ball's place in the figure's frame, cm; none: the same
    double air = 0.5;              ///< beats off the floor
    std::optional<double> lift;    ///< cm; none: by the distance; at most 1: a slide
    FootLanding on = FootLanding::ball;
    double turn = 0.0;                   ///< of the foot's toes, against the figure's front
    std::optional<double> weight = 1.0;  ///< on this foot after it, [0, 1]; none: no change
    double land = 0.0;                   ///< lands so much after `at`, beats
    std::size_t line = 0;                ///< in its file
};

/// How a dance is danced; each number may be set by the file and by a figure.
struct DanceStyle {
    double stance = 24.0;  ///< cm between the feet at rest
    double toe_out = 8.0;
    double knee = 18.0;        ///< bend of the carrying knee
    double air = 0.5;          ///< of steps that do not say theirs, beats
    double weight_time = 0.7;  ///< beats that the weight takes to move
    double over = 0.9;         ///< how far the body goes over the carrying foot, 0 to 1
    double sway = 3.0;         ///< the carrying hip rises by
    double step_yaw = 25.0;    ///< pelvis turns with the forward foot, degrees a metre
    double iso = 0.7;          ///< how quiet the chest stays over moving hips, 0 to 1
    double head_follow = 0.3;  ///< share of the chest's turns that the head takes
    double lag_chest = 0.06;   ///< beats behind the hips
    double lag_head = 0.12;
    double lag_arm = 0.08;
    double lag_elbow = 0.05;  ///< behind the arm
    double lag_hand = 0.08;   ///< behind the elbow
    double drag = 0.05;       ///< hands trail the arm's speed, seconds
    double breath = 1.0;
    double vary = 0.14;        ///< between repeats: share of a track's range
    double vary_cm = 1.6;      ///< wander of places
    double vary_deg = 3.0;     ///< wander of angles
    double jitter = 0.035;     ///< wander of timing, beats
    double asym = 0.06;        ///< the left arm does so much less
    double balance = 0.8;      ///< how much of a fault in balance is taken off, 0 to 1
    double tempo_scale = 0.7;  ///< how much smaller everything gets with the tempo
};

/// [least, greatest].
struct ValueRange {
    double lowest = 0.0;
    double highest = 0.0;
};

/// Jerk of all joints at most, m/s^3.
struct JerkBound {
    double rms = 350.0;
    double p999 = 2000.0;
};

/// What must come out of a figure: a frozen or sliding one does not pass.
struct FigureExpectation {
    std::optional<ValueRange> hip_travel;    ///< path of the hips over the floor, cm a beat
    std::optional<ValueRange> toe_contacts;  ///< contacts of both feet that begin, a bar
    std::optional<ValueRange> hand_delay;    ///< beats that the hands' motion trails the head's
    std::optional<JerkBound> jerk;           ///< instead of what holds for all dances
};

struct AuthoredFigure {
    std::string name;
    int beats = 4;                ///< 1 to 64
    bool is_mirrored = false;     ///< odd repeats are mirrored
    glm::dvec2 travel{0.0, 0.0};  ///< of the figure's frame per repeat, cm
    double turn = 0.0;            ///< of the frame per repeat
    std::vector<FootStep> steps;  ///< by the beat of landing
    /// By control: tracks that add up (the figure's, else the file's, else the control's rest).
    std::array<std::vector<Track>, kControlCount> body;
    DanceStyle style;
    FigureExpectation expectation;
    std::size_t line = 0;  ///< of its name in the file

    [[nodiscard]] const std::vector<Track>& tracks(Control control) const noexcept {
        return body[index_of(control)];
    }
    /// Does its frame stay where it is?
    [[nodiscard]] bool stays() const noexcept {
        return travel.x == 0.0 && travel.y == 0.0 && turn == 0.0;
    }
};

struct AuthoredDance {
    static constexpr std::string_view kFormat = "raks-choreography";
    static constexpr int kVersion = 1;

    std::string file;   ///< name for messages
    std::string dance;  ///< a genre label
    Bpm slowest{100.0};
    Bpm written{120.0};
    Bpm fastest{140.0};
    int beats_per_bar = 4;
    std::string licence;
    std::vector<AuthoredFigure> figures;

    /// Null: there is none.
    [[nodiscard]] const AuthoredFigure* figure(std::string_view name) const noexcept;
};

/// Reads a file of at most 1 MiB. Errors, one line with file, line, figure and beat where there are
/// any: not readable, not TOML, another format, a newer version, unknown keys and controls (the
/// nearest is named), numbers that are none or out of range, two figures of one name, steps of a
/// foot that contradict each other.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<AuthoredDance> load_authored_dance(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in errors.
[[nodiscard]] Expected<AuthoredDance> parse_authored_dance(std::string_view toml,
                                                           const std::string& name);

/// "figure \"box\" (line 12)" behind the file's name: how messages about a figure begin.
[[nodiscard]] std::string where_in(const AuthoredDance& dance, const AuthoredFigure& figure);

/// Where both feet are off the floor: a hop, which steps whose times in the air overlap make, on
/// purpose (a jump) or not.
struct Hop {
    double from = 0.0;  ///< beat
    double to = 0.0;
};
[[nodiscard]] std::vector<Hop> hops_of(const AuthoredFigure& figure);

}  // namespace raks::motion
