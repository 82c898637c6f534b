#include <string>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "apps/xbody/shown_model.hpp"
#include "apps/xbody/xbody_film.hpp"
#include "apps/xbody/xbody_window.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_clip.hpp"
#include "engine/show/avatar_files.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// `usual`: where none is asked for.
Expected<engine::PictureSize> size_of(const XbodyArguments& arguments, engine::PictureSize usual) {
    if (arguments.size.empty()) {
        return usual;
    }
    auto size = engine::parse_size(arguments.size);
    return size ? size : fail("--size: " + size.error().message);
}

XbodyFilmPlan film_plan(const XbodyArguments& arguments, const engine::PictureSize& size) {
    return {.output = arguments.output,
            .frame = arguments.frame,
            .rate = arguments.rate,
            .view = arguments.view,
            .size = size,
            .has_names = arguments.has_names};
}

// Errors: what can be said before anything is read.
Expected<void> check(const XbodyArguments& arguments, const engine::PictureSize& size) {
    if (arguments.output.empty()) {
        return {};
    }
    if (auto possible = check_xbody_film(film_plan(arguments, size)); !possible) {
        return possible;
    }
    return check_output(arguments.output,
                        {arguments.model, engine::AvatarClip::file_of(arguments.motion)});
}

Expected<void> show(const XbodyArguments& arguments,
                    ShownModel model,
                    const engine::PictureSize& size) {
    if (arguments.output.empty()) {
        return xbody_in_window(std::move(model),
                               {.width = size.width,
                                .height = size.height,
                                .view = arguments.view,
                                .frame = arguments.frame.value_or(0),
                                .has_names = arguments.has_names},
                               [] { return stop_signal().has_value(); });
    }
    ProgressLine progress("filming");
    const auto written =
        write_xbody_film(film_plan(arguments, size), std::move(model), [&](double share) {
            progress.show(share);
            return !stop_signal().has_value();
        });
    if (!written) {
        return fail(written.error());
    }
    if (*written != arguments.output) {
        say(fmt::format("stopped: {} holds what was filmed", printable(written->string())));
    }
    return {};
}

Expected<ShownModel> load(const XbodyArguments& arguments) {
    auto file = engine::find_avatar(arguments.model);
    if (!file) {
        return fail(std::move(file.error()));
    }
    if (file->empty()) {
        return fail("the mannequin has no file, as Raks makes it itself: name the file of a model");
    }
    auto joints = arguments.joints.labels();
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    return load_shown_model({std::move(*file),
                             arguments.options,
                             arguments.motion,
                             std::move(*joints),
                             arguments.arm_angle});
}

}  // namespace

ExitCode xbody(const XbodyArguments& arguments) {
    const auto size = size_of(
        arguments,
        arguments.output.empty() ? engine::PictureSize{1280, 720} : engine::PictureSize{960, 720});
    if (!size) {
        return fail(size.error());
    }
    if (auto possible = check(arguments, *size); !possible) {
        return fail(possible.error());
    }
    auto model = load(arguments);
    if (!model) {
        return fail(model.error());
    }
    for (const std::string& note : model->notes) {
        say(fmt::format("{}: {}", printable(arguments.model), note));
    }
    return exit_code_of(show(arguments, std::move(*model), *size));
}

}  // namespace raks::apps
