#include "motion/dance/baking/figure_passage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.hpp"
#include "motion/dance/baking/contact_windows.hpp"
#include "motion/figures/foot_events.hpp"

namespace raks::motion {
namespace {

// Peak speeds of a mean step, m/s. Landing detection (0.6 m/s at any pace) hardly finds one below
// the first, so that it is danced as one reach; one above the second keeps its own speed profile;
// between them both are blended.
constexpr double kSlowStep = 0.9;
constexpr double kBriskStep = 1.3;
// Duration of that reach at the learnt tempo; the foot waits before it. Small steps of people are
// no slower than others (their peak is 1.1 to 1.5 m/s).
constexpr double kQuickReach = 0.15;  // seconds
constexpr float kAside = 0.035F;      // metres; deviation of a contact's place between repeats

/// Index of the contact that shares most samples with the margin around the figure's start;
/// windows.size(): none does.
std::size_t contact_at_start(const std::vector<ContactWindow>& windows,
                             double samples_per_beat,
                             std::size_t samples) {
    std::size_t best = windows.size();
    double most = 0.0;
    for (std::size_t w = 0; w < windows.size(); ++w) {
        double shared = 0.0;  // samples of it within the margin around the start
        for (std::size_t k = 0; k < windows[w].length; ++k) {
            const double at = static_cast<double>((windows[w].first + k) % samples);
            const double away = std::min(at, static_cast<double>(samples) - at);
            shared += away < FigurePassage::kMargin * samples_per_beat ? 1.0 : 0.0;
        }
        if (shared > most) {
            most = shared;
            best = w;
        }
    }
    return best;
}

/// One foot's contacts over the figure and kBeatsAround beats on either side, in samples of
/// `poses`.
std::vector<PlannedContact> contacts_of(const FigureModel& model,
                                        Side side,
                                        const FigurePath& way,
                                        const Footing& footing,
                                        int samples_per_beat) {
    const auto s = static_cast<std::size_t>(side);
    const std::optional<glm::vec2>& start_place = footing.places[s];
    const auto samples =
        static_cast<std::size_t>(model.beats) * static_cast<std::size_t>(samples_per_beat);
    std::vector<ContactWindow> windows =
        start_at_landings(contact_windows(model.contact[s], model.beats, samples),
                          footing.landings[s],
                          footing.reach,
                          samples_per_beat,
                          samples);
    if (!footing.is_mean) {
        windows =
            with_passing_steps(std::move(windows), footing.landings[s], samples_per_beat, samples);
    }
    const std::size_t at_start = contact_at_start(windows, samples_per_beat, samples);
    const auto whole = static_cast<std::ptrdiff_t>(samples);
    const auto around = static_cast<std::ptrdiff_t>(kBeatsAround) * samples_per_beat;
    std::vector<PlannedContact> planned;
    // A foot that never leaves the floor has one contact over all beats.
    if (!windows.empty() && windows.front().length == samples) {
        PlannedContact& contact = planned.emplace_back();
        contact.window = {0, samples + 2 * static_cast<std::size_t>(around)};
        contact.place = start_place;
        return planned;
    }
    // The closed figure is repeated as often as the beats around it may need.
    for (int turn = -2; turn <= 1; ++turn) {
        for (std::size_t w = 0; w < windows.size(); ++w) {
            const auto first = static_cast<std::ptrdiff_t>(windows[w].first) + turn * whole;
            const std::ptrdiff_t end = first + static_cast<std::ptrdiff_t>(windows[w].length);
            const std::ptrdiff_t from = std::max(first, -around);
            const std::ptrdiff_t to = std::min(end, whole + around);
            // The ends of the passage cut some contacts. What is left of one is dropped where it is
            // shorter than a quarter of a beat, in which no foot can be planted.
            if (to - from < std::min<std::ptrdiff_t>(end - first, samples_per_beat / 4)) {
                continue;
            }
            PlannedContact contact;
            contact.window = {static_cast<std::size_t>(from + around),
                              static_cast<std::size_t>(to - from),
                              windows[w].is_step,
                              windows[w].is_passing};
            const std::ptrdiff_t centre = (first + end) / 2;
            // All figures begin with this foot at the same place, and end with it there, moved
            // along the way of the figure.
            if (w == at_start && start_place) {
                if (std::abs(centre) < whole / 2) {
                    contact.place = *start_place;
                } else if (std::abs(centre - whole) < whole / 2) {
                    contact.place = glm::vec2(way.move(glm::dvec2(*start_place)));
                }
            }
            planned.push_back(contact);
        }
    }
    std::sort(planned.begin(), planned.end(), [](const auto& a, const auto& b) {
        return a.window.first < b.window.first;
    });
    return planned;
}

/// Sets how each step that is a mean comes to its contact, at the learnt tempo: its weight of the
/// reach profile (1 below kSlowStep, 0 above kBriskStep); how long the foot waits before that
/// reach; and the sample at which the free foot comes to rest by itself by FootRules (none if it
/// never does). `speed`: of the free foot by sample, m/s.
void find_steps(const std::vector<double>& speed,
                double samples_per_second,
                std::vector<PlannedContact>& contacts) {
    const FootRules rules;
    const double quick = kQuickReach * samples_per_second;
    for (std::size_t c = 1; c < contacts.size(); ++c) {
        contacts[c].is_mean = true;
        const ContactWindow& window = contacts[c].window;
        ContactWindow& before = contacts[c - 1].window;
        const std::size_t left = before.first + before.length - 1;
        const std::size_t middle = window.first + window.length / 2;
        if (left >= window.first || middle >= speed.size()) {
            continue;
        }
        const auto begin = speed.begin();
        // Peak between leaving the last contact and the start of this one.
        const auto fastest = std::max_element(begin + static_cast<std::ptrdiff_t>(left),
                                              begin + static_cast<std::ptrdiff_t>(window.first));
        contacts[c].reach =
            std::clamp((kBriskStep - *fastest) / (kBriskStep - kSlowStep), 0.0, 1.0);
        // The contact before is prolonged, so that what is left of the flight lasts kQuickReach.
        if (window.is_step) {
            const double spare = std::max(0.0, static_cast<double>(window.first - left) - quick);
            before.length += static_cast<std::size_t>(contacts[c].reach * spare);
        }
        const auto end = begin + static_cast<std::ptrdiff_t>(middle);
        const auto slow =
            std::find_if(fastest, end, [&](double v) { return v < rules.landing_speed; });
        if (*fastest > rules.step_speed && slow != end) {
            contacts[c].arrival = static_cast<double>(slow - begin);
        }
    }
}

/// The contacts of both feet, by Side.
std::array<std::vector<PlannedContact>, 2> contacts_of(const FigureModel& model,
                                                       const FreeFigure& steps,
                                                       const FigurePath& way,
                                                       const Footing& footing) {
    std::array<std::vector<PlannedContact>, 2> contacts;
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        contacts[s] = contacts_of(model, side, way, footing, steps.samples_per_beat);
        if (footing.is_mean) {
            find_steps(steps.foot_speeds[s],
                       steps.samples_per_beat * model.learnt_tempo.beats_per_second(),
                       contacts[s]);
        }
    }
    return contacts;
}

/// Shifts contacts without a common place by a draw each: steps of one repeat do not fall exactly
/// where those of the last did.
void step_aside(const CounterRandom& random, Side side, std::vector<PlannedContact>& contacts) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        if (!contacts[c].place) {
            const std::uint64_t draw = 4 * c + 2 * static_cast<std::uint64_t>(side);
            contacts[c].aside = {kAside * static_cast<float>(random.normal(draw)),
                                 kAside * static_cast<float>(random.normal(draw + 1))};
        }
    }
}

}  // namespace

