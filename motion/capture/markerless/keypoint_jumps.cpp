#include "motion/capture/markerless/keypoint_jumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>

#include "motion/capture/markerless/away_frames.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/markerless/keypoint_tracks.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kSureVisibility = 0.3;  // a joint that is less sure is a guess, and no jump

// The middle of a camera's shoulders and hips; none: fewer than three are seen.
std::optional<glm::dvec2> seen_trunk(const KeypointTake& take,
                                     std::size_t frame,
                                     std::size_t camera) {
    glm::dvec2 sum{};
    double count = 0.0;
    for (const BodyPoint point : {BodyPoint::left_shoulder,
                                  BodyPoint::right_shoulder,
                                  BodyPoint::left_hip,
                                  BodyPoint::right_hip}) {
        const Keypoint& seen = take.point(frame, camera, point);
        if (seen.visibility >= kSureVisibility) {
            sum += seen.pixel;
            count += 1.0;
        }
    }
    return count >= 3.0 ? std::optional(sum / count) : std::nullopt;
}

// Calls `add` for each stretch of frames in which `is_so`; shorter gaps than `gap` are in it.
void for_stretches(std::size_t frames,
                   std::size_t gap,
                   const std::function<bool(std::size_t)>& is_so,
                   const std::function<void(std::size_t, std::size_t)>& add) {
    std::optional<std::size_t> first;
    std::size_t last = 0;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        if (!is_so(frame)) {
            continue;
        }
        if (first && frame - last > gap + 1) {
            add(*first, last);
            first.reset();
        }
        first = first.value_or(frame);
        last = frame;
    }
    if (first) {
        add(*first, last);
    }
}

/// Marks what jumps, by camera, frame and followed point.
class JumpSearch {
 public:
    JumpSearch(const Rig& rig, const std::vector<double>& errors, const KeypointTake& take)
        : rig_(rig),
          errors_(errors),
          take_(take),
          marks_(take.cameras * take.frame_count * followed_points().size()),
          people_(take.cameras * take.frame_count),
          shared_(take.frame_count),
          contradicting_(take.frame_count) {}

    std::vector<KeypointJump> search() {
        for (std::size_t point = 0; point < followed_points().size(); ++point) {
            for (std::size_t camera = 0; camera < take_.cameras; ++camera) {
                mark_by_time(camera, point);
            }
            mark_by_views(point);
        }
        mark_people();
        return stretches();
    }

 private:
    enum class Mark : std::uint8_t { none, by_time, by_views };

    [[nodiscard]] Mark& mark(std::size_t camera, std::size_t frame, std::size_t point) {
        return marks_[(camera * take_.frame_count + frame) * followed_points().size() + point];
    }
    [[nodiscard]] const Keypoint* seen(std::size_t camera,
                                       std::size_t frame,
                                       std::size_t point) const {
        const Keypoint& one = take_.point(frame, camera, followed_points()[point]);
        return one.visibility >= kSureVisibility ? &one : nullptr;
    }
    [[nodiscard]] std::size_t frames_of(double seconds) const {
        return static_cast<std::size_t>(std::lround(seconds * take_.frames_per_second));
    }

    // Out and back: from `before` to `after` the joint is nowhere near the line between them, but
    // for the frames at both ends, in which it is on its way.
    void mark_by_time(std::size_t camera, std::size_t point) {
        constexpr double kLongestOut = 0.2;       // seconds
        constexpr double kOnTheWay = 1.0 / 30.0;  // likewise
        constexpr double kFarOut = 6.0;           // usual errors
        constexpr double kBack = 0.5;             // of how far it was out
        const std::size_t way = std::max<std::size_t>(1, frames_of(kOnTheWay));
        const std::size_t longest = std::max<std::size_t>(1, frames_of(kLongestOut));
        for (std::size_t before = 0; before + way < take_.frame_count; ++before) {
            const std::size_t first = before + way;
            for (std::size_t last = first; last < first + longest && last + way < take_.frame_count;
                 ++last) {
                const std::size_t after = last + way;
                const Keypoint* const from = seen(camera, before, point);
                const Keypoint* const to = seen(camera, after, point);
                if (from == nullptr || to == nullptr) {
                    continue;
                }
                const double least =
                    least_away(camera, point, {before, first, last, after}, *from, *to);
                if (least > kFarOut * errors_[camera] &&
                    glm::distance(from->pixel, to->pixel) < kBack * least) {
                    for (std::size_t frame = before + 1; frame < after; ++frame) {
                        mark(camera, frame, point) = Mark::by_time;
                    }
                    break;
                }
            }
        }
    }

