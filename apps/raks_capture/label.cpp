// `raks capture label`: which marker is where in first pictures.

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/label_checks.hpp"
#include "apps/raks_capture/label_window.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

namespace raks::apps {
namespace {

// What is there of a file that a step before may have made.
template <typename Load>
auto loaded_if_there(const Path& file, const Load& load) {
    using Loaded = decltype(load());
    return is_there(file) ? load() : Loaded(typename Loaded::value_type{});
}

}  // namespace

ExitCode label_capture(const LabelArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    const auto markers = load_markers(*plan);
    // The window goes on with what was labelled before.
    const Path file = arguments.labels.empty() ? plan->file("labels.tsv") : arguments.labels;
    const auto labels = arguments.labels.empty()
                            ? loaded_if_there(file, [&file] { return load_labels(file); })
                            : load_labels(file);
    const auto rig =
        loaded_if_there(plan->file("rig.toml"), [&plan] { return load_capture_rig(*plan); });
    const auto clocks =
        loaded_if_there(plan->file("clocks.toml"), [&plan] { return load_clocks(*plan); });
    const auto seen =
        loaded_if_there(plan->file("detections.csv"), [&plan] { return load_observations(*plan); });
    for (const Error* const error : {markers ? nullptr : &markers.error(),
                                     labels ? nullptr : &labels.error(),
                                     rig ? nullptr : &rig.error(),
                                     clocks ? nullptr : &clocks.error(),
                                     seen ? nullptr : &seen.error()}) {
        if (error != nullptr) {
            return fail(*error);
        }
    }
    const LabelledCapture known{*plan,
                                *markers,
                                rig->cameras.empty() ? nullptr : &*rig,
                                seen->films.empty() ? nullptr : &*seen,
                                *clocks};
    if (arguments.labels.empty()) {
        if (auto checked = check_label_places(*labels, known); !checked) {
            return fail(std::move(checked.error()).in(file.string()));
        }
        return exit_code_of(label_in_window({*plan, *markers, *labels, *rig, *seen, *clocks}));
    }
    const auto doubts = check_labels(*labels, known);
    if (!doubts) {
        return fail(Error(doubts.error()).in(arguments.labels.string()));
    }
    for (const std::string& doubt : *doubts) {
        say(arguments.labels.string() + ": " + doubt);
    }
    return exit_code_of(write_file(plan->file("labels.tsv"), capture::labels_text(*labels)));
}

}  // namespace raks::apps
