#include "render/scene/director.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "render/scene/shot_rules.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::WorldPose;
using EventKind = MusicEvent::Kind;

// Seconds of a shot before another may follow on the next bar line: shortest and longest, by Pace.
constexpr std::array<glm::vec2, 3> kLengths = {{{10.0F, 15.0F}, {5.0F, 8.0F}, {3.0F, 5.0F}}};
constexpr double kLongerWhenCalm = 2.0;  // times as long with Liveliness::calm
// Seconds that a moving shot takes for its way: slow enough to be seen as still music moves.
constexpr double kPushSeconds = 10.0;
constexpr double kOrbitSeconds = 11.0;
constexpr double kGlideSeconds = 2.2;  // at least
// A shot that was on so lately is not chosen again.
constexpr double kShotRest = 12.0;
constexpr double kRestOfFeet = 40.0;
constexpr double kRestOfFace = 20.0;
// After so long without a face the next shot is one, and shots before it are cut short.
constexpr double kFaceWanted = 34.0;
constexpr double kFaceNeeded = 50.0;
// A drop cuts to what shows less than this share of the height that was seen.
constexpr float kNearer = 0.8F;
// From this share of their ways on that lead to or from the audience, dancers are seen from three
// quarters: from this many degrees on.
constexpr float kForeAndAft = 0.5F;
constexpr float kThreeQuartersLow = 30.0F;
constexpr float kThreeQuartersHigh = 48.0F;
constexpr double kLeastBeforeDrop = 3.0;  // seconds
constexpr float kWaysSeconds = 8.0F;      // over which ways are watched
// A picture that is so much too narrow for a shot does not get it.
constexpr float kMostDemand = 1.2F;
// Energy below which music is calm, and above which it is full.
constexpr float kCalmBelow = 0.35F;
constexpr float kFullAbove = 0.65F;
// A glide turns no further than this, so that it looks like a person's walk.
constexpr float kWidestGlide = glm::radians(35.0F);
constexpr float kWidestChange = 1.8F;  // of what is seen from the upper to the lower edge
// A cut changes the direction or the size by at least this much.
constexpr float kLeastTurn = glm::radians(22.0F);
constexpr float kLeastChange = 1.3F;
// Two dancers seen along their line hide each other.
constexpr float kNearLine = 0.26F;  // sine of 15 degrees
// In pictures narrower than this, turned by so much further, the two are seen at this sine.
constexpr float kTallBelow = 0.8F;
constexpr float kTallTurn = glm::radians(34.0F);
constexpr float kFurthestTurn = glm::radians(76.0F);
constexpr float kTallAcross = 0.45F;
constexpr float kNoLine = 0.15F;  // metres between two who have none

constexpr std::uint64_t kShotStream = 0x5107;
constexpr double kLongAgo = -1e9;

glm::vec2 floor_place(const WorldPose& dancer) noexcept {
    const glm::vec3& hips = dancer.position(Bone::hips);
    return {hips.x, hips.z};
}

// Sine of the angle from the line of action to the direction of a camera; 0: on it.
float across_line(float yaw, std::span<const WorldPose> dancers) noexcept {
    const glm::vec2 toward(std::sin(yaw), std::cos(yaw));
    glm::vec2 line(0.0F, 1.0F);
    if (dancers.size() == 2) {
        const glm::vec2 apart = floor_place(dancers[1]) - floor_place(dancers[0]);
        const float length = glm::length(apart);
        if (length < kNoLine) {
            return 0.0F;
        }
        line = apart / length;
    }
    return line.y * toward.x - line.x * toward.y;
}

// Metres from the picture's lower to its upper edge, where the target is.
float seen_height(const Camera& camera) noexcept {
    return 2.0F * camera.distance * std::tan(0.5F * camera.vertical_fov);
}

bool is_sounding(const MusicState& music) noexcept { return music.part != MusicPart::stopped; }

double bar_seconds(const MusicState& music) noexcept {
    return music.grid.beats_per_bar * music.grid.tempo.seconds_per_beat();
}

}  // namespace

std::string_view name_of(Shot shot) noexcept { return rule_of(shot).name; }

