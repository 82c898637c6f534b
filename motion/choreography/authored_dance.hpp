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
#include "motion/figures/couple_form.hpp"

#include <glm/vec2.hpp>

/// A dance as a dancer writes it down ("raks-choreography", TOML; docs/reference/choreography.md):
/// figures of steps, weight and body tracks. evaluate_figure() turns one into poses.
///
/// Beats count from 0 within a figure. Centimetres and degrees, as the dancer sees them: x to the
/// left, y up, z to the front; turns are positive to the left.
namespace raks::motion {

/// A value at a beat.
struct TrackKey {
    double beat = 0.0;   ///< of the figure
    double value = 0.0;  ///< in the control's unit
};

/// One movement of one control: keys joined by a spline (or by snaps), or a wave; a constant is a
/// wave without amplitude.
struct Track {
    std::vector<TrackKey> keys;  ///< by rising beat within [0, the figure's); empty: a wave
    double snap = 0.0;  ///< share of each gap between keys spent still before moving; 0: a spline
    double over = 0.0;  ///< overshoot of a snap, as a share of the move

    double wave = 0.0;   ///< amplitude, half the range
    double every = 4.0;  ///< period, beats
    double peak = 0.0;   ///< beat of the maximum
    double rest = 0.0;   ///< mean
    double skew = 0.0;   ///< > 0: short peaks, long troughs; [-0.9, 0.9]

    std::optional<double> lag;  ///< beats behind the music; none: the style's
    double vary = 1.0;          ///< factor of the style's noise

    /// Keys rather than a wave?
    [[nodiscard]] bool has_keys() const noexcept { return !keys.empty(); }
    /// Least value that it takes, without noise.
    [[nodiscard]] double lowest() const noexcept;
    /// Greatest value that it takes, without noise.
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

/// One step of one foot, as written.
struct FootStep {
    Side foot = Side::left;        ///< that steps
    double at = 0.0;               ///< beat of landing
    std::optional<glm::dvec2> to;  ///< place of the ball in the figure's frame, cm; none: it stays
    double air = 0.5;              ///< beats off the floor
    std::optional<double> lift;    ///< cm; none: by the distance; a lift of at most 1 cm is a slide
    FootLanding on = FootLanding::ball;  ///< how it lands
    double turn = 0.0;  ///< direction of the toes against the figure's front, degrees
    std::optional<double> weight = 1.0;  ///< on this foot after it, [0, 1]; none: no change
    double land = 0.0;                   ///< lands this much after `at`, beats
    std::size_t line = 0;                ///< in its file, for messages
};

/// How a dance is danced; each number may be set by the file and by a figure.
struct DanceStyle {
    double stance = 24.0;      ///< cm between the feet at rest
    double toe_out = 8.0;      ///< of both feet, degrees
    double knee = 18.0;        ///< bend of the carrying knee, degrees
    double air = 0.5;          ///< beats in the air, for steps that give none
    double weight_time = 0.7;  ///< beats that the weight takes to shift
    double over = 0.9;         ///< how far the body moves over the carrying foot, 0 to 1
    double sway = 3.0;         ///< roll that lifts the hip on the carrying side, degrees
    double step_yaw = 25.0;    ///< turn of the pelvis with the forward foot, degrees a metre
    double iso = 0.7;          ///< isolation: how still the chest stays over moving hips, 0 to 1
    double head_follow = 0.3;  ///< share of the chest's turns that the head takes
    double lag_chest = 0.06;   ///< beats that the chest follows the pelvis
    double lag_head = 0.12;    ///< beats behind the chest
    double lag_arm = 0.08;     ///< beats behind the hips
    double lag_elbow = 0.05;   ///< beats behind the arm
    double lag_hand = 0.08;    ///< beats behind the elbow
    double drag = 0.05;        ///< bend of the wrist by the arm's speed, seconds
    double breath = 1.0;       ///< amplitude, degrees
    double vary = 0.14;        ///< noise between repeats, as a share of a track's range
    double vary_cm = 1.6;      ///< noise of places, cm
    double vary_deg = 3.0;     ///< noise of angles, degrees
    double jitter = 0.035;     ///< noise of timing, beats
    double asym = 0.06;        ///< the left arm moves less by this share
    double balance = 0.8;      ///< share of the balance error that is corrected, 0 to 1
    /// Exponent by which movements shrink with the tempo (size_by_tempo.hpp)
    double tempo_scale = 0.7;
};

/// A closed range [lowest, highest].
struct ValueRange {
    double lowest = 0.0;   ///< least allowed
    double highest = 0.0;  ///< greatest allowed
};

/// Upper bounds of the jerk of all joints, m/s^3.
struct JerkBound {
    double rms = 350.0;    ///< root mean square
    double p999 = 2000.0;  ///< 99.9th percentile
};

/// What a figure's motion must measure; it rejects frozen or sliding figures.
struct FigureExpectation {
    std::optional<ValueRange> hip_travel;    ///< path of the hips over the floor, cm a beat
    std::optional<ValueRange> toe_contacts;  ///< contacts of both feet that begin, a bar
    std::optional<ValueRange> hand_delay;    ///< beats by which the hands follow the head
    std::optional<JerkBound> jerk;           ///< none: the bounds that hold for all dances
};

/// One figure, with the file's defaults resolved.
struct AuthoredFigure {
    std::string name;             ///< of a-z, 0-9 and _; unique in the dance
    int beats = 4;                ///< 1 to 64
    bool is_mirrored = false;     ///< odd repeats are danced as mirror images
    glm::dvec2 travel{0.0, 0.0};  ///< of the figure's frame per repeat, cm
    double turn = 0.0;            ///< of the frame per repeat, degrees
    std::vector<FootStep> steps;  ///< in order of `at`
    /// The follow's, in her own frame; none: made from `steps` (follow_figure.hpp)
    std::vector<FootStep> follow_steps;
    /// By control: tracks that add up (the figure's own, or the file's, or the control's rest
    /// value).
    std::array<std::vector<Track>, kControlCount> body;
    DanceStyle style;               ///< the file's, with the figure's changes
    FigureExpectation expectation;  ///< the file's, with the figure's changes
    std::size_t line = 0;           ///< of its name in the file

