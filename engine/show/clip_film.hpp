// Clip film: frames of a clip as a film, a folder of pictures, or one picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/offscreen.hpp"
#include "render/video/video_writer.hpp"

namespace raks::engine {

/// Which frames of a clip a film shows, one a picture.
struct FilmedFrames {
    std::vector<std::size_t> frames;
    double pictures_per_second = 30.0;
};

/// The frames of a whole clip played once at `rate` (not 0; < 0: from its end), at the clip's own
/// number of pictures a second where that is at most 60, else the largest whole part of it that is.
/// `frame_count` >= 1, `frames_per_second` > 0. Pure.
[[nodiscard]] FilmedFrames filmed_frames(std::size_t frame_count,
                                         double frames_per_second,
                                         double rate = 1.0);

/// A film to write.
struct ClipFilmPlan {
    std::filesystem::path
        output;          ///< a film or a folder, as VideoWriter has them; X.png: a picture
    PictureSize size;    ///< pixels
    FilmedFrames shown;  ///< of a picture the first
    render::VideoQuality quality = render::VideoQuality::normal;
    int samples = 1;  ///< a pixel: Renderer::samples
};

/// Draws one frame of the clip into a target.
using DrawFrame = std::function<void(std::size_t frame, const render::FrameTarget& target)>;
/// Told the share that is done, [0, 1]; false: stop here and keep what there is.
using FilmProgress = std::function<bool(double share)>;

/// Whether a path is one that write_clip_film writes: the errors of it that show before any work.
[[nodiscard]] Expected<void> check_clip_film(const ClipFilmPlan& plan);

/// A film that is written picture by picture, by whoever has other things to do between. One that
/// is destroyed before finish() leaves nothing behind. An OpenGL context must be current, always
/// the same. Threads: the context's.
class ClipFilm {
 public:
    /// Errors: those of the film, the file and the target.
    [[nodiscard]] static Expected<ClipFilm> begin(ClipFilmPlan plan);
    /// Pictures that are in it, of all; [0, 1].
    [[nodiscard]] double share() const noexcept;
    /// Draws the next picture; nothing where share() is 1. Errors: as begin.
    [[nodiscard]] Expected<void> add_next(const DrawFrame& draw);
    /// Ends it with what there is. Errors: as begin.
    [[nodiscard]] Expected<void> finish();
    /// As finish(), of a film that was to be longer: what has its name stays, and the film lies
    /// beside it under the path that is returned (VideoWriter::finish_stopped).
    [[nodiscard]] Expected<std::filesystem::path> finish_stopped();

 private:
    ClipFilm(ClipFilmPlan plan, render::OffscreenTarget target);

    ClipFilmPlan plan_;
    render::OffscreenTarget target_;
    std::unique_ptr<render::VideoWriter> writer_;  // null: a picture
    std::vector<std::uint8_t> rgba_;
    std::size_t done_ = 0;
};

/// Draws all frames of the plan and writes them. Returns the file: the plan's output, or where
/// `progress` ended it, that of ClipFilm::finish_stopped. An OpenGL context must be current:
/// whatever the caller draws with lives in it. Errors: those of the film, the file and the target.
/// Threads: the context's.
[[nodiscard]] Expected<std::filesystem::path> write_clip_film(const ClipFilmPlan& plan,
                                                              const DrawFrame& draw,
                                                              const FilmProgress& progress);

}  // namespace raks::engine
