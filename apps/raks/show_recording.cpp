#include "apps/raks/show_recording.hpp"

#include <utility>

namespace raks::apps {

Expected<void> ShowRecording::start(const Path& file) {
    const auto size = engine::parse_size(settings_.size);
    if (!size) {
        return fail(size.error());
    }
    if (!tap_) {
        tap_ = std::make_unique<engine::SoundTap>();
    }
    render::VideoOptions options;
    options.width = size->width;
    options.height = size->height;
    options.rate = render::FrameRate::nearest(engine::film_fps(settings_));
    // Beside drawing and playing, encoding must be quick.
    options.quality =
        settings_.quality == "high" ? render::VideoQuality::normal : render::VideoQuality::draft;
    options.has_alpha =
        settings_.backdrop == "transparent" && render::VideoWriter::keeps_alpha(file);
    auto recorder = Recorder::start(file, options, *tap_);
    if (!recorder) {
        return fail(recorder.error());
    }
    recorder_ = std::move(*recorder);
    stage_.emplace(settings_, *size);
    is_reading_ = false;
    return {};
}

void ShowRecording::follow(engine::LiveGraph& graph) {
    if (recorder_) {
        stage_->begin_anew();
        tap_->set_source(++source_);
        recorder_->follow(source_);
        graph.analysis().set_tap(engine::AnalysisStage::Listener::recording, tap_.get());
    }
}

Expected<void> ShowRecording::draw(engine::LiveGraph& graph,
                                   const engine::WindowView& view,
                                   const FilmedStage::Describe& describe) {
    if (!recorder_) {
        return {};
    }
    if (std::exchange(is_reading_, false)) {
        const auto picture = stage_->picture();
        if (!picture) {
            recorder_.reset();
            return fail(picture.error());
        }
        recorder_->give(*picture);
    }
    const engine::StageState& stage = graph.stage();
    const auto moment =
        recorder_->wanted(graph.passing_at(std::chrono::time_point_cast<Nanos>(HostClock::now())));
    if (!moment || stage.published_at_ns == 0) {
        return {};
    }
    auto drawn = stage_->draw(stage, *moment, view, describe);
    if (!drawn) {
        recorder_.reset();
    }
    is_reading_ = drawn.has_value();
    return drawn;
}

std::optional<std::string> ShowRecording::take_trouble() {
    auto trouble = recorder_ ? recorder_->take_trouble() : std::nullopt;
    if (trouble) {
        recorder_.reset();
    }
    return trouble;
}

std::string ShowRecording::stop(engine::LiveGraph* graph) {
    if (graph != nullptr) {
        graph->analysis().set_tap(engine::AnalysisStage::Listener::recording, nullptr);
    }
    const std::unique_ptr<Recorder> ended = std::exchange(recorder_, nullptr);
    return ended ? ended->stop() : std::string();
}

}  // namespace raks::apps
