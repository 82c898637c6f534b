#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/avatar_document.hpp"
#include "apps/raks/avatar_face.hpp"
#include "apps/raks/avatar_picture.hpp"
#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/json.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/avatar_model.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "engine/show/standing_model.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_reader.hpp"
#include "render/import/standing_body.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Names in files need not be UTF-8.
std::string text_of(const Json& json) { return json.text(2) + "\n"; }

/// Finds the bones of a model that does not name them. One without a body is shown, too, but a
/// label file that is wrong is a fault.
Expected<void> find_bones(render::Model& model, const Path& labels) {
    auto found = engine::find_bones(model, labels);
    if (!found && labels.empty()) {
        model.warnings.push_back("it cannot dance: " + found.error().message);
        return {};
    }
    return found;
}

Expected<void> check_thumbnail(const Path& thumbnail, const Path& model) {
    if (thumbnail.empty()) {
        return {};
    }
    if (thumbnail.extension() != ".png") {
        return fail(printable(thumbnail.string()) + ": a thumbnail is written as .png");
    }
    return check_output(thumbnail, {model});
}

// How tall it dances; none: it has no body.
std::optional<float> dancing_height(render::Model& model, const std::optional<float>& height) {
    if (!render::missing_bones(model.character.humanoid).empty()) {
        return std::nullopt;
    }
    const render::StandingBody standing = render::stand_up(model, height);
    return standing.height * standing.scale;
}

// A picture of the model, as a body at ease where it has one. Changes the model.
Expected<void> write_thumbnail(const AvatarShowArguments& arguments, render::Model model) {
    if (model.meshes.empty()) {
        return fail(fmt::format("{}: there is nothing in it to draw", printable(arguments.model)));
    }
    engine::AvatarModel shown{std::move(model), {}};
    if (render::missing_bones(shown.model.character.humanoid).empty()) {
        shown.options = engine::stand_model(shown.model, arguments.options.height);
    } else {
        shown.options = engine::stand_thing(shown.model);
    }
    const auto loaded = engine::make_avatar(shown, arguments.model);
    const render::Avatar& avatar = *loaded.avatar;
    render::RigState state(*avatar.rig);
    const motion::Pose pose = pose_at_ease(avatar);
    // The springs hang as they do after a while.
    const auto still = [&](StreamTime) { return pose; };
    render::advance(*avatar.rig, StreamTime{}, 1.0F, still, state);
    render::pose_avatar(*avatar.rig, pose, {}, 1.0F, state);
    if (auto done = put_on_face(arguments.expression, *avatar.rig, state); !done) {
        return done;
    }
    constexpr int kSide = 512;
    return write_avatar_picture(
        arguments.thumbnail,
        avatar,
        pose,
        state,
        {.width = kSide, .height = kSide, .camera = portrait_camera(shown, avatar)});
}

Json json_of(const std::vector<MorphWeight>& weights) {
    Json list = Json::array();
    for (const MorphWeight& weight : weights) {
        list.push_back(
            {{"node", weight.node}, {"target", weight.target}, {"weight", weight.weight}});
    }
    return list;
}

std::string text_of(const std::vector<MorphWeight>& weights) {
    std::string text = weights.empty() ? "the face moves no morph target\n" : "";
    for (const MorphWeight& weight : weights) {
        text += fmt::format(
            "morph target {} of node {}: {:g}\n", weight.target, weight.node, weight.weight);
    }
    return text;
}

}  // namespace

ExitCode avatar_list(const AvatarListArguments& arguments) {
    const auto files = engine::list_avatars();
    if (!files) {
        return fail(files.error());
    }
    Json json = {{"format", "raks-avatars"}, {"version", 1}};
    Json& list = json["avatars"] = Json::array();
    list.push_back({{"name", engine::kMannequinName}, {"file", nullptr}});
    std::string text = fmt::format("{} (comes with Raks)\n", engine::kMannequinName);
    for (const Path& file : *files) {
        const std::string name = file.stem().string();
        list.push_back({{"name", name}, {"file", file.string()}});
        text += fmt::format("{}\n  {}\n", printable(name), printable(file.string()));
    }
    if (files->empty()) {
        text += fmt::format("yours: put .vrm or .glb files into {}\n",
                            printable(engine::user_avatars_path().string()));
    }
    if (arguments.as_json) {
        print_json(text_of(json));
    } else {
        print_text(text);
    }
    return kExitDone;
}

ExitCode avatar_show(const AvatarShowArguments& arguments) {
    const auto file = engine::find_avatar(arguments.model);
    if (!file) {
        return fail(file.error());
    }
    if (file->empty()) {
        return fail("the mannequin has no file, as Raks makes it itself: name the file of a model");
    }
    if (auto possible = check_thumbnail(arguments.thumbnail, *file); !possible) {
        return fail(possible.error());
    }
    auto model = render::load_model(*file);
    if (!model) {
        return fail(model.error());
    }
    const Path labels = engine::find_labels(*file, arguments.options.labels);
    if (auto found = find_bones(*model, labels); !found) {
        return fail(found.error());
    }
    const auto height = dancing_height(*model, arguments.options.height);
    Json json = avatar_document(*model, file->string());
    json["dances_at_m"] = height ? Json(*height) : Json();
    std::string text = avatar_text(*model, file->string());
    if (!arguments.expression.empty()) {
        const render::AvatarRig rig = render::build_rig(*model);
        render::RigState state(rig);
        if (auto done = put_on_face(arguments.expression, rig, state); !done) {
            return fail(done.error());
        }
        const auto weights = morph_weights(*model, rig, state);
        json["morph_weights"] = json_of(weights);
        text += text_of(weights);
    }
    if (!arguments.thumbnail.empty()) {
        if (auto written = write_thumbnail(arguments, std::move(*model)); !written) {
            return fail(written.error());
        }
    }
    if (arguments.as_json) {
        print_json(text_of(json));
    } else {
        print_text(text);
    }
    return kExitDone;
}

}  // namespace raks::apps
