#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// Where a person's avatars lie, and what is meant by the name of one.
namespace raks::engine {

/// The name of the avatar that comes with Raks.
inline constexpr std::string_view kMannequinName = "mannequin";

/// $XDG_DATA_HOME/raks/avatars, or below ~/.local/share. Empty: neither is known. Threads: main.
[[nodiscard]] std::filesystem::path user_avatars_path();

/// Model files in user_avatars_path(), by name; none where there is no such folder. Errors: it
/// cannot be listed. Threads: main.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> list_avatars();

/// The file that `name` means: a file, else one in user_avatars_path() of that name with or without
/// its ending. Empty: kMannequinName. Errors: there is none, with the names that there are.
/// Threads: main.
[[nodiscard]] Expected<std::filesystem::path> find_avatar(const std::string& name);

/// The label file of a model (render::BoneLabels): `asked` if it is not empty, else the one beside
/// the model, me.labels.toml of me.3ds, if it is there. Empty: none. Threads: any.
[[nodiscard]] std::filesystem::path find_labels(const std::filesystem::path& model,
                                                const std::filesystem::path& asked);

}  // namespace raks::engine
