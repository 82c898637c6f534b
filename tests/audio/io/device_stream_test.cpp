// Real PortAudio on real servers: JACK with the dummy driver, PulseAudio with a null sink. Each
// test runs in a process of its own: libraries keep what they saw of the environment.
#include "audio/io/device_stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <future>
#include <limits>
#include <vector>

#include "audio/io/bell.hpp"
#include "base/random.hpp"
#include "tests/audio/io/long_block.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/pulse_server.hpp"
#include "tests/support/stall_watch.hpp"

namespace raks::audio {
namespace {

using raks::test::JackServer;
using raks::test::PulseServer;
using raks::test::StallWatch;

HostTime now() { return std::chrono::time_point_cast<Nanos>(HostClock::now()); }

/// Ends the process of a test with a reason that the parent prints.
void require(bool is_fine, const std::string& what) {
    if (!is_fine) {
        std::fprintf(stderr, "%s\n", what.c_str());
        std::_Exit(1);
    }
}

AudioDevice input_of(const AudioSystem& system, std::string_view name = {}) {
    const auto choice = choose_input(system.devices(), name);
    require(choice.has_value(), choice ? "" : choice.error().message);
    return choice->device;
}

AudioDevice output_of(const AudioSystem& system, std::string_view name = {}) {
    const auto choice = choose_output(system.devices(), name);
    require(choice.has_value(), choice ? "" : choice.error().message);
    return choice->device;
}

std::unique_ptr<DeviceStream> opened(Expected<std::unique_ptr<DeviceStream>> stream) {
    require(stream.has_value(), stream ? "" : stream.error().message);
    return std::move(*stream);
}

constexpr CounterRandom kNoise(9);
float noise_at(std::int64_t frame) {
    return static_cast<float>(kNoise.uniform(static_cast<std::uint64_t>(frame)) - 0.5);
}

/// Plays noise that says at every sample which frame it is.
class NoisePlayer final : public StreamCallback {
 public:
    void on_output(std::span<float> out,
                   int channels,
                   const BlockTime& time) noexcept RAKS_NONBLOCKING override {
        const auto width = static_cast<std::size_t>(channels);
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = noise_at(time.first_frame + static_cast<std::int64_t>(i / width));
        }
    }
};

/// Keeps the first channel, and says when it has enough.
class Recorder final : public StreamCallback {
 public:
    explicit Recorder(std::size_t frames) : samples_(frames, 0.0F) {}

    void on_input(std::span<const float> in,
                  int channels,
                  const BlockTime& time) noexcept RAKS_NONBLOCKING override {
        const auto width = static_cast<std::size_t>(channels);
        if (seen_ < 0) {
            seen_ = time.first_frame;  // blocks pass by before the stream is connected
        }
        is_time_right_ = is_time_right_ && time.first_frame == seen_ &&
                         time.entered.time_since_epoch().count() > 0;
        seen_ += static_cast<std::int64_t>(in.size() / width);
        std::size_t count = count_.load(std::memory_order_relaxed);
        for (std::size_t i = 0; i < in.size() && count < samples_.size(); i += width) {
            samples_[count++] = in[i];
        }
        count_.store(count, std::memory_order_release);
        bell_.ring();
    }

    /// Blocks until `frames` are recorded.
    void wait_for(std::size_t frames) {
        while (count_.load(std::memory_order_acquire) < frames) {
            bell_.wait();
        }
    }
    [[nodiscard]] std::span<const float> samples() const { return samples_; }
    [[nodiscard]] bool is_time_right() const { return is_time_right_; }