    struct Excursion {
        std::size_t before = 0;
        std::size_t first = 0;
        std::size_t last = 0;
        std::size_t after = 0;
    };
    // How near it comes to the line meanwhile; 0: it is not seen all the time.
    [[nodiscard]] double least_away(std::size_t camera,
                                    std::size_t point,
                                    const Excursion& out,
                                    const Keypoint& from,
                                    const Keypoint& to) const {
        double least = HUGE_VAL;
        for (std::size_t frame = out.first; frame <= out.last; ++frame) {
            const Keypoint* const here = seen(camera, frame, point);
            if (here == nullptr) {
                return 0.0;
            }
            const double share = static_cast<double>(frame - out.before) /
                                 static_cast<double>(out.after - out.before);
            least =
                std::min(least, glm::distance(here->pixel, glm::mix(from.pixel, to.pixel, share)));
        }
        return least;
    }

    void mark_by_views(std::size_t point) {
        std::vector<PlacedKeypoint> placed;
        for (std::size_t frame = 0; frame < take_.frame_count; ++frame) {
            placed.push_back(place_keypoint(rig_, take_, frame, followed_points()[point], errors_));
        }
        for (std::size_t frame = 0; frame < take_.frame_count; ++frame) {
            const KeypointOutcome outcome = placed[frame].outcome;
            shared_[frame] += outcome != KeypointOutcome::unseen ? 1.0 : 0.0;
            contradicting_[frame] += outcome == KeypointOutcome::contradicts ? 1.0 : 0.0;
            for (const std::size_t camera : placed[frame].odd) {
                if (seen(camera, frame, point) != nullptr) {
                    note(camera, frame, point);
                }
            }
            const auto place = placed[frame].outcome == KeypointOutcome::contradicts
                                   ? between(placed, frame)
                                   : std::nullopt;
            const auto camera = place ? far_from(*place, frame, point) : std::nullopt;
            if (camera) {
                note(*camera, frame, point);
            }
        }
    }

    void note(std::size_t camera, std::size_t frame, std::size_t point) {
        Mark& one = mark(camera, frame, point);
        one = one == Mark::none ? Mark::by_views : one;
    }

    // Where it is on the way from the last place before a frame to the next one behind it; none:
    // they are farther than half a second away.
    [[nodiscard]] std::optional<glm::dvec3> between(const std::vector<PlacedKeypoint>& placed,
                                                    std::size_t frame) const {
        const std::size_t farthest = frames_of(0.5);
        const auto is_placed = [&](std::size_t at) {
            return placed[at].outcome == KeypointOutcome::placed;
        };
        std::size_t before = 1;
        while (before <= std::min(farthest, frame) && !is_placed(frame - before)) {
            ++before;
        }
        std::size_t after = 1;
        while (after <= farthest && frame + after < placed.size() && !is_placed(frame + after)) {
            ++after;
        }
        if (before > std::min(farthest, frame) || after > farthest ||
            frame + after >= placed.size()) {
            return std::nullopt;
        }
        return glm::mix(placed[frame - before].place.place,
                        placed[frame + after].place.place,
                        static_cast<double>(before) / static_cast<double>(before + after));
    }

    // The one camera that has the joint far from there, much farther than any other has.
    [[nodiscard]] std::optional<std::size_t> far_from(const glm::dvec3& place,
                                                      std::size_t frame,
                                                      std::size_t point) const {
        constexpr double kFar = 4.0;      // usual errors
        constexpr double kFarther = 2.0;  // times the next one
        double most = 0.0;
        double next = 0.0;
        std::size_t worst = 0;
        for (std::size_t camera = 0; camera < take_.cameras; ++camera) {
            const Keypoint* const here = seen(camera, frame, point);
            const auto there = project(rig_.cameras[camera], place);
            if (here == nullptr || !there || !(errors_[camera] > 0.0)) {
                continue;
            }
            const double away = glm::distance(here->pixel, *there) / errors_[camera];
            next = std::max(next, std::min(away, most));
            if (away > most) {
                most = away;
                worst = camera;
            }
        }
        return most > kFar && most > kFarther * next ? std::optional(worst) : std::nullopt;
    }

