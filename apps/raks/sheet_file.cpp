#include "apps/raks/sheet_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "render/avatar/avatar.hpp"
#include "render/overlay/picture_text.hpp"
#include "render/video/png.hpp"
#include "render/video/straight_alpha.hpp"
#include "render/video/video_writer.hpp"

namespace raks::apps {
namespace {

constexpr int kTitleHeight = 44;       // pixels
constexpr float kTitlePixels = 24.0F;  // height of a line
constexpr float kLabelPixels = 18.0F;
constexpr int kEdge = 10;
constexpr std::uint32_t kPaper = 0x14161F;
constexpr std::uint32_t kInk = 0xF2EEE6;
constexpr std::uint32_t kAmber = 0xFFB454;

// The sheet below a strip for its title.
render::PoseSheet with_title(const render::PoseSheet& sheet, const std::string& title) {
    render::PoseSheet whole{sheet.width, sheet.height + kTitleHeight, {}};
    whole.rgba.resize(static_cast<std::size_t>(whole.width) *
                      static_cast<std::size_t>(whole.height) * 4U);
    const auto strip =
        static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(kTitleHeight) * 4U;
    for (std::size_t i = 0; i < strip; i += 4) {
        whole.rgba[i] = kPaper >> 16U & 0xFFU;
        whole.rgba[i + 1] = kPaper >> 8U & 0xFFU;
        whole.rgba[i + 2] = kPaper & 0xFFU;
        whole.rgba[i + 3] = 0xFF;
    }
    std::copy(sheet.rgba.begin(),
              sheet.rgba.end(),
              whole.rgba.begin() + static_cast<std::ptrdiff_t>(strip));
    render::PictureText(kTitlePixels)
        .write({whole.rgba, whole.width, whole.height}, kEdge, kEdge, kInk, title);
    return whole;
}

// Names of the views at the left, labels in the pictures of the first view. A band has a row for
// each view.
void write_labels(render::PoseSheet& sheet,
                  const render::PoseSheetConfig& config,
                  const SheetLabels& labels,
                  std::size_t poses) {
    constexpr const char* kViews[] = {"front", "side"};
    const render::PictureText text(kLabelPixels);
    const render::PictureText::Picture picture{sheet.rgba, sheet.width, sheet.height};
    const auto views = config.cameras.size();
    const auto columns = std::min(static_cast<std::size_t>(config.columns), poses);
    for (std::size_t i = 0; i < poses; ++i) {
        const int x = static_cast<int>(i % columns) * config.tile_width;
        for (std::size_t view = 0; view < views; ++view) {
            const auto row = static_cast<int>(i / columns * views + view);
            const int y = kTitleHeight + row * config.tile_height;
            if (view == 0 && i < labels.poses.size()) {
                text.write(picture, x + kEdge, y + kEdge / 2, kAmber, labels.poses[i]);
            }
            if (i % columns == 0 && view < std::size(kViews)) {
                const int foot =
                    y + config.tile_height - static_cast<int>(kLabelPixels) - kEdge / 2;
                text.write(picture, kEdge, foot, kInk, kViews[view]);
            }
        }
    }
}

}  // namespace

SheetLabels figure_labels(std::string title, std::size_t poses, int per_beat) {
    SheetLabels labels;
    labels.title = std::move(title);
    const auto beat = static_cast<std::size_t>(per_beat);
    for (std::size_t i = 0; i < poses; ++i) {
        const std::size_t part = i % beat;
        labels.poses.push_back(part == 0          ? std::to_string(1 + i / beat)
                               : 2 * part == beat ? std::string("&")
                                                  : std::string());
    }
    return labels;
}

SheetStudio::SheetStudio(render::OffscreenContext context,
                         render::Renderer renderer,
                         const engine::Look& look,
                         render::Quality quality)
    : context_(std::move(context)),
      renderer_(std::move(renderer)),
      scene_(look.scene),
      size_(render::size_of(*look.avatars.front().avatar)),
      quality_(quality) {}

Expected<SheetStudio> SheetStudio::open(const engine::Look& look, render::Quality quality) {
    auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto renderer = render::Renderer::create(*look.avatars.front().avatar, {.quality = quality});
    if (!renderer) {
        return fail(renderer.error());
    }
    return SheetStudio(std::move(*context), std::move(*renderer), look, quality);
}

// A sheet's cameras are made for the mannequin. Its edges are smooth on every computer, unless a
// person asks for speed.
render::PoseSheetConfig SheetStudio::framed(render::PoseSheetConfig config) const {
    for (render::Camera& camera : config.cameras) {
        camera = engine::camera_for(camera, size_);
    }
    config.samples = quality_ == render::Quality::fast ? 1 : config.samples;
    return config;
}

// Poses and clip bodies alike: the sheet is a template over what is drawn.
template <typename Body>
Expected<void> SheetStudio::write(const Path& output,
                                  std::span<const Body> bodies,
                                  const render::PoseSheetConfig& config,
                                  const SheetLabels& labels) {
    auto picture = render::draw_pose_sheet(renderer_, scene_, bodies, framed(config));
    if (!picture) {
        return fail(picture.error());
    }
    render::make_straight(picture->rgba);
    if (labels.title.empty()) {
        return render::write_png(output, picture->width, picture->height, picture->rgba);
    }
    render::PoseSheet labelled = with_title(*picture, labels.title);
    write_labels(labelled, config, labels, bodies.size());
    return render::write_png(output, labelled.width, labelled.height, labelled.rgba);
}

Expected<void> SheetStudio::write_sheet(const Path& output,
                                        std::span<const motion::Pose> poses,
                                        const render::PoseSheetConfig& config,
                                        const SheetLabels& labels) {
    return write(output, poses, config, labels);
}

Expected<void> SheetStudio::write_sheet(const Path& output,
                                        std::span<const render::ClipBody> bodies,
                                        const render::PoseSheetConfig& config,
                                        const SheetLabels& labels) {
    return write(output, bodies, config, labels);
}

Expected<render::PoseSheet> SheetStudio::draw_sheet(std::span<const motion::Pose> poses,
                                                    const render::PoseSheetConfig& config) {
    return render::draw_pose_sheet(renderer_, scene_, poses, framed(config));
}

Expected<render::PoseSheet> SheetStudio::draw_sticks(std::span<const motion::Pose> poses,
                                                     const render::PoseSheetConfig& config) {
    render::Scene scene = scene_;
    scene.view = render::View::stick;
    return render::draw_pose_sheet(renderer_, scene, poses, framed(config));
}

Expected<void> SheetStudio::write_film(const Path& output,
                                       std::span<const motion::Pose> poses,
                                       double fps) {
    // The sheet's layout also says size and cameras of one view.
    const render::PoseSheetConfig config = framed({});
    const auto views = static_cast<int>(config.cameras.size());
    auto target = render::OffscreenTarget::create({.width = views * config.tile_width,
                                                   .height = config.tile_height,
                                                   .samples = renderer_.samples()});
    if (!target) {
        return fail(target.error());
    }
    auto writer = render::VideoWriter::create(output,
                                              {.width = target->width(),
                                               .height = target->height(),
                                               .rate = render::FrameRate::nearest(fps),
                                               .audio_channels = 0});
    if (!writer) {
        return fail(writer.error());
    }
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(target->width()) *
                                   static_cast<std::size_t>(target->height()) * 4U);
    render::Scene scene = scene_;
    // One pose a picture; the views lie side by side.
    for (const motion::Pose& pose : poses) {
        for (int view = 0; view < views; ++view) {
            scene.camera = config.cameras[static_cast<std::size_t>(view)];
            // The camera follows the body over the floor.
            scene.camera.pan_to(pose.hips_position);
            render::FrameTarget tile = target->frame();
            tile.x = view * config.tile_width;
            tile.width = config.tile_width;
            renderer_.draw(scene, pose, tile);
        }
        auto added = target->read_rgba(rgba);
        if (added) {
            added = (*writer)->add_picture(rgba);
        }
        if (!added) {
            return added;
        }
    }
    return (*writer)->finish();
}

}  // namespace raks::apps
