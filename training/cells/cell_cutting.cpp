#include "training/cells/cell_cutting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "training/figures/repeat_features.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {
namespace {

constexpr double kMost = 0.5;          // share of a beat that is no dance
constexpr double kFewestFrames = 4.5;  // of a beat: what learning asks for, with some slack
constexpr double kLeastAround = 0.6;   // of a beat: motion before and behind a stretch
constexpr double kEndWindow = 0.125;   // seconds about the end of a cell in which its speed counts

// Frames [first, last) of a beat.
struct FrameRange {
    std::size_t first = 0;
    std::size_t last = 0;
};

class TakeCutter {
 public:
    TakeCutter(const PreparedTake& take, const std::vector<TakeBeat>& beats)
        : take_(take), beats_(beats), rate_(take.clip.frames_per_second) {
        for (const TakeBeat& beat : beats) {
            frames_.push_back(beat.time * rate_);
        }
    }

    TakeCut cut() {
        cut_.fates.assign(beats_.size(), BeatFate::unused);
        for (std::size_t i = 0; i + 1 < beats_.size(); ++i) {
            cut_.fates[i] = fate_of(i);
        }
        for (std::size_t i = 0; i < beats_.size();) {
            i = cut_.fates[i] == BeatFate::danced ? add_stretch(i) : i + 1;
        }
        for (std::size_t s = 0; s < cut_.stretches.size(); ++s) {
            for (std::size_t i = cut_.stretches[s].first; i < cut_.stretches[s].last; ++i) {
                add_cell(i, s);
            }
        }
        set_landings();
        return std::move(cut_);
    }

 private:
    [[nodiscard]] double length(std::size_t beat) const {
        return frames_[beat + 1] - frames_[beat];
    }
    [[nodiscard]] double last_frame() const {
        return static_cast<double>(take_.clip.poses.size() - 1);
    }
    [[nodiscard]] FrameRange range_of(std::size_t beat) const {
        const auto at = [&](double frame) {
            return std::min(static_cast<std::size_t>(std::lround(frame)),
                            take_.clip.poses.size() - 1);
        };
        return {at(frames_[beat]), std::max(at(frames_[beat]) + 1, at(frames_[beat + 1]))};
    }
    [[nodiscard]] double share(const std::vector<bool>& flags, const FrameRange& range) const {
        const auto begin = flags.begin();
        const auto count = std::count(begin + static_cast<std::ptrdiff_t>(range.first),
                                      begin + static_cast<std::ptrdiff_t>(range.last),
                                      true);
        return static_cast<double>(count) / static_cast<double>(range.last - range.first);
    }

    [[nodiscard]] BeatFate fate_of(std::size_t beat) const {
        if (!beats_[beat].is_used) {
            return BeatFate::unused;
        }
        const double seconds = beats_[beat + 1].time - beats_[beat].time;
        if (seconds < kShortestCell || seconds > kLongestCell || length(beat) < kFewestFrames) {
            return BeatFate::length;
        }
        const FrameRange range = range_of(beat);
        const TakePostures& postures = take_.postures;
        return share(postures.is_leap, range) > 0.0       ? BeatFate::leap
               : share(postures.is_spread, range) > kMost ? BeatFate::spread
               : share(postures.is_idle, range) > kMost   ? BeatFate::idle
               : share(postures.is_home, range) > kMost   ? BeatFate::home
                                                          : BeatFate::danced;
    }

    // The frame at which the motion beside a stretch begins or ends: one beat as long as the one
    // beside it, if the clip has most of it.
    [[nodiscard]] std::optional<double> around(double frame, double way) const {
        const double end = std::clamp(frame + way, 0.0, last_frame());
        const double has = std::abs(end - frame);
        return has >= std::max(kLeastAround * std::abs(way), kFewestFrames) ? std::optional(end)
                                                                            : std::nullopt;
    }

