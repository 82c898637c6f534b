#include "motion/dance/dynamics/waiting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr Nanos kFirstMoveAfter = std::chrono::milliseconds(700);  // until the first movement
constexpr double kFirstMoveSpread = 0.7;  // seconds later at most, by the seed
constexpr float kFeltNod = 0.13F;         // radians of neck and head, to a beat
constexpr float kFeltGive = 0.014F;       // metres that the knees give
constexpr double kMoveHandsGo = 1.1;      // seconds to a place of a movement
constexpr double kMoveHandsBack = 1.1;    // and back

constexpr std::uint64_t kIdleOrderStream = 21;  // streams of random numbers
constexpr std::uint64_t kIdleSideStream = 22;

Side other_than(Side side) noexcept { return side == Side::left ? Side::right : Side::left; }

/// Adds a movement that is not there yet.
template <std::size_t kSize>
void add_move(IdleMove move, std::array<IdleMove, kSize>& moves, std::size_t& count) noexcept {
    const auto end = moves.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(moves.begin(), end, move) == end) {
        moves[count++] = move;
    }
}

}  // namespace

// The first movements of the list are everyone's.
void Waiting::begin(StreamTime now,
                    const DanceHabits& habits,
                    std::uint64_t seed) noexcept RAKS_NONBLOCKING {
    count_ = 0;
    for (const IdleMove own : habits.idle) {
        add_move(own, order_, count_);
    }
    for (std::size_t i = 0; i < kMostMoves && count_ < kLeastMoves; ++i) {
        add_move(static_cast<IdleMove>(i), order_, count_);
    }
    const CounterRandom random(seed, kIdleOrderStream);
    for (std::size_t i = count_; i > 1; --i) {
        std::swap(order_[i - 1], order_[static_cast<std::size_t>(random.below(i, i))]);
    }
    seed_ = seed;
    since_ = now + kFirstMoveAfter + nanos_from_seconds(kFirstMoveSpread * random.uniform(0));
    ends_at_.reset();
}

void Waiting::end_song(Ending ending, StreamTime at) noexcept RAKS_NONBLOCKING {
    ending_ = ending;
    ends_at_ = at;
    since_ = at + nanos_from_seconds(gesture_of(ending).seconds());
}

IdleMove Waiting::nth(std::uint64_t number) const noexcept {
    return order_[static_cast<std::size_t>(number % count_)];
}

bool Waiting::is_nth_mirrored(std::uint64_t number) const noexcept {
    return CounterRandom(seed_, kIdleSideStream).below(number, 2) == 1;
}

Waiting::Moment Waiting::moment_at(StreamTime time) const noexcept {
    Moment moment;
    if (count_ == 0 || time < since_) {
        if (ends_at_ && time >= *ends_at_) {
            moment.gesture = &gesture_of(ending_);
            moment.seconds = to_seconds(time - *ends_at_);
        }
        return moment;
    }
    const double seconds = to_seconds(time - since_);
    const auto number = static_cast<std::uint64_t>(seconds / kMoveSeconds);
    moment.gesture = &gesture_of(nth(number));
    moment.seconds = seconds - kMoveSeconds * static_cast<double>(number);
    moment.is_mirrored = is_nth_mirrored(number);
    if (number > 0) {
        const BodyShape& last = gesture_of(nth(number - 1)).keys.back().shape;
        // Seen from the side to which this movement is made.
        moment.from = is_nth_mirrored(number - 1) != moment.is_mirrored ? mirrored(last) : last;
    }
    return moment;
}

BodyShape Waiting::shape_at_moment(const Moment& moment) const noexcept {
    if (moment.gesture == nullptr) {
        return {};
    }
    const BodyShape shape = shape_at(*moment.gesture, moment.from, moment.seconds);
    return moment.is_mirrored ? mirrored(shape) : shape;
}

std::optional<IdleMove> Waiting::move_at(StreamTime time) const noexcept RAKS_NONBLOCKING {
    if (count_ == 0 || time < since_) {
        return std::nullopt;
    }
    return nth(static_cast<std::uint64_t>(to_seconds(time - since_) / kMoveSeconds));
}

void Waiting::lead_hands(StreamTime now, HandRests& hands) const noexcept RAKS_NONBLOCKING {
    const Moment moment = moment_at(now);
    std::array<const GestureHand*, 2> led{};
    if (moment.gesture != nullptr) {
        for (const GestureHand& hand : moment.gesture->hands) {
            if (moment.seconds >= hand.from && moment.seconds < hand.to) {
                const Side side = moment.is_mirrored ? other_than(hand.side) : hand.side;
                led[static_cast<std::size_t>(side)] = &hand;
            }
        }
    }
    for (const Side side : kSides) {
        if (const GestureHand* const hand = led[static_cast<std::size_t>(side)]) {
            hands.go_to(side, hand->place, now, 0.0, kMoveHandsGo);
        } else {
            hands.let_go(side, now, kMoveHandsBack);
        }
    }
}

void Waiting::move(const Skeleton& skeleton,
                   StreamTime time,
                   const FeltBeat& beat,
                   Pose& pose) const noexcept RAKS_NONBLOCKING {
    BodyShape shape = shape_at_moment(moment_at(time));
    // Down on the beat, up between two.
    const auto down = static_cast<float>(0.5 + 0.5 * std::cos(2.0 * M_PI * beat.beat));
    shape.drop += kFeltGive * beat.felt * down;
    shape.head_nod += kFeltNod * beat.felt * down;
    apply_shape(skeleton, shape, pose);
}

void Waiting::shake(StreamTime time, Pose& pose) const noexcept RAKS_NONBLOCKING {
    const Moment moment = moment_at(time);
    if (moment.gesture != nullptr) {
        shake_hands(shape_at_moment(moment),
                    moment.seconds * static_cast<double>(moment.gesture->rate),
                    pose);
    }
}

}  // namespace raks::motion
