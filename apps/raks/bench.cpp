#include "apps/raks/bench.hpp"

#include <time.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/terminal/say.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music_analyzer.hpp"
#include "base/json.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/show/framing.hpp"
#include "engine/show/show.hpp"
#include "engine/show/themes.hpp"
#include "motion/dancer.hpp"
#include "motion/formation.hpp"
#include "render/gl/offscreen.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/scene/scene.hpp"

#include <fmt/format.h>

namespace raks::apps {

namespace {

// Processor time instead of wall-clock time: other programs on the machine do not count. Finer than
// getrusage, which counts some kernels' ticks.
double seconds_of(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double thread_cpu_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

double process_cpu_seconds() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

// The value at each rank below, without interpolation.
Spread spread_of(std::vector<double> values) {
    if (values.empty()) {
        return {};
    }
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    return {at(0.50), at(0.95), at(0.99), values.back()};
}

namespace {

// Fast music with all instruments of the generator's montuno: a heavy case for analyzer and dancer.
Expected<audio::GeneratedMusic> bench_music(double seconds) {
    audio::MusicPlan plan;
    plan.style = audio::Style::montuno;
    plan.tempo = {{0.0, 184.0}};
    plan.seconds = seconds;
    plan.channels = 1;
    return audio::generate(plan);
}

// Keeps all states. Memory is reserved, so that growing it is not measured.
class CollectStates final : public audio::MusicAnalyzer::Sink {
 public:
    explicit CollectStates(double seconds) {
        states.reserve(static_cast<std::size_t>(seconds * kHopsPerSecond) + 16);
    }
    void on_state(const MusicState& state) noexcept override { states.push_back(state); }
    std::vector<MusicState> states;
};

double microseconds_since(HostTime start) {
    return static_cast<double>((HostClock::now() - start).count()) * 1e-3;
}

// Adds the cost of this analyzer on a piece; names end in `suffix`. Processor time over the whole
// piece, wall-clock time a hop.
void add_analysis(audio::MusicAnalyzer& analyzer,
                  const audio::GeneratedMusic& music,
                  double seconds,
                  const std::string& suffix,
                  BenchReport& report) {
    CollectStates collect(seconds);
    std::vector<double> hop_us;
    const double start = thread_cpu_seconds();
    // 10 ms of samples: one hop.
    const std::size_t hop = static_cast<std::size_t>(music.rate.hertz() / 100);
    for (std::size_t at = 0; at + hop <= music.samples.size(); at += hop) {
        const HostTime hop_start = HostClock::now();
        analyzer.process(std::span(music.samples).subspan(at, hop), collect);
        hop_us.push_back(microseconds_since(hop_start));
    }
    const double cpu = thread_cpu_seconds() - start;
    report.values.emplace_back("times_real_time" + suffix, seconds / cpu);
    report.values.emplace_back("cpu_us_a_hop" + suffix,
                               1e6 * cpu / static_cast<double>(hop_us.size()));
    report.spreads.emplace_back("wall_us_a_hop" + suffix, spread_of(hop_us));
}

// The analyzer without and with the genre recognition, and other programs on the same music.
Expected<BenchReport> bench_analysis(double seconds) {
    const auto music = bench_music(seconds);
    engine::Settings settings;
    const auto setup = open_dances(settings);
    if (!music || !setup) {
        return fail(!music ? music.error() : setup.error());
    }
    auto plain = engine::make_analyzer(music->rate, {setup->models.beats, nullptr, nullptr});
    auto whole = engine::make_analyzer(music->rate, setup->models);
    if (!plain || !whole) {
        return fail(!plain ? plain.error() : whole.error());
    }
    BenchReport report;
    add_analysis(*plain, *music, seconds, "", report);
    add_analysis(*whole, *music, seconds, "_with_genre", report);
    add_aubio(*music, seconds, report);
    if (auto added = add_mfcc(*music, seconds, report); !added) {
        return fail(added.error());
    }
    return report;
}

// Adds what it costs to dance one dance to these states; names end in `suffix`.
Expected<void> add_dance(const DanceSetup& setup,
                         std::string_view dance,
                         std::span<const MusicState> states,
                         const std::string& suffix,
                         BenchReport& report) {
    const auto library = engine::load_dance(setup.catalogue, dance, setup.skeleton);
    if (!library) {
        return fail(library.error());
    }
    motion::Dancer dancer;
    if (auto prepared = dancer.prepare(*library, setup.skeleton, 1); !prepared) {
        return fail(prepared.error());
    }
    const auto track = std::make_unique<motion::PoseTrack>();
    // Hops between two requests for another figure: transitions between figures cost most.
    constexpr HopIndex kHopsAFigure = 400;
    std::set<std::string> figures;
    // Each hop computes its pose and the predicted ones after it.
    constexpr double kPoses = 1.0 + motion::PoseTrack::kPredictedPoses;
    std::vector<double> hop_us;
    hop_us.reserve(states.size());
    for (const MusicState& state : states) {
        if (state.hop % kHopsAFigure == 0) {
            dancer.command({.time = state.time});
            figures.insert(dancer.status().figure.data());
        }
        const double hop_start = thread_cpu_seconds();
        dancer.advance(state, *track);
        hop_us.push_back(1e6 * (thread_cpu_seconds() - hop_start));
    }
    figures.erase("");  // standing
    const double whole = std::accumulate(hop_us.begin(), hop_us.end(), 0.0);
    report.values.emplace_back("figures_danced" + suffix, static_cast<double>(figures.size()));
    report.values.emplace_back("cpu_us_a_pose" + suffix,
                               whole / (kPoses * static_cast<double>(states.size())));
    report.spreads.emplace_back("cpu_us_a_hop" + suffix, spread_of(std::move(hop_us)));
    return {};
}

// Cost of the dancer alone: the states are computed before. The list's first dance, which is of
// figures, and the one that is danced where none is known, which is of whole takes.
Expected<BenchReport> bench_motion(double seconds) {
    const auto music = bench_music(seconds);
    if (!music) {
        return fail(music.error());
    }
    engine::Settings settings;
    const auto setup = open_dances(settings);
    if (!setup) {
        return fail(setup.error());
    }
    auto analyzer = engine::make_analyzer(music->rate, setup->models);
    if (!analyzer) {
        return fail(analyzer.error());
    }
    CollectStates collect(seconds);
    analyzer->process(music->samples, collect);
    BenchReport report;
    const std::string first = setup->catalogue.entries().front().info.name;
    const std::string fallback = engine::dance_to_load(settings, setup->catalogue);
    auto added = add_dance(*setup, first, collect.states, "", report);
    if (added && fallback != first) {
        added = add_dance(*setup, fallback, collect.states, "_of_fallback", report);
    }
    return added ? Expected<BenchReport>(std::move(report)) : fail(std::move(added.error()));
}

// Processor time in milliseconds of each picture, of all threads, as a software renderer uses
// several.
struct PictureCosts {
    std::vector<double> drawing;  // without overlay
    std::vector<double> reading;  // back, as films and outputs do it
};

// Of pictures of this size.
Expected<PictureCosts> picture_costs(render::Renderer& renderer,
                                     const render::Scene& scene,
                                     std::span<const motion::Pose> poses,
                                     const engine::PictureSize& size) {
    auto target = render::OffscreenTarget::create(
        {.width = size.width, .height = size.height, .samples = renderer.samples()});
    if (!target) {
        return fail(target.error());
    }
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(size.width) *
                                   static_cast<std::size_t>(size.height) * 4);
    PictureCosts costs;
    constexpr int kPictures = 60;
    for (int i = 0; i < kPictures; ++i) {
        // finish() waits until the driver has done what it was given.
        const double start = process_cpu_seconds();
        renderer.draw(scene, poses, target->frame());
        target->finish();
        const double drawn = process_cpu_seconds();
        target->begin_reading();
        target->finish();
        if (auto read = target->finish_reading(rgba); !read) {
            return fail(read.error());
        }
        costs.drawing.push_back(1e3 * (drawn - start));
        costs.reading.push_back(1e3 * (process_cpu_seconds() - drawn));
    }
    return costs;
}

// Those who stand in a grid.
std::vector<motion::Pose> standing_poses(std::size_t dancers) {
    std::vector<motion::Pose> poses;
    for (const glm::dvec2& place : motion::places_in(motion::Formation::grid, dancers)) {
        motion::Pose& pose = poses.emplace_back();
        pose.hips_position =
            motion::mannequin_skeleton().offsets[0] +
            glm::vec3(static_cast<float>(place.x), 0.0F, static_cast<float>(place.y));
    }
    return poses;
}

// What each of a crowd costs more than the first, seen by the camera that shows all of them.
Expected<double> cost_of_each_more(render::Renderer& renderer, render::Scene scene) {
    constexpr std::size_t kCrowd = 12;
    constexpr engine::PictureSize kSize{1280, 720};
    const std::vector<motion::Pose> crowd = standing_poses(kCrowd);
    engine::Framing framing(scene.camera,
                            static_cast<float>(kSize.width) / static_cast<float>(kSize.height));
    scene.camera = framing.follow(crowd, 0.0);
    const auto one = picture_costs(renderer, scene, standing_poses(1), kSize);
    const auto all = picture_costs(renderer, scene, crowd, kSize);
    if (!one || !all) {
        return fail(!one ? one.error() : all.error());
    }
    return (spread_of(all->drawing).p50 - spread_of(one->drawing).p50) / (kCrowd - 1);
}

// Cost of building the mannequin, of pictures in two sizes and their reading back, and of more
// dancers.
Expected<BenchReport> bench_render() {
    const auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    const double avatar_start = process_cpu_seconds();
    const render::Avatar avatar = render::build_mannequin();
    const double avatar_ms = 1e3 * (process_cpu_seconds() - avatar_start);
    auto renderer = render::Renderer::create(avatar);
    if (!renderer) {
        return fail(renderer.error());
    }
    BenchReport report;
    report.notes.emplace_back("driver", context->renderer_name());
    render::Scene scene;
    // Rings that are shown: confidence and a moment near a beat.
    scene.rings = render::beat_rings({.confidence = 1.0F}, stream_time_from_seconds(0.2));
    for (const auto& [width, height] : {std::pair{1280, 720}, std::pair{640, 360}}) {
        const auto costs = picture_costs(*renderer, scene, standing_poses(1), {width, height});
        if (!costs) {
            return fail(costs.error());
        }
        report.spreads.emplace_back(fmt::format("cpu_ms_{}x{}", width, height),
                                    spread_of(costs->drawing));
        report.spreads.emplace_back(fmt::format("read_back_cpu_ms_{}x{}", width, height),
                                    spread_of(costs->reading));
    }
    for (const std::string& name : engine::theme_names()) {
        const auto theme = engine::find_theme(name);
        if (!theme) {
            return fail(theme.error());
        }
        render::Scene themed = scene;
        themed.theme = *theme;
        const auto costs = picture_costs(*renderer, themed, standing_poses(1), {1280, 720});
        if (!costs) {
            return fail(costs.error());
        }
        report.spreads.emplace_back("cpu_ms_of_" + name, spread_of(costs->drawing));
    }
    report.values.emplace_back("mannequin_cpu_ms", avatar_ms);
    const auto each = cost_of_each_more(*renderer, scene);
    if (!each) {
        return fail(each.error());
    }
    report.values.emplace_back("each_more_cpu_ms_1280x720", *each);
    return report;
}

}  // namespace

std::string to_text(const BenchReport& report) {
    std::string text;
    for (const auto& [name, note] : report.notes) {
        text += fmt::format("{:<24} {}\n", name, note);
    }
    for (const auto& [name, value] : report.values) {
        text += fmt::format("{:<24} {:.2f}\n", name, value);
    }
    for (const auto& [name, spread] : report.spreads) {
        text += fmt::format("{:<24} p50 {:.3f}  p95 {:.3f}  p99 {:.3f}  max {:.3f}\n",
                            name,
                            spread.p50,
                            spread.p95,
                            spread.p99,
                            spread.max);
    }
    return text;
}

ExitCode bench(const BenchArguments& arguments) {
    auto report = arguments.what == "analysis"  ? bench_analysis(arguments.seconds)
                  : arguments.what == "motion"  ? bench_motion(arguments.seconds)
                  : arguments.what == "render"  ? bench_render()
                  : arguments.what == "train"   ? bench_train()
                  : arguments.what == "capture" ? bench_capture()
                  : arguments.what == "avatar"
                      ? bench_avatar(arguments.model)
                      : bench_latency(arguments.seconds, arguments.is_held);
    if (!report) {
        return fail(report.error());
    }
    const std::string text =
        arguments.as_json ? to_json(arguments.what, *report) : to_text(*report);
    print_text(text);
    return kExitDone;
}

std::string to_json(const std::string& what, const BenchReport& report) {
    // All results are on one level, by name.
    Json document = {{"format", "raks-bench"}, {"version", 1}, {"bench", what}};
    for (const auto& [name, note] : report.notes) {
        document[name] = note;
    }
    for (const auto& [name, value] : report.values) {
        document[name] = value;
    }
    for (const auto& [name, spread] : report.spreads) {
        document[name] = {
            {"p50", spread.p50}, {"p95", spread.p95}, {"p99", spread.p99}, {"max", spread.max}};
    }
    // A driver's name need not be UTF-8.
    return document.text(2) + "\n";
}

}  // namespace raks::apps
