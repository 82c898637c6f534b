#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "audio/genre/tag_evidence.hpp"
#include "audio/io/audio_tags.hpp"
#include "base/expected.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/setup/formations.hpp"
#include "engine/setup/settings.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/show/avatar_clip.hpp"
#include "engine/show/picture.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::apps {

/// What every command that dances starts with.
struct DanceSetup {
    engine::DanceCatalogue catalogue;  ///< all dances
    engine::AnalyzerModels models;     ///< of the analyzer
    motion::Skeleton skeleton;         ///< of the body that dances
};

/// What the settings say of the avatar's file.
[[nodiscard]] engine::AvatarOptions avatar_options(const engine::Settings& settings);

/// Whether a label file that a person names can be read; an empty path can. Errors: those of
/// render::load_labels.
[[nodiscard]] Expected<void> check_labels(const std::filesystem::path& labels);

/// Whether there are the avatars and the label file that the settings name: before any work, for
/// commands that take them, also where nobody is seen. Errors: the first that is not there.
[[nodiscard]] Expected<void> check_avatars(const engine::Settings& settings);

/// Whether the setting is what the program remembers, or a preset holds: then it need not be there
/// any more.
[[nodiscard]] bool may_be_gone(const engine::Settings& settings, engine::SettingField field);

/// Puts the mannequin in the place of avatars that may be gone and are, and says so in one line.
void replace_missing_avatars(engine::Settings& settings);

/// engine::film_fps(), and says so where it is not what the settings say.
[[nodiscard]] double said_film_fps(const engine::Settings& settings);

/// A clip in a dance's place, on the mannequin's body as dances are; says what its model lacks. The
/// settings' label file is for it, too, where it is one of the avatar's own. Errors: those of
/// engine::AvatarClip::load. `arm_angle`: of a VMD (motion::MotionReadOptions). `others`: of
/// engine::AvatarClipOptions.
[[nodiscard]] Expected<engine::AvatarClip> open_clip(
    const std::string& motion,
    const engine::Settings& settings,
    std::optional<double> arm_angle = {},
    render::OtherNodes others = render::OtherNodes::folded);

/// The look that the settings ask for, with its avatar; says whose work that is, and what its file
/// lacks. Errors: those of engine::read_look and engine::load_avatar.
[[nodiscard]] Expected<engine::Look> open_look(const engine::Settings& settings);

/// True when `--dance` names a path: a folder of dances, or a written dance (.toml).
[[nodiscard]] bool is_dance_place(const std::string& dance);

/// Finds all dances, and prints once what is hidden or left out. Where `settings.dance` is a path,
/// the dance there is used, and its name replaces the path: a written dance is first learnt into a
/// folder of the user's cache, where it is found the next time. Errors: those of the catalogue, of
/// a written dance, and of the analyzer's models. `body`: that dances (render::dance_body).
[[nodiscard]] Expected<DanceSetup> open_dances(
    engine::Settings& settings, const motion::Skeleton& body = motion::mannequin_skeleton());

/// What a command that dances offline begins with.
struct OfflineSetup : DanceSetup {
    engine::Dancers dancers;
};
/// As open_dances(), and loads all dances that the settings ask for; says which were left out.
/// `bodies`: those that dancers have in turn, at least one. Errors: also those of
/// engine::Dancers::load.
[[nodiscard]] Expected<OfflineSetup> open_dancers(engine::Settings& settings,
                                                  std::vector<motion::Skeleton> bodies = {
                                                      motion::mannequin_skeleton()});

/// Reads what the person said of songs' dances for analyzers that dance; where it cannot be read,
/// one line says why and nothing was said. What measures leaves it out.
/// Threads: main.
void read_corrections(engine::AnalyzerModels& models);

/// "the file says salsa (Mambo)", "you said salsa"; empty: it says nothing.
[[nodiscard]] std::string told_line(const audio::TagEvidence& evidence);

/// What of a file is danced offline, and how.
struct OfflineMusic {
    std::filesystem::path file;
    SampleRate rate{48'000};  ///< of the file
    double start = 0.0;       ///< seconds into the file
    bool is_as_live = false;  ///< it is analyzed as it comes, and not all of it first
    audio::AudioTags tags{};  ///< what it says of itself
};
/// A driver for this music. Says where its own words speak for a dance. Analyzes all of the file
/// first, with progress on a terminal, unless it is to be danced as it comes. Errors: those of
/// engine::plan_song and OfflineDriver::create.
[[nodiscard]] Expected<engine::OfflineDriver> open_driver(const OfflineMusic& music,
                                                          const OfflineSetup& setup);

/// Says where that lies which was danced before a signal came, and how much it is.
void say_stopped(const std::vector<std::filesystem::path>& files, Nanos danced);

/// What a command that dances live begins with.
struct StageSetup : DanceSetup {
    engine::Formations formations;
};
/// A dance that came while a show runs, with all dances that there are beside it.
struct LoadedDance {
    std::shared_ptr<StageSetup> setup;
    std::string name;  ///< of the dance
};
/// Loads a written dance or a folder of dances for a show that runs. Errors: as open_formations.
/// Threads: workers.
[[nodiscard]] Expected<LoadedDance> load_dance(engine::Settings settings,
                                               const std::filesystem::path& place);

/// The same as open_formations() while a window is open: signals are noted. Threads: workers.
[[nodiscard]] Expected<StageSetup> load_formations(engine::Settings& settings);
/// As open_dances(), and solves the dance that the show begins with; others are solved while it
/// runs. Errors: also those of engine::Formations::load.
[[nodiscard]] Expected<StageSetup> open_formations(engine::Settings& settings);

}  // namespace raks::apps
