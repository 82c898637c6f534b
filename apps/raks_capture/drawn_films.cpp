#include "apps/raks_capture/drawn_films.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "apps/raks_capture/filmed_picture.hpp"
#include "audio/music/damage/room_recorder.hpp"
#include "base/dice.hpp"
#include "base/suggest.hpp"
#include "render/gl/offscreen.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/renderer.hpp"
#include "render/video/video_writer.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

constexpr int kSoundRate = 48'000;
constexpr int kBlurDrawings = 2;  // of a picture while the shutter is open

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

/// A grey hall, darker than the theme it is made of so that cameras with twice the gain do not burn
/// it out, and a mannequin of one plain colour.
render::Theme studio_theme() {
    constexpr float kDarker = 0.35F;
    const auto known = render::find_theme("studio_light");
    render::Theme theme = known ? **known : render::default_theme();
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

/// What one picture after the other is drawn with.
class Studio {
 public:
    [[nodiscard]] static Expected<Studio> open(const capture::StudioMotion& motion,
                                               const capture::MarkerSet& markers);

    /// Draws the dancer at a moment of the capture, RGBA.
    [[nodiscard]] Expected<std::span<const std::uint8_t>> draw(const render::PinholeView& view,
                                                               double capture_time);

 private:
    Studio(render::OffscreenContext context,
           render::Renderer renderer,
           const capture::StudioMotion& motion,
           const capture::MarkerSet& markers)
        : context_(std::move(context)),
          renderer_(std::move(renderer)),
          motion_(&motion),
          markers_(&markers) {}
    [[nodiscard]] Expected<void> make_target(const render::PinholeView& view);

    render::OffscreenContext context_;
    render::Renderer renderer_;
    const capture::StudioMotion* motion_;
    const capture::MarkerSet* markers_;
    std::vector<glm::vec3> paints_;  // by marker
    std::unique_ptr<const render::Theme> theme_ = std::make_unique<render::Theme>(studio_theme());
    std::optional<render::OffscreenTarget> target_;
    std::vector<std::uint8_t> rgba_;
};

Expected<Studio> Studio::open(const capture::StudioMotion& motion,
                              const capture::MarkerSet& markers) {
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
    auto renderer = render::Renderer::create(render::build_mannequin(render::MannequinBuild::lead));
    if (!renderer) {
        return fail(std::move(renderer.error()));
    }
    if (auto prepared = renderer->prepare_spheres(); !prepared) {
        return fail(std::move(prepared.error()));
    }
    Studio studio(std::move(*context), std::move(*renderer), motion, markers);
    studio.paints_ = std::move(paints);
    return studio;
}

Expected<void> Studio::make_target(const render::PinholeView& view) {
    const auto width = static_cast<int>(view.width);
    const auto height = static_cast<int>(view.height);
    if (target_ && target_->width() == width && target_->height() == height) {
        return {};
    }
    auto target = render::OffscreenTarget::create(
        {.width = width, .height = height, .samples = renderer_.samples()});
    if (!target) {
        return fail(std::move(target.error()));
    }
    target_ = std::move(*target);
    rgba_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    return {};
}

Expected<std::span<const std::uint8_t>> Studio::draw(const render::PinholeView& view,
                                                     double capture_time) {
    if (auto made = make_target(view); !made) {
        return fail(std::move(made.error()));
    }
    const motion::Pose pose =
        motion::pose_between(motion_->poses, capture_time * motion_->frames_per_second);
    const motion::WorldPose world = motion::world_pose(motion_->skeleton, pose);
    render::Scene scene;
    scene.camera.yaw = 0.0F;  // the lights are those of the room, not of this camera
    scene.dress = render::Dress::mannequin;
    scene.theme = theme_.get();
    scene.placed = render::placed_camera(view);
    const std::vector<glm::dvec3> places =
        capture::marker_places(*markers_, motion_->skeleton, world);
    for (std::size_t i = 0; i < places.size(); ++i) {
        scene.spheres.push_back({.centre = glm::vec3(places[i]),
                                 .radius = static_cast<float>(markers_->radius),
                                 .colour = paints_[i]});
    }
    renderer_.draw(scene, pose, target_->frame());
    if (auto read = target_->read_rgba(rgba_); !read) {
        return fail(std::move(read.error()));
    }
    return std::span<const std::uint8_t>(rgba_);
}

/// The film of one camera.
class CameraTake {
 public:
    CameraTake(Studio& studio,
               const capture::Camera& camera,
               const capture::Clock& clock,
               std::size_t number,
               const DrawnFilmOptions& options)
        : studio_(studio),
          camera_(camera),
          clock_(clock),
          number_(number),
          options_(options),
          dice_(options.seed, 100 + number),
          filmed_(camera, options.is_draft ? 1 : 2) {
        const double gain = dice_.log_uniform(options.least_gain, options.greatest_gain);
        for (int c = 0; c < 3; ++c) {
            const double cast = dice_.uniform(-0.5, 0.5) * options.colour_cast;
            sensor_.gain[c] = gain * (1.0 + cast);
        }
        sensor_.noise = options.noise;
    }

    [[nodiscard]] Expected<void> write(const fs::path& path, std::size_t pictures);

 private:
    [[nodiscard]] Expected<void> add_picture(render::VideoWriter& film, std::size_t picture);
    [[nodiscard]] std::vector<float> heard(std::size_t pictures);

    Studio& studio_;
    const capture::Camera& camera_;
    const capture::Clock& clock_;
    std::size_t number_;
    const DrawnFilmOptions& options_;
    Dice dice_;
    FilmedPicture filmed_;
    Sensor sensor_;
};

std::vector<float> CameraTake::heard(std::size_t pictures) {
    const audio::RoomRecorder recorder{
        .seconds = static_cast<double>(pictures) / options_.frames_per_second,
        .offset = clock_.offset,
        .drift_ppm = clock_.drift_ppm,
        .metres = glm::distance(camera_.centre(), options_.loudspeaker),
        .reverberation = options_.reverberation,
        .signal_to_noise_db = options_.signal_to_noise_db};
    return audio::record_in_room(kSoundRate, options_.music, recorder, dice_);
}

Expected<void> CameraTake::add_picture(render::VideoWriter& film, std::size_t picture) {
    const double time =
        clock_.capture_time(static_cast<double>(picture) / options_.frames_per_second);
    const int drawings = options_.is_draft ? 1 : kBlurDrawings;
    for (int i = 0; i < drawings; ++i) {
        // The middle of the time in which the shutter is open is that of the picture.
        const double off = options_.shutter_seconds * ((i + 0.5) / drawings - 0.5);
        const auto drawn = studio_.draw(filmed_.drawing(), time + off);
        if (!drawn) {
            return fail(drawn.error());
        }
        filmed_.add(*drawn);
    }
    return film.add_picture(filmed_.develop(sensor_, dice_));
}

Expected<void> CameraTake::write(const fs::path& path, std::size_t pictures) {
    auto film =
        render::VideoWriter::create(path,
                                    {.width = camera_.lens.width,
                                     .height = camera_.lens.height,
                                     .rate = render::FrameRate::nearest(options_.frames_per_second),
                                     .quality = render::VideoQuality::high,
                                     .audio_rate = kSoundRate,
                                     .audio_channels = options_.music.empty() ? 0 : 1});
    if (!film) {
        return fail(std::move(film.error()));
    }
    if (!options_.music.empty()) {
        if (auto added = (*film)->add_sound(heard(pictures)); !added) {
            return added;
        }
    }
    for (std::size_t i = 0; i < pictures; ++i) {
        if (options_.is_stop_requested()) {
            return fail(path.string() + ": was stopped");
        }
        if (auto added = add_picture(**film, i); !added) {
            return added;
        }
        options_.tell_progress(number_, i + 1, pictures);
    }
    return (*film)->finish();
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
                                           const DrawnFilmOptions& options) {
    auto studio = Studio::open(motion, markers);
    if (!studio) {
        return fail(std::move(studio.error()));
    }
    const double seconds = static_cast<double>(motion.poses.size() - 1) / motion.frames_per_second;
    const auto pictures =
        static_cast<std::size_t>(std::floor(seconds * options.frames_per_second + 1e-9)) + 1;
    std::vector<fs::path> films;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        films.push_back(folder / (rig.cameras[i].name + options.ending));
        CameraTake take(*studio, rig.cameras[i], clocks[i], i, options);
        if (auto written = take.write(films.back(), pictures); !written) {
            return fail(std::move(written.error()));
        }
    }
    return films;
}

}  // namespace raks::apps
