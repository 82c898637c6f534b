#include "apps/xbody/window_film.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

engine::FilmedFrames frames_of(const ShownModel& model, const XbodySession& session) {
    // A clip that stands still has no end.
    const double rate = session.transport.rate();
    return engine::filmed_frames(model.frame_count(), model.rate(), rate == 0.0 ? 1.0 : rate);
}

}  // namespace

fs::path free_film_name(const fs::path& folder, const fs::path& model, const std::string& ending) {
    constexpr int kMost = 10'000;
    fs::path path;
    for (int number = 1; number < kMost; ++number) {
        path = folder / fmt::format("raks-{}-{}{}", model.stem().string(), number, ending);
        std::error_code error;
        if (!fs::exists(path, error)) {
            break;
        }
    }
    return path;
}

WindowFilm::WindowFilm(fs::path file,
                       engine::ClipFilm film,
                       const XbodySession& session,
                       float unit)
    : file_(std::move(file)),
      film_(std::move(film)),
      humanoid_(session.humanoid),
      is_hidden_(session.tree.is_hidden),
      camera_(session.camera),
      marks_(session.marks()),
      tuning_(session.tuning),
      unit_(unit) {}

Expected<WindowFilm> WindowFilm::begin(fs::path file,
                                       const XbodyStage& stage,
                                       const XbodySession& session,
                                       const engine::PictureSize& size,
                                       float unit) {
    constexpr int kSmallest = 16;  // of a film's sides
    engine::ClipFilmPlan plan{
        .output = file,
        .size = {std::max(size.width / 2 * 2, kSmallest), std::max(size.height / 2 * 2, kSmallest)},
        .shown = frames_of(stage.model(), session),
        .quality = render::VideoQuality::high,
        .samples = stage.samples()};
    if (file.extension() == ".png") {
        plan.shown.frames = {session.transport.frame()};
    }
    auto film = engine::ClipFilm::begin(std::move(plan));
    if (!film) {
        return fail(std::move(film.error()));
    }
    return WindowFilm(std::move(file), std::move(*film), session, unit);
}

Expected<void> WindowFilm::add_next(XbodyStage& stage, render::PaneHost& host) {
    return film_.add_next([&](std::size_t frame, const render::FrameTarget& target) {
        stage.show(frame, tuning_);
        draw_xbody_picture(stage, humanoid_, is_hidden_, camera_, marks_, unit_, host, target);
    });
}

}  // namespace raks::apps