Director::Director(std::uint64_t seed, Liveliness liveliness) noexcept
    : dice_(seed, kShotStream), liveliness_(liveliness) {
    side_ = dice_.chance(0.5) ? 1.0F : -1.0F;
    seen_.fill(kLongAgo);
}

void Director::set_picture(float aspect, float size) noexcept {
    aspect_ = aspect;
    size_ = size;
}

std::optional<bool> Director::side_of_line(float yaw, std::span<const WorldPose> dancers) noexcept {
    const float across = across_line(yaw, dancers);
    return std::abs(across) < 1e-3F ? std::nullopt : std::optional(across > 0.0F);
}

const DirectedView& Director::advance(const MusicState& music,
                                      std::span<const WorldPose> dancers) noexcept {
    if (dancers.empty()) {
        return shown_;
    }
    now_ = to_seconds(music.time);
    const bool is_first = !last_hop_ || music.hop != *last_hop_ + 1;
    const std::uint32_t cuts = shown_.cuts;
    if (is_first) {
        begin();
    }
    last_hop_ = music.hop;
    room_.advance(dancers);
    watch_ways(dancers);
    notice(music);
    if (wants_change(music, is_on_bar_line(music))) {
        change(music, dancers);
    }
    seen_[static_cast<std::size_t>(shown_.shot)] = now_;
    if (shown_.shot == Shot::face || !is_sounding(music)) {
        face_seen_ = now_;
    }
    shown_.is_gliding = now_ < last_change_ + glide_seconds_;
    shown_.camera = smoothed(camera_of(view(), aspect_), is_first || shown_.cuts != cuts);
    shown_.camera.target *= size_;
    shown_.camera.zoom(size_);
    return shown_;
}

// A wide shot opens.
void Director::begin() noexcept {
    room_.reset();
    shown_.shot = Shot::wide;
    from_ = to_ = {ShotSize::wide, side_ * glm::radians(8.0F)};
    move_seconds_ = 0.0;
    glide_seconds_ = 0.0;
    begins_ = last_change_ = now_;
    length_ = static_cast<double>(kLengths[static_cast<std::size_t>(Pace::usual)].x);
    bar_position_.reset();
    drop_at_.reset();
    next_.reset();
    face_seen_ = now_;
    has_places_ = false;
    sideways_ = fore_and_aft_ = 0.0F;
}

void Director::watch_ways(std::span<const WorldPose> dancers) noexcept {
    constexpr std::array<Bone, 5> kWatched = {
        Bone::hips, Bone::left_hand, Bone::right_hand, Bone::left_foot, Bone::right_foot};
    constexpr auto kSeconds = static_cast<float>(to_seconds(kHop));
    const float share = 1.0F - std::exp(-kSeconds / kWaysSeconds);
    float aside = 0.0F;
    float along = 0.0F;
    for (std::size_t i = 0; i < kWatched.size(); ++i) {
        const glm::vec3 place = dancers.front().position(kWatched[i]);
        const glm::vec3 speed = has_places_ ? (place - places_[i]) / kSeconds : glm::vec3(0.0F);
        places_[i] = place;
        aside += speed.x * speed.x;
        along += speed.z * speed.z;
    }
    has_places_ = true;
    sideways_ += share * (aside - sideways_);
    fore_and_aft_ += share * (along - fore_and_aft_);
}

// What an event asks for.
void Director::notice(const MusicState& music) noexcept {
    const MusicEvent& coming = music.ahead.events.front();
    until_drop_ = music.ahead.is_known && coming.kind == EventKind::drop
                      ? to_seconds(coming.time - music.time)
                      : -kLongAgo;
    switch (music.event.kind) {
        case EventKind::drop: {
            const double at = to_seconds(music.event.time);
            // One that is known too late is answered on the next beat.
            constexpr double kInTime = 0.12;
            const Beats beat(std::ceil(music.grid.beats_at(music.time).count()));
            drop_at_ = now_ - at <= kInTime ? at : to_seconds(music.grid.time_of(beat));
            break;
        }
        case EventKind::breakdown:
            next_ = Shot::upper_body;
            length_ = 0.0;
            break;
        case EventKind::build_up:
            next_ = Shot::push;
            length_ = 0.0;
            break;
        case EventKind::entry:
            next_ = Shot::full;
            break;
        case EventKind::end:
            next_ = Shot::wide;
            length_ = 0.0;
            break;
        case EventKind::none:
        case EventKind::stop:
            break;
    }
}

