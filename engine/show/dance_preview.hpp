#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "base/key.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::engine {

/// Shows a written dance while it is being written: dances one of its figures in a loop at a tempo,
/// and reads the file again whenever it is saved. A fault of a newly saved text is reported, and
/// the last good one goes on.
///
/// Keys: left and right go to the figure before and after, up and down change the tempo, space
/// pauses.
/// Threads: one.
class DancePreview {
 public:
    /// `path`: the dance's file. `figure`: the one to begin with; empty: the first. `tempo`: none:
    /// as written. Errors: those of load_written_dance and find_figure.
    [[nodiscard]] static Expected<DancePreview> create(const std::filesystem::path& path,
                                                       const std::string& figure,
                                                       std::optional<Bpm> tempo);

    /// Checks whether the file was saved since the last call, and reads it then. True: another
    /// dance is shown, or another fault is reported.
    bool refresh();
    /// Moves on by `seconds` of time; does nothing in a pause.
    void advance(double seconds);
    /// Carries out a key of the list above. False: the key means nothing here.
    bool handle(const KeyEvent& key);

    /// The pose at the present beat, in the skeleton's space.
    [[nodiscard]] motion::Pose pose() const;
    /// Poses of one repeat (of a mirrored figure both sides), `per_beat` a beat, for a contact
    /// sheet.
    [[nodiscard]] std::vector<motion::Pose> sheet(int per_beat) const;
    /// Beats of the sheet of figure `number` (of figures()).
    [[nodiscard]] int beats_of_sheet(std::size_t number) const;

    /// "hip_drop   108 BPM   beat 2.4 of 4", or the fault of the file that was saved last.
    [[nodiscard]] std::string status() const;
    /// What is wrong with the file that was saved last; empty: nothing.
    [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
    /// Name of the figure that is shown.
    [[nodiscard]] std::string_view figure() const noexcept;
    /// Names of all figures, in the file's order.
    [[nodiscard]] std::vector<std::string> figures() const;

    /// Shows the figure of this number, in the file's order, from its first beat.
    void show(std::size_t figure);

 private:
    DancePreview() = default;
    [[nodiscard]] motion::Pose at_beat(double beat) const;
    void take(motion::AuthoredDance dance);
    void evaluate();

    std::filesystem::path path_;
    std::filesystem::file_time_type saved_;
    motion::AuthoredDance dance_;
    motion::EvaluatedFigure evaluated_;
    std::optional<Bpm> tempo_;
    std::size_t shown_ = 0;
    double beat_ = 0.0;
    bool is_paused_ = false;
    std::string fault_;
};

}  // namespace raks::engine
