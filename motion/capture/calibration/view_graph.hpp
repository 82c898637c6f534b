// Which cameras saw the board together, and whether that joins all of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/calibration/board_detection.hpp"

namespace raks::capture {

/// What one camera saw of the board at one moment.
struct Sighting {
    std::size_t camera = 0;            ///< index in the rig
    std::size_t moment = 0;            ///< the same for pictures taken at once
    std::vector<BoardCorner> corners;  ///< kFewestBoardCorners or more
};

/// How many moments two cameras both saw the board, for each two cameras.
class SharedViews {
 public:
    /// Counts moments. `cameras`: how many there are; above every index in the sightings.
    SharedViews(const std::vector<Sighting>& sightings, std::size_t cameras);

    [[nodiscard]] std::size_t cameras() const noexcept { return cameras_; }
    /// Of two cameras, in any order.
    [[nodiscard]] std::size_t between(std::size_t a, std::size_t b) const noexcept {
        return counts_[a * cameras_ + b];
    }

 private:
    std::size_t cameras_;
    std::vector<std::size_t> counts_;  // cameras * cameras
};

/// Two cameras that are joined by what both saw.
struct Join {
    std::size_t from =
        0;  ///< joined to the first camera by the joins before this one, or itself it
    std::size_t to = 0;
    std::size_t shared = 0;  ///< moments
};

inline constexpr std::size_t kFewestShared = 8;  ///< less does not join two cameras
inline constexpr std::size_t kFewShared = 15;    ///< less is doubtful

/// The joins by which all cameras hang together, from the first camera on: those with the most
/// shared views (a maximum spanning tree). Error: pairs with kFewestShared or more do not join all
/// cameras; it names the two that want the board, and what they have.
[[nodiscard]] Expected<std::vector<Join>> joins_of(const SharedViews& shared,
                                                   const std::vector<std::string>& names);

/// A line for each join with less than kFewShared shared views.
[[nodiscard]] std::vector<std::string> weak_joins(const std::vector<Join>& joins,
                                                  const std::vector<std::string>& names);

}  // namespace raks::capture