// Positions and not numbers of bars: where those are counted from may change with every bar.
bool Director::is_on_bar_line(const MusicState& music) noexcept {
    if (music.grid.confidence < BeatGrid::kDanceable) {
        bar_position_.reset();
        return false;
    }
    const double position = music.grid.bar_position(music.grid.beats_at(music.time));
    const bool is_new = bar_position_ && position < *bar_position_ - 0.5;
    bar_position_ = position;
    return is_new;
}

bool Director::wants_change(const MusicState& music, bool is_bar_line) const noexcept {
    const double elapsed = now_ - last_change_;
    const double bar = bar_seconds(music);
    // The grid may have moved a little since: nearly a bar is one.
    const bool is_a_bar_past = elapsed >= 0.98 * bar;
    const auto longest = static_cast<double>(rule_of(shown_.shot).longest);
    if (!is_a_bar_past) {
        return elapsed >= longest;
    }
    if (drop_at_ && now_ >= *drop_at_) {
        return true;
    }
    if (!is_bar_line || !is_sounding(music) || drop_at_) {
        return elapsed >= longest;
    }
    // It would be on for longer than it may if it stayed to the next bar line.
    constexpr double kTolerance = 0.05;
    if (elapsed + bar > longest + kTolerance) {
        return true;
    }
    // Before a drop that is known there is no cut, so that the drop can have one.
    const bool is_drop_near = until_drop_ < 1.2 * bar;
    // A camera that still moves would stop short.
    const bool is_moving = now_ < begins_ + move_seconds_ || now_ < last_change_ + glide_seconds_;
    return !is_drop_near && !is_moving && elapsed >= length_;
}

void Director::change(const MusicState& music, std::span<const WorldPose> dancers) noexcept {
    const bool is_drop = drop_at_ && now_ >= *drop_at_;
    const Pace pace = music.part == MusicPart::breakdown || music.energy.lately < kCalmBelow
                          ? Pace::calm
                      : is_drop || music.energy.lately > kFullAbove ? Pace::full
                                                                    : Pace::usual;
    const Shot drawn = next_shot(pace, dancers.size());
    const Shot shot = is_drop ? shot_of_drop(dancers.size()) : drawn;
    next_.reset();
    drop_at_.reset();

    glide_from_ = view();
    set_up(shot, bar_seconds(music), dancers);
    const bool is_part = shot == Shot::feet || shot == Shot::face || shown_.shot == Shot::feet ||
                         shown_.shot == Shot::face;
    // Two who turn fill a tall picture: a camera that turns, too, would lose one.
    const bool is_full = dancers.size() > 1 && aspect_ < kTallBelow;
    const bool glides = glides_to(view_of_stand(from_)) && !is_drop && !is_part && !is_full;
    glide_seconds_ = glides ? std::max(bar_seconds(music), kGlideSeconds) : 0.0;
    shown_.cuts += glides ? 0 : 1;
    shown_.shot = shot;
    last_change_ = now_;
    draw_length(pace);
}

// A face that has not been seen for long, what an event asks for, or one that is drawn.
Shot Director::next_shot(Pace pace, std::size_t dancers) noexcept {
    const Shot drawn = choose(pace, dancers);
    if (now_ - face_seen_ > kFaceWanted && shown_.shot != Shot::face) {
        return Shot::face;
    }
    return next_ && *next_ != shown_.shot && suits(*next_, dancers) ? *next_ : drawn;
}

// Nearer than what is on, or else lower.
Shot Director::shot_of_drop(std::size_t dancers) const noexcept {
    const auto height_of = [this](const ShotView& of) {
        return seen_height(camera_of(of, aspect_));
    };
    const float nearer = height_of(view_of(ShotSize::knees_up, room_.room(), to_.yaw));
    return suits(Shot::knees_up, dancers) && nearer < kNearer * height_of(view()) ? Shot::knees_up
                                                                                  : Shot::low;
}

