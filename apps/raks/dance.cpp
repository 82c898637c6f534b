#include "apps/raks/commands.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/raks/dance_setup.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/danced_faces.hpp"
#include "engine/show/danced_model.hpp"
#include "engine/show/given_away.hpp"
#include "engine/show/picture.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/formats/mmd/vmd_writer.hpp"
#include "motion/skeleton/formats/vrma.hpp"
#include "render/export/glb_writer.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// One dancer's dance, at an even rate.
struct Danced {
    std::span<const motion::Pose> poses;
    std::vector<render::Face> faces;  // one a pose
};

// What passes each hop on to poses and faces.
class CollectDance final : public engine::OfflineDriver::Sink {
 public:
    CollectDance(double fps, const engine::FaceHabits& habits) : poses(fps), faces(fps, habits) {}

    void on_hop(const engine::PerformedHop& hop) override {
        poses.on_hop(hop);
        faces.advance(hop.music, hop.tracks);
    }
    [[nodiscard]] Danced of(std::size_t dancer) const {
        const std::vector<motion::Pose>& own = poses.dancers[dancer];
        return {own, faces.of(dancer, own.size())};
    }

    engine::CollectPoses poses;
    engine::CollectFaces faces;
};

bool is_motion_alone(const Path& output) {
    return output.extension() == ".bvh" || output.extension() == ".vrma" ||
           output.extension() == ".vmd";
}

// Writes one dancer's dance as motion alone.
Expected<void> write_motion(const Path& path,
                            const motion::Skeleton& skeleton,
                            const Danced& danced,
                            const DanceArguments& arguments) {
    if (path.extension() == ".bvh") {
        return motion::write_bvh(path, skeleton, danced.poses, arguments.fps);
    }
    const auto face = engine::expression_tracks(danced.faces);
    if (path.extension() == ".vrma") {
        return motion::write_vrma(path, skeleton, danced.poses, arguments.fps, face);
    }
    const auto note = motion::write_vmd(
        path, skeleton, danced.poses, arguments.fps, face, {.legs = arguments.legs});
    if (!note) {
        return fail(note.error());
    }
    if (!note->empty()) {
        say(*note);
    }
    return {};
}

bool is_with_avatar(const Path& output) { return output.extension() == ".glb"; }

// The files of the avatars that were asked for; an empty path stands for the mannequin.
Expected<std::vector<Path>> avatar_files(const DanceArguments& arguments) {
    std::vector<Path> files;
    for (const std::string& name : arguments.settings.avatars) {
        auto file = engine::find_avatar(name);
        if (!file) {
            return fail(file.error());
        }
        files.push_back(std::move(*file));
    }
    return files;
}

// The models that dance, in turn. Says what is wrong with their files.
Expected<std::vector<render::Model>> models_of(const std::vector<Path>& files,
                                               const engine::AvatarOptions& options) {
    std::vector<render::Model> models;
    for (const Path& file : files) {
        if (file.empty()) {
            models.push_back(engine::mannequin_to_give_away());
            continue;
        }
        auto model = engine::load_to_give_away(file, options);
        if (!model) {
            return fail(std::move(model.error()));
        }
        if (auto checked = engine::check_has_surface(*model, file); !checked) {
            return fail(std::move(checked.error()));
        }
        for (const std::string& warning : model->warnings) {
            say_detail(warning);
        }
        models.push_back(std::move(*model));
    }
    return models;
}

// The bodies of the models; without models the mannequin's.
std::vector<motion::Skeleton> bodies_of(const std::vector<render::Model>& models) {
    std::vector<motion::Skeleton> bodies;
    bodies.reserve(models.size() + 1);
    for (const render::Model& model : models) {
        bodies.push_back(engine::dance_body_of(model));
    }
    if (bodies.empty()) {
        bodies.push_back(motion::mannequin_skeleton());
    }
    return bodies;
}

// The file of one dancer: x.bvh when there is one, else x_1.bvh, x_2.bvh, ...; of a couple 1 leads.
Path file_of(const Path& output, std::size_t dancer, std::size_t dancers) {
    if (dancers == 1) {
        return output;
    }
    Path path = output;
    path.replace_filename(
        fmt::format("{}_{}{}", output.stem().string(), dancer + 1, output.extension().string()));
    return path;
}

// Writes one dancer's model with its dance as an animation.
Expected<void> write_model(const Path& path,
                           render::Model model,
                           const Danced& danced,
                           const DanceArguments& arguments) {
    if (danced.poses.empty()) {
        return fail(path.string() + ": there is nothing to dance to");
    }
    engine::put_dance(model,
                      danced.poses,
                      danced.faces,
                      arguments.fps,
                      path.stem().string(),
                      arguments.input.filename().string());
    const auto bytes = render::glb_bytes(model);
    return bytes ? write_file(path, *bytes) : fail(bytes.error());
}

