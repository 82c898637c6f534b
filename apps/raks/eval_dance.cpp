#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "apps/clips/clip_reading.hpp"
#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/reports/eval_dance_report.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/audio_file.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/trials/trained_figures.hpp"
#include "motion/dance_library.hpp"

namespace raks::apps {
namespace {

using Figures = std::vector<motion::FigureModel>;

// The name of the trial that measures the dynamics; it has no landings, feet and jerks.
constexpr std::string_view kDynamicsTrial = "dynamics";

// All standard trials of the dance, or those named but for kDynamicsTrial. Errors: an unknown name.
Expected<std::vector<engine::DanceTrial>> chosen_trials(const DanceInfo& dance,
                                                        const Figures& figures,
                                                        const std::vector<std::string>& names) {
    // The mean period of all figures, which is averaged and not the tempo: trials are placed around
    // it.
    double seconds_per_beat = 0.0;
    for (const motion::FigureModel& figure : figures) {
        seconds_per_beat +=
            figure.learnt_tempo.seconds_per_beat() / static_cast<double>(figures.size());
    }
    std::vector<engine::DanceTrial> all =
        engine::standard_trials(dance, Bpm::from_period(seconds_per_beat));
    if (names.empty()) {
        return all;
    }
    // For the suggestion.
    std::vector<std::string_view> known;
    known.reserve(all.size() + 1);
    for (const engine::DanceTrial& trial : all) {
        known.push_back(trial.name);
    }
    known.push_back(kDynamicsTrial);
    std::vector<engine::DanceTrial> chosen;
    for (const std::string& name : names) {
        if (name == kDynamicsTrial) {
            continue;
        }
        const auto found = std::find_if(
            all.begin(), all.end(), [&](const auto& trial) { return trial.name == name; });
        if (found == all.end()) {
            return fail(unknown_name("trial", name, known));
        }
        chosen.push_back(*found);
    }
    return chosen;
}

// What is danced and measured.
struct Measured {
    const DanceSetup& setup;
    const DanceReport& report;
    engine::DanceForm form;
    motion::Dynamics dynamics = motion::Dynamics::on;

