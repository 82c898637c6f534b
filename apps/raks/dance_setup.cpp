#include "apps/raks/dance_setup.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "apps/dances/written_dance.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/offline/song_planner.hpp"
#include "engine/setup/asked_formation.hpp"
#include "engine/setup/dance_corrections.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/told_genre.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/dress_by_dance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

// A written dance is one file; a folder of dances has several.
bool is_written_dance(const fs::path& place) { return place.extension() == ".toml"; }

}  // namespace

engine::AvatarOptions avatar_options(const engine::Settings& settings) {
    engine::AvatarOptions options;
    if (settings.avatar_height > 0.0) {
        options.height = static_cast<float>(settings.avatar_height);
    }
    options.labels = settings.avatar_labels;
    options.most_image_bytes = static_cast<std::size_t>(settings.avatar_pictures_mb) << 20U;
    return options;
}

Expected<void> check_labels(const fs::path& labels) {
    if (labels.empty()) {
        return {};
    }
    const auto read = render::load_labels(labels);
    return read ? Expected<void>() : fail(read.error());
}

Expected<void> check_avatars(const engine::Settings& settings) {
    for (const std::string& name : settings.avatars) {
        if (const auto found = engine::find_avatar(name); !found) {
            return fail(found.error());
        }
    }
    return check_labels(settings.avatar_labels);
}

bool may_be_gone(const engine::Settings& settings, engine::SettingField field) {
    const engine::SettingRank rank = engine::origin_of(settings, field).rank;
    return rank == engine::SettingRank::window || rank == engine::SettingRank::preset;
}

void replace_missing_avatars(engine::Settings& settings) {
    if (!may_be_gone(settings, &engine::Settings::avatars)) {
        return;
    }
    std::string first;
    std::size_t missing = 0;
    for (std::string& name : settings.avatars) {
        if (!engine::find_avatar(name)) {
            first = missing++ == 0 ? name : first;
            name = engine::kMannequinName;
        }
    }
    if (missing > 0) {
        say(fmt::format("{}{}: not there any more; the mannequin dances instead",
                        printable(first),
                        missing > 1 ? fmt::format(" and {} more avatars", missing - 1) : ""));
    }
}

double said_film_fps(const engine::Settings& settings) {
    const double fps = engine::film_fps(settings);
    if (fps != settings.fps) {
        say(fmt::format("no monitor shows a film: it has {} pictures a second (--fps)", fps));
    }
    return fps;
}

Expected<engine::AvatarClip> open_clip(const std::string& motion,
                                       const engine::Settings& settings,
                                       std::optional<double> arm_angle,
                                       render::OtherNodes others) {
    engine::AvatarClipOptions options;
    options.others = others;
    options.avatar = engine::find_avatar(settings.avatars.front()).value_or(fs::path());
    options.labels = settings.avatar_labels;
    options.arm_angle = arm_angle;
    auto clip = engine::AvatarClip::load(motion, motion::mannequin_skeleton().offsets[0], options);
    if (clip) {
        if (!clip->choice().empty()) {
            say(clip->choice());
        }
        for (const std::string& warning : clip->warnings()) {
            say_detail(warning);
        }
    }
    return clip;
}