 private:
    std::vector<float> samples_;
    std::atomic<std::size_t> count_{0};
    Bell bell_;
    std::int64_t seen_ = -1;
    bool is_time_right_ = true;
};

/// The place at which `samples` begins to be the played noise, and how many of the rest are not.
struct Found {
    std::int64_t first_frame = -1;  ///< of the noise
    std::size_t at = 0;             ///< in the recording
    std::size_t wrong = 0;
};
Found find_noise(std::span<const float> samples) {
    for (std::size_t at = 0; at + 64 < samples.size(); ++at) {
        if (samples[at] == 0.0F) {
            continue;
        }
        for (std::int64_t frame = 0; frame < 200'000; ++frame) {
            bool is_same = true;
            for (std::int64_t i = 0; i < 8 && is_same; ++i) {
                is_same = samples[at + static_cast<std::size_t>(i)] == noise_at(frame + i);
            }
            if (is_same) {
                Found found{.first_frame = frame, .at = at};
                for (std::size_t i = at; i < samples.size(); ++i) {
                    const auto expected = noise_at(frame + static_cast<std::int64_t>(i - at));
                    found.wrong += samples[i] == expected ? 0U : 1U;
                }
                return found;
            }
        }
        break;
    }
    return {};
}

[[noreturn]] void loop_through_jack(int rate, int period) {
    {
        const StallWatch watch;
        const JackServer jack(rate, period);
        require(jack.problem().empty(), jack.problem());
        auto system = AudioSystem::open().value();
        const AudioDevice in = input_of(system);
        const AudioDevice out = output_of(system);
        require(in.host_api == "JACK" && in.name == "system", "chose " + in.name);
        require(std::lround(in.default_rate) == rate,
                "default rate " + std::to_string(in.default_rate));
        Recorder recorder(static_cast<std::size_t>(3 * rate));
        NoisePlayer player;
        const auto output = opened(DeviceStream::open_output(out, {}));
        const auto input = opened(DeviceStream::open_input(in, {}));
        output->connect(player);
        input->connect(recorder);
        require(output->rate().hertz() == rate && input->channels() == 2, "rate or channels");
        require(jack.connect("raks:out_0", "raks-in:in_0"), "jack_connect");
        require(jack.disconnect("system:capture_1", "raks-in:in_0"), "jack_disconnect");
        recorder.wait_for(static_cast<std::size_t>(3 * rate));
        require(input->is_alive(now()) && output->is_alive(now()), "alive");
        // A loop of ports has no latency: what comes in was out when its block began.
        require(input->heard_after() >= std::chrono::milliseconds(-100) &&
                    input->heard_after() <= std::chrono::milliseconds(25) &&
                    output->heard_after() >= Nanos(0) &&
                    output->heard_after() <= std::chrono::milliseconds(200),
                "latency");
        require(input->callbacks() > 0 && recorder.is_time_right(), "frame count");
        const Found found = find_noise(recorder.samples());
        require(found.first_frame >= 0, "the noise did not come back");
        require(found.at < static_cast<std::size_t>(rate), "the noise came late");
        // A server on a machine that stands still drops blocks itself.
        require(found.wrong == 0 || watch.is_machine_slow(),
                std::to_string(found.wrong) + " samples lost or wrong, xruns " +
                    std::to_string(input->xruns()));
    }
    std::exit(0);
}

[[noreturn]] void survive_the_death_of_jack(bool is_output) {
    {
        JackServer jack;
        require(jack.problem().empty(), jack.problem());
        auto system = AudioSystem::open().value();
        NoisePlayer player;
        auto stream = opened(is_output ? DeviceStream::open_output(output_of(system), {})
                                       : DeviceStream::open_input(input_of(system), {}));
        stream->connect(player);
        const timespec look_again{0, 20'000'000};
        while (stream->callbacks() < 10) {
            nanosleep(&look_again, nullptr);
        }
        require(stream->is_alive(now()), "alive before");
        jack.kill();
        while (stream->is_alive(now())) {
            nanosleep(&look_again, nullptr);
        }
        if (is_output) {  // said by the user; otherwise the destructor must see it
            stream->abandon();
            require(!stream->is_alive(now()), "dead after");
        }
    }
    end_process(7);
}

[[noreturn]] void close_while_a_block_is_on_its_way() {
    {
        const JackServer jack;
        require(jack.problem().empty(), jack.problem());
        auto system = AudioSystem::open().value();
        auto stream = opened(DeviceStream::open_input(input_of(system), {}));
        test::LongBlock block;
        stream->connect(block);
        block.wait_for_begin();
        const auto closing = std::async(std::launch::async, [&] { stream.reset(); });
        // Longer than a device is given to stop: what it still calls must not be gone by then.
        require(closing.wait_for(std::chrono::milliseconds(1500)) == std::future_status::timeout,
                "closed while it called");
        block.let_end();
    }
    end_process(7);
}

[[noreturn]] void listen_to_a_pulse_monitor() {
    {
        const PulseServer pulse;
        require(pulse.problem().empty(), pulse.problem());
        auto system = AudioSystem::open().value();
        const auto choice = choose_input(system.devices());
        require(choice.has_value(), "no input");
        require(choice->device.name == "Monitor of Null Output", "chose " + choice->reason);
        NoisePlayer player;
        Recorder recorder(4 * 48'000);
        const auto output = opened(DeviceStream::open_output(output_of(system), {}));
        const auto input = opened(DeviceStream::open_input(choice->device, {}));
        output->connect(player);
        input->connect(recorder);
        recorder.wait_for(48'000);
        bool is_heard = false;
        for (std::size_t frames = 52'800; frames <= 4 * 48'000 && !is_heard; frames += 4'800) {
            recorder.wait_for(frames);
            const auto recent = recorder.samples().subspan(frames - 4'800, 4'800);
            is_heard = *std::max_element(recent.begin(), recent.end()) > 0.3F;
        }
        require(is_heard, "silence from the monitor");
    }
    std::exit(0);
}

[[noreturn]] void find_no_device() {
    setenv("JACK_DEFAULT_SERVER", "raks-none", 1);          // NOLINT(concurrency-mt-unsafe)
    setenv("JACK_NO_START_SERVER", "1", 1);                 // NOLINT(concurrency-mt-unsafe)
    setenv("PULSE_SERVER", "unix:/nonexistent/native", 1);  // NOLINT(concurrency-mt-unsafe)
    {
        const auto system = AudioSystem::open();
        require(system.has_value(), "system");
        const AudioDevice gone{.portaudio_index = 999, .name = "gone", .input_channels = 2};
        const auto stream = DeviceStream::open_input(gone, {});
        require(!stream && stream.error().message.rfind("device 'gone' ", 0) == 0, "error");
    }
    std::exit(0);
}

class DeviceStreamTest : public ::testing::Test {
 protected:
    void SetUp() override { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(DeviceStreamTest, a_jack_loop_loses_no_sample) {
    EXPECT_EXIT(loop_through_jack(48'000, 256), ::testing::ExitedWithCode(0), "^$");
}

TEST_F(DeviceStreamTest, a_jack_server_at_another_rate_and_period_works_too) {
    EXPECT_EXIT(loop_through_jack(96'000, 1024), ::testing::ExitedWithCode(0), "^$");
}

TEST_F(DeviceStreamTest, the_death_of_jack_is_seen_and_the_process_ends) {
    EXPECT_EXIT(survive_the_death_of_jack(true), ::testing::ExitedWithCode(7), "^$");
    EXPECT_EXIT(survive_the_death_of_jack(false), ::testing::ExitedWithCode(7), "^$");
}

TEST_F(DeviceStreamTest, closing_waits_for_the_block_that_is_on_its_way) {
    EXPECT_EXIT(close_while_a_block_is_on_its_way(), ::testing::ExitedWithCode(7), "^$");
}

TEST_F(DeviceStreamTest, a_pulse_monitor_is_found_and_heard) {
    EXPECT_EXIT(listen_to_a_pulse_monitor(), ::testing::ExitedWithCode(0), "^$");
}

TEST_F(DeviceStreamTest, without_any_device_there_is_a_clear_error_and_no_noise) {
    EXPECT_EXIT(find_no_device(), ::testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace raks::audio
