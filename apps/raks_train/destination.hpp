#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "engine/setup/dance_folder.hpp"

namespace raks::apps {

/// Where what is learnt goes.
struct Destination {
    std::filesystem::path file;    ///< one model, and nothing else; empty: into a folder
    std::filesystem::path folder;  ///< of dances (engine/setup/dance_folder.hpp)
    std::string name;              ///< that `output` gives the dance; empty: none
    bool is_installed = false;     ///< the folder is where `--dance NAME` finds it
};

/// What `-o OUTPUT` means: a path that ends in .json is one model; a path with a '/' or a folder
/// that is there is a folder of dances; all else is the name of a dance, which is installed below
/// user_dances_path(). Empty: `otherwise` is that name.
/// Errors: a name that a dance cannot have; no home to install it in.
[[nodiscard]] Expected<Destination> destination_of(const std::string& output,
                                                   const std::string& otherwise);

/// Puts the figures there, and says on stderr where they are and how they are danced.
/// `dance`: for a folder. Errors: a file with several figures; as add_to_folder and save_figure.
[[nodiscard]] Expected<void> deliver(const Destination& destination,
                                     const DanceInfo& dance,
                                     std::span<const engine::LearntFigure> figures);

}  // namespace raks::apps
