// A model as a figure to be given away.
#pragma once

#include <filesystem>

#include "base/expected.hpp"
#include "engine/show/avatar_model.hpp"
#include "render/model/model.hpp"

namespace raks::engine {

/// Reads a model as VRM 1.0 has figures: standing in its T-pose, facing +z, as tall as it dances,
/// with a tail at the end of each chain that swings. Errors: those of load_avatar_model.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<render::Model> load_to_give_away(const std::filesystem::path& file,
                                                        const AvatarOptions& options);

/// The mannequin in the first outfit of the stage. Threads: workers. Real-time: no (0.3 s).
[[nodiscard]] render::Model mannequin_to_give_away();

}  // namespace raks::engine
