// Camera motion: a file that moves the camera of a show.
#pragma once

#include <filesystem>
#include <utility>

#include "base/expected.hpp"
#include "motion/skeleton/formats/mmd/vmd_camera.hpp"
#include "render/scene/camera.hpp"

namespace raks::engine {

/// A camera's VMD. Threads: one. Real-time: no.
class CameraMotion {
 public:
    /// Errors: those of reading and of motion::MmdCameraPath::parse.
    [[nodiscard]] static Expected<CameraMotion> load(const std::filesystem::path& file);

    /// The camera at seconds of the show. `size`: of the dancers against the mannequin's 1. It
    /// stands as much farther and higher as they are taller than MikuMikuDance's bodies.
    [[nodiscard]] render::Camera at(double seconds, float size = 1.0F) const;

 private:
    explicit CameraMotion(motion::MmdCameraPath path) : path_(std::move(path)) {}

    motion::MmdCameraPath path_;
};

/// A view of MikuMikuDance as a camera of ours. Pure.
[[nodiscard]] render::Camera camera_of(const motion::MmdView& view, float size);

}  // namespace raks::engine
