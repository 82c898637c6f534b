#include "apps/raks_capture/drawn_films.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/suggest.hpp"
#include "render/gl/offscreen.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/renderer.hpp"
#include "render/scene/stage_light.hpp"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

struct Paint {
    std::string_view name;
    glm::dvec3 colour;  // linear
};
constexpr std::array<Paint, 7> kPaints{{{"green", {0.03, 0.50, 0.08}},
                                        {"blue", {0.03, 0.10, 0.60}},
                                        {"yellow", {0.80, 0.65, 0.03}},
                                        {"magenta", {0.65, 0.04, 0.35}},
                                        {"cyan", {0.03, 0.48, 0.62}},
                                        {"orange", {0.85, 0.25, 0.02}},
                                        {"red", {0.60, 0.02, 0.02}}}};
constexpr auto kPaintNames = [] {
    std::array<std::string_view, kPaints.size()> names{};
    std::transform(kPaints.begin(), kPaints.end(), names.begin(), [](const Paint& paint) {
        return paint.name;
    });
    return names;
}();

/// A bright hall: its look must not change with the themes of shows.
constexpr std::string_view kBrightHall = R"(
format = "raks-theme"
version = 1
exposure = 0.66
backdrop = { top = "#d9d4cb", glow = "#f3efe8", horizon = "#e6e1d9" }
floor = { centre = "#eae4dc", edge = "#e7dfd5", ambient = 0.72 }
rings = { colour = "#b05a3c", cover = 1.0 }

[lights]
key = [2.1, 1.98, 1.82]
fill = [0.3, 0.34, 0.42]
rim = [0.7, 0.7, 0.72]
sky = [0.52, 0.55, 0.6]
ground = [0.34, 0.3, 0.26]
)";

/// A grey hall, darker than the theme it is made of so that cameras with twice the gain do not burn
/// it out, and a mannequin of one plain colour.
render::Theme studio_theme() {
    constexpr float kDarker = 0.35F;
    render::Theme theme =
        render::parse_theme(kBrightHall, "hall", "hall").value_or(render::default_theme());
    theme.body = theme.joint_bands = theme.band_edge = {0.24F, 0.21F, 0.19F};
    for (glm::vec3* const colour : {&theme.background_top,
                                    &theme.background_glow,
                                    &theme.background_horizon,
                                    &theme.floor_centre,
                                    &theme.floor_edge}) {
        *colour *= kDarker;
    }
    return theme;
}

/// The part of a picture in which a dancer is to be seen.
class DancerExtent {
 public:
    explicit DancerExtent(const render::PinholeView& view) : view_(view) {}

    /// Takes in the body, its markers and its shadow.
    void take_in(const motion::WorldPose& world, const glm::vec3& key_light) {
        constexpr double kAround = 0.4;  // a joint: flesh, hair and markers; metres
        constexpr double kFaded = 2.5;   // radii of a shadow beyond which there is nothing of it
        for (std::size_t bone = 0; bone < motion::kBoneCount; ++bone) {
            take_in(glm::dvec3(world.position(static_cast<motion::Bone>(bone))), kAround);
        }
        for (const render::ShadowBlob& blob : render::shadow_blobs(world, 1.0F, key_light)) {
            take_in({blob.x, 0.0, blob.z}, kFaded * static_cast<double>(blob.radius));
        }
    }

    /// In pixels of the view, rows from below.
    [[nodiscard]] render::PixelBox box() const {
        const glm::dvec2 low = glm::clamp(glm::floor(low_), glm::dvec2(0.0), size());
        const glm::dvec2 high = glm::clamp(glm::ceil(high_), low, size());
        return {static_cast<int>(low.x),
                static_cast<int>(size().y - high.y),
                static_cast<int>(high.x - low.x),
                static_cast<int>(high.y - low.y)};
    }

 private:
    [[nodiscard]] glm::dvec2 size() const { return {view_.width, view_.height}; }

    void take_in(const glm::dvec3& centre, double radius) {
        const glm::dvec3 place = view_.rotation * centre + view_.translation;
        const double depth = place.z - radius;
        if (depth < 0.1) {
            low_ = glm::dvec2(0.0);  // too near to tell
            high_ = size();
            return;
        }
        const glm::dvec2 middle(view_.fx * place.x / place.z + view_.cx,
                                view_.fy * place.y / place.z + view_.cy);
        const glm::dvec2 reach = radius / depth * glm::dvec2(view_.fx, view_.fy);
        low_ = glm::min(low_, middle - reach);
        high_ = glm::max(high_, middle + reach);
    }