Expected<engine::Look> open_look(const engine::Settings& settings) {
    auto look = engine::read_look(settings);
    if (!look) {
        return look;
    }
    for (const std::string& note : look->notes) {
        say(note);
    }
    engine::AvatarOptions options = avatar_options(settings);
    options.costume = look->costume;
    look->most_image_bytes = options.most_image_bytes;
    if (settings.avatars.size() > 1 && !options.labels.empty()) {
        return fail(
            "--labels says which nodes are the bones of one avatar, and there are several: save "
            "each one's as MODEL.labels.toml beside it");
    }
    auto avatars = engine::load_avatars(settings.avatars, options);
    if (!avatars && may_be_gone(settings, &engine::Settings::avatars)) {
        say(avatars.error().message + "; the mannequin dances instead");
        avatars = engine::load_avatars({std::string(engine::kMannequinName)},
                                       {.height = {}, .labels = {}, .costume = look->costume});
    }
    if (!avatars) {
        return fail(std::move(avatars.error()));
    }
    const bool has_mannequin = std::any_of(
        avatars->begin(), avatars->end(), [](const auto& avatar) { return avatar.is_mannequin; });
    if (has_mannequin && (options.height || !options.labels.empty())) {
        say("the mannequin keeps its own height and bones");
    }
    for (const std::string& credit : engine::credits_of(*avatars)) {
        say("avatar: " + credit);
    }
    for (const engine::LoadedAvatar& avatar : *avatars) {
        for (const std::string& warning : avatar.warnings) {
            say_detail(warning);
        }
    }
    engine::put_on(std::move(*avatars), *look);
    return look;
}

// A name that could be a dance's is not looked for as a folder: "salsa" is the dance even where a
// folder of that name lies.
bool is_dance_place(const std::string& dance) {
    std::error_code ignored;
    return is_written_dance(dance) || dance.find('/') != std::string::npos ||
           (!is_dance_name(dance) && fs::is_directory(dance, ignored));
}

namespace {

Expected<DanceSetup> read_dances(engine::Settings& settings, const motion::Skeleton& body) {
    say_detail("loading the dances");
    fs::path given;
    if (is_dance_place(settings.dance)) {
        given = settings.dance;
        // Learnt figures make a folder of dances, which is then loaded like any other.
        if (is_written_dance(given)) {
            auto learnt = learn_written_dance(given, motion::mannequin_skeleton());
            if (!learnt) {
                return fail(std::move(learnt.error()));
            }
            given = std::move(*learnt);
        }
    }
    auto catalogue = engine::DanceCatalogue::load(given);
    if (!catalogue) {
        return fail(std::move(catalogue.error()));
    }
    // Only here, so that each note is printed once a run.
    for (const std::string& note : catalogue->notes()) {
        say(note);
    }
    // From here on the settings hold a name, as all later steps expect.
    if (!given.empty()) {
        settings.dance = catalogue->given_dance();
    }
    // The name can only be checked now that all dances are known.
    if (auto checked = engine::check_dances(settings, *catalogue); !checked) {
        return fail(std::move(checked.error()));
    }
    for (const std::string& note : engine::material_notes(settings, *catalogue)) {
        say(note);
    }
    for (const std::string& note : engine::dress_notes(*catalogue->list())) {
        say(note);
    }
    for (const std::string& note : engine::hold_notes(settings, *catalogue)) {
        say(note);
    }
    auto models = engine::load_analyzer_models(catalogue->list(), engine::genre_aids_of(settings));
    if (!models) {
        return fail(std::move(models.error()));
    }
    if (!models->tagger_note.empty()) {
        say(models->tagger_note);
    }
    return DanceSetup{std::move(*catalogue), std::move(*models), body};
}

}  // namespace

Expected<DanceSetup> open_dances(engine::Settings& settings, const motion::Skeleton& body) {
    // Nothing of what is loaded would be kept.
    const EndAtOnceOnSignals at_once;
    return read_dances(settings, body);
}

Expected<LoadedDance> load_dance(engine::Settings settings, const fs::path& place) {
    settings.dance = place.string();
    auto dances = read_dances(settings, motion::mannequin_skeleton());
    if (!dances) {
        return fail(std::move(dances.error()));
    }
    // The others stay within reach.
    const std::string name = std::exchange(settings.dance, "auto");
    auto formations = engine::Formations::load(settings, dances->catalogue, {dances->skeleton});
    if (!formations) {
        return fail(std::move(formations.error()));
    }
    return LoadedDance{
        std::make_shared<StageSetup>(StageSetup{std::move(*dances), std::move(*formations)}), name};
}

