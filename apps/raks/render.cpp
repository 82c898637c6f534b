#include "apps/raks/commands.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/raks/dance_setup.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/audio_tags.hpp"
#include "base/pending_file.hpp"
#include "engine/offline/clip_driver.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/setup/told_genre.hpp"
#include "engine/show/clip_performer.hpp"
#include "engine/show/show.hpp"
#include "render/avatar/avatar.hpp"
#include "render/gl/offscreen.hpp"
#include "render/video/video_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

// Draws the pictures that are due as the dance goes on, and passes them to the film. Pictures are
// due at an exact rate, whatever the hops.
constexpr Nanos kTailStep = std::chrono::milliseconds(17);

class Film final : public engine::OfflineDriver::Sink {
 public:
    Film(engine::Show& show,
         render::OffscreenTarget& target,
         render::VideoWriter& writer,
         const RenderArguments& arguments,
         render::FrameRate rate,
         const audio::AudioTags& tags,
         std::optional<double> total)
        : show_(show),
          target_(target),
          writer_(writer),
          rate_(rate),
          start_seconds_(arguments.section.start),
          lead_(nanos_from_seconds(arguments.settings.pose_lead_ms * 1e-3)),
          source_(audio::title_line(tags, arguments.input.filename().string())),
          total_(total),
          is_draft_(arguments.settings.quality == "fast"),
          rgba_(static_cast<std::size_t>(target.width()) *
                static_cast<std::size_t>(target.height()) * 4) {}

    // The track is final up to its newest final hop: pictures up to there can be drawn. Tails look
    // one of their steps ahead.
    void on_hop(const engine::PerformedHop& hop) override {
        last_.emplace(Last{hop.music, hop.dancer});
        tracks_ = hop.tracks;
        places_ = hop.places;
        show_.advance(hop.music, hop.tracks);
        while (!fault_ &&
               next_moment() + lead_ + kTailStep <= time_of_hop(hop.track.newest_final())) {
            draw();
        }
    }

    // Draws the remaining pictures up to the end of the music.
    void finish(StreamTime end) {
        while (!fault_ && last_ && next_moment() < end) {
            draw();
        }
    }

    // Of a clip, by seconds of the film; none: faces go by the music.
    using FaceAt = std::function<std::optional<render::Face>(double)>;
    void set_face(FaceAt face) { face_at_ = std::move(face); }
    // All of a clip that is the avatar's own, `start` seconds from its beginning on.
    void set_clip(std::shared_ptr<const engine::AvatarClip> clip, double start) {
        face_at_ = [clip, start](double time) { return clip->face_at(start + time); };
        clip_ = std::move(clip);
        clip_start_ = start;
    }
    // Who says which dance it is, where that is not heard; lives as long as the program.
    void set_teller(std::string_view teller) { teller_ = teller; }

    [[nodiscard]] const std::optional<Error>& fault() const noexcept { return fault_; }
    [[nodiscard]] std::int64_t pictures() const noexcept { return next_; }

 private:
    // Copies: the hop's references are valid during on_hop() only.
    struct Last {
        MusicState music;
        motion::DancerStatus dancer;
    };

