#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/tap_reader.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/devices.hpp"
#include "base/printable.hpp"
#include "base/sleep_until.hpp"
#include "engine/setup/device_offsets.hpp"
#include "engine/trials/click_player.hpp"
#include "engine/trials/click_train.hpp"
#include "engine/trials/loop_recorder.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

constexpr int kLoopClicks = 32;
// To find the pulse, the taps, and some for those that are missed.
constexpr int kTapClicks = 32;
constexpr double kTapDistance = 0.8;  // seconds: 75 a minute
// What was played last is heard so long after it was handed over, at most.
constexpr double kLongestWay = 2.5;
constexpr Nanos kLook = std::chrono::milliseconds(50);

// Errors: the device went away.
Expected<void> check_alive(const engine::ClickPlayer& player) {
    if (!player.is_alive()) {
        return fail("the loudspeaker is gone: nothing was measured");
    }
    return {};
}

// Nothing: a signal came.
using MaybeOffset = Expected<std::optional<engine::MeasuredOffset>>;

MaybeOffset measure_loop(const audio::AudioDevice& output, const audio::AudioDevice& input) {
    const engine::ClickTrain train = engine::irregular_clicks(kLoopClicks);
    auto recorder = engine::LoopRecorder::start(input, train.seconds + 2.0 * kLongestWay);
    if (!recorder) {
        return fail(recorder.error());
    }
    auto player = engine::ClickPlayer::start(output, train);
    if (!player) {
        return fail(player.error());
    }
    (*recorder)->keep();
    ProgressLine progress("clicks");
    std::optional<HostTime> end;
    while (!end || HostClock::now() < *end) {
        if (stop_signal()) {
            return std::nullopt;
        }
        if (auto alive = check_alive(**player); !alive) {
            return fail(alive.error());
        }
        progress.show((*player)->progress());
        if (!end && (*player)->progress() >= 1.0) {
            end = HostClock::now() + nanos_from_seconds(kLongestWay);
        }
        sleep_until(HostClock::now() + kLook);
    }
    const auto sent = (*player)->clock();
    if (!sent) {
        return fail(sent.error());
    }
    const auto heard = (*recorder)->recording();
    if (!heard) {
        return fail(input.name + ": " + heard.error().message);
    }
    const auto offset = engine::loop_offset(train, *sent, *heard);
    return offset ? MaybeOffset(*offset) : fail(offset.error());
}

MaybeOffset measure_taps(const audio::AudioDevice& output) {
    const engine::ClickTrain train = engine::regular_clicks(kTapClicks, kTapDistance);
    say(fmt::format("tap any key to the clicks, {} times", engine::kTaps));
    TapReader keys;
    auto player = engine::ClickPlayer::start(output, train);
    if (!player) {
        return fail(player.error());
    }
    ProgressLine progress("taps");
    std::vector<HostTime> taps;
    while (taps.size() < engine::kTaps && (*player)->progress() < 1.0 && !keys.has_ended()) {
        if (stop_signal()) {
            return std::nullopt;
        }
        if (auto alive = check_alive(**player); !alive) {
            return fail(alive.error());
        }
        if (const auto tap = keys.wait(kLook)) {
            taps.push_back(*tap);
        }
        progress.show(fmt::format("{} of {}", taps.size(), engine::kTaps));
    }
    if (keys.has_ended() && taps.empty()) {
        return fail("standard input has ended: taps are keys that are pressed in a terminal");
    }
    const auto sent = (*player)->clock();
    if (!sent) {
        return fail(sent.error());
    }
    std::vector<HostTime> clicks;
    for (const double click : train.clicks) {
        clicks.push_back(sent->heard_at(std::llround(click * sent->rate().hertz())));
    }
    const auto offset = engine::tap_offset(clicks, taps);
    return offset ? MaybeOffset(*offset) : fail(offset.error());
}

ExitCode forget(engine::DeviceOffsets offsets, const audio::AudioDevice& output) {
    if (!offsets.forget(output.name)) {
        say(fmt::format("no offset is kept for {}", audio::described(output)));
        return kExitDone;
    }
    if (auto saved = offsets.save(); !saved) {
        return fail(saved.error());
    }
    say(fmt::format("forgotten: {}", audio::described(output)));
    return kExitDone;
}

// The input that a loop is heard with: without a name a microphone, else the loudspeaker's monitor.
// Says so where it cannot hear the air.
Expected<audio::AudioDevice> loop_input(std::vector<audio::AudioDevice> devices,
                                        const audio::AudioDevice& output,
                                        const std::string& name) {
    if (name.empty()) {
        const bool has_microphone =
            std::any_of(devices.begin(), devices.end(), [](const audio::AudioDevice& device) {
                return device.input_channels > 0 && !device.is_monitor;
            });
        std::erase_if(devices, [&](const audio::AudioDevice& device) {
            return device.is_monitor && (has_microphone || device.monitor_of != output.name);
        });
    }
    const auto input = audio::choose_input(devices, name);
    if (!input) {
        return fail(input.error());
    }
    say("listening to " + input->reason);
    if (input->device.is_monitor) {
        say("a monitor hears what the loudspeaker is sent, not what it plays: --device MICROPHONE "
            "measures the rest");
    }
    return input->device;
}

}  // namespace

ExitCode calibrate(const CalibrateArguments& arguments) {
    const engine::Settings& settings = arguments.settings;
    // What cannot be read is not written over: found out before anything is measured.
    auto offsets = engine::DeviceOffsets::load();
    if (!offsets) {
        return fail(offsets.error().message + "; nothing was measured: mend or remove the file");
    }
    const auto system = audio::AudioSystem::open(audio::audio_system_of(settings.audio_system));
    if (!system) {
        return fail(system.error());
    }
    const auto output = audio::choose_output(system->devices(), settings.output);
    if (!output) {
        return fail(output.error());
    }
    if (arguments.forgets) {
        return forget(std::move(*offsets), output->device);
    }
    say("sound goes to " + output->reason);
    MaybeOffset measured;
    if (arguments.by_taps) {
        measured = measure_taps(output->device);
    } else {
        const auto input = loop_input(system->devices(), output->device, settings.device);
        if (!input) {
            return fail(input.error());
        }
        measured = measure_loop(output->device, *input);
    }
    if (!measured) {
        return fail(measured.error());
    }
    if (!*measured) {
        return kExitDone;  // ended by a signal
    }
    offsets->set({output->device.name, (*measured)->offset, arguments.by_taps ? "tap" : "loop"});
    if (auto saved = offsets->save(); !saved) {
        return fail(saved.error());
    }
    print_text(fmt::format("{} is heard {} than it reports ({} {}, quartiles {:.1f} ms apart)\n",
                           printable(audio::described(output->device)),
                           engine::in_words((*measured)->offset),
                           (*measured)->count,
                           arguments.by_taps ? "taps" : "clicks",
                           1e3 * to_seconds((*measured)->quartiles)));
    say("kept in " + engine::DeviceOffsets::path().string());
    return kExitDone;
}

}  // namespace raks::apps