StartPlaces learnt_places(const FigureModel& model,
                          const FigureTracks& tracks,
                          const FigurePath& way,
                          const Skeleton& skeleton) {
    const FreeFigure figure = free_figure(model, tracks, way, skeleton);
    const auto contacts = contacts_of(model, figure, way, {{}, model.landings});
    StartPlaces places;
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const auto start = static_cast<std::ptrdiff_t>(kBeatsAround) * figure.samples_per_beat;
        const auto margin =
            static_cast<std::ptrdiff_t>(FigurePassage::kMargin * figure.samples_per_beat);
        glm::vec2 sum{};
        float count = 0.0F;
        for (const PlannedContact& contact : contacts[s]) {
            if (contact.window.is_passing) {
                continue;
            }
            for (std::size_t k = 0; k < contact.window.length; ++k) {
                const auto i = static_cast<std::ptrdiff_t>(contact.window.first + k);
                if (std::abs(i - start) > margin) {
                    continue;
                }
                const WorldPose world =
                    world_body(skeleton, figure.poses[static_cast<std::size_t>(i)]);
                const Bone foot = on_side(Bone::left_foot, side);
                const glm::vec3 ball =
                    world.position(foot) + pivot_from_ankle(skeleton, side, world.rotation(foot));
                sum += glm::vec2(ball.x, ball.z);
                count += 1.0F;
            }
        }
        if (count > 0.0F) {
            places[s] = sum / count;
        }
    }
    return places;
}

