#include "apps/xbody/dropped_files.hpp"

#include <utility>

#include "base/printable.hpp"
#include "engine/setup/play_list.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

/// Reads one file after the other; what comes first counts.
class DropReader {
 public:
    void read(const DroppedFile& file) {
        if (engine::looks_like_music(file.path)) {
            take_first(file, music_);
        } else if (render::is_model_name(file.path)) {
            read_model(file);
        } else {
            take_first(file, motion_);
        }
    }

    // Once it is known whom a motion moves.
    DroppedFiles finish(const MotionWearer& wearer) {
        if (motion_) {
            motion_->sound = music_ ? music_->path : motion_->sound;
            read_motion(*motion_, wearer);
        }
        if (files_.motion.empty()) {
            files_.music = music_;
        }
        return std::move(files_);
    }

 private:
    void take_first(const DroppedFile& file, std::optional<DroppedFile>& place) {
        if (place) {
            files_.left_out.push_back(file.name);
        } else {
            place = file;
        }
    }

    void read_model(const DroppedFile& file) {
        auto model =
            load_shown_model({.file = file.path, .options = {}, .motion = {}, .joints = {}});
        if (!model) {
            files_.faults.push_back(model.error().message);
        } else if (model->as_read.meshes.empty() && !model->as_read.animations.empty()) {
            take_first(file, motion_);
        } else if (files_.model) {
            files_.left_out.push_back(file.name);
        } else {
            files_.model = std::move(*model);
        }
    }

    void read_motion(const DroppedFile& file, const MotionWearer& wearer) {
        auto clip =
            load_motion(file.path.string(), files_.model ? wearer_of(*files_.model) : wearer);
        if (!clip) {
            files_.faults.push_back(clip.error().message);
            return;
        }
        files_.motion = file.path.string();
        files_.motion_name = file.name;
        files_.sound = file.sound;
        if (files_.model) {
            wear(files_.motion, std::move(*clip), *files_.model);
        } else {
            files_.clip = std::move(*clip);
        }
    }

    DroppedFiles files_;
    std::optional<DroppedFile> motion_;
    std::optional<DroppedFile> music_;
};

}  // namespace

DroppedFile dropped_file(const std::string& path) {
    return {path, printable(std::filesystem::path(path).filename().string())};
}

DroppedFiles read_dropped(const std::vector<DroppedFile>& files, const MotionWearer& wearer) {
    DropReader reader;
    for (const DroppedFile& file : files) {
        reader.read(file);
    }
    return reader.finish(wearer);
}

std::string message_of(const DroppedFiles& files) {
    std::vector<std::string> sentences;
    if (files.model) {
        sentences.push_back("This is " + printable(files.model->file().filename().string()));
    }
    if (!files.motion_name.empty()) {
        sentences.push_back(fmt::format("It is moved by {}{}",
                                        files.motion_name,
                                        files.sound.empty() ? "" : ", with its music"));
    }
    if (files.music) {
        sentences.push_back("Making a dance to " + files.music->name);
    }
    if (!files.left_out.empty()) {
        sentences.push_back(fmt::format("Left out, as one is shown at a time: {}",
                                        fmt::join(files.left_out, ", ")));
    }
    sentences.insert(sentences.end(), files.faults.begin(), files.faults.end());
    if (files.model && !files.model->notes.empty()) {
        sentences.emplace_back("What was mended or left out of it is on File");
    }
    return fmt::format("{}", fmt::join(sentences, ". "));
}

std::string loading_message(const std::vector<DroppedFile>& files) {
    return files.size() == 1
               ? "Loading " + files.front().name
               : fmt::format("Loading {} and {} more", files.front().name, files.size() - 1);
}

}  // namespace raks::apps