// Puts a copy of the music beside the models, whose files name it. A file of that name is kept.
Expected<void> lay_music_beside(const Path& output, const Path& music) {
    Path beside = output;
    beside.replace_filename(music.filename());
    std::error_code ignored;
    if (is_there(beside)) {
        if (!std::filesystem::equivalent(beside, music, ignored)) {
            say(beside.string() + ": lies there already and stays as it is");
        }
        return {};
    }
    std::ifstream from(music, std::ios::binary);
    auto copy = PendingFile::create(beside);
    if (!copy) {
        return fail(copy.error());
    }
    std::vector<char> block(std::size_t{1} << 20U);
    while (from.read(block.data(), static_cast<std::streamsize>(block.size())), from.gcount() > 0) {
        const std::string_view bytes(block.data(), static_cast<std::size_t>(from.gcount()));
        if (auto written = copy->write(bytes); !written) {
            return written;
        }
    }
    if (!from.eof()) {
        return fail(music.string() + ": cannot be read to its end; it is not copied");
    }
    return copy->commit();
}

// Dances to all of the music, or to what was read when a signal came.
void dance_through(engine::MusicSource& source,
                   engine::OfflineDriver& driver,
                   CollectDance& collect) {
    ProgressLine progress("dancing");
    for (auto block = source.next(); !block.mono.empty() && !stop_signal(); block = source.next()) {
        driver.feed(block.mono, collect);
        if (const auto share = source.progress()) {
            progress.show(*share);
        }
    }
    driver.finish(collect);
    collect.poses.finish(source.given());
}

}  // namespace

ExitCode dance(const DanceArguments& given) {
    DanceArguments arguments = given;
    // Checked before the music is read, as everything that can fail at once.
    const bool is_alone = is_motion_alone(arguments.output);
    if (!is_alone && !is_with_avatar(arguments.output)) {
        return fail(arguments.output.string() +
                    ": cannot write this kind of motion; known: .bvh, .vrma, .vmd, .glb");
    }
    auto avatars = avatar_files(arguments);
    if (!avatars) {
        return fail(std::move(avatars.error()));
    }
    std::vector<Path> inputs = *avatars;
    inputs.push_back(arguments.input);
    if (auto checked = check_output(arguments.output, inputs); !checked) {
        return fail(std::move(checked.error()));
    }
    auto source = engine::MusicSource::open(arguments.input);
    if (!source) {
        return fail(source.error());
    }
    if (is_alone) {
        std::erase(*avatars, Path());
    }
    auto models = models_of(*avatars, avatar_options(arguments.settings));
    if (!models) {
        return fail(models.error());
    }
    // Avatars are loaded even so: one that cannot dance is an error here, too.
    if (is_alone && !models->empty()) {
        say(arguments.output.string() +
            ": holds the motion of the mannequin's body; write X.glb to have it on the avatar");
        models->clear();
    }
    auto setup = open_dancers(arguments.settings, bodies_of(*models));
    if (!setup) {
        return fail(setup.error());
    }
    read_corrections(setup->models);
    auto driver = open_driver(
        {arguments.input, source->rate(), 0.0, arguments.is_as_live, source->tags()}, *setup);
    if (!driver) {
        return fail(std::move(driver.error()));
    }
    // Poses are kept in memory: files need their number before the first.
    CollectDance collect(arguments.fps, engine::face_habits(arguments.settings));
    dance_through(*source, *driver, collect);
    if (!source->warning().empty()) {
        say(source->warning());
    }
    // A dance that a signal cut short must not replace the file of a whole one.
    const bool is_stopped = stop_signal().has_value();
    // No hop was danced.
    if (collect.poses.dancers.empty()) {
        collect.poses.dancers
            .emplace_back();  // of no length: the writer says that there are no poses
    }
    // One file a dancer.
    std::vector<Path> files;
    for (std::size_t i = 0; i < collect.poses.dancers.size(); ++i) {
        const Path whole = file_of(arguments.output, i, collect.poses.dancers.size());
        const Path path = is_stopped ? stopped_name(whole) : whole;
        files.push_back(path);
        const auto written =
            is_alone ? write_motion(path, setup->skeleton, collect.of(i), arguments)
                     : write_model(path, (*models)[i % models->size()], collect.of(i), arguments);
        if (!written) {
            return fail(written.error());
        }
    }
    if (is_stopped) {
        say_stopped(files, source->given());
    }
    if (!is_alone) {
        if (auto laid = lay_music_beside(arguments.output, arguments.input); !laid) {
            return fail(laid.error());
        }
    }
    return kExitDone;
}

}  // namespace raks::apps
