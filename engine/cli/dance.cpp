#include "engine/cli/commands.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

#include "engine/cli/progress.hpp"
#include "engine/cli/signals.hpp"
#include "engine/dance_files.hpp"
#include "engine/music_source.hpp"
#include "engine/offline_driver.hpp"
#include "motion/skeleton/bvh.hpp"

namespace raks::cli {
namespace {

/// Takes the poses of an even frame rate out of the track as it grows.
class CollectPoses final : public engine::OfflineDriver::Sink {
 public:
    explicit CollectPoses(double fps) : fps_(fps) {}

    void on_hop(const engine::PerformedHop& hop) override {
        for (; next_time() <= time_of_hop(hop.track.newest_final()); ++next_) {
            poses.push_back(hop.track.at(next_time()));
        }
        last_ = hop.track.at_hop(hop.track.newest_final());
    }

    /// Exactly as many poses as the music is long.
    void finish(Nanos duration) {
        const auto count = static_cast<std::size_t>(std::ceil(to_seconds(duration) * fps_));
        poses.resize(count, last_);
    }

    std::vector<motion::Pose> poses;

 private:
    [[nodiscard]] StreamTime next_time() const {
        return stream_time_from_seconds(static_cast<double>(next_) / fps_);
    }

    double fps_;
    std::int64_t next_ = 0;
    motion::Pose last_;
};

}  // namespace

ExitCode dance(const DanceArguments& arguments) {
    if (arguments.output.extension() != ".bvh") {
        return fail(arguments.output.string() + ": cannot write this kind of motion; known: .bvh");
    }
    auto source = engine::MusicSource::open(arguments.input);
    if (!source) {
        return fail(source.error());
    }
    auto library = engine::load_dance(engine::dance_to_load(arguments.settings));
    if (!library) {
        return fail(library.error());
    }
    auto driver = engine::OfflineDriver::create(
        source->rate(), *library, static_cast<std::uint64_t>(arguments.settings.seed));
    if (!driver) {
        return fail(driver.error());
    }
    CollectPoses collect(arguments.fps);
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
