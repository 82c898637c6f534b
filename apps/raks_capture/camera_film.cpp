#include "apps/raks_capture/camera_film.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "audio/music/damage/room_recorder.hpp"
#include "base/dice.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "render/video/video_writer.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

constexpr int kSoundRate = 48'000;
constexpr int kBlurDrawings = 2;        // of a picture while the shutter is open, at least
constexpr double kBlurSeconds = 0.005;  // between such drawings, at most
constexpr double kBandSeconds = 0.004;  // between drawings of rows that are read after one another

/// The film of one camera.
class CameraTake {
 public:
    CameraTake(DrawnEvent& event, const FilmingCamera& filming, const DrawnFilmOptions& options)
        : event_(event),
          filming_(filming),
          options_(options),
          dice_(options.seed, 100 + filming.number),
          filmed_(std::in_place, filming.camera, options.is_draft ? 1 : 2) {
        const double gain = dice_.log_uniform(options.least_gain, options.greatest_gain);
        for (int c = 0; c < 3; ++c) {
            const double cast = dice_.uniform(-0.5, 0.5) * options.colour_cast;
            sensor_.gain[c] = gain * (1.0 + cast);
        }
        sensor_.noise = options.noise;
    }

    [[nodiscard]] Expected<void> write(const std::filesystem::path& path);

 private:
    [[nodiscard]] Expected<void> aim();
    [[nodiscard]] Expected<void> expose(double time);
    [[nodiscard]] Expected<void> add_picture(render::VideoWriter& film, std::size_t picture);
    [[nodiscard]] std::vector<float> heard();

    DrawnEvent& event_;
    const FilmingCamera& filming_;
    const DrawnFilmOptions& options_;
    Dice dice_;
    std::optional<FilmedPicture> filmed_;  // anew once the camera is bumped
    bool is_bumped_ = false;
    Sensor sensor_;
};

std::vector<float> CameraTake::heard() {
    const audio::RoomRecorder recorder{
        .seconds = static_cast<double>(filming_.pictures) / options_.frames_per_second,
        .offset = filming_.clock.offset,
        .drift_ppm = filming_.clock.drift_ppm,
        .metres = glm::distance(filming_.camera.centre(), options_.loudspeaker),
        .reverberation = options_.reverberation,
        .signal_to_noise_db = options_.signal_to_noise_db};
    return audio::record_in_room(kSoundRate, options_.music, recorder, dice_);
}

Expected<void> CameraTake::aim() {
    const auto still = event_.aim(filmed_->drawing());
    if (!still) {
        return fail(still.error());
    }
    filmed_->set_still(*still);
    return {};
}

// Gathers the light of one moment; rows that are read later show a later one.
Expected<void> CameraTake::expose(double time) {
    const double rolling = options_.rolling_shutter;
    const int bands = std::max(1, static_cast<int>(std::ceil(rolling / kBandSeconds)));
    const int height = filming_.camera.lens.height;
    for (int band = 0; band < bands; ++band) {
        const auto drawn = event_.draw(time + rolling * ((band + 0.5) / bands - 0.5));
        if (!drawn) {
            return fail(drawn.error());
        }
        filmed_->add(
            drawn->rgba, drawn->part, {band * height / bands, (band + 1) * height / bands});
    }
    return {};
}

Expected<void> CameraTake::add_picture(render::VideoWriter& film, std::size_t picture) {
    const double seconds = static_cast<double>(picture) / options_.frames_per_second;
    if (filming_.bump && seconds >= *filming_.bump && !is_bumped_) {
        is_bumped_ = true;
        filmed_.emplace(capture::bumped(filming_.camera), options_.is_draft ? 1 : 2);
        if (auto aimed = aim(); !aimed) {
            return aimed;
        }
    }
    const double time = filming_.clock.capture_time(seconds);
    const int drawings =
        options_.is_draft
            ? 1
            : std::max(kBlurDrawings,
                       static_cast<int>(std::ceil(options_.shutter_seconds / kBlurSeconds)));
    for (int i = 0; i < drawings; ++i) {
        // The middle of the time in which the shutter is open is that of the picture.
        const double off = options_.shutter_seconds * ((i + 0.5) / drawings - 0.5);
        if (auto exposed = expose(time + off); !exposed) {
            return exposed;
        }
    }
    return film.add_picture(filmed_->develop(sensor_, dice_));
}

Expected<void> CameraTake::write(const std::filesystem::path& path) {
    if (auto aimed = aim(); !aimed) {
        return aimed;
    }
    auto film =
        render::VideoWriter::create(path,
                                    {.width = filming_.camera.lens.width,
                                     .height = filming_.camera.lens.height,
                                     .rate = render::FrameRate::nearest(options_.frames_per_second),
                                     .quality = render::VideoQuality::normal,
                                     .audio_rate = kSoundRate,
                                     .audio_channels = options_.music.empty() ? 0 : 1});
    if (!film) {
        return fail(std::move(film.error()));
    }
    if (!options_.music.empty()) {
        if (auto added = (*film)->add_sound(heard()); !added) {
            return added;
        }
    }
    for (std::size_t i = 0; i < filming_.pictures; ++i) {
        if (options_.is_stop_requested()) {
            return fail(path.string() + ": was stopped");
        }
        if (auto added = add_picture(**film, i); !added) {
            return added;
        }
        options_.tell_progress(filming_.number, i + 1, filming_.pictures);
    }
    auto finished = (*film)->finish();
    if (finished) {
        options_.tell_film(path);
    }
    return finished;
}

}  // namespace

Expected<void> film_event(DrawnEvent& event,
                          const FilmingCamera& filming,
                          const std::filesystem::path& path,
                          const DrawnFilmOptions& options) {
    CameraTake take(event, filming, options);
    return take.write(path);
}

}  // namespace raks::apps
