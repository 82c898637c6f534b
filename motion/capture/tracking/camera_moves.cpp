#include "motion/capture/tracking/camera_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/printable.hpp"
#include "base/statistics.hpp"
#include "motion/skeleton/formats/table_rows.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kMoveSeconds = 0.5;         // seconds
constexpr std::size_t kWindowsAround = 2;    // windows before and after that say the same
constexpr std::size_t kLeastWindows = 3;     // of a stretch
constexpr std::size_t kLeastSpots = 10;      // of a window that says something
constexpr double kReach = 0.1;               // 60 pixels at a focal length of 600
constexpr double kAtMarker = 5.0;            // sigma
constexpr double kOffset = 3.0;              // sigma
constexpr double kFewAgainstOthers = 0.5;    // of the share of spots that lie at a marker
constexpr double kLeastShareOfOthers = 0.2;  // below it the others say nothing

/// What one camera saw in one window, against where the markers are.
struct CameraWindow {
    std::size_t expected = 0;  ///< spots that could lie at a marker
    std::size_t fitting = 0;   ///< that do
    std::vector<double> off_x;
    std::vector<double> off_y;
    std::vector<double> distances;

    [[nodiscard]] std::optional<double> share() const {
        return expected < kLeastSpots
                   ? std::nullopt
                   : std::optional(static_cast<double>(fitting) / static_cast<double>(expected));
    }
};

double median_of(std::vector<double> values) {
    return values.empty() ? 0.0 : upper_median(std::move(values));
}

/// Compares all spots with the markers, camera by camera and window by window.
class Comparison {
 public:
    Comparison(const TrackRunInput& input,
               FrameViews& views,
               const std::vector<TrackedMarker>& tracked)
        : input_(input),
          markers_(input.classes.size()),
          frames_(tracked.size() / std::max<std::size_t>(1, markers_)),
          long_(static_cast<std::size_t>(std::max(1.0, std::round(kMoveSeconds / input.seconds)))),
          windows_(input.rig->cameras.size(),
                   std::vector<CameraWindow>((frames_ + long_ - 1) / long_)) {
        for (std::size_t frame = 0; frame < frames_; ++frame) {
            for (std::size_t camera = 0; camera < windows_.size(); ++camera) {
                compare(camera, &tracked[frame * markers_], views.at(frame), frame / long_);
            }
        }
    }

    [[nodiscard]] std::size_t cameras() const { return windows_.size(); }

    // The stretches in which a camera disagrees.
    [[nodiscard]] std::vector<CameraMove> stretches(std::size_t camera) const {
        const std::vector<bool> bad = disagreements(camera);
        std::vector<CameraMove> moves;
        std::size_t first = 0;
        for (std::size_t window = 0; window <= bad.size(); ++window) {
            if (window < bad.size() && bad[window]) {
                continue;
            }
            if (window - first >= kLeastWindows) {
                moves.push_back({input_.rig->cameras[camera].name,
                                 first * long_,
                                 std::min(window * long_, frames_) - 1,
                                 offset_of(camera, first, window)});
            }
            first = window + 1;
        }
        return moves;
    }

 private:
    // Spots of a camera at one frame, colour by colour: as many as there are markers of that colour
    // in the picture, at most, can lie at one.
    void compare(std::size_t camera,
                 const TrackedMarker* tracked,
                 const std::vector<SeenSpot>& spots,
                 std::size_t window) {
        std::vector<std::size_t> in_picture(markers_, 0);  // by class; as many as markers, at most
        std::vector<std::size_t> found(markers_, 0);
        for (std::size_t marker = 0; marker < markers_; ++marker) {
            count_marker(camera, marker, tracked[marker], spots, in_picture, window);
        }
        for (const SeenSpot& spot : spots) {
            if (spot.camera == camera) {
                ++found[spot.colour];
            }
        }
        for (std::size_t colour = 0; colour < markers_; ++colour) {
            windows_[camera][window].expected += std::min(in_picture[colour], found[colour]);
        }
    }

