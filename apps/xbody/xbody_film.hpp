// A picture or a film of a model with its bones, without a window.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/xbody/shown_model.hpp"
#include "apps/xbody/xbody_marks.hpp"
#include "apps/xbody/xbody_stage.hpp"
#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/clip_film.hpp"
#include "render/panes/pane_host.hpp"

namespace raks::apps {

/// What is drawn.
struct XbodyFilmPlan {
    std::filesystem::path output;      ///< X.png, .mp4, .avi, .mkv, .webm, or a folder
    std::optional<std::size_t> frame;  ///< of the clip, alone; none: of a picture 0, of a film all
    double rate = 1.0;                 ///< of a film; -2 to 4, not 0
    std::string view = "front";        ///< or side, back, top
    engine::PictureSize size{960, 720};  ///< pixels
    bool has_names = false;              ///< beside the bones
};

/// Errors that show before anything is read: a kind of film that cannot be written, those of
/// VideoWriter.
[[nodiscard]] Expected<void> check_xbody_film(const XbodyFilmPlan& plan);

/// Draws the model off-screen and writes it. The camera has all that the clip reaches. Errors: a
/// frame that the clip does not have, no OpenGL, those of the file. `progress` and what is
/// returned: as of write_clip_film. Threads: main.
[[nodiscard]] Expected<std::filesystem::path> write_xbody_film(
    const XbodyFilmPlan& plan, ShownModel model, const engine::FilmProgress& progress);

/// Draws one picture of the stage as it stands, with its marks, into a target. `scale`: pixels a
/// unit of the marks.
void draw_xbody_picture(XbodyStage& stage,
                        const render::HumanoidMap& humanoid,
                        const std::vector<bool>& is_hidden,
                        const render::Camera& camera,
                        const XbodyMarks& marks,
                        float scale,
                        render::PaneHost& host,
                        const render::FrameTarget& target);

}  // namespace raks::apps
