#include "apps/raks_capture/synchronise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "audio/io/audio_file.hpp"
#include "audio/sync/joint_alignment.hpp"
#include "audio/sync/sync_track.hpp"
#include "base/suggest.hpp"

namespace raks::apps {
namespace {

// The tracks that can be compared: their sound, and whose it is.
struct Tracks {
    std::vector<audio::SyncTrack> tracks;
    std::vector<std::optional<std::size_t>> cameras;  // of each track; nothing: the song
    std::vector<std::optional<double>> metres;        // from the loudspeaker
};

// One run of synchronise().
class Synchronisation {
 public:
    Synchronisation(const SyncPlan& plan, const std::function<bool(double)>& progress)
        : plan_(plan), progress_(progress) {}

    SyncResult run() {
        for (const CameraSound& camera : plan_.cameras) {
            result_.cameras.push_back({camera.camera, std::nullopt, false, false, {}, 0, 0, 0.0});
        }
        read_tracks();
        if (!heard_.tracks.empty()) {
            align();
        }
        set_by_hand();
        for (const CameraSync& camera : result_.cameras) {
            doubt(camera);
        }
        return std::move(result_);
    }

 private:
    // Half of the time goes into reading, roughly.
    bool goes_on(double share) const { return !progress_ || progress_(share); }

    void read_tracks() {
        const std::size_t files = plan_.cameras.size() + (plan_.music ? 1 : 0);
        for (std::size_t i = 0; i < files; ++i) {
            if (!goes_on(0.5 * static_cast<double>(i) / static_cast<double>(files))) {
                result_.is_whole = false;
                return;
            }
            const bool is_song = i == plan_.cameras.size();
            const auto& file = is_song ? *plan_.music : plan_.cameras[i].file;
            auto track =
                read_track(file, is_song ? file.filename().string() : plan_.cameras[i].camera);
            if (!track) {
                // A clock that is set by hand needs no sound.
                if (is_song || !by_hand(plan_.cameras[i].camera)) {
                    result_.warnings.push_back(std::move(track.error().message));
                }
                result_.is_whole = result_.is_whole && !is_song;
                continue;
            }
            heard_.tracks.push_back(std::move(*track));
            heard_.cameras.push_back(is_song ? std::nullopt : std::optional(i));
            heard_.metres.push_back(is_song ? std::optional(0.0) : plan_.cameras[i].metres);
        }
    }

    Expected<audio::SyncTrack> read_track(const std::filesystem::path& file,
                                          const std::string& name) {
        if (file.empty()) {
            return fail(name + ": has no film in capture.toml, so its clock cannot be told");
        }
        auto sound = audio::read_all_mono(file, kLongestTake);
        if (!sound) {
            return fail(std::move(sound.error()));
        }
        if (!sound->warning.empty()) {
            result_.warnings.push_back(sound->warning);
        }
        return audio::SyncTrack::prepare(sound->samples, sound->rate, name);
    }

    void align() {
        audio::JointOptions options;
        options.most_offset = plan_.most_offset;
        options.threads = plan_.threads;
        const auto song = std::find(heard_.cameras.begin(), heard_.cameras.end(), std::nullopt);
        if (song != heard_.cameras.end()) {
            options.song = static_cast<std::size_t>(song - heard_.cameras.begin());
        }
        auto joint =
            audio::align_jointly(heard_.tracks, options, [&](std::size_t done, std::size_t all) {
                return goes_on(0.5 + 0.5 * static_cast<double>(done) / static_cast<double>(all));
            });
        audio::correct_sound_way(joint, heard_.metres);
        move_to_hand_set_reference(joint);
        for (std::size_t i = 0; i < heard_.tracks.size(); ++i) {
            if (options.song == i) {
                take_song(joint.clocks[i]);
            } else {
                take_camera(i, joint, options.song && joint.clocks[*options.song]);
            }
        }
        if (options.song && result_.song) {
            doubt_length(joint, *options.song);
        }
    }

    // A song that ends long before the films: another one may follow, of which nothing is known.
    void doubt_length(const audio::JointAlignment& joint, std::size_t song) {
        constexpr double kLongAfter = 20.0;  // seconds
        const double ends = joint.clocks[song]->line.at(heard_.tracks[song].seconds());
        double last = ends;
        for (std::size_t i = 0; i < heard_.tracks.size(); ++i) {
            if (joint.clocks[i] && i != song) {
                last = std::max(last, joint.clocks[i]->line.at(heard_.tracks[i].seconds()));
            }
        }
        if (last > ends + kLongAfter) {
            result_.warnings.push_back(fmt::format(
                "{}: ends at {:.1f} s, and the films at {:.1f}: of a second song, where one was "
                "played, the beats are not known; cut the films, or give both songs as one file",
                heard_.tracks[song].name(),
                ends,
                last));
        }
    }