    // In whole nanoseconds from the picture's number: a rate such as 30000/1001 does not drift.
    [[nodiscard]] StreamTime next_moment() const {
        return StreamTime(Nanos(next_ * rate_.denominator * 1'000'000'000 / rate_.numerator));
    }

    // The pose leads by pose_lead; overlay and beat rings show the moment itself.
    void draw() {
        const StreamTime moment = next_moment();
        render::OverlayState info;
        info.source = source_;
        info.genre_teller = teller_;
        info.position = start_seconds_ + to_seconds(moment);
        show_.draw({last_->music,
                    last_->dancer,
                    {.tracks = tracks_,
                     .places = places_,
                     .moment = moment,
                     .lead = lead_,
                     .face = face_at_ ? face_at_(to_seconds(moment)) : std::nullopt,
                     .move_others = others_at(clip_start_ + to_seconds(moment + lead_))}},
                   info,
                   target_.frame());
        // The first fault ends the film: later pictures are not drawn.
        auto done = target_.read_rgba(rgba_);
        if (done) {
            done = writer_.add_picture(rgba_);
        }
        if (!done) {
            fault_ = done.error();
        }
        ++next_;
        tell_time();
    }

    [[nodiscard]] decltype(engine::DancedMoment::move_others) others_at(double seconds) const {
        if (clip_ == nullptr) {
            return {};
        }
        return [this, seconds](const motion::Pose& pose,
                               const render::JointTree& tree,
                               render::JointState& state) {
            clip_->move_others(seconds, pose, tree, state);
        };
    }

    // How long the film will take, once the first pictures tell.
    void tell_time() {
        constexpr std::int64_t kLeastPictures = 5;
        constexpr double kLeastSeconds = 2.0;
        constexpr double kWorthSaying = 15.0;  // seconds
        const HostTime now = HostClock::now();
        if (next_ == 1) {  // the first one warms up the driver
            begun_ = now;
        }
        const double gone = to_seconds(now - begun_);
        if (has_told_time_ || !total_ || next_ < kLeastPictures || gone < kLeastSeconds) {
            return;
        }
        has_told_time_ = true;
        const double pictures = *total_ * rate_.fps();
        const double expected = gone * pictures / static_cast<double>(next_ - 1);
        if (expected > kWorthSaying) {
            say(fmt::format("about {} for {:.0f} pictures{}",
                            time_in_words(expected),
                            pictures,
                            is_draft_ ? "" : " (--quality fast: a quick draft)"));
        }
    }

    engine::Show& show_;
    render::OffscreenTarget& target_;
    render::VideoWriter& writer_;
    render::FrameRate rate_;
    double start_seconds_;
    Nanos lead_;
    std::string source_;
    std::optional<double> total_;  // seconds of the film, where the music says it
    bool is_draft_;
    HostTime begun_{};
    bool has_told_time_ = false;
    std::vector<std::uint8_t> rgba_;
    std::int64_t next_ = 0;
    std::optional<Last> last_;
    std::span<const motion::PoseTrack> tracks_;
    std::span<const glm::vec2> places_;
    std::optional<Error> fault_;
    FaceAt face_at_;
    std::shared_ptr<const engine::AvatarClip> clip_;  // null: no clip, or to music
    double clip_start_ = 0.0;
    std::string_view teller_ = render::OverlayState().genre_teller;
};

// Completes a film; one that a signal stopped keeps its `danced` beside the file that it was to
// replace, and says so.
Expected<void> finish(render::VideoWriter& writer, Nanos danced) {
    if (!stop_signal()) {
        return writer.finish();
    }
    const auto kept = writer.finish_stopped();
    if (!kept) {
        return fail(kept.error());
    }
    say_stopped({*kept}, danced);
    return {};
}

// Feeds the music to dancer and film, to its end or to a signal.
// `Driver`: of dancers or of a clip.
template <typename Driver>
Expected<void> run(engine::MusicSource& source,
                   Driver& driver,
                   render::VideoWriter& writer,
                   Film& film) {
    ProgressLine progress("rendering");
    // The sound of each block goes into the film before the pictures that it leads to.
    for (auto block = source.next(); !block.mono.empty() && !stop_signal(); block = source.next()) {
        if (auto added = writer.add_sound(block.stereo); !added) {
            return added;
        }
        driver.feed(block.mono, film);
        if (film.fault()) {
            return fail(*film.fault());
        }
        if (const auto share = source.progress()) {
            progress.show(*share);
        }
    }
    // The hops that the analyzer still delays, then the pictures after them.
    driver.finish(film);
    film.finish(StreamTime(source.given()));
    if (film.fault()) {
        return fail(*film.fault());
    }
    return finish(writer, source.given());
}

// Size, rate and quality of the film; the sound's rate is the music's.
render::VideoOptions video_options(const RenderArguments& arguments, const engine::Look& look) {
    render::VideoOptions options;
    options.has_alpha = arguments.has_alpha;
    options.width = look.size.width;
    options.height = look.size.height;
    const std::vector<std::string> credits = engine::credits_of(look.avatars);
    if (!credits.empty()) {
        options.comment = fmt::format("Avatar: {}", fmt::join(credits, "; "));
    }
    // The nearest rate that the format can express.
    options.rate = render::FrameRate::nearest(arguments.settings.fps);
    options.quality = arguments.settings.quality == "fast" ? render::VideoQuality::draft
                                                           : render::VideoQuality::high;
    return options;
}

// Where all pictures are drawn. The members are destroyed last to first: what is drawn with before
// the context.
struct Studio {
    render::OffscreenContext context;
    engine::Show show;
    render::OffscreenTarget target;
};

// No window: rendering works without a display.
Expected<Studio> open_studio(const RenderArguments& arguments,
                             const engine::Look& look,
                             std::shared_ptr<const DanceList> dances) {
    auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto show = engine::Show::create(look, arguments.settings.overlay, std::move(dances));
    if (!show) {
        return fail(show.error());
    }
    auto target = render::OffscreenTarget::create(
        {.width = look.size.width, .height = look.size.height, .samples = show->samples()});
    if (!target) {
        return fail(target.error());
    }
    return Studio{std::move(*context), std::move(*show), std::move(*target)};
}

// A film of `driver`, to music.
template <typename Driver>
ExitCode film_music(const RenderArguments& arguments,
                    const engine::Look& look,
                    engine::MusicSource& source,
                    Driver& driver,
                    const DanceSetup& setup,
                    Film::FaceAt face = {}) {
    render::VideoOptions options = video_options(arguments, look);
    options.audio_rate = source.rate().hertz();
    auto writer = render::VideoWriter::create(arguments.output, options);
    if (!writer) {
        return fail(writer.error());
    }
    auto studio = open_studio(arguments, look, setup.catalogue.list());
    if (!studio) {
        return fail(studio.error());
    }
    Film film(studio->show,
              studio->target,
              **writer,
              arguments,
              options.rate,
              source.tags(),
              source.seconds());
    film.set_face(std::move(face));
    film.set_teller(
        engine::teller_of(engine::told_by(setup.models, source.tags(), arguments.input)));
    if (auto ran = run(source, driver, **writer, film); !ran) {
        return fail(ran.error());
    }
    if (!source.warning().empty()) {
        say(source.warning());
    }
    return kExitDone;
}

// A silent film of a clip, once through.
ExitCode film_clip(const RenderArguments& arguments,
                   const engine::Look& look,
                   std::shared_ptr<const engine::AvatarClip> clip,
                   double seconds) {
    const double start = arguments.section.start;
    engine::ClipDriver driver([clip, start](const MusicState& state) {
        return clip->pose_at(start + to_seconds(state.time));
    });
    render::VideoOptions options = video_options(arguments, look);
    options.audio_channels = 0;
    auto writer = render::VideoWriter::create(arguments.output, options);
    if (!writer) {
        return fail(writer.error());
    }
    auto studio = open_studio(arguments, look, std::make_shared<const DanceList>());
    if (!studio) {
        return fail(studio.error());
    }
    Film film(studio->show, studio->target, **writer, arguments, options.rate, {}, seconds);
    film.set_clip(std::move(clip), start);
    ProgressLine progress("rendering");
    constexpr double kPart = 0.5;  // seconds between two looks at signals
    double done = 0.0;
    while (done < seconds && !stop_signal() && !film.fault()) {
        done = std::min(done + kPart, seconds);
        driver.perform(stream_time_from_seconds(done), film);
        progress.show(done / seconds);
    }
    film.finish(stream_time_from_seconds(done));
    if (film.fault()) {
        return fail(*film.fault());
    }
    return exit_code_of(finish(**writer, nanos_from_seconds(done)));
}

// The avatar performs a clip: once in silence, or to music as `play` does.
ExitCode render_clip(RenderArguments& arguments, const engine::Look& look) {
    // To music a clip begins again and again, and only what a pose holds is led over.
    const bool is_whole = arguments.input.empty() && arguments.settings.avatars.size() == 1;
    auto opened = open_clip(arguments.motion.file,
                            arguments.settings,
                            arguments.motion.arm_angle,
                            is_whole ? render::OtherNodes::moved : render::OtherNodes::folded);
    if (!opened) {
        return fail(opened.error());
    }
    const double start = arguments.section.start;
    if (arguments.input.empty()) {
        auto clip = std::make_shared<const engine::AvatarClip>(std::move(*opened));
        const double length = clip->duration();
        if (!(length > start)) {
            return fail(
                fmt::format("{}: the clip ends at {:.3f} s", arguments.motion.file, length));
        }
        const double seconds =
            std::min(arguments.section.duration.value_or(length), length - start);
        return film_clip(arguments, look, std::move(clip), seconds);
    }
    auto source = engine::MusicSource::open(arguments.input, start, arguments.section.duration);
    if (!source) {
        return fail(source.error());
    }
    const auto setup = open_dances(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    const engine::ClipTiming timing = arguments.motion.timing(*opened);
    const auto performer = std::make_shared<engine::ClipPerformer>(std::move(*opened), timing);
    performer->set_song_start(start);
    say_detail(performer->description());
    auto driver = engine::ClipDriver::create(
        source->rate(),
        engine::told(setup->models, source->tags(), arguments.input),
        [performer](const MusicState& state) { return performer->next(state.time, state); });
    if (!driver) {
        return fail(driver.error());
    }
    return film_music(arguments, look, *source, *driver, *setup, [performer](double /*time*/) {
        return performer->face();
    });
}

}  // namespace

ExitCode render(const RenderArguments& given) {
    RenderArguments arguments = given;
    arguments.settings.fps = said_film_fps(arguments.settings);
    // A film is not in a hurry.
    if (arguments.settings.quality == "auto") {
        arguments.settings.quality = "high";
    }
    if (arguments.has_alpha) {
        arguments.settings.backdrop = "transparent";
    }
    auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    if (!arguments.motion.camera.empty()) {
        auto camera = engine::CameraMotion::load(arguments.motion.camera);
        if (!camera) {
            return fail(camera.error());
        }
        look->camera_motion = std::make_shared<const engine::CameraMotion>(std::move(*camera));
    }
    // What shows nothing behind the dance keeps that, wherever the film can.
    if (look->scene.backdrop == render::Backdrop::transparent && !arguments.has_alpha) {
        arguments.has_alpha = render::VideoWriter::keeps_alpha(arguments.output);
        if (!arguments.has_alpha) {
            say("this form of film has no alpha: what is transparent is black in it (.mov, .webm "
                "and a folder for .png keep it)");
        }
    }
    // What cannot be written is said before anything is loaded. A film over its own music would
    // destroy it.
    if (auto checked = check_is_no_input(arguments.output,
                                         {arguments.input,
                                          engine::AvatarClip::file_of(arguments.motion.file),
                                          arguments.motion.camera});
        !checked) {
        return fail(std::move(checked.error()));
    }
    if (auto checked =
            render::VideoWriter::check(arguments.output, video_options(arguments, *look));
        !checked) {
        return fail(checked.error());
    }
    if (!arguments.motion.file.empty()) {
        return render_clip(arguments, *look);
    }
    // Without a file, the demo.
    if (arguments.input.empty()) {
        const EndAtOnceOnSignals at_once;
        const auto demo = engine::demo_music();
        if (!demo) {
            return fail(demo.error());
        }
        arguments.input = *demo;
    }
    auto source = engine::MusicSource::open(
        arguments.input, arguments.section.start, arguments.section.duration);
    if (!source) {
        return fail(source.error());
    }
    auto setup = open_dancers(arguments.settings, engine::dance_bodies_of(look->avatars));
    if (!setup) {
        return fail(setup.error());
    }
    read_corrections(setup->models);
    auto driver = open_driver({arguments.input,
                               source->rate(),
                               arguments.section.start,
                               arguments.is_as_live,
                               source->tags()},
                              *setup);
    if (!driver) {
        return fail(std::move(driver.error()));
    }
    return film_music(arguments, *look, *source, *driver, *setup);
}

}  // namespace raks::apps