    void mark_people() {
        constexpr std::size_t kFewest = 6;  // joints
        for (std::size_t camera = 0; camera < take_.cameras; ++camera) {
            for (std::size_t frame = 0; frame < take_.frame_count; ++frame) {
                std::size_t there = 0;
                std::size_t jumped = 0;
                for (std::size_t point = 0; point < followed_points().size(); ++point) {
                    there += seen(camera, frame, point) != nullptr ? 1U : 0U;
                    jumped += mark(camera, frame, point) != Mark::none ? 1U : 0U;
                }
                people_[camera * take_.frame_count + frame] =
                    jumped >= kFewest && 2 * jumped >= there;
            }
        }
    }

    // Stretches in which the cameras do not see the same person.
    [[nodiscard]] std::vector<KeypointJump> disagreements() const {
        constexpr double kShare = 1.0 / 3.0;  // of the joints that two cameras see
        constexpr double kAround = 0.25;      // seconds, each side, that are counted together
        constexpr double kShortest = 0.3;     // seconds
        std::vector<KeypointJump> all;
        const std::size_t around = frames_of(kAround);
        const auto is_so = [&](std::size_t frame) {
            double shared = 0.0;
            double contradicting = 0.0;
            const std::size_t end = std::min(frame + around + 1, take_.frame_count);
            for (std::size_t at = frame - std::min(frame, around); at < end; ++at) {
                shared += shared_[at];
                contradicting += contradicting_[at];
            }
            return shared > 0.0 && contradicting >= kShare * shared;
        };
        for_stretches(take_.frame_count,
                      frames_of(kShortest),
                      is_so,
                      [&](std::size_t first, std::size_t last) {
                          if (last - first >= frames_of(kShortest)) {
                              all.push_back({std::nullopt, std::nullopt, first, last});
                          }
                      });
        return all;
    }

    // Whether a stretch is long enough for what views alone tell.
    [[nodiscard]] bool is_long(std::size_t first, std::size_t last) const {
        constexpr double kShortest = 0.1;  // seconds
        return static_cast<double>(last - first + 1) >= kShortest * take_.frames_per_second;
    }

    // Other people, by what most joints of a camera do.
    void add_people(std::size_t camera, std::vector<KeypointJump>& all) const {
        constexpr double kGap = 0.1;  // seconds between stretches that are one
        for_stretches(
            take_.frame_count,
            frames_of(kGap),
            [&](std::size_t frame) {
                return static_cast<bool>(people_[camera * take_.frame_count + frame]);
            },
            [&](std::size_t first, std::size_t last) {
                if (is_long(first, last)) {
                    all.push_back({camera, std::nullopt, first, last});
                }
            });
    }

    // Joints that jump while the camera follows the dancer.
    void add_joints(std::size_t camera,
                    const std::vector<KeypointJump>& people,
                    std::vector<KeypointJump>& all) {
        for (std::size_t point = 0; point < followed_points().size(); ++point) {
            const auto is_marked = [&](std::size_t frame) {
                return mark(camera, frame, point) != Mark::none &&
                       std::none_of(people.begin(), people.end(), [&](const auto& person) {
                           return person.camera.value_or(camera) == camera &&
                                  person.first <= frame && frame <= person.last;
                       });
            };
            const auto add = [&](std::size_t first, std::size_t last) {
                bool is_sure = is_long(first, last);
                for (std::size_t frame = first; frame <= last; ++frame) {
                    is_sure = is_sure || mark(camera, frame, point) == Mark::by_time;
                }
                if (is_sure) {
                    all.push_back({camera, followed_points()[point], first, last});
                }
            };
            for_stretches(take_.frame_count, 1, is_marked, add);
        }
    }

    std::vector<KeypointJump> stretches() {
        std::vector<KeypointJump> people = disagreements();
        for (std::size_t camera = 0; camera < take_.cameras; ++camera) {
            add_people(camera, people);
        }
        std::vector<KeypointJump> all = people;
        for (std::size_t camera = 0; camera < take_.cameras; ++camera) {
            add_joints(camera, people, all);
        }
        return all;
    }

    const Rig& rig_;
    const std::vector<double>& errors_;
    const KeypointTake& take_;
    std::vector<Mark> marks_;   // cameras x frames x points
    std::vector<bool> people_;  // cameras x frames
    // By frame: joints that two cameras see, and those of them whose views contradict one another.
    std::vector<double> shared_;
    std::vector<double> contradicting_;
};

}  // namespace

