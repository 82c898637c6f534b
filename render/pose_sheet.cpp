#include "render/pose_sheet.hpp"

#include "render/gl/offscreen.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace raks::render {
namespace {

/// A preset framed for a narrow tile.
Camera tile_camera(const char* name) {
    Camera camera = find_camera(name).value_or(Camera{});
    camera.distance = 5.2F;  // hands over the head and a long step stay inside a 3:4 tile
    camera.target.y = 1.0F;
    return camera;
}

/// What would otherwise divide by zero or draw nothing.
Expected<void> validate(const PoseSheetConfig& config, std::size_t poses) {
    if (poses == 0) {
        return fail("a pose sheet needs at least one pose");
    }
    if (config.cameras.empty()) {
        return fail("a pose sheet needs at least one camera");
    }
    if (config.columns < 1) {
        return fail("a pose sheet of " + std::to_string(config.columns) +
                    " columns, must be at least 1");
    }
    if (config.tile_width < 1 || config.tile_height < 1) {
        return fail("a pose sheet with tiles of " + std::to_string(config.tile_width) + "x" +
                    std::to_string(config.tile_height) + " pixels, each side must be at least 1");
    }
    return {};
}

/// Where tile (row, column) lies in the target; row 0 is at the top.
FrameTarget tile(const FrameTarget& sheet,
                 const PoseSheetConfig& config,
                 std::size_t row,
                 std::size_t column) {
    FrameTarget place = sheet;
    place.width = config.tile_width;
    place.height = config.tile_height;
    place.x = static_cast<int>(column) * config.tile_width;
    place.y = sheet.height - (static_cast<int>(row) + 1) * config.tile_height;
    return place;
}

/// Where the camera looks: under or over the hips.
glm::vec3 hips_of(const motion::Pose& pose) { return pose.hips_position; }
glm::vec3 hips_of(const ClipBody& body) { return body.landmarks.position(motion::Bone::hips); }

/// One sheet of poses or of recorded bodies: all tiles go into one target, which is read once.
template <typename Body>
Expected<PoseSheet> draw_sheet(Renderer& renderer,
                               const Scene& scene,
                               std::span<const Body> poses,
                               const PoseSheetConfig& config) {
    if (Expected<void> valid = validate(config, poses.size()); !valid) {
        return fail(std::move(valid.error()));
    }
    const std::size_t columns = std::min(static_cast<std::size_t>(config.columns), poses.size());
    // A band is one row of poses; it has a row of tiles for each camera.
    const std::size_t bands = (poses.size() + columns - 1) / columns;  // of poses
    const std::size_t rows = bands * config.cameras.size();
    // In 64 bits: OffscreenTarget refuses what is too large, but it must not wrap on the way.
    const auto width = static_cast<std::int64_t>(columns) * config.tile_width;
    const auto height = static_cast<std::int64_t>(rows) * config.tile_height;
    if (width > OffscreenTarget::kMaxSide || height > OffscreenTarget::kMaxSide) {
        return fail("a pose sheet of " + std::to_string(width) + "x" + std::to_string(height) +
                    " pixels, at most " + std::to_string(OffscreenTarget::kMaxSide) + " a side");
    }
    Expected<OffscreenTarget> target = OffscreenTarget::create({.width = static_cast<int>(width),
                                                                .height = static_cast<int>(height),
                                                                .samples = config.samples});
    if (!target) {
        return fail(std::move(target.error()));
    }
    Scene tile_scene = scene;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (std::size_t view = 0; view < config.cameras.size(); ++view) {
            tile_scene.camera = config.cameras[view];
            tile_scene.camera.pan_to(hips_of(poses[i]));
            const std::size_t row = i / columns * config.cameras.size() + view;
            renderer.draw(tile_scene, poses[i], tile(target->frame(), config, row, i % columns));
        }
    }
    // Places without a pose at the end of the last band are left as the driver allocated them.
    PoseSheet sheet{static_cast<int>(width), static_cast<int>(height), {}};
    sheet.rgba.resize(static_cast<std::size_t>(width * height) * 4U);
    if (Expected<void> read = target->read_rgba(sheet.rgba); !read) {
        return fail(std::move(read.error()));
    }
    return sheet;
}

}  // namespace

std::vector<Camera> PoseSheetConfig::default_cameras() {
    return {tile_camera("front"), tile_camera("side")};
}

Expected<PoseSheet> draw_pose_sheet(Renderer& renderer,
                                    const Scene& scene,
                                    std::span<const motion::Pose> poses,
                                    const PoseSheetConfig& config) {
    return draw_sheet(renderer, scene, poses, config);
}

Expected<PoseSheet> draw_pose_sheet(Renderer& renderer,
                                    const Scene& scene,
                                    std::span<const ClipBody> bodies,
                                    const PoseSheetConfig& config) {
    return draw_sheet(renderer, scene, bodies, config);
}

}  // namespace raks::render
