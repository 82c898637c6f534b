#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "engine/setup/dance_folder.hpp"

namespace raks::apps {

/// Where learnt figures are written to.
struct Destination {
    std::filesystem::path file;    ///< one model, and nothing else; empty: into a folder
    std::filesystem::path folder;  ///< of dances (engine/setup/dance_folder.hpp)
    std::string name;              ///< that `output` gives the dance; empty: none
    bool is_installed = false;     ///< the folder is where `--dance NAME` finds it
};

/// Interprets `-o OUTPUT`: a path that ends in .json is one model; a path with a '/', or an
/// existing folder, is a folder of dances; everything else is the name of a dance, which is
/// installed below user_dances_path(). Empty: `otherwise` is that name. Errors: a name that a dance
/// cannot have; no home folder to install in.
[[nodiscard]] Expected<Destination> destination_of(const std::string& output,
                                                   const std::string& otherwise);

/// Writes the figures there, and says on stderr where they are and how to dance them. `dance`: the
/// entry of a folder's dances.toml. Errors: several figures for one
/// file; as add_to_folder and save_figure.
[[nodiscard]] Expected<void> deliver(const Destination& destination,
                                     const DanceInfo& dance,
                                     std::span<const engine::LearntFigure> figures,
                                     const engine::NewGrammar& grammar = {});

}  // namespace raks::apps
