#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/reports/eval_avatar_report.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "engine/trials/avatar_measures.hpp"
#include "engine/trials/dance_trial.hpp"
#include "engine/trials/trained_figures.hpp"
#include "render/avatar/avatar.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using Figures = std::vector<motion::FigureModel>;

// A dance, and the music that it is measured to.
struct DanceTask {
    DanceInfo dance;
    Figures figures;
    engine::DanceTrial trial;
};

Bpm learnt_tempo(const Figures& figures) {
    double seconds = 0.0;
    for (const motion::FigureModel& figure : figures) {
        seconds += figure.learnt_tempo.seconds_per_beat() / static_cast<double>(figures.size());
    }
    return Bpm::from_period(seconds);
}

// The steady trial in the dance's own style that is nearest to its learnt tempo.
engine::DanceTrial own_trial(const DanceInfo& dance, Bpm learnt) {
    std::vector<engine::DanceTrial> trials = engine::standard_trials(dance, learnt);
    std::erase_if(trials, [&](const engine::DanceTrial& trial) {
        return trial.kind != engine::TrialKind::steady || !trial.name.starts_with(dance.name + "-");
    });
    const auto away = [&](const engine::DanceTrial& trial) {
        return std::abs(trial.music.tempo.front().bpm - learnt.bpm());
    };
    return *std::min_element(trials.begin(), trials.end(), [&](const auto& a, const auto& b) {
        return away(a) < away(b);
    });
}

// All dances, or the one that was asked for. Errors: a figure that cannot be read.
Expected<std::vector<DanceTask>> tasks_of(const DanceSetup& setup,
                                          const engine::Settings& settings) {
    std::vector<DanceTask> tasks;
    for (const DanceInfo& dance : setup.catalogue.list()->all()) {
        if (settings.dance != "auto" && settings.dance != dance.name) {
            continue;
        }
        auto figures = engine::trained_figures(
            *setup.catalogue.find(dance.name), motion::DanceRole::lead, engine::form_of(settings));
        if (!figures) {
            return fail(std::move(figures.error()));
        }
        engine::DanceTrial trial = own_trial(dance, learnt_tempo(*figures));
        tasks.push_back({dance, std::move(*figures), std::move(trial)});
    }
    return tasks;
}

// Dances and measures one dance.
Expected<AvatarDance> measured(const DanceSetup& setup,
                               const engine::Settings& settings,
                               const DanceTask& task,
                               const render::Avatar& avatar) {
    const motion::Skeleton body = render::dance_body(avatar);
    auto library = engine::load_dance(
        setup.catalogue, task.dance.name, body, motion::DanceRole::lead, engine::form_of(settings));
    if (!library) {
        return fail(std::move(library.error()));
    }
    const engine::TrialCast cast{
        setup.models,
        engine::cast_of(std::move(*library), body, static_cast<std::uint64_t>(settings.seed)),
        0};
    auto result = engine::run_trial(task.trial, cast, task.figures);
    if (!result) {
        return fail(std::move(result.error()));
    }
    std::vector<motion::Pose> poses;
    poses.reserve(result->poses.size());
    for (const motion::Pose& pose : result->poses) {
        poses.push_back(render::retargeted(pose, body, avatar));
    }
    AvatarDance dance;
    dance.dance = task.dance.name;
    dance.mesh = engine::measure_avatar(avatar, poses, engine::kTrialPosesPerSecond);
    dance.trial = std::move(*result);
    dance.pelvis_height = static_cast<double>(avatar.skeleton.hips_height() - avatar.pelvis_drop);
    return dance;
}

// One avatar in all dances. Errors: it cannot be loaded; a dance cannot be solved for it.
Expected<AvatarRow> row_of(const std::string& model,
                           const DanceSetup& setup,
                           const engine::Settings& settings,
                           std::span<const DanceTask> tasks) {
    auto loaded = engine::load_avatar(model);
    if (!loaded) {
        return fail(std::move(loaded.error()));
    }
    const render::Avatar& avatar = *loaded->avatar;
    AvatarRow row{.model = model,
                  .name = printable(Path(model).stem().string(), 60),
                  .height = static_cast<double>(avatar.height),
                  .hips_height = static_cast<double>(avatar.skeleton.hips_height()),
                  .dances = {}};
    ProgressLine progress("dancing");
    for (const DanceTask& task : tasks) {
        if (stop_signal()) {
            break;
        }
        progress.show(row.name + ", " + task.dance.name);
        auto dance = measured(setup, settings, task, avatar);
        if (!dance) {
            return fail(std::move(dance.error()).in(printable(model, 200)));
        }
        row.dances.push_back(std::move(*dance));
    }
    return row;
}

}  // namespace

ExitCode eval_avatar(const EvalAvatarArguments& given) {
    EvalAvatarArguments arguments = given;
    const auto setup = open_dances(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    const auto tasks = tasks_of(*setup, arguments.settings);
    if (!tasks) {
        return fail(tasks.error());
    }
    AvatarReport report{.seed = arguments.settings.seed, .avatars = {}};
    std::size_t left_out = 0;
    for (const std::string& model : arguments.models) {
        auto row = row_of(model, *setup, arguments.settings, *tasks);
        if (stop_signal()) {
            return kExitDone;  // half a table would mislead
        }
        if (row) {
            report.avatars.push_back(std::move(*row));
            continue;
        }
        if (arguments.models.size() == 1) {
            return fail(row.error());
        }
        complain(row.error().message);
        ++left_out;
    }
    if (report.avatars.empty()) {
        return fail(fmt::format("none of the {} models can dance", left_out));
    }
    arguments.as_json ? print_json(to_json(report)) : print_text(to_text(report));
    return left_out > 0 ? kExitPartly : kExitDone;
}

}  // namespace raks::apps
