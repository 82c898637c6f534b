#include "engine/cli/commands.hpp"

#include <cstdio>

#include "engine/cli/progress.hpp"
#include "engine/cli/signals.hpp"
#include "engine/collect_poses.hpp"
#include "engine/dance_files.hpp"
#include "engine/music_source.hpp"
#include "engine/offline_driver.hpp"
#include "motion/skeleton/bvh.hpp"

namespace raks::cli {
ExitCode dance(const DanceArguments& arguments) {
    if (arguments.output.extension() != ".bvh") {
        return fail(arguments.output.string() + ": cannot write this kind of motion; known: .bvh");
    }
    auto source = engine::MusicSource::open(arguments.input);
    if (!source) {
        return fail(source.error());
    }
    auto dancers = engine::Dancers::load(arguments.settings);
    if (!dancers) {
        return fail(dancers.error());
    }
    if (auto all = dancers->wait(); !all) {
        return fail(all.error());
    }
    auto driver = engine::OfflineDriver::create(source->rate(), dancers->members());
    if (!driver) {
        return fail(driver.error());
    }
    engine::CollectPoses collect(arguments.fps);
    ProgressLine progress("dancing");
    for (auto block = source->next(); !block.mono.empty() && !stop_signal();
         block = source->next()) {
        driver->feed(block.mono, collect);
        if (const auto share = source->progress()) {
            progress.show(*share);
        }
    }
    driver->finish(collect);
    collect.finish(source->given());
    if (!source->warning().empty()) {
        std::fprintf(stderr, "raks: %s\n", source->warning().c_str());
    }
    if (auto written = motion::write_bvh(
            arguments.output, motion::mannequin_skeleton(), collect.poses, arguments.fps);
        !written) {
        return fail(written.error());
    }
    return kExitDone;
}

}  // namespace raks::cli
