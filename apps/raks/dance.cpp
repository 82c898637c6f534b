#include "apps/raks/commands.hpp"

#include <cstdio>

#include "apps/raks/dance_setup.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/offline/offline_driver.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/formats/vrma.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Writes one dancer's poses; null: this kind of file is not known.
using Writer = decltype(&motion::write_bvh);

Writer writer_of(const Path& output) {
    const Path ending = output.extension();
    return ending == ".bvh"    ? &motion::write_bvh
           : ending == ".vrma" ? &motion::write_vrma
                               : nullptr;
}

// The file of one dancer: x.bvh when there is one, else x_1.bvh, x_2.bvh, ...; of a couple 1 leads.
Path file_of(const Path& output, std::size_t dancer, std::size_t dancers) {
    if (dancers == 1) {
        return output;
    }
    Path path = output;
    path.replace_filename(
        fmt::format("{}_{}{}", output.stem().string(), dancer + 1, output.extension().string()));
    return path;
}

}  // namespace

ExitCode dance(const DanceArguments& given) {
    DanceArguments arguments = given;
    // Checked before the music is read, as everything that can fail at once.
    const Writer write = writer_of(arguments.output);
    if (write == nullptr) {
        return fail(arguments.output.string() +
                    ": cannot write this kind of motion; known: .bvh, .vrma");
    }
    if (auto checked = check_output(arguments.output, {arguments.input}); !checked) {
        return fail(std::move(checked.error()));
    }
    auto source = engine::MusicSource::open(arguments.input);
    if (!source) {
        return fail(source.error());
    }
    const auto setup = open_dancers(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    auto driver = open_driver({arguments.input, source->rate(), 0.0, arguments.is_as_live}, *setup);
    if (!driver) {
        return fail(std::move(driver.error()));
    }
    // Poses are kept in memory: files need their number before the first.
    engine::CollectPoses collect(arguments.fps);
    ProgressLine progress("dancing");
    for (auto block = source->next(); !block.mono.empty() && !stop_signal();
         block = source->next()) {
        driver->feed(block.mono, collect);
        if (const auto share = source->progress()) {
            progress.show(*share);
        }
    }
    // The end of the music, or of what was read when a signal came.
    driver->finish(collect);
    collect.finish(source->given());
    if (!source->warning().empty()) {
        say(source->warning());
    }
    say_if_stopped(arguments.output, source->given());
    // No hop was danced.
    if (collect.dancers.empty()) {
        collect.dancers.emplace_back();  // of no length: the writer says that there are no poses
    }
    // One file a dancer.
    for (std::size_t i = 0; i < collect.dancers.size(); ++i) {
        const Path path = file_of(arguments.output, i, collect.dancers.size());
        if (auto written = write(path, setup->skeleton, collect.dancers[i], arguments.fps);
            !written) {
            return fail(written.error());
        }
    }
    return kExitDone;
}

}  // namespace raks::apps