    const render::PinholeView& view_;
    glm::dvec2 low_{1e9};
    glm::dvec2 high_{-1e9};
};

/// The dancer with its markers on the stage. Most of a picture is the empty stage, which is drawn
/// once a camera: of each further picture only the part is drawn where the dancer and its shadow
/// are.
class DrawnDancer : public DrawnEvent {
 public:
    [[nodiscard]] static Expected<std::unique_ptr<DrawnDancer>> create(
        const capture::StudioMotion& motion, const capture::MarkerSet& markers, int people);

    [[nodiscard]] Expected<std::span<const std::uint8_t>> aim(
        const render::PinholeView& view) override;
    [[nodiscard]] Expected<EventPicture> draw(double capture_time) override;

 private:
    DrawnDancer(render::OffscreenContext context,
                render::Renderer renderer,
                const capture::StudioMotion& motion,
                const capture::MarkerSet& markers)
        : context_(std::move(context)),
          renderer_(std::move(renderer)),
          motion_(motion),
          markers_(markers) {}
    [[nodiscard]] Expected<void> make_target(const render::PinholeView& view);
    [[nodiscard]] render::Scene stage() const;
    [[nodiscard]] Expected<void> read_part(const render::PixelBox& part);
    void copy_rows(const render::PixelBox& part,
                   std::span<const std::uint8_t> from,
                   int from_width);

    render::OffscreenContext context_;
    render::Renderer renderer_;
    const capture::StudioMotion& motion_;
    const capture::MarkerSet& markers_;
    std::vector<glm::vec3> paints_;  // by marker
    int people_ = 1;
    render::Theme theme_ = studio_theme();
    std::optional<render::OffscreenTarget> target_;
    render::PinholeView view_;
    std::vector<std::uint8_t> empty_;  // the stage
    std::vector<std::uint8_t> rgba_;   // the stage with the dancer in last_
    std::vector<std::uint8_t> read_;   // of the part that was drawn
    render::PixelBox last_;
};

Expected<std::unique_ptr<DrawnDancer>> DrawnDancer::create(const capture::StudioMotion& motion,
                                                           const capture::MarkerSet& markers,
                                                           int people) {
    std::vector<glm::vec3> paints;
    for (const capture::Marker& marker : markers.markers) {
        const auto paint = marker_paint(marker.colour);
        if (!paint) {
            return fail("marker " + marker.name + ": " + paint.error().message);
        }
        paints.emplace_back(*paint);
    }
    auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(std::move(context.error()));
    }
    auto renderer =
        render::Renderer::create(render::build_mannequin({render::MannequinBuild::lead}));
    if (!renderer) {
        return fail(std::move(renderer.error()));
    }
    if (auto prepared = renderer->prepare_spheres(); !prepared) {
        return fail(std::move(prepared.error()));
    }
    std::unique_ptr<DrawnDancer> dancer(
        new DrawnDancer(std::move(*context), std::move(*renderer), motion, markers));
    dancer->paints_ = std::move(paints);
    dancer->people_ = people;
    return dancer;
}

Expected<void> DrawnDancer::make_target(const render::PinholeView& view) {
    const auto width = static_cast<int>(view.width);
    const auto height = static_cast<int>(view.height);
    if (target_ && target_->width() == width && target_->height() == height) {
        return {};
    }
    // The target is larger than the picture, and needs no further samples.
    auto target = render::OffscreenTarget::create({.width = width, .height = height, .samples = 1});
    if (!target) {
        return fail(std::move(target.error()));
    }
    target_ = std::move(*target);
    return {};
}

render::Scene DrawnDancer::stage() const {
    render::Scene scene;
    scene.camera.yaw = 0.0F;  // the lights are those of the room, not of this camera
    // Markers are found best on one plain colour; without them the dancer wears clothes.
    scene.dress = markers_.markers.empty() ? render::Dress::dancer : render::Dress::mannequin;
    scene.theme = &theme_;
    scene.placed = render::placed_camera(view_);
    return scene;
}

Expected<std::span<const std::uint8_t>> DrawnDancer::aim(const render::PinholeView& view) {
    if (auto made = make_target(view); !made) {
        return fail(std::move(made.error()));
    }
    view_ = view;
    empty_.resize(static_cast<std::size_t>(target_->width()) *
                  static_cast<std::size_t>(target_->height()) * 4);
    motion::Pose far_away;
    far_away.hips_position.z = 1e4F;
    renderer_.draw(stage(), far_away, target_->frame());
    if (auto read = target_->read_rgba(empty_); !read) {
        return fail(std::move(read.error()));
    }
    rgba_ = empty_;
    last_ = {};
    return std::span<const std::uint8_t>(empty_);
}

