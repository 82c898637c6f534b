// A model file as the figure that dances in it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/expected.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/import/model_images.hpp"
#include "render/model/mannequin_style.hpp"
#include "render/model/model.hpp"

namespace raks::engine {

/// What a person says of an avatar's file.
struct AvatarOptions {
    /// Metres, above 0; none: its own where that is 0.5 to 2.5 m, else 1.7.
    std::optional<float> height;
    /// A label file (render::BoneLabels); empty: the one beside the model, if there is one.
    std::filesystem::path labels;
    /// What the mannequin wears.
    render::Costume costume = render::Costume::unitard;
    /// What the pictures on it may take of a driver's memory; the largest are halved till then.
    std::size_t most_image_bytes = render::kUsualImageBytes;
};

/// Finds the bones of a model: those that it names itself, else by the label file, by names and by
/// shape. A label file that is not needed is said in a warning of the model. Errors: those of the
/// label file and of render::map_humanoid. Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> find_bones(render::Model& model, const std::filesystem::path& labels);

/// A model whose nodes lie where its figure stands (stand_model), and what its rig needs.
struct AvatarModel {
    render::Model model;
    render::RigOptions options;
};

/// Reads a model and stands its figure up. Errors, with the file's name: those of its reader and of
/// find_bones; bones that a dancer needs are missing. Threads: workers. Real-time: no.
[[nodiscard]] Expected<AvatarModel> load_avatar_model(const std::filesystem::path& file,
                                                      const AvatarOptions& options = {});

/// How the error of a model ends that is motion or a skeleton alone.
inline constexpr std::string_view kMotionAlone =
    "has bones, but no surface to draw; an avatar is a model, not motion";

/// Whether a model that was read from `file` can be worn. Errors: it has nothing to draw
/// (kMotionAlone). Threads: any.
[[nodiscard]] Expected<void> check_has_surface(const render::Model& model,
                                               const std::filesystem::path& file);

}  // namespace raks::engine
