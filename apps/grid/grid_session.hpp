// Grid session: what a person does while setting the beats of a take right, as a value.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/grid/grid_edits.hpp"
#include "base/history.hpp"

namespace raks::apps {

/// A beat that is being dragged.
struct HeldBeat {
    std::size_t beat = 0;
    double time = 0.0;       ///< where it is now
    bool has_moved = false;  ///< far enough to be meant
};

/// A stretch of the clip, seconds.
struct GridStretch {
    double from = 0.0;
    double to = 0.0;

    friend bool operator==(const GridStretch&, const GridStretch&) = default;
};

/// Beats that a person is setting right, and where they are with it.
struct GridSession {
    std::string take;
    double seconds = 0.0;  ///< of the clip
    History<GridBeats> beats;
    std::optional<std::size_t> chosen;   ///< beat
    std::optional<GridStretch> stretch;  ///< that was marked
    std::optional<HeldBeat> held;        ///< while the button is down
    std::vector<double> taps;            ///< of the run that goes on; a step once it ends
    bool is_new = false;                 ///< no file holds the grid that it began with

    /// Whether a file holds the beats as they are.
    [[nodiscard]] bool is_saved() const { return !is_new && taps.empty() && beats.is_saved(); }
    /// A file holds them now.
    void mark_saved() {
        beats.mark_saved();
        is_new = false;
    }

    /// The beats as they are shown: with what is dragged or tapped just now.
    [[nodiscard]] GridBeats shown() const;
    /// The beats that half, double, shift and even out are about: those of the stretch, else all.
    [[nodiscard]] BeatReach meant() const;
    /// Those that leaving out and using are about: of the stretch, else the one that is chosen.
    [[nodiscard]] BeatReach meant_for_use() const;
};

/// A session that begins with a grid of a clip of so many seconds; the grid counts as saved.
[[nodiscard]] GridSession grid_session(const motion::TakeGrid& grid, double seconds);

/// A beat is chosen, or none.
struct ChooseBeat {
    std::optional<std::size_t> beat;
};
/// The beat after the one that is chosen, or before it.
struct StepBeat {
    bool is_next = true;
};
/// A moment that somebody tapped at.
struct TapBeat {
    double time = 0.0;
};
/// The taps so far become beats, in one step.
struct EndTaps {};
/// A beat is dragged; LetGoOfBeat ends it, as one step.
struct HoldBeat {
    HeldBeat held;
};
/// See HoldBeat.
struct LetGoOfBeat {};
/// The beat that is chosen goes this much later.
struct NudgeBeat {
    double by = 0.0;
};
/// A beat at a moment; it is chosen.
struct InsertBeat {
    double time = 0.0;
};
/// The beat that is chosen goes away.
struct RemoveBeat {};
/// The beats that are meant go this much later.
struct ShiftBeats {
    double by = 0.0;
};
/// Half of them.
struct HalveBeats {};
/// Twice as many.
struct DoubleBeats {};
/// At even distances.
struct EvenBeats {};
/// The beat that is chosen is the 1 of its half bar.
struct MarkOne {};
/// The beats that are meant may not be danced; if none of them may, all may.
struct ToggleUse {};
/// A moment begins the stretch, or ends it.
struct MarkStretch {
    double time = 0.0;
    bool is_first = true;
};
/// Nothing is chosen or marked.
struct ForgetChosen {};
/// Other beats altogether.
struct ReplaceBeats {
    GridBeats beats;
};
/// The last step is taken back.
struct UndoGrid {};
/// Or done again.
struct RedoGrid {};

using GridAction = std::variant<ChooseBeat,
                                StepBeat,
                                TapBeat,
                                EndTaps,
                                HoldBeat,
                                LetGoOfBeat,
                                NudgeBeat,
                                InsertBeat,
                                RemoveBeat,
                                ShiftBeats,
                                HalveBeats,
                                DoubleBeats,
                                EvenBeats,
                                MarkOne,
                                ToggleUse,
                                MarkStretch,
                                ForgetChosen,
                                ReplaceBeats,
                                UndoGrid,
                                RedoGrid>;

/// Does what was asked for. Whatever is no tap ends a run of taps first.
void apply(const GridAction& action, GridSession& session);

}  // namespace raks::apps
