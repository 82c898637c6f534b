// `raks capture correct`: a person puts tracks right.
#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/correct_session.hpp"
#include "apps/raks_capture/correct_window.hpp"

namespace raks::apps {
ExitCode correct(const CorrectArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    const auto given =
        is_without_markers(*plan)
            ? load_joint_tracking(*plan)
            : load_tracking(*plan, plan->file("labels.tsv"), capture::ChromaForm::normalised);
    if (!given) {
        return fail(given.error());
    }
    if (auto checked = check_edits(given->edits, given->markers, given->rig); !checked) {
        return fail(std::move(checked.error()).in(plan->file("edits.jsonl").string()));
    }
    return exit_code_of(correct_in_window(*plan, *given));
}

}  // namespace raks::apps
