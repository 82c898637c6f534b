#include "engine/show/clip_film.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/video/png.hpp"

namespace raks::engine {
namespace {

constexpr double kMostPicturesPerSecond = 60.0;

bool is_picture(const ClipFilmPlan& plan) { return plan.output.extension() == ".png"; }

render::VideoOptions options_of(const ClipFilmPlan& plan) {
    render::VideoOptions options;
    options.width = plan.size.width;
    options.height = plan.size.height;
    options.rate = render::FrameRate::nearest(plan.shown.pictures_per_second);
    options.quality = plan.quality;
    options.audio_channels = 0;
    return options;
}

}  // namespace

FilmedFrames filmed_frames(std::size_t frame_count, double frames_per_second, double rate) {
    FilmedFrames filmed;
    // A rate that a decimal number shows a little above 60 is 60.
    const double parts =
        std::max(std::ceil(frames_per_second / kMostPicturesPerSecond - 1e-3), 1.0);
    filmed.pictures_per_second = std::max(frames_per_second / parts, 1.0);
    const double step = std::abs(rate) * frames_per_second / filmed.pictures_per_second;
    const auto last = static_cast<double>(frame_count - 1);
    for (std::size_t picture = 0;; ++picture) {
        // A little more, so that rounding does not show a frame twice.
        const double at = std::floor(static_cast<double>(picture) * step + 1e-6);
        if (at > last) {
            return filmed;
        }
        filmed.frames.push_back(static_cast<std::size_t>(rate < 0.0 ? last - at : at));
    }
}

Expected<void> check_clip_film(const ClipFilmPlan& plan) {
    return is_picture(plan) ? Expected<void>()
                            : render::VideoWriter::check(plan.output, options_of(plan));
}

ClipFilm::ClipFilm(ClipFilmPlan plan, render::OffscreenTarget target)
    : plan_(std::move(plan)),
      target_(std::move(target)),
      rgba_(static_cast<std::size_t>(plan_.size.width) *
            static_cast<std::size_t>(plan_.size.height) * 4U) {}

Expected<ClipFilm> ClipFilm::begin(ClipFilmPlan plan) {
    auto target = render::OffscreenTarget::create(
        {.width = plan.size.width, .height = plan.size.height, .samples = plan.samples});
    if (!target) {
        return fail(std::move(target.error()));
    }
    ClipFilm film(std::move(plan), std::move(*target));
    if (is_picture(film.plan_)) {
        film.plan_.shown.frames.resize(1);
        return film;
    }
    auto writer = render::VideoWriter::create(film.plan_.output, options_of(film.plan_));
    if (!writer) {
        return fail(std::move(writer.error()));
    }
    film.writer_ = std::move(*writer);
    return film;
}

double ClipFilm::share() const noexcept {
    return static_cast<double>(done_) / static_cast<double>(plan_.shown.frames.size());
}

Expected<void> ClipFilm::add_next(const DrawFrame& draw) {
    if (done_ == plan_.shown.frames.size()) {
        return {};
    }
    draw(plan_.shown.frames[done_], target_.frame());
    if (auto read = target_.read_rgba(rgba_); !read) {
        return read;
    }
    ++done_;
    return writer_ ? writer_->add_picture(rgba_)
                   : render::write_png(plan_.output, plan_.size.width, plan_.size.height, rgba_);
}

Expected<void> ClipFilm::finish() { return writer_ ? writer_->finish() : Expected<void>(); }

Expected<std::filesystem::path> ClipFilm::finish_stopped() {
    return writer_ ? writer_->finish_stopped() : Expected<std::filesystem::path>(plan_.output);
}

Expected<std::filesystem::path> write_clip_film(const ClipFilmPlan& plan,
                                                const DrawFrame& draw,
                                                const FilmProgress& progress) {
    auto film = ClipFilm::begin(plan);
    if (!film) {
        return fail(std::move(film.error()));
    }
    while (film->share() < 1.0) {
        if (auto added = film->add_next(draw); !added) {
            return fail(std::move(added.error()));
        }
        if (!progress(film->share()) && film->share() < 1.0) {
            return film->finish_stopped();
        }
    }
    auto finished = film->finish();
    return finished ? Expected<std::filesystem::path>(plan.output)
                    : fail(std::move(finished.error()));
}

}  // namespace raks::engine