// Rows of the picture go down, those of a box up.
void DrawnDancer::copy_rows(const render::PixelBox& part,
                            std::span<const std::uint8_t> from,
                            int from_width) {
    const bool is_whole = from_width == target_->width();
    const int top = target_->height() - part.y - part.height;
    for (int row = 0; row < part.height; ++row) {
        const auto to = static_cast<std::ptrdiff_t>(top + row) * target_->width() + part.x;
        const auto source = is_whole ? to : static_cast<std::ptrdiff_t>(row) * from_width;
        std::copy_n(from.begin() + 4 * source, 4 * part.width, rgba_.begin() + 4 * to);
    }
}

Expected<void> DrawnDancer::read_part(const render::PixelBox& part) {
    copy_rows(last_, empty_, target_->width());
    last_ = {};
    if (part.width < 1 || part.height < 1) {
        return {};
    }
    read_.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height) * 4);
    if (auto read = render::read_rgba({.framebuffer = target_->frame().framebuffer,
                                       .x = part.x,
                                       .y = part.y,
                                       .width = part.width,
                                       .height = part.height},
                                      read_);
        !read) {
        return read;
    }
    copy_rows(part, read_, part.width);
    last_ = part;
    return {};
}

Expected<EventPicture> DrawnDancer::draw(double capture_time) {
    const motion::Pose pose =
        motion::pose_between(motion_.poses, capture_time * motion_.frames_per_second);
    const motion::WorldPose world = motion::world_pose(motion_.skeleton, pose);
    render::Scene scene = stage();
    const std::vector<glm::dvec3> places =
        capture::marker_places(markers_, motion_.skeleton, world);
    for (std::size_t i = 0; i < places.size(); ++i) {
        scene.spheres.push_back({.centre = glm::vec3(places[i]),
                                 .radius = static_cast<float>(markers_.radius),
                                 .colour = paints_[i]});
    }
    DancerExtent extent(view_);
    const glm::vec3 key_light = render::light_directions(scene.camera).key;
    extent.take_in(world, key_light);
    std::vector<motion::Pose> poses{pose};
    if (people_ > 1) {
        poses.push_back(capture::passer_by(motion_, capture_time));
        extent.take_in(motion::world_pose(motion_.skeleton, poses.back()), key_light);
    }
    render::FrameTarget frame = target_->frame();
    frame.part = extent.box();
    renderer_.draw(scene, poses, frame);
    if (auto read = read_part(*frame.part); !read) {
        return fail(std::move(read.error()));
    }
    const render::PixelBox& part = *frame.part;
    return EventPicture{
        rgba_, {part.x, target_->height() - part.y - part.height, part.width, part.height}};
}

}  // namespace

Expected<glm::dvec3> marker_paint(std::string_view colour) {
    const auto* const found =
        std::find_if(kPaints.begin(), kPaints.end(), [colour](const Paint& paint) {
            return paint.name == colour;
        });
    if (found == kPaints.end()) {
        return fail(unknown_name("colour of a drawn marker", colour, kPaintNames));
    }
    return found->colour;
}

Expected<std::vector<fs::path>> draw_films(const capture::StudioMotion& motion,
                                           const capture::Rig& rig,
                                           const capture::MarkerSet& markers,
                                           std::span<const capture::Clock> clocks,
                                           const fs::path& folder,
                                           const DrawnFilmOptions& options,
                                           const capture::StudioOptions& studio) {
    const auto dancer = DrawnDancer::create(motion, markers, studio.people);
    if (!dancer) {
        return fail(dancer.error());
    }
    std::vector<fs::path> films;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        films.push_back(folder / (rig.cameras[i].name + options.ending));
        DrawnFilmOptions own = options;
        own.frames_per_second =
            i < studio.rates.size() ? studio.rates[i] : options.frames_per_second;
        const FilmingCamera filming{rig.cameras[i],
                                    clocks[i],
                                    i,
                                    capture::picture_count(motion, own.frames_per_second),
                                    studio.bump_of(i)};
        if (auto written = film_event(**dancer, filming, films.back(), own); !written) {
            return fail(std::move(written.error()));
        }
    }
    return films;
}

}  // namespace raks::apps
