// What the dancer's hands do beside the dance: they rest, and take shapes.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.hpp"
#include "motion/dancer_state.hpp"

namespace raks::motion {
namespace {

constexpr std::uint64_t kRestStream = 4;  // streams of random numbers
constexpr std::uint64_t kShapeStream = 8;

constexpr double kLongestStay = 1.1;  // seconds that a hand lies still on the body
constexpr double kOwnShape = 0.25;    // share in which both hands take different shapes

/// How hands are at a place.
struct WayOfRest {
    double both = 0.0;                    ///< share in which both hands go there
    bool lies = false;                    ///< still on the body: not for long
    HandShape shape = HandShape::danced;  ///< danced: as the dance says
};

WayOfRest way_at(HandPlace place) noexcept {
    switch (place) {
        case HandPlace::thigh:
            return {0.6, true};
        case HandPlace::hip:
            return {0.15, true};
        case HandPlace::waist:
        case HandPlace::chest:
            return {0.0, true};
        case HandPlace::wide:
        case HandPlace::high:
            return {0.3};
        case HandPlace::low:
            return {0.6};
        case HandPlace::offered:
            return {0.2};
        case HandPlace::swing:
            return {0.7};
        case HandPlace::snap:
            return {0.4, false, HandShape::snap};
        case HandPlace::clap:
            return {1.0, false, HandShape::clap};
        case HandPlace::skirt:
            return {0.7, false, HandShape::pinch};
        case HandPlace::head:
            return {0.2, false, HandShape::lengthy};
        case HandPlace::frame:
            return {1.0, false, HandShape::lengthy};
    }
    return {};
}

/// Draws a shape by its weights; `at` in [0, 1).
HandShape drawn_shape(const HandShapeWeights& weights, double at) noexcept {
    float sum = 0.0F;
    for (const float weight : weights) {
        sum += weight;
    }
    float left = static_cast<float>(at) * sum;
    std::size_t last = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] <= 0.0F) {
            continue;
        }
        last = i;
        left -= weights[i];
        if (left < 0.0F) {
            break;
        }
    }
    return static_cast<HandShape>(last);
}

}  // namespace

/// The beat by which hands move.
double Dancer::State::hands_beat(StreamTime now, Nanos ahead) const noexcept {
    return is_dancing ? shown_phase(now, ahead).count() : 0.0;
}

/// Lets hands rest for a figure, more often in calm music; where they lie still, only for a moment.
void Dancer::State::rest_hands(const MusicState& music) noexcept {
    if (part.is_in_couple || sequence.is_of_cells()) {
        return;
    }
    if (rest_ends && music.time >= *rest_ends) {
        end_rest(music.time);
    }
    if (figure_rested == sequence.number()) {
        return;
    }
    figure_rested = sequence.number();
    const CounterRandom random(part.ways, kRestStream);
    const std::uint64_t draw = 4 * figure_rested;
    const double calm = 1.5 - static_cast<double>(manner.energy());
    const bool rests = random.uniform(draw) < content().chooser.habits().rests * calm;
    const auto place =
        rests
            ? another_place(content().chooser.habits().rest_at, last_rest, random.uniform(draw + 1))
            : std::nullopt;
    if (!place) {
        end_rest(music.time);
        return;
    }
    const WayOfRest way = way_at(*place);
    // A frame is kept, or left, by both hands.
    const bool both =
        content().form.hold == CoupleHold::closed || random.uniform(draw + 2) < way.both;
    const Side own = random.below(draw + 3, 2) == 0 ? Side::left : Side::right;
    end_rest(music.time);
    for (const Side side : kSides) {
        if (both || side == own) {
            hands.go_to(side, *place, music.time, hands_beat(music.time, Nanos(0)), kHandsToRest);
        }
    }
    last_rest = *place;
    if (way.lies) {
        rest_ends = music.time + nanos_from_seconds(kHandsToRest + kLongestStay);
    }
}

/// All hands go to where the dance keeps them: where its figures have them, or in a frame.
void Dancer::State::end_rest(StreamTime now) noexcept {
    const std::optional<HandPlace> keep = content().chooser.habits().hands.keep;
    if (!keep) {
        release_hands(now, kHandsToRest);
        return;
    }
    rest_ends.reset();
    for (const Side side : kSides) {
        hands.go_to(side, *keep, now, hands_beat(now, Nanos(0)), kHandsToRest);
    }
}

/// All hands go back into the dance.
void Dancer::State::release_hands(StreamTime now, double seconds) noexcept {
    rest_ends.reset();
    for (const Side side : kSides) {
        hands.let_go(side, now, seconds);
    }
}

/// Gives the hands the shapes of the dance, or of the place at which they rest: a change begins so
/// that it is over on a count.
void Dancer::State::shape_hands(const MusicState& music) noexcept {
    const HandHabits& habits = content().chooser.habits().hands;
    const HandShapeWeights& shapes =
        sequence.figure().hands ? *sequence.figure().hands : habits.shapes;
    const double beat = std::max(0.0, shown_phase(music.time, HandShapes::kEase).count());
    const auto span = static_cast<std::uint64_t>(beat / habits.every);
    const CounterRandom random(part.ways, kShapeStream);
    const HandShape common = drawn_shape(shapes, random.uniform(4 * span));
    const bool is_own = random.uniform(4 * span + 1) < kOwnShape;
    for (const Side side : kSides) {
        HandShape shape = common;
        if (is_own && side == Side::right) {
            shape = drawn_shape(shapes, random.uniform(4 * span + 2));
        }
        if (hands.rests(side)) {
            const HandShape at_rest = way_at(hands.place(side)).shape;
            shape = at_rest != HandShape::danced ? at_rest : shape;
        }
        fingers.take(side, shape, music.time, shown);
    }
}

}  // namespace raks::motion
