#pragma once

#include <cstdint>
#include <vector>

#include "base/time.hpp"
#include "engine/offline/offline_driver.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::engine {

/// Takes the poses of an even frame rate out of all dancers' tracks as they grow: pose i at i / fps
/// seconds.
class CollectPoses final : public OfflineDriver::Sink {
 public:
    explicit CollectPoses(double fps) : fps_(fps) {}

    void on_hop(const PerformedHop& hop) override;

    /// Exactly as many poses as the music is long.
    void finish(Nanos duration);

    std::vector<std::vector<motion::Pose>> dancers;  ///< by dancer, then by pose

 private:
    [[nodiscard]] StreamTime next_time() const;

    double fps_;
    std::int64_t next_ = 0;
    std::vector<motion::Pose> last_;
};

}  // namespace raks::engine