// One of those that suit, by their weights; the one that is on does not follow itself.
Shot Director::choose(Pace pace, std::size_t dancers) noexcept {
    std::array<float, kShots> weights{};
    float sum = 0.0F;
    for (std::size_t i = 0; i < kShots; ++i) {
        const auto shot = static_cast<Shot>(i);
        const bool is_part = shot == Shot::feet || shot == Shot::face;
        const double rest = shot == Shot::feet   ? kRestOfFeet
                            : shot == Shot::face ? kRestOfFace
                                                 : kShotRest;
        if (shot != shown_.shot && suits(shot, dancers)) {
            const bool is_rested = now_ - seen_[i] >= rest;
            const float weight = kShotRules[i].weights[static_cast<std::size_t>(pace)];
            weights[i] = is_rested ? weight : is_part ? 0.0F : 0.15F * weight;
        }
        sum += weights[i];
    }
    float draw = static_cast<float>(dice_.uniform(0.0, static_cast<double>(sum)));
    for (std::size_t i = 0; i < kShots; ++i) {
        draw -= weights[i];
        if (draw < 0.0F && weights[i] > 0.0F) {
            return static_cast<Shot>(i);
        }
    }
    return shown_.shot == Shot::full ? Shot::wide : Shot::full;
}

bool Director::suits(Shot shot, std::size_t dancers) const noexcept {
    const ShotRule& rule = rule_of(shot);
    if (rule.is_of_one && dancers > 2) {
        return false;
    }
    // One that must end just before a drop would take the drop's cut away.
    const auto longest = static_cast<double>(rule.longest);
    if (until_drop_ > longest && until_drop_ < longest + kLeastBeforeDrop) {
        return false;
    }
    if (shot == Shot::face) {
        return true;  // of one face, if no more
    }
    // Shots of the whole body are good at any distance; another one must not become such a shot.
    const float yaw = side_ * glm::radians(0.5F * (rule.yaw_low + rule.yaw_high));
    return rule.to <= ShotSize::full ||
           width_demand(view_of(rule.to, room_.room(), yaw), aspect_) <= kMostDemand;
}

// Where the camera of a shot stands, and where it goes.
void Director::set_up(Shot shot, double bar, std::span<const WorldPose> dancers) noexcept {
    const ShotRule& rule = rule_of(shot);
    begins_ = now_;
    move_seconds_ = 0.0;
    from_ = to_ = {rule.from, yaw_for(rule.yaw_low, rule.yaw_high, dancers)};
    if (shot == Shot::face) {
        from_.whose = to_.whose = choose_face(dancers.size(), from_.yaw);
    }
    if (shot == Shot::push) {
        to_.size = rule.to;
        move_seconds_ = std::max(kPushSeconds, 4.0 * bar);
    } else if (shot == Shot::orbit) {
        // From wherever it is to the other end of the range, on the same side.
        const float low = glm::radians(rule.yaw_low);
        const float high = glm::radians(rule.yaw_high);
        const float side = from_.yaw < 0.0F ? -1.0F : 1.0F;
        const float end = std::abs(from_.yaw) > 0.5F * (low + high) ? low : high;
        to_.yaw = side * end;
        const bool crosses = across_line(to_.yaw, dancers) * across_line(from_.yaw, dancers) < 0.0F;
        if (crosses) {
            to_.yaw = from_.yaw;
        }
        move_seconds_ = kOrbitSeconds;
    }
}

// Both where they are so close that the picture holds them; else one and the other in turn.
FaceOf Director::choose_face(std::size_t dancers, float yaw) noexcept {
    if (dancers != 2) {
        return FaceOf::first;
    }
    const ShotView both = view_of(ShotSize::face, room_.room(), yaw, FaceOf::both);
    const ShotView one = view_of(ShotSize::face, room_.room(), yaw, FaceOf::first);
    constexpr float kMostForTwo = 2.0F;  // times as much as is seen of one
    if (seen_height(camera_of(both, aspect_)) <
        kMostForTwo * seen_height(camera_of(one, aspect_))) {
        return FaceOf::both;
    }
    shows_second_face_ = !shows_second_face_;
    return shows_second_face_ ? FaceOf::second : FaceOf::first;
}

ShotView Director::view_of_stand(const Stand& stand) const noexcept {
    return view_of(stand.size, room_.room(), stand.yaw, stand.whose);
}

