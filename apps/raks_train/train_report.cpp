#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/clips/clip_reading.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/reports/figure_report_page.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "training/figures/classifier_evaluation.hpp"
#include "training/figures/figure_report.hpp"
#include "training/figures/training_plan.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using motion::DanceRole;

// The plan of one dancer: the follow's scale is the last that is given.
// Errors: those of --joint and --joints.
Expected<motion::FigureTrainingPlan> report_plan(const TrainReportArguments& arguments,
                                                 DanceRole role) {
    auto known = plan_of(arguments);
    if (!known) {
        return known;
    }
    motion::FigureTrainingPlan& plan = *known;
    plan.role = role;
    if (!arguments.scales.empty()) {
        plan.metres_per_unit =
            role == DanceRole::lead ? arguments.scales.front() : arguments.scales.back();
    }
    return known;
}

// "both" reports the lead first.
std::vector<DanceRole> roles_of(const std::string& role) {
    if (role == "both") {
        return {DanceRole::lead, DanceRole::follow};
    }
    return {role == "lead" ? DanceRole::lead : DanceRole::follow};
}

// Loads the clips and computes the report, figure by figure and dancer by dancer; keeps the repeats
// that the classifier is evaluated with.
class Reporter {
 public:
    explicit Reporter(const TrainReportArguments& arguments) : arguments_(arguments) {
        const int cores = static_cast<int>(std::thread::hardware_concurrency());
        threads_ = arguments.threads > 0 ? arguments.threads : std::max(cores, 1);
    }

    Expected<ReportData> report() {
        ReportData data;
        data.dance = arguments_.dance;
        std::vector<motion::DancerExamples> dancers;
        for (const DanceRole role : roles_of(arguments_.role)) {
            motion::DancerExamples& dancer = dancers.emplace_back();
            dancer.role = role;
            for (std::size_t f = 0; f < arguments_.figures.size(); ++f) {
                auto figure = report_one(f, dancer);
                if (!figure) {
                    return fail(std::move(figure.error()));
                }
                data.figures.push_back(std::move(*figure));
            }
        }
        // At least two figures are needed to tell apart.
        if (arguments_.figures.size() > 1) {
            progress_.show("telling figures apart");
            auto evaluation = motion::evaluate_classifier(
                arguments_.figures, dancers, classifier_training(), threads_);
            if (!evaluation) {
                return fail(std::move(evaluation.error()));
            }
            data.classifier = std::move(*evaluation);
        }
        return data;
    }

    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
    // A clip serves several figures, so that the same warning would come several times: each is
    // kept once.
    Expected<motion::TrainingMaterial> load(const motion::FigureTrainingPlan& plan) {
        Expected<motion::TrainingMaterial> material = motion::load_material(plan);
        if (material) {
            for (const std::string& warning : material->warnings) {
                if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) {
                    warnings_.push_back(warning);
                }
            }
        }
        return material;
    }

    // Options that are the same for every model of the report.
    [[nodiscard]] motion::FigureTrainingOptions training() const {
        motion::FigureTrainingOptions training;
        training.dance = arguments_.dance;
        training.features = arguments_.features;
        training.baum_welch_iterations = arguments_.iterations;
        return training;
    }

    // The classifier's models have a fixed number of states; the report's own number is searched
    // for.
    [[nodiscard]] motion::FigureTrainingOptions classifier_training() const {
        motion::FigureTrainingOptions options = training();
        options.states = arguments_.states;
        return options;
    }

    // The report of one figure of one dancer; adds its repeats to the classifier's training
    // material.
    Expected<motion::FigureReport> report_one(std::size_t f, motion::DancerExamples& dancer) {
        const std::string role(motion::kRoleNames[static_cast<std::size_t>(dancer.role)]);
        progress_.show(fmt::format("{} of the {}", arguments_.figures[f], role));
        auto known = report_plan(arguments_, dancer.role);
        if (!known) {
            return fail(std::move(known.error()));
        }
        motion::FigureTrainingPlan& plan = *known;
        plan.figure = arguments_.figures[f];
        const auto material = load(plan);
        if (!material) {
            return fail(material.error());
        }
        motion::FigureTrainingOptions options = training();
        options.name = plan.figure;
        options.role = dancer.role;
        // A repeat has one beat more than the figure has counts: that of the next count 1.
        options.beats = static_cast<int>(material->repeats[0].beat_frames.size()) - 1;
        auto report = motion::report_figure(material->clips,
                                            material->repeats,
                                            options,
                                            {.most = arguments_.most_states, .threads = threads_});
        if (!report) {
            return fail(std::move(report.error()).in(plan.figure + " of the " + role));
        }
        const auto examples = motion::examples_of(f, material->clips, material->repeats, options);
        dancer.training.insert(dancer.training.end(), examples.begin(), examples.end());
        return add_unseen(f, plan, options, dancer).map([&] { return std::move(*report); });
    }

    // Adds the repeats of the test split, which no model is trained on, to the classifier's test
    // material.
    Expected<void> add_unseen(std::size_t f,
                              motion::FigureTrainingPlan plan,
                              const motion::FigureTrainingOptions& options,
                              motion::DancerExamples& dancer) {
        if (arguments_.test_split.empty() || arguments_.figures.size() < 2) {
            return {};
        }
        plan.split = arguments_.test_split;
        plan.min_confidence = arguments_.test_confidence;
        const auto material = load(plan);
        if (!material) {
            return fail(material.error());
        }
        const auto examples = motion::examples_of(f, material->clips, material->repeats, options);
        dancer.unseen.insert(dancer.unseen.end(), examples.begin(), examples.end());
        return {};
    }

    const TrainReportArguments& arguments_;
    int threads_ = 1;
    std::vector<std::string> warnings_;
    ProgressLine progress_{"report"};
};