FigurePassage::FigurePassage(const FigureModel& model,
                             const FreeFigure& steps,
                             std::vector<Pose> body,
                             const FigurePath& way,
                             const Footing& footing,
                             const CounterRandom* random,
                             const Skeleton& skeleton) {
    auto contacts = contacts_of(model, steps, way, footing);
    for (const Side side : kSides) {
        if (random != nullptr) {
            step_aside(*random, side, contacts[static_cast<std::size_t>(side)]);
        }
    }
    lock_feet(skeleton, contacts, steps.samples_per_beat, steps.feet, body);
    keep(body, steps.samples_per_beat);
}

FigurePassage::FigurePassage(const FreeFigure& figure) {
    keep(figure.poses, figure.samples_per_beat);
}

void FigurePassage::keep(const std::vector<Pose>& poses, int samples_per_beat) {
    samples_per_beat_ = samples_per_beat;
    const auto skipped = static_cast<std::size_t>((kBeatsAround - kMargin) * samples_per_beat);
    std::vector<Sample> samples;
    for (std::size_t i = skipped; i < poses.size() - skipped + 1; ++i) {
        const Pose& pose = poses[i];
        Sample sample;
        for (std::size_t bone = 0; bone < kBones.size(); ++bone) {
            const glm::quat& rotation = pose.rotation(kBones[bone]);
            const bool is_other_sign =
                !samples.empty() && glm::dot(samples.back().rotations[bone], rotation) < 0.0F;
            sample.rotations[bone] = is_other_sign ? -rotation : rotation;
        }
        sample.hips = pose.hips_position;
        std::copy(pose.foot_contact.begin(), pose.foot_contact.end(), sample.contact.begin());
        samples.push_back(sample);
    }
    set_samples(std::move(samples));
}

void FigurePassage::set_samples(std::vector<Sample> samples) {
    auto list = std::make_shared<const std::vector<Sample>>(std::move(samples));
    samples_ = *list;
    owner_ = std::move(list);
}

void FigurePassage::take_signs_of(const FigurePassage& other) {
    std::vector<Sample> samples(samples_.begin(), samples_.end());
    for (std::size_t bone = 0; bone < kBones.size(); ++bone) {
        if (glm::dot(samples_.front().rotations[bone], other.samples_.front().rotations[bone]) <
            0.0F) {
            for (Sample& sample : samples) {
                sample.rotations[bone] = -sample.rotations[bone];
            }
        }
    }
    set_samples(std::move(samples));
}

namespace {

constexpr float kCompactSteps = 32767.0F;

std::array<std::int16_t, 4> compact_of(const glm::quat& rotation) {
    const auto step = [](float value) {
        const float whole = std::isfinite(value) ? std::clamp(value, -1.0F, 1.0F) : 0.0F;
        return static_cast<std::int16_t>(std::lround(whole * kCompactSteps));
    };
    return {step(rotation.w), step(rotation.x), step(rotation.y), step(rotation.z)};
}

const glm::quat& rotation_of(const glm::quat& rotation) noexcept { return rotation; }

// Of unit length but for the rounding, which interpolation takes away.
glm::quat rotation_of(const std::array<std::int16_t, 4>& compact) noexcept {
    constexpr float kStep = 1.0F / kCompactSteps;
    return {kStep * static_cast<float>(compact[0]),
            kStep * static_cast<float>(compact[1]),
            kStep * static_cast<float>(compact[2]),
            kStep * static_cast<float>(compact[3])};
}

const glm::vec3& hips_of(const glm::vec3& hips) noexcept { return hips; }
glm::vec3 hips_of(const std::array<float, 3>& hips) noexcept { return {hips[0], hips[1], hips[2]}; }

}  // namespace

FigurePassage FigurePassage::compact() const {
    auto list = std::make_shared<std::vector<CompactSample>>();
    list->reserve(samples_.size());
    for (const Sample& sample : samples_) {
        CompactSample& small = list->emplace_back();
        std::transform(
            sample.rotations.begin(), sample.rotations.end(), small.rotations.begin(), compact_of);
        small.hips = {sample.hips.x, sample.hips.y, sample.hips.z};
        small.contact = sample.contact;
    }
    FigurePassage passage;
    passage.samples_per_beat_ = samples_per_beat_;
    passage.compact_ = *list;
    passage.owner_ = std::move(list);
    return passage;
}

