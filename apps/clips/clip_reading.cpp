#include "apps/clips/clip_reading.hpp"

#include "render/import/model_motion.hpp"

namespace raks::apps {

motion::MotionReadOptions clip_reading(double fps, const std::filesystem::path& skeleton) {
    motion::MotionReadOptions options;
    if (fps > 0.0) {
        options.frames_per_second = fps;
    }
    options.skeleton = skeleton;
    options.read_model = [](const motion::ClipAddress& address,
                            std::optional<double> frames_per_second) {
        return render::read_model_motion(address.file, address.clip, frames_per_second);
    };
    return options;
}

}  // namespace raks::apps