Expected<OfflineSetup> open_dancers(engine::Settings& settings,
                                    std::vector<motion::Skeleton> bodies) {
    const EndAtOnceOnSignals at_once;
    auto setup = open_dances(settings, bodies.front());
    if (!setup) {
        return fail(std::move(setup.error()));
    }
    // Bodies that nobody has are not solved for.
    bodies.resize(std::min(bodies.size(),
                           engine::asked_dancers(settings, engine::asked_formation(settings))));
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    auto dancers = engine::Dancers::load(settings, setup->catalogue, bodies, cores);
    if (!dancers) {
        return fail(std::move(dancers.error()));
    }
    // All dances must be ready: otherwise the result would depend on which thread is faster.
    for (const std::string& line : dancers->wait()) {
        say(line);
    }
    return OfflineSetup{std::move(*setup), std::move(*dancers)};
}

Expected<StageSetup> load_formations(engine::Settings& settings) {
    auto setup = read_dances(settings, motion::mannequin_skeleton());
    if (!setup) {
        return fail(std::move(setup.error()));
    }
    auto formations = engine::Formations::load(settings, setup->catalogue, {setup->skeleton});
    if (!formations) {
        return fail(std::move(formations.error()));
    }
    return StageSetup{std::move(*setup), std::move(*formations)};
}

Expected<StageSetup> open_formations(engine::Settings& settings) {
    const EndAtOnceOnSignals at_once;
    return load_formations(settings);
}

void read_corrections(engine::AnalyzerModels& models) {
    auto corrections = engine::DanceCorrections::load();
    if (!corrections) {
        complain(corrections.error().message + "; no dance that you said is used");
        corrections = engine::DanceCorrections();
    }
    models.corrections = std::make_shared<engine::KeptCorrections>(std::move(*corrections));
}

std::string told_line(const audio::TagEvidence& evidence) {
    if (evidence.dance().empty()) {
        return {};
    }
    return evidence.is_by_person ? fmt::format("you said {}", engine::told_name(evidence))
                                 : fmt::format("the file says {} ({})",
                                               engine::told_name(evidence),
                                               fmt::join(evidence.words, ", "));
}

Expected<engine::OfflineDriver> open_driver(const OfflineMusic& music, const OfflineSetup& setup) {
    const engine::Cast cast = setup.dancers.cast();
    if (const std::string line = told_line(engine::told_by(setup.models, music.tags, music.file));
        !line.empty()) {
        say_detail(line);
    }
    if (!music.is_as_live) {
        ProgressLine progress("analyzing");
        auto plan = engine::plan_song(
            music.file,
            setup.models,
            [&](double share) { progress.show(share); },
            [] { return stop_signal().has_value(); });
        if (!plan) {
            return fail(std::move(plan.error()));
        }
        if (stop_signal()) {
            return fail("stopped while the music was analyzed");
        }
        if (*plan) {
            // At a whole frame, as it is decoded from there on.
            const StreamTime start =
                music.rate.time_of(music.rate.index_at(stream_time_from_seconds(music.start)));
            return engine::OfflineDriver::create(music.rate, std::move(*plan), start, cast);
        }
        say(music.file.string() +
            ": is longer than an hour, so that it is not analyzed before it plays");
    }
    auto driver = engine::OfflineDriver::create(
        music.rate, engine::told(setup.models, music.tags, music.file), cast);
    if (!driver) {
        return fail(std::move(driver.error()).in(music.file.string()));
    }
    return driver;
}

void say_stopped(const std::vector<fs::path>& files, Nanos danced) {
    std::string names;
    for (const fs::path& file : files) {
        names += (names.empty() ? "" : ", ") + printable(file.string());
    }
    say(fmt::format("stopped: {} {} the first {:.1f} s",
                    names,
                    files.size() == 1 ? "holds" : "hold",
                    to_seconds(danced)));
}

}  // namespace raks::apps