// The lines that are printed: chosen numbers of states, and how often figures are told apart.
std::string summary_of(const ReportData& data) {
    std::string text;
    for (const motion::FigureReport& figure : data.figures) {
        text += fmt::format("{} of the {}, {} repeats: states",
                            figure.figure,
                            motion::kRoleNames[static_cast<std::size_t>(figure.role)],
                            figure.takes.size());
        std::string_view separator = " ";
        for (const motion::Part which : motion::parts_of(figure.features)) {
            const auto p = static_cast<std::size_t>(which);
            const motion::PartSelection& part = figure.parts[p].selection;
            text += fmt::format(
                "{}{} {} (peak {})", separator, motion::kPartNames[p], part.chosen, part.peak);
            separator = ", ";
        }
        text += "\n";
    }
    // The first two figures are also compared alone.
    const auto told_apart = [&](const std::string& who, const motion::Decisions& decisions) {
        text += fmt::format("told apart, {}: {} of {}; {} against {}: {} of {}\n",
                            who,
                            decisions.right(),
                            decisions.total(),
                            data.classifier->figures[0],
                            data.classifier->figures[1],
                            decisions.right_between(0, 1),
                            decisions.total_of(0, 1));
    };
    if (data.classifier) {
        for (const motion::DancerEvaluation& dancer : data.classifier->dancers) {
            const std::string role(motion::kRoleNames[static_cast<std::size_t>(dancer.role)]);
            told_apart(role + ", takes left out", dancer.left_out);
            told_apart(role + ", unseen", dancer.unseen);
        }
        if (data.classifier->dancers.size() == 2) {
            told_apart("both together, unseen", data.classifier->couple);
        }
    }
    return text;
}

}  // namespace

ExitCode train_report(const TrainReportArguments& arguments) {
    if (const Path cells = cell_dance_of(arguments); !cells.empty()) {
        if (auto checked = check_is_no_input(arguments.output, {cells}); !checked) {
            return fail(std::move(checked.error()));
        }
        return report_cells(cells, arguments.output);
    }
    if (arguments.labels.empty()) {
        return fail("--labels is required: a table says which figures the clips have");
    }
    if (auto checked = check_clip_options(
            arguments.joints,
            {arguments.labels, arguments.counts, arguments.faults, arguments.skeleton});
        !checked) {
        return fail(std::move(checked.error()));
    }
    // The same figure twice would be told apart from itself.
    for (auto figure = arguments.figures.begin(); figure != arguments.figures.end(); ++figure) {
        if (std::find(arguments.figures.begin(), figure, *figure) != figure) {
            return fail("--figure names " + *figure + " twice");
        }
    }
    if (auto checked = check_is_no_input(arguments.output, inputs_of(arguments)); !checked) {
        return fail(std::move(checked.error()));
    }
    // Created before the work, which takes a minute: an output that cannot be written fails at
    // once.
    auto file = PendingFile::create(arguments.output);
    if (!file) {
        return fail(std::move(file.error()));
    }
    std::vector<std::string> warnings;
    const auto data = [&] {
        // In a scope of its own: its progress line is cleared before anything is printed.
        Reporter reporter(arguments);
        auto report = reporter.report();
        warnings = reporter.warnings();
        return report;
    }();
    if (!data) {
        return fail(data.error());
    }
    for (const std::string& warning : warnings) {
        say(warning);
    }
    if (auto written = file->write(draw_report(*data)); !written) {
        return fail(std::move(written.error()));
    }
    if (auto committed = file->commit(); !committed) {
        return fail(std::move(committed.error()));
    }
    print_text(summary_of(*data));
    return kExitDone;
}

}  // namespace raks::apps
