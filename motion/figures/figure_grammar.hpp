// Figure grammar: which figures a dance has and how they follow one another.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/couple_form.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/solo_arms.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// Transitions between the figures of a dance (a bigram), and how lively each figure is.
struct FigureGrammar {
    /// One figure and what may follow it.
    struct Rule {
        std::string figure;   ///< name
        double energy = 0.5;  ///< liveliness, [0, 1]: 0 suits the quietest music, 1 the loudest
        /// >= 0: weight of the figure after those whose rules do not list it; 0: it comes only
        /// after those that do
        double seen = 1.0;
        std::vector<double> after;  ///< by figure: weight that it follows this one, >= 0
        /// By DanceRole: how far a partner moves aside in the middle of the figure, so that both
        /// have room; left, forward of where it starts; metres.
        std::array<glm::dvec2, 2> aside{};
        std::vector<HeldHands> holds{};  ///< of a couple, where it holds by the hands
        /// It may be danced left for right; not what a hand does by its nature, such as to play
        bool can_mirror = true;
        bool can_slow = false;  ///< it may be danced at half the tempo, to calm music
        std::optional<HandShapeWeights> hands{};  ///< shapes of its hands; none: those of the dance
        StillPart still = StillPart::nothing;     ///< what stays in the room while the hips move
    };
    /// Where one partner of a couple stands.
    struct Place {
        DanceRole role = DanceRole::lead;  ///< which partner
        /// The point about which its half-turn figures turn, seen from where they start: left,
        /// forward; metres. It is the same point on the floor for both partners.
        glm::dvec2 turn_point{0.0, 0.0};
        double heading = 0.0;  ///< on the stage, where figures start; radians
    };
    /// Where the feet stand as figures start.
    enum class Starts : std::uint8_t {
        /// The same place for each foot in all figures: those learnt from takes begin alike
        common,
        own,  ///< each figure has its own stance, as written figures do; the dancer steps over
    };
    std::string dance;                 ///< the dance's label
    int beats_per_bar = 4;             ///< 2 to 12
    Starts starts = Starts::common;    ///< whether figures share a stance
    DanceHabits habits;                ///< what its dancers do beside its figures
    std::vector<Place> places;         ///< one a role; none: each turns about its own point
    std::optional<CoupleForm> couple;  ///< none: nothing is said; a dance for one has none
    std::vector<Rule> rules;           ///< one a figure; the dance begins with the first
    SoloArms solo;                     ///< of a couples' dance: the arms of one who dances it alone
    /// What of the file is no hold, and what is danced instead; a line each
    std::vector<std::string> notes;

    /// The place of a role; null: the dance has none.
    [[nodiscard]] const Place* place_of(DanceRole role) const noexcept;

    /// All transitions between different figures with equal weight; a single figure follows itself.
    [[nodiscard]] static FigureGrammar uniform(const std::vector<std::string>& figures);
};

/// Reads models/trained/DANCE.toml: format = "raks-dance", version = 1, dance, beats_per_bar (2 to
/// 12; default 4), starts ("common", the default, or "own"), pauses, rests, rest_at, mirror,
/// endings, idle and [hands] (see DanceHabits), and one [[figure]] each with name, energy, `seen`
/// (default 1) and `after` = { figure = weight, ... }; without `after` every other figure follows,
/// weighted by its `seen` (0: never). For couples [lead] and [follow] with turn_point = [left,
/// forward] and heading in degrees, and in a figure lead_aside and follow_aside = [left, forward];
/// [couple] with hold ("none", "hands" or "closed"), apart = [left, forward] and of a closed hold
/// hips, clasp, look and contacts (ClosedFrame); [solo] (read_solo_arms); and in a figure mirror
/// (default true), half_tempo (default false), hands (shapes), still ("chest" or "head") and holds
/// = [{ lead, follow ("left" or "right"), from, to (beats) }, ...]. A hold that cannot be read is
/// left out, and `notes` says so. Errors, one line: not readable, not TOML, another format, a newer
/// version, unknown keys and figures (the nearest name is given), two figures of one name, weights
/// that are negative or no numbers, a figure that nothing follows. Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureGrammar> load_grammar(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in errors.
[[nodiscard]] Expected<FigureGrammar> parse_grammar(std::string_view toml, const std::string& name);

/// Adds the figures of another file to a grammar; everything else in that file is ignored. Its
/// `after` may name figures of both. After each old figure, a new one gets the mean of that
/// figure's positive weights, times its own `seen`. Errors: as load_grammar; a figure that the
/// grammar has already. After an error the grammar is unchanged.
[[nodiscard]] Expected<void> extend_grammar(const std::filesystem::path& path,
                                            FigureGrammar& grammar);

/// The names of the figures in the text of such a file. Rules are not checked, so the file may
/// extend another one. Errors: not TOML.
[[nodiscard]] Expected<std::vector<std::string>> figures_in_grammar(std::string_view toml,
                                                                    const std::string& name);

/// Letters, digits, '-' and '_', at most 60: valid as part of a file name on any system.
[[nodiscard]] bool is_figure_name(std::string_view name) noexcept;
/// An error message: the name in quotes and why it is not valid.
[[nodiscard]] std::string why_no_figure_name(std::string_view name);

/// TOML text of a [[figure]]. `next`: the figure that always comes after it; empty: any may.
[[nodiscard]] std::string figure_rule_text(std::string_view figure,
                                           double seen,
                                           std::string_view next = {});
/// TOML text of a file's head, without figures, with comments for its editor.
[[nodiscard]] std::string grammar_head_text(const FigureGrammar& grammar);

}  // namespace raks::motion
