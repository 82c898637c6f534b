#pragma once

#include <cstdint>
#include <vector>

#include "base/time.hpp"
#include "engine/offline/offline_driver.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::engine {

/// Samples all dancers' pose tracks at an even frame rate while they grow: pose i at i / fps
/// seconds.
class CollectPoses final : public OfflineDriver::Sink {
 public:
    /// `fps`: poses a second, > 0.
    explicit CollectPoses(double fps) : fps_(fps) {}

    /// Appends the poses whose time the hop's tracks have reached.
    void on_hop(const PerformedHop& hop) override;

    /// Cuts or extends each dancer's poses to the length of the music, ceil(duration x fps); the
    /// last pose is repeated where poses lack.
    void finish(Nanos duration);

    std::vector<std::vector<motion::Pose>> dancers;  ///< by dancer, then by pose

 private:
    [[nodiscard]] StreamTime next_time() const;

    double fps_;
    std::int64_t next_ = 0;
    std::vector<motion::Pose> last_;
};

}  // namespace raks::engine
