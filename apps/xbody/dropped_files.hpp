// Dropped files: what is to be shown of models, motions and music that were dropped together.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/xbody/shown_model.hpp"
#include "engine/live/clip_sound.hpp"

namespace raks::apps {

/// A file, and what people call it.
struct DroppedFile {
    std::filesystem::path path;
    std::string name;               ///< printable
    std::filesystem::path sound{};  ///< of a motion: its music; empty: none
};
/// One that is called as its file is.
[[nodiscard]] DroppedFile dropped_file(const std::string& path);

/// What of them is shown: the first of the models, the first of the motions, and the first piece of
/// music, which is that of the motion, or where there is none danced to. Models and motions are
/// told apart by what is in them: a model without a surface is a motion.
struct DroppedFiles {
    std::optional<ShownModel> model;            ///< moved by the motion, where there is one
    std::optional<engine::AvatarClip> clip;     ///< for the model that is shown already
    std::string motion;                         ///< its path; empty: none
    std::string motion_name;                    ///< of the motion, whoever it moves; empty: none
    std::optional<DroppedFile> music;           ///< to be danced to
    std::filesystem::path sound;                ///< of the motion; empty: it has none
    std::unique_ptr<engine::ClipSound> player;  ///< of the sound; null: nobody opened it
    std::vector<std::string> left_out;          ///< names of what is good but too many
    std::vector<std::string> faults;            ///< one line each
};

/// Reads them. `wearer`: whom a motion without a model moves. `files` in the order in which they
/// count. Threads: workers. Real-time: no.
[[nodiscard]] DroppedFiles read_dropped(const std::vector<DroppedFile>& files,
                                        const MotionWearer& wearer);

/// What a person is told of it, in a line: what is shown, what is left out, and faults.
[[nodiscard]] std::string message_of(const DroppedFiles& files);

/// While they are read: "Loading a.vrm and 2 more". `files`: not empty.
[[nodiscard]] std::string loading_message(const std::vector<DroppedFile>& files);

}  // namespace raks::apps