// A direction in this range of degrees, on the side of the line of action where the camera is.
float Director::yaw_for(float low, float high, std::span<const WorldPose> dancers) noexcept {
    const bool is_fore_and_aft =
        dancers.size() != 2 && fore_and_aft_ > kForeAndAft * (fore_and_aft_ + sideways_);
    if (is_fore_and_aft) {
        low = std::max(low, kThreeQuartersLow);
        high = std::max(high, kThreeQuartersHigh);
    }
    const auto degrees =
        static_cast<float>(dice_.uniform(static_cast<double>(low), static_cast<double>(high)));
    const float drawn = glm::radians(degrees);
    if (dancers.size() != 2) {
        return side_ * drawn;
    }
    // Of these directions that which shows the two beside each other rather than in a row; in a
    // tall picture, where they would be small then, half before each other.
    const float current = glide_from_.yaw;
    const float here = across_line(current, dancers);
    const bool is_tall = aspect_ < kTallBelow;
    const float further = is_tall ? kTallTurn : 0.0F;
    float best = current;
    float least = is_tall ? 1.0F : 1.0F - kNearLine;
    for (const float yaw : {side_ * drawn,
                            -side_ * drawn,
                            side_ * std::min(drawn + further, kFurthestTurn),
                            -side_ * std::min(drawn + further, kFurthestTurn)}) {
        const float across = across_line(yaw, dancers);
        const float from_best = std::abs(std::abs(across) - (is_tall ? kTallAcross : 1.0F));
        if (across * here >= 0.0F && std::abs(across) > kNearLine && from_best < least) {
            best = yaw;
            least = from_best;
        }
    }
    return best;
}

// Neighbouring views now and then; those that hardly differ always, as a cut between them would
// look like a mistake.
bool Director::glides_to(const ShotView& to) noexcept {
    const double chance = liveliness_ == Liveliness::calm ? 0.7 : 0.3;
    const bool is_wished = dice_.chance(chance);
    const float turn = std::abs(to.yaw - glide_from_.yaw);
    const float before = seen_height(camera_of(glide_from_, aspect_));
    const float after = seen_height(camera_of(to, aspect_));
    const float change = std::max(before, after) / std::min(before, after);
    return (turn < kLeastTurn && change < kLeastChange) ||
           (is_wished && turn < kWidestGlide && change < kWidestChange);
}

ShotView Director::view() const noexcept {
    const ShotView shot =
        between(view_of_stand(from_), view_of_stand(to_), progress(begins_, move_seconds_));
    return glide_seconds_ > 0.0 ? between(glide_from_, shot, progress(last_change_, glide_seconds_))
                                : shot;
}

Camera Director::smoothed(Camera camera, bool is_cut) noexcept {
    const auto follow = [is_cut](FollowSpring& spring, float aim) {
        constexpr float kCameraSeconds = 0.16F;
        if (is_cut) {
            spring.begin(aim);
        }
        return spring.follow(aim, static_cast<float>(to_seconds(kHop)), kCameraSeconds);
    };
    camera.distance = follow(distance_, camera.distance);
    for (int axis = 0; axis < 3; ++axis) {
        camera.target[axis] = follow(target_[static_cast<std::size_t>(axis)], camera.target[axis]);
    }
    return camera;
}

// Of a way that begins then and takes so long: [0, 1], without a jerk at its ends.
float Director::progress(double begins, double seconds) const noexcept {
    return seconds > 0.0 ? smoothstep(0.0F, 1.0F, static_cast<float>((now_ - begins) / seconds))
                         : 0.0F;
}

void Director::draw_length(Pace pace) noexcept {
    const glm::vec2 range = kLengths[static_cast<std::size_t>(pace)];
    const double longest = static_cast<double>(rule_of(shown_.shot).longest);
    length_ = std::min(dice_.uniform(static_cast<double>(range.x), static_cast<double>(range.y)),
                       longest);
    if (liveliness_ == Liveliness::calm) {
        length_ = std::min(kLongerWhenCalm * length_, longest);
    }
    // A face is needed by then; in two bars or so it may follow.
    length_ = std::min(length_, std::max(face_seen_ + kFaceNeeded - now_, 0.0));
}

}  // namespace raks::render
