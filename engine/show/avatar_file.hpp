// Avatars by name: the mannequin, a file, or one in the person's folder.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::render {
struct Avatar;
struct Licence;
}  // namespace raks::render

namespace raks::engine {

inline constexpr std::string_view kMannequinName = "mannequin";

/// An avatar, and what a person should know of it.
struct LoadedAvatar {
    std::shared_ptr<const render::Avatar> avatar;  ///< never null
    std::string credit;                 ///< whose work, under which licence; the mannequin: empty
    bool is_credit_required = false;    ///< its licence asks for the line
    std::vector<std::string> warnings;  ///< one line each, for people
};

/// The person's avatars: $XDG_DATA_HOME/raks/avatars, or below the home. May not exist.
[[nodiscard]] std::filesystem::path user_avatars_path();

/// Files of the person's avatars, by name. Empty where the folder is not there.
[[nodiscard]] std::vector<std::filesystem::path> user_avatars();

/// The file that a setting names: a path, or the name, with or without its ending, of one of the
/// person's avatars. Errors: there is no such file, with the names that there are.
[[nodiscard]] Expected<std::filesystem::path> find_avatar(const std::string& name);

/// "Seed-san by VirtualCast, Inc., VRM Public License 1.0 (credit required)". Pure.
[[nodiscard]] std::string credit_line(const render::Licence& licence, const std::string& file);

/// Loads an avatar: `mannequin`, or as find_avatar. `height`: metres; none: its own where that is
/// 0.5 to 2.5 m, else 1.7. Errors: those of find_avatar; of the file (base/file.hpp); of its reader,
/// with what is wrong and where; bones that a dancer needs are missing. Threads: workers.
/// Real-time: no.
[[nodiscard]] Expected<LoadedAvatar> load_avatar(const std::string& name,
                                                 std::optional<float> height = std::nullopt);

}  // namespace raks::engine