FigurePassage::Place FigurePassage::place_of(double beat) const noexcept {
    const double last = static_cast<double>(count() - 1);
    const double at = std::clamp((beat + kMargin) * samples_per_beat_, 0.0, last);
    const auto i = std::min(static_cast<std::size_t>(at), count() - 2);
    return {i, static_cast<float>(at - static_cast<double>(i))};
}

template <typename Samples>
void FigurePassage::set_rotations(const Samples& samples,
                                  const Place& place,
                                  std::size_t first,
                                  Pose& pose) noexcept {
    const auto& before = samples[place.before];
    const auto& after = samples[place.before + 1];
    for (std::size_t bone = first; bone < kBones.size(); ++bone) {
        pose.rotation(kBones[bone]) = interpolate(
            rotation_of(before.rotations[bone]), rotation_of(after.rotations[bone]), place.share);
    }
}

template <typename Samples>
void FigurePassage::set_body(const Samples& samples, const Place& place, Pose& pose) noexcept {
    const auto& before = samples[place.before];
    const auto& after = samples[place.before + 1];
    set_rotations(samples, place, 0, pose);
    pose.hips_position = glm::mix(hips_of(before.hips), hips_of(after.hips), place.share);
    const auto& contact = place.share < 0.5F ? before.contact : after.contact;
    pose.foot_contact = {contact[0] != 0, contact[1] != 0};
}

void FigurePassage::at(double beat, Pose& pose) const noexcept RAKS_NONBLOCKING {
    const Place place = place_of(beat);
    compact_.empty() ? set_body(samples_, place, pose) : set_body(compact_, place, pose);
}

void FigurePassage::arms_at(double beat, Pose& pose) const noexcept RAKS_NONBLOCKING {
    const Place place = place_of(beat);
    constexpr std::size_t kFirst = kBones.size() - kArmBones;
    compact_.empty() ? set_rotations(samples_, place, kFirst, pose)
                     : set_rotations(compact_, place, kFirst, pose);
}

void FigurePassage::pack(Packer& packer) const {
    packer.put(samples_per_beat_);
    packer.put_block(samples_);
    packer.put_block(compact_);
}

FigurePassage FigurePassage::unpack(Unpacker& unpacker, std::shared_ptr<const void> owner) {
    FigurePassage passage;
    passage.samples_per_beat_ = unpacker.take<double>();
    passage.samples_ = unpacker.take_block<Sample>();
    passage.compact_ = unpacker.take_block<CompactSample>();
    passage.owner_ = std::move(owner);
    return passage;
}

bool FigurePassage::covers(int beats) const noexcept {
    // One sample more than slices: both ends are there. Written so that NaN does not cover.
    const double slices = (static_cast<double>(beats) + 2.0 * kMargin) * samples_per_beat_;
    return beats > 0 && samples_per_beat_ >= 1.0 && (samples_.empty() || compact_.empty()) &&
           std::abs(static_cast<double>(count()) - 1.0 - slices) < 1.0;
}

namespace {

constexpr double kStep = 0.125;  // beats between samples
// Cosine of half of 120 degrees, the dot product of two quaternions
constexpr float kNearest = 0.5F;

// The dot product is signed: with signs made to agree a negative one is the longer way round.
bool can_mix(const FigurePassage& a, const FigurePassage& b, int beats) {
    for (double beat = -FigurePassage::kMargin; beat <= beats + FigurePassage::kMargin;
         beat += kStep) {
        Pose one;
        Pose other;
        a.arms_at(beat, one);
        b.arms_at(beat, other);
        for (std::size_t i = FigurePassage::kBones.size() - FigurePassage::kArmBones;
             i < FigurePassage::kBones.size();
             ++i) {
            const Bone bone = FigurePassage::kBones[i];
            if (glm::dot(one.rotation(bone), other.rotation(bone)) < kNearest) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

ArmMixes arm_mixes(std::span<const FigurePassage> passages, int beats) {
    RAKS_ASSERT(passages.size() <= kWays);
    ArmMixes mixes;
    for (std::size_t a = 0; a < passages.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            mixes[a][b] = mixes[b][a] = can_mix(passages[a], passages[b], beats);
        }
    }
    return mixes;
}

}  // namespace raks::motion
