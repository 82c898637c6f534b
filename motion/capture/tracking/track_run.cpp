#include "motion/capture/tracking/track_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kSpotGate = 11.8;        // chi-square, 2 degrees of freedom: 99.7 %
constexpr double kInnovationGate = 25.0;  // 3 degrees of freedom
constexpr int kGateOffAfter = 3;          // misses
constexpr int kVelocityFor = 2;           // misses; then a marker moves with the others
constexpr int kSoughtAfter = 5;           // misses
constexpr double kSoughtWithin = 0.6;     // metres of where it is thought to be
constexpr double kSoughtSpeed = 1.5;      // metres a second by which that grows
constexpr double kSaidRadius = 6.0;       // pixels: a spot this near is what a person meant

/// A marker while it is followed.
struct Follow {
    std::optional<MarkerBelief> belief;
    int misses = 0;
};

class TrackRun {
 public:
    TrackRun(const TrackRunInput& input, FrameViews& views)
        : input_(input), views_(views), follows_(input.classes.size()) {}

    // The markers of the next frame.
    std::vector<TrackedMarker> advance(std::size_t frame) {
        spots_ = &views_.at(frame);
        now_.assign(follows_.size(), {});
        for (const MarkerSwap& swap : input_.swaps) {
            if (swap.frame == frame) {
                std::swap(follows_[swap.one], follows_[swap.other]);
            }
        }
        predict();
        take_said(frame);
        follow_spots(frame);
        give_up_the_impossible();
        seek_lost(frame);
        finish();
        return std::move(now_);
    }

 private:
    void predict() {
        glm::dvec3 velocity(0.0);
        int tracked = 0;
        for (const Follow& follow : follows_) {
            if (follow.belief && follow.misses == 0) {
                velocity += follow.belief->velocity;
                ++tracked;
            }
        }
        for (Follow& follow : follows_) {
            if (!follow.belief) {
                continue;
            }
            if (follow.misses >= kVelocityFor && tracked > 0) {
                follow.belief->velocity = velocity / static_cast<double>(tracked);
            }
            follow.belief = predicted(*follow.belief, input_.seconds, input_.acceleration);
        }
    }

    // Places that a person said in two or more views.
    void take_said(std::size_t frame) {
        std::vector<std::vector<SeenSpot>> said(follows_.size());
        for (const SaidView& view : input_.said) {
            if (view.frame == frame) {
                said[view.marker].push_back(said_spot(view));
            }
        }
        for (std::size_t marker = 0; marker < said.size(); ++marker) {
            if (said[marker].empty()) {
                continue;
            }
            std::vector<PointView> views;
            const Follow& follow = follows_[marker];
            const glm::dvec3 velocity = follow.belief ? follow.belief->velocity : glm::dvec3(0.0);
            for (const SeenSpot& spot : said[marker]) {
                views.push_back(view_of(spot, velocity));
            }
            add_matching_views(marker, said[marker], views);
            if (const auto point = triangulate(*input_.rig, views, input_.sigma)) {
                restart(marker, *point);
            }
        }
    }

    // The spot that a person pointed to, which no other marker may have then, or the pixel itself.
    SeenSpot said_spot(const SaidView& view) {
        const Camera& camera = input_.rig->cameras[view.camera];
        SeenSpot said{view.camera,
                      input_.classes[view.marker],
                      view.pixel,
                      direction_of(camera.lens, view.pixel),
                      view.late,
                      true};
        double nearest = kSaidRadius;
        SeenSpot* meant = nullptr;
        for (SeenSpot& spot : *spots_) {
            const double apart = glm::distance(spot.pixel, view.pixel);
            if (spot.camera == view.camera && spot.colour == said.colour && apart < nearest) {
                nearest = apart;
                meant = &spot;
            }
        }
        if (meant != nullptr) {
            meant->is_used = true;
            said = *meant;
        }
        return said;
    }

    // Where one view was said only, those that the belief finds in the other cameras.
    void add_matching_views(std::size_t marker,
                            const std::vector<SeenSpot>& said,
                            std::vector<PointView>& views) {
        if (!follows_[marker].belief || said.size() > 1) {
            return;
        }
        std::vector<std::optional<MarkerBelief>> beliefs(follows_.size());
        beliefs[marker] = follows_[marker].belief;
        const auto matched =
            match_spots(*input_.rig, beliefs, input_.classes, input_.sigma, kSpotGate, *spots_);
        for (const std::size_t spot : matched[marker]) {
            if ((*spots_)[spot].camera != said.front().camera) {
                views.push_back(view_of((*spots_)[spot], beliefs[marker]->velocity));
            } else {
                (*spots_)[spot].is_used = false;
            }
        }
    }

    void restart(std::size_t marker, const TriangulatedPoint& point) {
        const MeasuredPlace measured{point.place, point.covariance};
        follows_[marker].belief = first_belief(measured);
        note(marker, measured, point);
    }

    void note(std::size_t marker, const MeasuredPlace& measured, const TriangulatedPoint& point) {
        follows_[marker].misses = 0;
        now_[marker].measured = measured;
        now_[marker].views = point.views.size();
        now_[marker].residual = point.residual;
    }

    [[nodiscard]] bool is_hidden(std::size_t marker, std::size_t frame) const {
        return std::any_of(
            input_.hidden.begin(), input_.hidden.end(), [&](const MarkerStretch& stretch) {
                return stretch.marker == marker && frame >= stretch.first && frame <= stretch.last;
            });
    }