    void count_marker(std::size_t index,
                      std::size_t marker,
                      const TrackedMarker& tracked,
                      const std::vector<SeenSpot>& spots,
                      std::vector<std::size_t>& in_picture,
                      std::size_t window) {
        const Camera& camera = input_.rig->cameras[index];
        const auto at = tracked.measured && tracked.belief
                            ? project(camera, tracked.measured->place)
                            : std::nullopt;
        if (!at || !is_in_picture(camera.lens, *at)) {
            return;
        }
        ++in_picture[input_.classes[marker]];
        double nearest = kReach * camera.lens.fx;
        std::optional<glm::dvec2> off;
        for (const SeenSpot& spot : spots) {
            if (spot.camera != index || spot.colour != input_.classes[marker]) {
                continue;
            }
            const auto then =
                project(camera, tracked.measured->place + spot.late * tracked.belief->velocity);
            if (then && glm::distance(*then, spot.pixel) < nearest) {
                nearest = glm::distance(*then, spot.pixel);
                off = spot.pixel - *then;
            }
        }
        if (!off) {
            return;
        }
        CameraWindow& seen = windows_[index][window];
        seen.fitting += nearest <= kAtMarker * input_.sigma ? 1U : 0U;
        seen.off_x.push_back(off->x);
        seen.off_y.push_back(off->y);
        seen.distances.push_back(nearest);
    }

    // Whether a camera disagrees in one window; none: too little is seen to tell.
    [[nodiscard]] std::optional<bool> is_off(std::size_t camera, std::size_t window) const {
        const CameraWindow& own = windows_[camera][window];
        std::vector<double> others;
        for (std::size_t other = 0; other < windows_.size(); ++other) {
            const auto share = other != camera ? windows_[other][window].share() : std::nullopt;
            if (share) {
                others.push_back(*share);
            }
        }
        const auto share = own.share();
        if (!share || others.size() < 2) {
            return std::nullopt;
        }
        const double usual = median_of(others);
        if (usual < kLeastShareOfOthers) {
            return std::nullopt;
        }
        const double offset = std::hypot(median_of(own.off_x), median_of(own.off_y));
        return *share < kFewAgainstOthers * usual ||
               (own.off_x.size() >= kLeastSpots && offset > kOffset * input_.sigma);
    }

    // By window: what the majority of those around it says.
    [[nodiscard]] std::vector<bool> disagreements(std::size_t camera) const {
        const std::size_t count = windows_[camera].size();
        std::vector<std::optional<bool>> each(count);
        for (std::size_t window = 0; window < count; ++window) {
            each[window] = is_off(camera, window);
        }
        std::vector<bool> bad(count, false);
        for (std::size_t window = 0; window < count; ++window) {
            int votes = 0;
            const std::size_t from = window > kWindowsAround ? window - kWindowsAround : 0;
            for (std::size_t i = from; i < std::min(count, window + kWindowsAround + 1); ++i) {
                votes += each[i] ? (*each[i] ? 1 : -1) : 0;
            }
            bad[window] = votes > 0;
        }
        return bad;
    }

    [[nodiscard]] double offset_of(std::size_t camera, std::size_t first, std::size_t end) const {
        std::vector<double> distances;
        for (std::size_t window = first; window < end; ++window) {
            const auto& own = windows_[camera][window].distances;
            distances.insert(distances.end(), own.begin(), own.end());
        }
        return median_of(std::move(distances));
    }

    const TrackRunInput& input_;
    std::size_t markers_;
    std::size_t frames_;
    std::size_t long_;                                // frames in a window
    std::vector<std::vector<CameraWindow>> windows_;  // by camera
};

std::size_t frames_in(const std::vector<CameraMove>& moves) {
    std::size_t frames = 0;
    for (const CameraMove& move : moves) {
        frames += move.last - move.first + 1;
    }
    return frames;
}