std::vector<KeypointJump> find_other_people(const std::vector<double>& errors,
                                            const KeypointTake& take) {
    // Of the body's height in the picture.
    constexpr double kTrembling = 0.2;
    constexpr double kFastest = 1.5;
    constexpr double kFarthest = 0.45;
    std::vector<KeypointJump> people;
    for (std::size_t camera = 0; camera < take.cameras; ++camera) {
        std::vector<std::optional<glm::dvec2>> trunks;
        for (std::size_t frame = 0; frame < take.frame_count; ++frame) {
            trunks.push_back(seen_trunk(take, frame, camera));
        }
        const double size = body_size(errors[camera]);
        const auto away = away_frames(
            trunks, take.frames_per_second, {size * kTrembling, size * kFastest, size * kFarthest});
        for_stretches(
            take.frame_count,
            0,
            [&](std::size_t frame) { return static_cast<bool>(away[frame]); },
            [&](std::size_t first, std::size_t last) {
                people.push_back({camera, std::nullopt, first, last});
            });
    }
    return people;
}

std::vector<KeypointJump> find_jumps(const Rig& rig,
                                     const std::vector<double>& errors,
                                     const KeypointTake& take) {
    return JumpSearch(rig, errors, take).search();
}

void hide_jumps(const std::vector<KeypointJump>& jumps, KeypointTake& take) {
    for (const KeypointJump& jump : jumps) {
        for (std::size_t i = 0; i < take.cameras * (jump.last - jump.first + 1); ++i) {
            const std::size_t camera = i % take.cameras;
            auto& points = take.at(jump.first + i / take.cameras, camera);
            if (jump.camera.value_or(camera) != camera) {
                continue;
            }
            if (jump.point) {
                points[static_cast<std::size_t>(*jump.point)] = {};
            } else {
                points = {};
            }
        }
    }
}

void add_flags(const std::vector<KeypointJump>& jumps,
               const std::vector<std::string>& names,
               Tracks& tracks) {
    for (const KeypointJump& jump : jumps) {
        const auto name = name_of(jump.point.value_or(BodyPoint::nose));
        const auto marker = std::find(tracks.markers.begin(), tracks.markers.end(), name);
        if (marker != tracks.markers.end()) {
            tracks.flags.push_back({jump.point ? Doubt::jumped : Doubt::person,
                                    static_cast<std::size_t>(marker - tracks.markers.begin()),
                                    jump.first,
                                    jump.last,
                                    jump.camera ? names[*jump.camera] : std::string()});
        }
    }
    // That joints are lost meanwhile needs no flag of each.
    std::erase_if(tracks.flags, [&](const Flag& flag) {
        constexpr std::size_t kAround = 2;  // frames
        return flag.doubt == Doubt::lost &&
               std::any_of(jumps.begin(), jumps.end(), [&](const KeypointJump& jump) {
                   return !jump.point && flag.first + kAround >= jump.first &&
                          flag.last <= jump.last + kAround;
               });
    });
    sort_flags(tracks);
}

std::vector<std::string> words_of(const std::vector<KeypointJump>& jumps,
                                  const std::vector<std::string>& names,
                                  const Tracks& tracks) {
    std::vector<std::string> lines;
    for (std::size_t camera = 0; camera < names.size(); ++camera) {
        std::size_t stretches = 0;
        double away = 0.0;  // seconds of another person
        for (const KeypointJump& jump : jumps) {
            if (jump.camera == camera) {
                stretches += jump.point ? 1U : 0U;
                away += jump.point ? 0.0
                                   : static_cast<double>(jump.last - jump.first + 1) /
                                         tracks.frames_per_second;
            }
        }
        if (away > 0.0) {
            lines.push_back(
                fmt::format("{}: somebody else was followed for {:.1f} s, which do not count",
                            names[camera],
                            away));
        }
        if (stretches > 0) {
            lines.push_back(fmt::format(
                "{}: joints jumped in {} stretches, which do not count", names[camera], stretches));
        }
    }
    double apart = 0.0;
    for (const KeypointJump& jump : jumps) {
        apart += jump.camera
                     ? 0.0
                     : static_cast<double>(jump.last - jump.first + 1) / tracks.frames_per_second;
    }
    if (apart > 0.0) {
        lines.push_back(fmt::format(
            "the cameras do not follow the same person for {:.1f} s, which do not count; tell "
            "which one is wrong in raks capture correct",
            apart));
    }
    return lines;
}

}  // namespace raks::capture
