#include "apps/raks/avatar_document.hpp"
#include "apps/raks/commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace raks::apps {
namespace {

using Json = nlohmann::ordered_json;

// Names in files need not be UTF-8.
std::string text_of(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Finds the bones of a model that does not name them. One without a figure is shown, too.
void find_bones(render::Model& model) {
    if (const auto mapped = render::map_humanoid(model); !mapped) {
        model.warnings.push_back("it cannot dance: " + mapped.error().message);
    }
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
        return fail("the mannequin is no file: it is made by Raks itself");
    }
    auto model = render::load_model(*file);
    if (!model) {
        return fail(model.error());
    }
    find_bones(*model);
    if (arguments.as_json) {
        print_json(text_of(avatar_document(*model, file->string())));
    } else {
        print_text(avatar_text(*model, file->string()));
    }
    return kExitDone;
}

}  // namespace raks::apps
