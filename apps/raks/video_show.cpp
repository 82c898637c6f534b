#include "apps/raks/video_show.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "motion/skeleton/skeleton.hpp"
#include "render/video/video_writer.hpp"

namespace raks::apps {
namespace {

bool wear_the_same(const engine::DancerBodies& one, const engine::DancerBodies& other) {
    const auto& a = one.wardrobe();
    const auto& b = other.wardrobe();
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(), [](const auto& builds, const auto& others) {
            return std::equal(builds.begin(),
                              builds.end(),
                              others.begin(),
                              others.end(),
                              [](const auto& body, const auto& another) {
                                  return body.handle.number == another.handle.number &&
                                         body.avatar == another.avatar;
                              });
        });
}

}  // namespace

void follow_stage(engine::Staging& staging, const engine::StageState& stage) {
    const HopIndex newest = stage.music.hop;
    const HopIndex oldest = newest - static_cast<HopIndex>(engine::StageState::kRecent) + 1;
    const HopIndex last = staging.last_hop().value_or(-1);
    for (HopIndex hop = std::max({last + 1, oldest, HopIndex{0}}); hop <= newest; ++hop) {
        if (const MusicState* const state = stage.state_of(hop)) {
            staging.advance(*state, std::span(stage.tracks).first(stage.dancers));
        }
    }
}

engine::ShownMoment shown_moment(const engine::StageState& stage, StreamTime moment) {
    return {stage.music,
            stage.dancer,
            {.tracks = std::span(stage.tracks).first(stage.dancers),
             .places = std::span(stage.places).first(stage.dancers),
             .moment = moment}};
}

Expected<std::unique_ptr<VideoShow>> VideoShow::create(const VideoArguments& asked,
                                                       const engine::Settings& settings,
                                                       std::shared_ptr<const DanceList> dances) {
    const auto size = engine::parse_size(settings.size);
    if (!size) {
        return fail(size.error());
    }
    const render::FrameRate rate = render::FrameRate::nearest(settings.fps);
    auto output = engine::VideoOutput::open(
        asked.wishes, {size->width, size->height, rate.numerator, rate.denominator});
    if (!output) {
        return fail(output.error());
    }
    return std::unique_ptr<VideoShow>(
        new VideoShow(asked, settings, std::move(dances), std::move(*output)));
}

VideoShow::VideoShow(const VideoArguments& asked,
                     const engine::Settings& settings,
                     std::shared_ptr<const DanceList> dances,
                     std::unique_ptr<engine::VideoOutput> output)
    : dances_(std::move(dances)),
      offset_(nanos_from_seconds(asked.offset_ms * 1e-3)),
      has_overlay_(asked.has_overlay),
      output_(std::move(output)),
      staging_(static_cast<std::uint64_t>(settings.seed),
               settings.calm ? render::Liveliness::calm : render::Liveliness::usual),
      rgba_(output_->format().bytes()) {}

// The picture that was drawn last has been copied meanwhile.
void VideoShow::pass_on() {
    if (const auto due = std::exchange(reading_, std::nullopt)) {
        if (const auto read = target_->finish_reading(rgba_); read) {
            output_->give(*due, rgba_);
        } else {
            has_failed_ = true;
            trouble_ = "--video-out: " + read.error().message;
        }
    }
}

// False: the driver refuses, and has done so before.
bool VideoShow::make_target(int samples) {
    if (!target_ && !has_failed_) {
        auto made = render::OffscreenTarget::create({.width = output_->format().width,
                                                     .height = output_->format().height,
                                                     .samples = samples});
        if (made) {
            target_.emplace(std::move(*made));
        } else {
            has_failed_ = true;
            trouble_ = "--video-out: " + made.error().message;
        }
    }
    return target_ && !has_failed_;
}

engine::DancerBodies& VideoShow::bodies_as(const engine::DancerBodies& shown) {
    if (!bodies_ || !wear_the_same(*bodies_, shown)) {
        bodies_.emplace(shown.wardrobe(), motion::mannequin_skeleton(), shown.habits());
    }
    return *bodies_;
}

// Where a window takes longer than the outputs' pictures are apart, two are drawn at once: what
// others record goes before the window.
void VideoShow::draw(engine::LiveGraph& graph,
                     const engine::WindowView& view,
                     const std::function<void(render::OverlayState&)>& describe) {
    constexpr int kMostAtOnce = 2;
    for (int drawn = 0; drawn < kMostAtOnce; ++drawn) {
        pass_on();
        const auto due = output_->wanted(std::chrono::time_point_cast<Nanos>(HostClock::now()));
        if (!due || graph.stage().published_at_ns == 0 ||
            !make_target(view.drawing.renderer.samples())) {
            return;
        }
        draw_picture(*due, graph, view, describe);
    }
}

void VideoShow::draw_picture(HostTime due,
                             engine::LiveGraph& graph,
                             const engine::WindowView& view,
                             const std::function<void(render::OverlayState&)>& describe) {
    const engine::StageState& stage = graph.stage();
    engine::DancerBodies& bodies = bodies_as(view.drawing.bodies);
    const render::FrameTarget frame = target_->frame();
    const engine::ShownMoment shown = shown_moment(stage, graph.passing_at(due - offset_));
    render::Scene scene = view.scene;
    staging_.set_picture(static_cast<float>(frame.width) / static_cast<float>(frame.height),
                         bodies.size());
    follow_stage(staging_, stage);
    staging_.set(scene, view.camera, {.time = shown.danced.moment}, shown.danced.tracks);
    engine::draw_moment(shown, view.drawing.renderer, bodies, scene, frame);
    if (has_overlay_) {
        render::OverlayState info;
        describe_moment(shown, *dances_, info);
        describe(info);
        constexpr float kOrdinaryMonitor = 1.0F;
        view.drawing.overlay.draw(info, render::OverlayView::shown, frame, kOrdinaryMonitor);
    }
    target_->begin_reading();
    reading_ = due;
}

std::vector<std::string> VideoShow::take_lines() {
    std::vector<std::string> lines = output_->take_lines();
    if (!trouble_.empty()) {
        lines.push_back(std::exchange(trouble_, {}));
    }
    return lines;
}

}  // namespace raks::apps
