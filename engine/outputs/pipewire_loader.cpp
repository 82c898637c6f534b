#include "base/program_parts.hpp"
#include "engine/outputs/pipewire_sink.hpp"

namespace raks::engine {

Expected<std::unique_ptr<VideoSink>> open_pipewire_sink(const std::string& name,
                                                        const VideoFormat& format) {
    constexpr const char* kModule = "raks-pipewire.so";
    if (!find_program_part(kModule, "lib/raks", "RAKS_PIPEWIRE_MODULE")) {
        return fail(
            "--video-out pipewire: Raks was built without PipeWire; \"scripts/build.sh stream\" "
            "builds it with");
    }
    static const Expected<void*> open =
        load_program_part(kModule, "lib/raks", "RAKS_PIPEWIRE_MODULE", kOpenPipewire);
    if (!open) {
        return fail("--video-out pipewire: " + open.error().message);
    }
    OpenedVideoSink sink;
    reinterpret_cast<OpenPipewire> (*open)(name, format, sink);
    return sink;
}

}  // namespace raks::engine
