#include "apps/raks/stick_joints.hpp"

#include <utility>

#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "motion/skeleton/body/joint_finder.hpp"
#include "motion/skeleton/body/joint_report.hpp"

#include <fmt/format.h>

namespace raks::apps {

Expected<void> look_for_joints(const StickArguments& arguments, motion::MotionClip& clip) {
    auto labels = arguments.joints.labels();
    if (!labels) {
        return fail(std::move(labels.error()));
    }
    clip.labels = std::move(*labels);
    const auto search = motion::search_joints(clip);
    if (!search) {
        return fail(search.error());
    }
    for (const std::string& note : search->found.notes) {
        say(arguments.input.string() + ": " + note);
    }
    if (search->refusal) {
        say(arguments.input.string() + ": drawn as it is: " + search->refusal->message);
    }
    return {};
}

Expected<void> write_joints(const StickArguments& arguments, const motion::MotionClip& clip) {
    const auto search = motion::search_joints(clip);
    if (!search) {
        return fail(search.error());
    }
    auto file = PendingFile::create(arguments.joints_output);
    if (!file) {
        return fail(std::move(file.error()));
    }
    if (auto done = file->write(motion::joint_map_text(clip, search->found.mapping)); !done) {
        return done;
    }
    if (auto done = file->commit(); !done) {
        return done;
    }
    print_text(fmt::format("{}: which joint is which bone; mend it and give it to --joints\n",
                           printable(arguments.joints_output.string())));
    return {};
}

}  // namespace raks::apps
