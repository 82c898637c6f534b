#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/video_sink.hpp"

namespace raks::engine {

/// A video stream of PipeWire that others can show and record, with alpha: RGBA, premultiplied, as
/// the tools that lay such streams over others expect (libfunnel, obs-pwvideo). `name`: by which
/// people find it. Where no PipeWire runs, or it dies, it says so once and tries again each second.
/// It comes from a module that is loaded when it is asked for (pipewire_module.cpp).
/// Errors: the module is not there.
[[nodiscard]] Expected<std::unique_ptr<VideoSink>> open_pipewire_sink(const std::string& name,
                                                                      const VideoFormat& format);

/// What the module's function gives.
using OpenedVideoSink = Expected<std::unique_ptr<VideoSink>>;
/// As open_pipewire_sink(), into `sink`.
using OpenPipewire = void (*)(const std::string& name,
                              const VideoFormat& format,
                              OpenedVideoSink& sink);
/// Under which the module has it. Of another build: another name.
inline constexpr const char* kOpenPipewire = "raks_open_pipewire_1";

}  // namespace raks::engine