    // Where the clock of the reference is set by hand, all others follow it.
    void move_to_hand_set_reference(audio::JointAlignment& joint) const {
        const auto camera = heard_.cameras[joint.reference];
        const capture::Clock* const set = camera ? by_hand(plan_.cameras[*camera].camera) : nullptr;
        if (set == nullptr) {
            return;
        }
        for (auto& clock : joint.clocks) {
            if (clock) {
                clock->line = clock->line.then({set->offset, set->drift_ppm});
            }
        }
    }

    void take_song(const Expected<audio::JointClock>& clock) {
        if (clock) {
            result_.song = SongSync{clock->line, clock->confidence};
        } else {
            result_.warnings.push_back(clock.error().message);
            result_.is_whole = false;
        }
    }

    void take_camera(std::size_t track, const audio::JointAlignment& joint, bool has_song) {
        CameraSync& camera = result_.cameras[*heard_.cameras[track]];
        const auto& clock = joint.clocks[track];
        if (!clock) {
            if (by_hand(camera.camera) == nullptr) {
                result_.warnings.push_back(clock.error().message + slow_motion_of(track));
            }
            return;
        }
        camera.clock = capture::Clock{
            camera.camera, clock->line.offset, clock->line.drift_ppm, clock->confidence};
        camera.used = clock->used;
        camera.compared = clock->compared;
        camera.disagreement = clock->disagreement;
        if (clock->through != track) {
            camera.through = heard_.tracks[clock->through].name();
        }
        if (has_song && !clock->hears_song) {
            result_.warnings.push_back(fmt::format("{}: does not hear the music", camera.camera));
        }
    }

    // A film that fits no other and is several times as long as they are: telephones play pictures
    // that they took quickly more slowly, and its sound with them.
    [[nodiscard]] std::string slow_motion_of(std::size_t track) const {
        constexpr double kSlow = 1.7;
        std::vector<double> lengths;
        for (std::size_t i = 0; i < heard_.tracks.size(); ++i) {
            if (i != track && heard_.cameras[i]) {
                lengths.push_back(heard_.tracks[i].seconds());
            }
        }
        if (lengths.empty()) {
            return {};
        }
        const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
        std::nth_element(lengths.begin(), middle, lengths.end());
        const double times = heard_.tracks[track].seconds() / *middle;
        return times < kSlow ? std::string()
                             : fmt::format(
                                   "; it is {:.1f} times as long as the others: is it in slow "
                                   "motion? Film at the usual speed",
                                   times);
    }

    void set_by_hand() {
        for (CameraSync& camera : result_.cameras) {
            if (const capture::Clock* const set = by_hand(camera.camera)) {
                camera = {camera.camera, *set, true, false, {}, 0, 0, 0.0};
            }
            result_.is_whole = result_.is_whole && camera.clock.has_value();
        }
    }

    void doubt(const CameraSync& camera) {
        if (!camera.clock || camera.is_by_hand) {
            return;
        }
        if (camera.clock->confidence < kDoubtfulConfidence) {
            result_.warnings.push_back(
                fmt::format("{}: its clock is doubtful (confidence {:.2f}; {} of {} stretches of "
                            "5 s agree): compare the films, or set it by hand",
                            camera.camera,
                            camera.clock->confidence,
                            camera.used,
                            camera.compared));
        }
        if (camera.disagreement > kDoubtfulDisagreement) {
            result_.warnings.push_back(
                fmt::format("{}: two ways to its clock differ by {:.0f} ms: compare the films, "
                            "or set it by hand",
                            camera.camera,
                            1e3 * camera.disagreement));
        }
    }

    [[nodiscard]] const capture::Clock* by_hand(const std::string& camera) const {
        const auto set = std::find_if(plan_.by_hand.begin(),
                                      plan_.by_hand.end(),
                                      [&](const auto& clock) { return clock.camera == camera; });
        return set == plan_.by_hand.end() ? nullptr : &*set;
    }

    const SyncPlan& plan_;
    const std::function<bool(double)>& progress_;
    Tracks heard_;
    SyncResult result_;
};

}  // namespace

std::vector<capture::Clock> SyncResult::clocks() const {
    std::vector<capture::Clock> known;
    for (const CameraSync& camera : cameras) {
        if (camera.clock) {
            known.push_back(*camera.clock);
        }
    }
    return known;
}

Expected<SyncResult> synchronise(const SyncPlan& plan,
                                 const std::function<bool(double)>& progress) {
    if (plan.cameras.empty()) {
        return fail("there is no camera to synchronise");
    }
    std::vector<std::string_view> names;
    for (const CameraSound& camera : plan.cameras) {
        names.push_back(camera.camera);
    }
    for (const capture::Clock& clock : plan.by_hand) {
        if (std::find(names.begin(), names.end(), clock.camera) == names.end()) {
            return fail("clocks set by hand: " + unknown_name("camera", clock.camera, names));
        }
    }
    return Synchronisation(plan, progress).run();
}

}  // namespace raks::apps