    void follow_spots(std::size_t frame) {
        std::vector<std::optional<MarkerBelief>> beliefs(follows_.size());
        for (std::size_t marker = 0; marker < follows_.size(); ++marker) {
            if (follows_[marker].misses < kSoughtAfter && !now_[marker].measured &&
                !is_hidden(marker, frame)) {
                beliefs[marker] = follows_[marker].belief;
            }
        }
        const auto matched =
            match_spots(*input_.rig, beliefs, input_.classes, input_.sigma, kSpotGate, *spots_);
        for (std::size_t marker = 0; marker < follows_.size(); ++marker) {
            measure(marker, matched[marker]);
        }
    }

    // Places a marker by its spots; those that do not count are free again.
    void measure(std::size_t marker, const std::vector<std::size_t>& matched) {
        if (matched.empty()) {
            return;
        }
        Follow& follow = follows_[marker];
        std::vector<PointView> views;
        for (const std::size_t spot : matched) {
            views.push_back(view_of((*spots_)[spot], follow.belief->velocity));
            (*spots_)[spot].is_used = false;
        }
        const auto point = triangulate(*input_.rig, views, input_.sigma);
        constexpr double kLargestResidual = 4.0;  // sigma
        if (!point || point->residual > kLargestResidual * input_.sigma + 1.0) {
            return;
        }
        const MeasuredPlace measured{point->place, point->covariance};
        if (follow.misses < kGateOffAfter &&
            innovation(*follow.belief, measured) > kInnovationGate) {
            now_[marker].jumps = true;
            return;
        }
        for (const std::size_t view : point->views) {
            (*spots_)[matched[view]].is_used = true;
        }
        follow.belief = updated(*follow.belief, measured);
        note(marker, measured, *point);
    }

    // How many of the body's limits a place breaks, against markers that were measured now.
    [[nodiscard]] int broken_limits(std::size_t marker, const glm::dvec3& place) const {
        int broken = 0;
        for (const DistanceLimit& limit : input_.limits) {
            if (limit.one != marker && limit.other != marker) {
                continue;
            }
            const std::size_t other = limit.one == marker ? limit.other : limit.one;
            if (!now_[other].measured) {
                continue;
            }
            const double apart = glm::distance(place, now_[other].measured->place);
            broken += apart < limit.least || apart > limit.most ? 1 : 0;
        }
        return broken;
    }

    void give_up_the_impossible() {
        for (;;) {
            int most = 0;
            std::size_t worst = 0;
            for (std::size_t marker = 0; marker < follows_.size(); ++marker) {
                if (!now_[marker].measured) {
                    continue;
                }
                const int broken = broken_limits(marker, now_[marker].measured->place);
                const bool is_worse = broken > most || (broken == most && broken > 0 &&
                                                        now_[marker].views < now_[worst].views);
                if (is_worse) {
                    most = broken;
                    worst = marker;
                }
            }
            if (most == 0) {
                return;
            }
            now_[worst] = {};
            now_[worst].contradicts = true;
            follows_[worst].misses = kSoughtAfter;
        }
    }

    // Markers that were lost for long take places that unused spots of their colour agree on.
    void seek_lost(std::size_t frame) {
        std::vector<std::size_t> lost;
        for (std::size_t marker = 0; marker < follows_.size(); ++marker) {
            if (follows_[marker].misses >= kSoughtAfter && follows_[marker].belief &&
                !now_[marker].measured && !is_hidden(marker, frame)) {
                lost.push_back(marker);
            }
        }
        // Those that were lost last are the surest.
        std::stable_sort(lost.begin(), lost.end(), [&](std::size_t one, std::size_t other) {
            return follows_[one].misses < follows_[other].misses;
        });
        for (const std::size_t marker : lost) {
            if (const auto found = sought(marker)) {
                for (const std::size_t spot : found->spots) {
                    (*spots_)[spot].is_used = true;
                }
                restart(marker, found->point);
            }
        }
    }

    [[nodiscard]] std::optional<SpotAgreement> sought(std::size_t marker) const {
        const Follow& follow = follows_[marker];
        const auto same_colour =
            std::count(input_.classes.begin(), input_.classes.end(), input_.classes[marker]);
        const std::size_t least_views = same_colour == 1 ? 2 : 3;
        const double reach = kSoughtWithin + kSoughtSpeed * input_.seconds * follow.misses;
        std::optional<SpotAgreement> best;
        double best_score = std::numeric_limits<double>::infinity();
        for (SpotAgreement& found :
             agreements(*input_.rig, *spots_, input_.classes[marker], input_.sigma, least_views)) {
            const double apart = glm::distance(found.point.place, follow.belief->place);
            if (apart > reach || broken_limits(marker, found.point.place) > 0) {
                continue;
            }
            // A further view is worth 20 cm.
            constexpr double kWorthOfView = 0.2;
            const double score = apart - kWorthOfView * static_cast<double>(found.spots.size());
            if (score < best_score) {
                best_score = score;
                best = std::move(found);
            }
        }
        return best;
    }

    void finish() {
        for (std::size_t marker = 0; marker < follows_.size(); ++marker) {
            if (!now_[marker].measured) {
                ++follows_[marker].misses;
            }
            now_[marker].belief = follows_[marker].belief;
        }
    }

    const TrackRunInput& input_;
    FrameViews& views_;
    std::vector<Follow> follows_;             ///< by marker
    std::vector<TrackedMarker> now_;          ///< by marker; of this frame
    std::vector<SeenSpot>* spots_ = nullptr;  ///< of this frame
};

}  // namespace

std::vector<TrackedMarker> run_tracker(const TrackRunInput& input,
                                       FrameViews& views,
                                       std::size_t frame_count) {
    TrackRun run(input, views);
    std::vector<TrackedMarker> result;
    result.reserve(frame_count * input.classes.size());
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        for (const TrackedMarker& marker : run.advance(frame)) {
            result.push_back(marker);
        }
    }
    return result;
}

}  // namespace raks::capture
