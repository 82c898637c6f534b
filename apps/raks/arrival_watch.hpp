#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/raks/bench.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/descriptor.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/trials/loop_recorder.hpp"

namespace raks::apps {

/// Receivers of this program's own on 127.0.0.1, which note when each beat comes by OSC and by
/// OS2L. Threads: main, for all methods.
class ArrivalWatch {
 public:
    /// Opens a port for each. Errors: the system has none.
    [[nodiscard]] static Expected<std::unique_ptr<ArrivalWatch>> open();
    ~ArrivalWatch();                                        ///< ends the receivers
    ArrivalWatch(const ArrivalWatch&) = delete;             ///< its threads refer to it
    ArrivalWatch& operator=(const ArrivalWatch&) = delete;  ///< likewise

    /// Targets for Outputs::open.
    [[nodiscard]] std::vector<engine::OutputWish> wishes() const;
    /// How the beats came, against those that were out: mean and deviation of the differences (late
    /// is positive), how many came, and how far from when Raks meant them to be heard.
    void add_to(BenchReport& report,
                const std::vector<engine::AudibleBeat>& audible,
                const audio::GeneratedMusic& music) const;

 private:
    struct Arrival {
        HostTime at;
        HostTime meant{};  // of OSC: the bundle's time tag
    };
    ArrivalWatch() = default;
    void hear_osc();
    void hear_os2l();
    void add_spread(const std::string& name,
                    const std::vector<Arrival>& arrivals,
                    const std::vector<engine::AudibleBeat>& audible,
                    const audio::GeneratedMusic& music,
                    BenchReport& report) const;

    Descriptor osc_socket_;
    Descriptor os2l_socket_;
    int osc_port_ = 0;
    int os2l_port_ = 0;
    std::atomic<bool> is_stopping_{false};
    mutable std::mutex mutex_;  // of the two below
    std::vector<Arrival> osc_;
    std::vector<Arrival> os2l_;
    std::thread osc_thread_;
    std::thread os2l_thread_;
};

}  // namespace raks::apps