    /// The tracks of one control.
    [[nodiscard]] const std::vector<Track>& tracks(Control control) const noexcept {
        return body[index_of(control)];
    }
    /// Does its frame stay in place from repeat to repeat?
    [[nodiscard]] bool stays() const noexcept {
        return travel.x == 0.0 && travel.y == 0.0 && turn == 0.0;
    }
};

/// How a dance is danced by two, who face one another; the follow's part is made from the lead's.
struct CoupleStyle {
    /// How the follow moves.
    enum class Follow : std::uint8_t {
        opposite,  ///< as one with the lead: forward where the lead goes back
        mirror,    ///< the lead's mirror image
    };
    Follow follow = Follow::opposite;    ///< how she moves
    CoupleHold hold = CoupleHold::none;  ///< how they hold one another
    glm::dvec2 apart{0.0, 80.0};         ///< her place seen from the lead's: left, forward; cm

    /// What a grammar says of it.
    [[nodiscard]] CoupleForm form() const noexcept { return {hold, 0.01 * apart}; }
};
/// Names in files, by CoupleStyle::Follow.
inline constexpr std::array<std::string_view, 2> kFollowNames = {"opposite", "mirror"};

/// A whole dance file.
struct AuthoredDance {
    static constexpr std::string_view kFormat = "raks-choreography";  ///< of the file
    static constexpr int kVersion = 1;                                ///< newest that can be read

    std::string file;                     ///< name for messages
    std::string dance;                    ///< the dance's label in the program's list
    Bpm slowest{100.0};                   ///< tempo down to which it is danced
    Bpm written{120.0};                   ///< tempo at which it has its written size
    Bpm fastest{140.0};                   ///< tempo up to which it is danced
    int beats_per_bar = 4;                ///< 1 to 12
    std::string licence;                  ///< as the file gives it
    std::optional<CoupleStyle> couple;    ///< none: it is danced alone
    std::vector<AuthoredFigure> figures;  ///< in the file's order

    /// The figure of that name; null: there is none.
    [[nodiscard]] const AuthoredFigure* figure(std::string_view name) const noexcept;
};

/// Reads a file of at most 1 MiB. Errors are one line, with file, line, figure and beat where they
/// are known: not readable, not TOML, another format, a newer version, unknown keys or controls
/// (the nearest name is given), values that are no numbers or out of range, two figures of one
/// name, steps of a foot that contradict each other. Threads: workers. Real-time: no.
[[nodiscard]] Expected<AuthoredDance> load_authored_dance(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in errors.
[[nodiscard]] Expected<AuthoredDance> parse_authored_dance(std::string_view toml,
                                                           const std::string& name);

/// `belly.toml: line 12: figure "box"`: how messages about a figure begin.
[[nodiscard]] std::string where_in(const AuthoredDance& dance, const AuthoredFigure& figure);

/// A stretch of time in which both feet are off the floor, because the air times of two steps
/// overlap, on purpose (a jump) or not.
struct Hop {
    double from = 0.0;  ///< beat
    double to = 0.0;    ///< beat
};
/// All hops of a figure that repeats, by their beginning. Threads: any. Real-time: no.
[[nodiscard]] std::vector<Hop> hops_of(const AuthoredFigure& figure);

}  // namespace raks::motion
