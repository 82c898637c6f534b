// Window film: what the Xbody window shows, written picture by picture while it is used.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/xbody/xbody_film.hpp"
#include "apps/xbody/xbody_session.hpp"
#include "apps/xbody/xbody_stage.hpp"
#include "base/expected.hpp"
#include "engine/show/clip_film.hpp"

namespace raks::apps {

/// The file of a picture or film of a model in a folder: raks-STEM-1.mp4, or the first number that
/// is free. `ending`: with its dot; "": a folder of pictures.
[[nodiscard]] std::filesystem::path free_film_name(const std::filesystem::path& folder,
                                                   const std::filesystem::path& model,
                                                   const std::string& ending);

/// A film of a stage with the view, marks and sliders that a session has when it begins. One that
/// is destroyed before finish() leaves nothing behind. Threads: the one of the OpenGL context.
class WindowFilm {
 public:
    /// Of a picture the session's frame, of a film all, at the session's rate. `size`: pixels of
    /// the view; made even. Errors: those of ClipFilm.
    [[nodiscard]] static Expected<WindowFilm> begin(std::filesystem::path file,
                                                    const XbodyStage& stage,
                                                    const XbodySession& session,
                                                    const engine::PictureSize& size,
                                                    float unit);
    [[nodiscard]] double share() const noexcept { return film_.share(); }
    [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
    /// Draws a picture; the stage stands at another frame then. Errors: as begin.
    [[nodiscard]] Expected<void> add_next(XbodyStage& stage, render::PaneHost& host);
    /// Errors: as begin.
    [[nodiscard]] Expected<void> finish() { return film_.finish(); }

 private:
    WindowFilm(std::filesystem::path file,
               engine::ClipFilm film,
               const XbodySession& session,
               float unit);

    std::filesystem::path file_;
    engine::ClipFilm film_;
    render::HumanoidMap humanoid_;
    std::vector<bool> is_hidden_;
    render::Camera camera_;
    XbodyMarks marks_;
    PoseTuning tuning_;
    float unit_;
};

}  // namespace raks::apps
