// Learning line: the command line that learns a captured dance.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/expected.hpp"
#include "training/figures/label_counts.hpp"

namespace raks::apps {

/// The song of a captured dance, and where in it the motion begins.
struct FilmedSong {
    std::filesystem::path file;
    motion::DancedMusic music;  ///< its beats; `offset` is the second at the motion's first frame
};

/// What can be learnt of a motion.
enum class Learnable {
    figure,  ///< three repeats of one figure or more are alike
    take,    ///< it is improvised: it repeats less than that
};

/// Looks for a figure in the motion by the beats of the song, without a song by those of the feet:
/// what `raks train figure` would find. Motion in which nothing can be found is a take.
/// Threads: workers. Real-time: no (a second or two for a minute of motion).
[[nodiscard]] Learnable what_can_be_learnt(const std::filesystem::path& clip,
                                           const std::optional<motion::DancedMusic>& music);

/// The line that learns it as a dance "mine", to be pasted into a shell: `raks train figure` or, of
/// what is improvised, `raks train take`, with the song and where in it the motion begins; without
/// a song a take is learnt as one phrase, since nothing tells its beats for sure.
[[nodiscard]] std::string learning_line(const std::filesystem::path& clip,
                                        const std::optional<FilmedSong>& song,
                                        Learnable what);

}  // namespace raks::apps
