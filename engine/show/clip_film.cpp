#include "engine/show/clip_film.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/gl/offscreen.hpp"
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

Expected<void> write_clip_film(const ClipFilmPlan& plan,
                               const DrawFrame& draw,
                               const FilmProgress& progress) {
    auto target = render::OffscreenTarget::create(
        {.width = plan.size.width, .height = plan.size.height, .samples = plan.samples});
    if (!target) {
        return fail(std::move(target.error()));
    }
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(plan.size.width) *
                                   static_cast<std::size_t>(plan.size.height) * 4U);
    if (is_picture(plan)) {
        draw(plan.shown.frames.front(), target->frame());
        if (auto read = target->read_rgba(rgba); !read) {
            return read;
        }
        return render::write_png(plan.output, plan.size.width, plan.size.height, rgba);
    }
    auto writer = render::VideoWriter::create(plan.output, options_of(plan));
    if (!writer) {
        return fail(std::move(writer.error()));
    }
    const auto count = static_cast<double>(plan.shown.frames.size());
    double done = 0.0;
    for (const std::size_t frame : plan.shown.frames) {
        draw(frame, target->frame());
        if (auto read = target->read_rgba(rgba); !read) {
            return read;
        }
        if (auto added = (*writer)->add_picture(rgba); !added) {
            return added;
        }
        done += 1.0;
        if (!progress(done / count)) {
            break;
        }
    }
    return (*writer)->finish();
}

}  // namespace raks::engine