constexpr std::size_t kMoveColumns = 4;

Expected<CameraMove> move_of(const std::vector<std::string_view>& cells) {
    if (cells.size() != kMoveColumns) {
        return fail(fmt::format("has {} cells, needs camera, first, last, offset", cells.size()));
    }
    const Expected<double> first = motion::number_of_cell(cells[1]);
    const Expected<double> last = motion::number_of_cell(cells[2]);
    const Expected<double> offset = motion::number_of_cell(cells[3]);
    for (const auto* number : {&first, &last, &offset}) {
        if (!*number) {
            return fail(number->error());
        }
    }
    constexpr double kMostFrames = 1e8;
    if (!(*first >= 0.0 && *first <= *last && *last <= kMostFrames) ||
        *first != std::floor(*first) || *last != std::floor(*last)) {
        return fail("first and last must be frames, the last not before the first");
    }
    if (!std::isfinite(*offset)) {
        return fail("offset must be pixels");
    }
    return CameraMove{std::string(cells[0]),
                      static_cast<std::size_t>(*first),
                      static_cast<std::size_t>(*last),
                      *offset};
}

}  // namespace

std::vector<CameraMove> find_moved_camera(const TrackRunInput& input,
                                          FrameViews& views,
                                          const std::vector<TrackedMarker>& tracked) {
    const Comparison comparison(input, views, tracked);
    std::vector<CameraMove> worst;
    for (std::size_t camera = 0; camera < comparison.cameras(); ++camera) {
        auto moves = comparison.stretches(camera);
        if (frames_in(moves) > frames_in(worst)) {
            worst = std::move(moves);
        }
    }
    return worst;
}

std::string moves_text(const std::vector<CameraMove>& moves) {
    std::string text = "camera\tfirst\tlast\toffset\n";
    for (const CameraMove& move : moves) {
        text += fmt::format("{}\t{}\t{}\t{}\n", move.camera, move.first, move.last, move.offset);
    }
    return text;
}

Expected<std::vector<CameraMove>> read_moves(std::string_view text, const std::string& file) {
    constexpr std::size_t kMostMoves = 10'000;
    motion::TableRows rows(motion::without_byte_order_mark(text), '\t');
    motion::TableRow row;
    if (!rows.next(row) || row.cells.size() != kMoveColumns || row.cells[0] != "camera" ||
        row.cells[3] != "offset") {
        return fail(
            file +
            ": is not a table of moved cameras: its first line must be camera, first, last, "
            "offset");
    }
    std::vector<CameraMove> moves;
    while (rows.next(row)) {
        Expected<CameraMove> move = move_of(row.cells);
        if (move && moves.size() == kMostMoves) {
            move = fail(fmt::format("more than {} stretches", kMostMoves));
        }
        if (!move) {
            return fail(fmt::format("{}: line {}: {}", file, row.number, move.error().message));
        }
        moves.push_back(std::move(*move));
    }
    return moves;
}

std::string words_of_move(const CameraMove& move, const Tracks& tracks) {
    const bool is_to_the_end = move.last + 1 >= tracks.frame_count;
    const bool is_all = is_to_the_end && move.first == 0;
    const std::string when =
        is_all ? "all the time"
        : is_to_the_end
            ? fmt::format("from {:.1f} s on (frame {})", tracks.time_of(move.first), move.first)
            : fmt::format("from {:.1f} to {:.1f} s (frames {} to {})",
                          tracks.time_of(move.first),
                          tracks.time_of(move.last),
                          move.first,
                          move.last);
    return fmt::format(
        "camera \"{}\" disagrees with the others {}: {}; what it sees then does not count. {}",
        printable(move.camera, 40),
        when,
        is_all ? "it was moved after the board was filmed, or its clock is wrong"
               : "it was moved, or its film jumps",
        is_all ? "Film the board again, or look at clocks.toml"
               : "To use it, cut the film there and film the board again");
}

}  // namespace raks::capture
