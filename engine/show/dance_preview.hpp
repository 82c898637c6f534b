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

/// A written dance while it is being written: dances one figure of it round and round at a tempo,
/// and the file's newer text as soon as it is saved. A faulty save is told and the last good dance
/// goes on.
///
/// Keys: left and right go to the figure before and after, up and down change the tempo, space
/// pauses.
/// Threads: one.
class DancePreview {
 public:
    /// `figure`: the one to begin with; empty: the first. `tempo`: none: as written. Errors: those
    /// of the reader and of faults_in_motion; no such figure.
    [[nodiscard]] static Expected<DancePreview> create(const std::filesystem::path& path,
                                                       const std::string& figure,
                                                       std::optional<Bpm> tempo);

    /// Looks whether the file was saved since, and reads it then. True: another dance is shown, or
    /// another fault is told.
    bool refresh();
    /// Time went by.
    void advance(double seconds);
    /// False: the key means nothing here.
    bool handle(const KeyEvent& key);

    /// As danced now.
    [[nodiscard]] motion::Pose pose() const;
    /// One repeat (of a mirrored figure both sides), `per_beat` poses a beat.
    [[nodiscard]] std::vector<motion::Pose> sheet(int per_beat) const;

    /// "hip_drop  108 BPM  beat 2.4", or what is wrong with the file that was saved last.
    [[nodiscard]] std::string status() const;
    [[nodiscard]] const std::string& fault() const noexcept { return fault_; }
    [[nodiscard]] std::string_view figure() const noexcept;
    [[nodiscard]] std::vector<std::string> figures() const;

    /// Shows the figure of this number.
    void show(std::size_t figure);

 private:
    DancePreview() = default;
    [[nodiscard]] Expected<motion::AuthoredDance> read() const;
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