    [[nodiscard]] Expected<std::shared_ptr<const motion::DanceLibrary>> library(
        motion::DanceRole role) const {
        return engine::load_dance(setup.catalogue, report.dance.name, setup.skeleton, role, form);
    }
};

// The library that dances: the lead's is the one that `raks play` uses; for a follow
// alone one is built from all figures that were learnt from follows.
Expected<std::shared_ptr<const motion::DanceLibrary>> library_of(const Measured& measured,
                                                                 const Figures& figures) {
    if (measured.report.role == motion::DanceRole::lead) {
        return measured.library(measured.report.role);
    }
    return motion::DanceLibrary::build(
        figures, measured.setup.skeleton, nullptr, measured.form.generator);
}

// The cast: the measured role alone, or the couple.
Expected<engine::TrialCast> cast_of(const Measured& measured, const Figures& figures) {
    using motion::Formation;
    using motion::Repertoire;
    const auto seed = static_cast<std::uint64_t>(measured.report.seed);
    const DanceSetup& setup = measured.setup;
    if (measured.form.company != engine::Company::couple) {
        const auto library = library_of(measured, figures);
        if (!library) {
            return fail(library.error());
        }
        return engine::TrialCast{
            setup.models, engine::cast_of(*library, setup.skeleton, seed, measured.dynamics), 0};
    }
    const auto lead = measured.library(motion::DanceRole::lead);
    if (!lead) {
        return fail(lead.error());
    }
    const auto follow = measured.library(motion::DanceRole::follow);
    if (!follow) {
        return fail(follow.error());
    }
    return engine::TrialCast{setup.models,
                             motion::members_of(Formation::couple,
                                                {{setup.skeleton, Repertoire::of_one(*lead)},
                                                 {setup.skeleton, Repertoire::of_one(*follow)}},
                                                seed,
                                                measured.dynamics),
                             // The lead is member 0, the follow member 1.
                             static_cast<std::size_t>(measured.report.role)};
}

// The figures of a written dance, each danced by itself; empty where the dance was captured.
Expected<std::vector<engine::DancedWrittenFigure>> written_of(const Measured& measured) {
    const auto library = measured.library(measured.report.role);
    if (!library) {
        return fail(library.error());
    }
    return engine::danced_written_figures(measured.report.dance.name,
                                          *library,
                                          measured.setup.skeleton,
                                          static_cast<std::uint64_t>(measured.report.seed));
}

// The dynamics, where they were asked for.
Expected<std::optional<DynamicsReport>> dynamics_of(const EvalDanceArguments& arguments,
                                                    const DanceInfo& dance,
                                                    const engine::TrialCast& cast,
                                                    ProgressLine& progress) {
    const auto& names = arguments.trials;
    if (!names.empty() && std::find(names.begin(), names.end(), kDynamicsTrial) == names.end()) {
        return std::optional<DynamicsReport>();
    }
    const auto seed = static_cast<std::uint64_t>(arguments.settings.seed);
    progress.show("dynamics, known");
    auto known = engine::run_dynamics_trial(dance, cast, seed, engine::Knowledge::known);
    if (!known) {
        return fail(std::move(known.error()).in("dynamics"));
    }
    progress.show("dynamics, live");
    auto live = engine::run_dynamics_trial(dance, cast, seed, engine::Knowledge::live);
    if (!live) {
        return fail(std::move(live.error()).in("dynamics"));
    }
    return std::optional(DynamicsReport{*known, *live});
}

// How the dances to the files follow their loudness; empty when a signal came before all were done.
Expected<std::vector<FollowedFile>> followed_files(const std::vector<Path>& files,
                                                   const engine::TrialCast& cast) {
    std::vector<FollowedFile> followed;
    ProgressLine progress("dancing");
    for (const Path& file : files) {
        progress.show(file.filename().string());
        const auto music = audio::read_all_mono(file);
        if (!music) {
            return fail(music.error());
        }
        FollowedFile& one = followed.emplace_back();
        one.name = file.filename().string();
        for (const auto& [result, knowledge] : {std::pair{&one.known, engine::Knowledge::known},
                                                {&one.live, engine::Knowledge::live}}) {
            if (stop_signal()) {
                return std::vector<FollowedFile>();  // half a table would mislead
            }
            auto following = engine::music_following(music->samples, music->rate, cast, knowledge);
            if (!following) {
                return fail(std::move(following.error()).in(file.string()));
            }
            *result = *following;
        }
    }
    return followed;
}

// People's takes, measured like trials; none without clips.
Expected<std::vector<MeasuredDance>> people_of(const EvalDanceArguments& arguments,
                                               motion::DanceRole role,
                                               const Figures& figures) {
    if (arguments.clips.empty()) {
        return std::vector<MeasuredDance>{};
    }
    motion::CapturedDancePlan plan;
    plan.folder = arguments.clips;
    plan.labels = arguments.labels;
    plan.role = role;
    plan.metres_per_unit = arguments.scale;
    // What is not given stays at the plan's default.
    if (!arguments.counts.empty()) {
        plan.counts = arguments.counts;
    }
    if (!arguments.faults.empty()) {
        plan.faults = arguments.faults;
    }
    plan.reading = clip_reading(arguments.fps);
    auto joints = arguments.joints.labels();
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    plan.joints = std::move(*joints);
    const auto takes = motion::measure_captured(plan, figures);
    if (!takes) {
        return fail(takes.error());
    }
    return as_rows(*takes);
}

// The dances that `raks dance` would dance to these files, which need not be one dance.
ExitCode eval_against(EvalDanceArguments& arguments) {
    const auto setup = open_dancers(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    const auto files = followed_files(arguments.against, {setup->models, setup->dancers.cast(), 0});
    if (!files) {
        return fail(files.error());
    }
    if (files->empty()) {
        return kExitDone;  // stopped: half a table would mislead
    }
    if (arguments.as_json) {
        print_json(to_json(std::span(*files)));
    } else {
        print_text(to_text(std::span(*files)));
    }
    return kExitDone;
}

}  // namespace

ExitCode eval_dance(const EvalDanceArguments& given) {
    EvalDanceArguments arguments = given;
    // No music is unknown here: without a dance the list's first is measured.
    arguments.settings.fallback_dance = "first";
    if (!arguments.against.empty()) {
        return eval_against(arguments);
    }
    const auto setup = open_dances(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    const DanceList& dances = *setup->catalogue.list();
    DanceReport report;
    report.dance =
        *dances.find(dances.id_of(engine::dance_to_load(arguments.settings, setup->catalogue)));
    report.role = arguments.role;
    report.seed = arguments.settings.seed;
    report.generator = arguments.settings.generator;
    // Refers to the report, whose dance and role are set above.
    const Measured measured{*setup,
                            report,
                            engine::form_of(arguments.settings),
                            engine::dynamics_of(arguments.settings)};
    // The trained figures say where each step lands: trials and takes are measured against them.
    const engine::CatalogueEntry& entry = *setup->catalogue.find(report.dance.name);
    const auto figures = engine::trained_figures(entry, report.role, measured.form);
    if (!figures) {
        return fail(figures.error());
    }
    const auto trials = chosen_trials(report.dance, *figures, arguments.trials);
    if (!trials) {
        return fail(trials.error());
    }
    auto cast = cast_of(measured, *figures);
    if (!cast) {
        return fail(cast.error());
    }
    report.is_of_cells = engine::is_of_cells(entry, report.role, measured.form);
    cast->landings = engine::judged_landings(report.is_of_cells);
    // Clips before trials: a fault in them should not cost the minute that the trials take.
    auto people = people_of(arguments, report.role, *figures);
    if (!people) {
        return fail(people.error());
    }
    report.people = std::move(*people);
    // The figures by themselves are not of the dynamics.
    if (!report.is_of_cells && (arguments.trials.empty() || !trials->empty())) {
        auto written = written_of(measured);
        if (!written) {
            return fail(written.error());
        }
        report.written = std::move(*written);
    }
    // In a scope of its own: the progress line is cleared before the report is printed.
    {
        ProgressLine progress("dancing");
        for (const engine::DanceTrial& trial : *trials) {
            if (stop_signal()) {
                return kExitDone;  // half a table would mislead
            }
            progress.show(trial.name);
            auto result = engine::run_trial(trial, *cast, *figures);
            if (!result) {
                return fail(std::move(result.error()).in(trial.name));
            }
            report.trials.push_back({trial.name, trial.kind, std::move(*result)});
        }
        auto dynamics = dynamics_of(arguments, report.dance, *cast, progress);
        if (!dynamics) {
            return fail(std::move(dynamics.error()));
        }
        report.dynamics = std::move(*dynamics);
    }
    if (report.is_of_cells && report.dynamics) {
        // A take may be taken up at any of its beats.
        report.dynamics->known.first_count_off.reset();
        report.dynamics->live.first_count_off.reset();
    }
    if (arguments.as_json) {
        print_json(to_json(report));
    } else {
        print_text(to_text(report));
    }
    return kExitDone;
}

}  // namespace raks::apps
