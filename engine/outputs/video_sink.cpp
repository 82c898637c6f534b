#include "engine/outputs/video_sink.hpp"

#include <string_view>

#include "engine/outputs/pipewire_sink.hpp"
#include "engine/outputs/video_pipe.hpp"

namespace raks::engine {

Expected<std::unique_ptr<VideoSink>> open_video_sink(const VideoWish& wish,
                                                     const VideoFormat& format) {
    constexpr std::string_view kPipewire = "pipewire";
    const std::string_view target = wish.target;
    if (target == kPipewire) {
        return open_pipewire_sink("Raks", format);
    }
    if (target.substr(0, kPipewire.size()) == kPipewire && target[kPipewire.size()] == ':') {
        const std::string_view name = target.substr(kPipewire.size() + 1);
        return name.empty() ? fail("--video-out pipewire: has no name behind the colon")
                            : open_pipewire_sink(std::string(name), format);
    }
    return open_video_pipe(wish.target, wish.form, format);
}

}  // namespace raks::engine
