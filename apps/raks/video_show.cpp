#include "apps/raks/video_show.hpp"

#include <utility>

#include "render/video/video_writer.hpp"

namespace raks::apps {

Expected<std::unique_ptr<VideoShow>> VideoShow::create(const VideoArguments& asked,
                                                       const engine::Settings& settings) {
    const auto size = engine::parse_size(settings.size);
    if (!size) {
        return fail(size.error());
    }
    const render::FrameRate rate = render::FrameRate::nearest(engine::film_fps(settings));
    auto output = engine::VideoOutput::open(
        asked.wishes, {size->width, size->height, rate.numerator, rate.denominator});
    if (!output) {
        return fail(output.error());
    }
    return std::unique_ptr<VideoShow>(
        new VideoShow(asked, FilmedStage(settings, *size), std::move(*output)));
}

VideoShow::VideoShow(const VideoArguments& asked,
                     FilmedStage stage,
                     std::unique_ptr<engine::VideoOutput> output)
    : offset_(nanos_from_seconds(asked.offset_ms * 1e-3)),
      has_overlay_(asked.has_overlay),
      output_(std::move(output)),
      stage_(std::move(stage)) {}

// The picture that was drawn last has been copied meanwhile.
void VideoShow::pass_on() {
    if (const auto due = std::exchange(reading_, std::nullopt)) {
        if (const auto picture = stage_.picture()) {
            output_->give(*due, *picture);
        } else {
            give_up(picture.error());
        }
    }
}

void VideoShow::give_up(const Error& why) {
    has_failed_ = true;
    trouble_ = "--video-out: " + why.message;
}

// Where a window takes longer than the outputs' pictures are apart, two are drawn at once: what
// others record goes before the window.
void VideoShow::draw(engine::LiveGraph& graph,
                     const engine::WindowView& view,
                     const FilmedStage::Describe& describe) {
    constexpr int kMostAtOnce = 2;
    drawn_.reset();
    for (int drawn = 0; drawn < kMostAtOnce && !has_failed_; ++drawn) {
        pass_on();
        const engine::StageState& stage = graph.stage();
        const auto due = output_->wanted(std::chrono::time_point_cast<Nanos>(HostClock::now()));
        if (!due || stage.published_at_ns == 0) {
            return;
        }
        const StreamTime moment = graph.passing_at(*due - offset_);
        if (const auto done =
                stage_.draw(stage, moment, view, has_overlay_ ? describe : FilmedStage::Describe());
            !done) {
            give_up(done.error());
            return;
        }
        reading_ = due;
        drawn_ = moment;
    }
}

// What the window adds of its own, such as messages, lies over the picture alone.
bool VideoShow::show(const render::FrameTarget& window, StreamTime moment) {
    // A picture is seen to be out of step from 40 ms on (EBU R37).
    constexpr Nanos kAlike = std::chrono::milliseconds(40);
    const bool is_alike = drawn_ && moment - *drawn_ < kAlike && *drawn_ - moment < kAlike;
    return is_alike && !has_overlay_ && stage_.copy_to(window);
}

std::vector<std::string> VideoShow::take_lines() {
    std::vector<std::string> lines = output_->take_lines();
    if (!trouble_.empty()) {
        lines.push_back(std::exchange(trouble_, {}));
    }
    return lines;
}

}  // namespace raks::apps
