#include "apps/clips/clip_reading.hpp"

#include <utility>

#include "base/file.hpp"
#include "render/import/model_motion.hpp"

namespace raks::apps {

motion::MotionReadOptions clip_reading(double fps,
                                       const std::filesystem::path& skeleton,
                                       std::optional<double> arm_angle) {
    motion::MotionReadOptions options;
    if (fps > 0.0) {
        options.frames_per_second = fps;
    }
    options.skeleton = skeleton;
    options.arm_angle = arm_angle;
    options.read_model = [](const motion::ClipAddress& address,
                            std::optional<double> frames_per_second) {
        return render::read_model_motion(address.file, address.clip, frames_per_second);
    };
    return options;
}

Expected<void> check_clip_options(const JointArguments& joints,
                                  const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) {
        if (auto start = read_file_start(file, 1); !file.empty() && !start) {
            return fail(std::move(start.error()));
        }
    }
    auto labels = joints.labels();
    return labels ? Expected<void>() : fail(std::move(labels.error()));
}

}  // namespace raks::apps
