#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// How a dance goes from figure to figure: a bigram, and how lively each figure is.
struct FigureGrammar {
    struct Rule {
        std::string figure;
        double energy = 0.5;        ///< [0, 1]: 0 for the quietest music, 1 for the loudest
        double seen = 1.0;          ///< > 0: how often it occurs, where no rule says more
        std::vector<double> after;  ///< by figure: weight that it comes after this one, >= 0
        /// By DanceRole: how far one of a couple goes aside in the middle of the figure, so that
        /// both have room; left, forward of where it starts; metres.
        std::array<glm::dvec2, 2> aside{};
    };
    /// Where one of a couple stands.
    struct Place {
        DanceRole role = DanceRole::lead;
        /// About which its half-turn figures turn, seen from where they start: left, forward;
        /// metres. The same point on the floor for both.
        glm::dvec2 turn_point{0.0, 0.0};
        double heading = 0.0;  ///< on the stage, where figures start; radians
    };
    /// Where the feet stand as figures start.
    enum class Starts : std::uint8_t {
        common,  ///< all in one place a foot: figures from people's takes begin alike
        own,     ///< each in its own: written figures have a stance each, the dancer steps over
    };
    std::string dance;
    int beats_per_bar = 4;
    Starts starts = Starts::common;
    std::vector<Place> places;  ///< by role; none: each about its own
    std::vector<Rule> rules;    ///< by figure; the dance begins with the first

    /// Null: the dance has none for this role.
    [[nodiscard]] const Place* place_of(DanceRole role) const noexcept;

    /// Every figure after every other alike, none after itself unless it is alone.
    [[nodiscard]] static FigureGrammar uniform(const std::vector<std::string>& figures);
};

/// Reads models/trained/DANCE.toml: format = "raks-dance", version = 1, dance, beats_per_bar (2 to
/// 12; 4 if left out), starts ("common" if left out, or "own"), and one [[figure]] each with name,
/// energy, `seen` (1 if left out) and `after` = { figure = weight, ... }; without `after` every
/// other figure follows as often as it is seen. For couples [lead] and [follow] with
/// turn_point = [left, forward] and heading in degrees, and with a figure lead_aside and
/// follow_aside = [left, forward].
/// Errors, one line: not readable, not TOML, another format, a newer version, unknown keys and
/// figures (the nearest is named), two figures of one name, weights that are negative or no
/// numbers, a figure that nothing follows. Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureGrammar> load_grammar(const std::filesystem::path& path);
[[nodiscard]] Expected<FigureGrammar> parse_grammar(std::string_view toml, const std::string& name);

/// Adds the figures of another file to a grammar. What the file says besides figures is left
/// aside. Its `after` may name figures of both; the figures of `grammar` go on to each new one with
/// the mean of the weights that they have, times `seen`.
/// Errors: as load_grammar; a figure that the grammar has already.
[[nodiscard]] Expected<void> extend_grammar(const std::filesystem::path& path,
                                            FigureGrammar& grammar);

/// The names of the figures in the text of such a file, whatever their rules say: also of one that
/// extends another. Errors: not TOML.
[[nodiscard]] Expected<std::vector<std::string>> figures_in_grammar(std::string_view toml,
                                                                    const std::string& name);

/// Letters, digits, '-' and '_', at most 60: a part of a file's name on any system.
[[nodiscard]] bool is_figure_name(std::string_view name) noexcept;
/// "NAME" with the reason why it is none; for errors.
[[nodiscard]] std::string why_no_figure_name(std::string_view name);

/// A [[figure]] without `after`, as text of such a file.
[[nodiscard]] std::string figure_rule_text(std::string_view figure, double seen);
/// A file without figures yet: its head, with comments for who edits it.
[[nodiscard]] std::string grammar_head_text(const FigureGrammar& grammar);

}  // namespace raks::motion