    // Adds the stretch that begins with a beat; returns the beat behind it.
    std::size_t add_stretch(std::size_t first) {
        const auto before = around(frames_[first], -length(first));
        if (!before) {
            cut_.fates[first] = BeatFate::edge;
            return first + 1;
        }
        std::size_t last = first;
        while (cut_.fates[last] == BeatFate::danced && last - first < kLongestStretch) {
            ++last;
        }
        const std::size_t next = last;
        auto behind = around(frames_[last], length(last - 1));
        while (!behind && last > first) {
            cut_.fates[--last] = BeatFate::edge;
            behind = last > first ? around(frames_[last], length(last - 1)) : std::nullopt;
        }
        if (behind) {
            TakeStretch stretch{first, last, {*before}};
            stretch.beat_frames.insert(stretch.beat_frames.end(),
                                       frames_.begin() + static_cast<std::ptrdiff_t>(first),
                                       frames_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
            stretch.beat_frames.push_back(*behind);
            cut_.stretches.push_back(std::move(stretch));
        }
        return next;
    }

    [[nodiscard]] const TakeMoment& moment(double frame) const {
        return take_.moments[std::min(static_cast<std::size_t>(std::lround(frame)),
                                      take_.moments.size() - 1)];
    }

    void add_cell(std::size_t beat, std::size_t stretch) {
        CellSource source;
        Cell& cell = source.cell;
        cell.take = static_cast<std::uint16_t>(stretch);
        cell.beat = static_cast<std::uint16_t>(beat - cut_.stretches[stretch].first + 1);
        cell.is_second_half = beats_[beat].half == 2;
        source.start = moment(frames_[beat]);
        source.end = moment(frames_[beat + 1]);
        for (std::size_t i = 0; i < source.course.size(); ++i) {
            const double part =
                static_cast<double>(i + 1) / static_cast<double>(source.course.size() + 1);
            source.course[i] = moment(frames_[beat] + part * length(beat));
        }
        cell.stands_at_end = source.end.is_planted[0] && source.end.is_planted[1];
        measure_way(range_of(beat), cell);
        cell.speed_at_end = static_cast<float>(speed_about(frames_[beat + 1]));
        cut_.cells.push_back(source);
    }

    // Mean speed of the joints about a frame.
    [[nodiscard]] double speed_about(double frame) const {
        const double half = 0.5 * kEndWindow * rate_;
        const auto first = static_cast<std::size_t>(std::lround(std::max(0.0, frame - half)));
        const auto last =
            static_cast<std::size_t>(std::lround(std::min(last_frame(), frame + half)));
        double sum = 0.0;
        for (std::size_t i = first; i <= last; ++i) {
            sum += take_.moments[i].speed();
        }
        return sum / static_cast<double>(last - first + 1);
    }

    // How the hips go over a cell, in the frame of its start, and how much it moves.
    void measure_way(const FrameRange& range, Cell& cell) const {
        double heading = 0.0;
        double speed = 0.0;
        glm::dvec2 way{};
        for (std::size_t frame = range.first; frame < range.last; ++frame) {
            const TakeMoment& now = take_.moments[frame];
            const double c = std::cos(heading);
            const double s = std::sin(heading);
            way += glm::dvec2(c * now.hips_velocity.x + s * now.hips_velocity.y,
                              -s * now.hips_velocity.x + c * now.hips_velocity.y) /
                   rate_;
            heading += now.turning / rate_;
            speed += now.speed();
        }
        cell.way = glm::vec2(way);
        cell.turn = static_cast<float>(heading);
        cell.energy = static_cast<float>(speed / static_cast<double>(range.last - range.first));
    }

    // When the feet land, against the beats of the table.
    void set_landings() {
        if (cut_.cells.empty()) {
            return;
        }
        const PhaseWarp warp(frames_);
        for (std::size_t side = 0; side < take_.landings.size(); ++side) {
            std::vector<double> landed;
            for (const double frame : take_.landings[side]) {
                landed.push_back(warp.beat_at(frame));
            }
            for (CellSource& source : cut_.cells) {
                const TakeStretch& stretch = cut_.stretches[source.cell.take];
                const auto beat = static_cast<double>(stretch.first + source.cell.beat - 1);
                double nearest = Cell::kNoLanding;
                for (const double each : landed) {
                    const double offset = each - beat;
                    if (offset >= -0.5 && offset < 0.5) {
                        ++cut_.landings;
                        cut_.far_landings += std::abs(offset) > kFarLanding ? 1U : 0U;
                        nearest = std::abs(offset) < std::abs(nearest) ? offset : nearest;
                    }
                }
                source.cell.landings[side] = static_cast<float>(nearest);
            }
        }
    }

    const PreparedTake& take_;
    const std::vector<TakeBeat>& beats_;
    double rate_;
    std::vector<double> frames_;  // of the beats, fractional
    TakeCut cut_;
};

}  // namespace

Expected<TakeCut> cut_take(const PreparedTake& take, const std::vector<TakeBeat>& beats) {
    const std::string& name = take.clip.name;
    if (beats.size() < 2) {
        return fail(
            fmt::format("{}: has one beat in the table's line {}; a cell needs the next one",
                        name,
                        beats.front().line));
    }
    const double end =
        static_cast<double>(take.clip.poses.size() - 1) / take.clip.frames_per_second;
    for (std::size_t i = 0; i < beats.size(); ++i) {
        // A beat that is not used and ends none that is has no effect.
        const bool counts = beats[i].is_used || (i > 0 && beats[i - 1].is_used);
        if (counts && beats[i].time > end) {
            return fail(fmt::format(
                "{}: the beat at {:.3f} s (the table's line {}) lies beyond the end of the clip, "
                "{:.3f} s; take it out or set \"used\" of the beat before to 0",
                name,
                beats[i].time,
                beats[i].line,
                end));
        }
    }
    return TakeCutter(take, beats).cut();
}

std::vector<bool> danced_frames(const PreparedTake& take,
                                const std::vector<TakeBeat>& beats,
                                const TakeCut& cut) {
    std::vector<bool> danced(take.clip.poses.size());
    for (std::size_t i = 0; i + 1 < beats.size(); ++i) {
        if (cut.fates[i] != BeatFate::danced) {
            continue;
        }
        const double rate = take.clip.frames_per_second;
        const auto first = static_cast<std::size_t>(std::lround(beats[i].time * rate));
        const auto last = static_cast<std::size_t>(std::lround(beats[i + 1].time * rate));
        for (std::size_t f = first; f < std::min(last, danced.size()); ++f) {
            danced[f] = true;
        }
    }
    return danced;
}

}  // namespace raks::motion
