#include "motion/dance/dance_content.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/random.hpp"
#include "motion/dance/baking/arms.hpp"
#include "motion/dance/baking/landing_delay.hpp"
#include "motion/dance/baking/trajectory.hpp"
#include "motion/dance/baking/variation.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/dynamics/isolation.hpp"
#include "motion/dance/figure_places.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kWorkers = 2;  // threads that bake passages
// Streams of random numbers, so that the draws stay independent
constexpr std::uint64_t kPassageStream = 100;
constexpr std::uint64_t kDetailStream = 1000;
constexpr std::uint64_t kWaysStream = 2;
constexpr int kLandingIterations = 2;  // Passes of landing correction for each passage.
// Pace (of the learnt tempo) at which the landings of mean steps are measured. Such a step slows
// before it rests, so the slower the dance, the earlier it falls under the landing speed (0.30 m/s
// at any pace). Halfway to the slowest pace danced, the errors at both ends are smallest.
constexpr double kMeanAimPace = 0.85;
// Factors of the missing accelerations (variation.hpp). Some exceed 1: the takes were learnt
// through a low-pass of 10 Hz, while their jerk is measured without. With these the whole body's
// jerk equals people's at their tempo. Steps get less, or a landing would be detected twice.
constexpr double kTorsoDetail = 1.42;
constexpr double kArmDetail = 0.95;
constexpr double kPlaceDetail = 1.62;
constexpr double kStepDetail = 0.4;

/// Restores the arms of a varied figure of positions: bone lengths, and near enough to those learnt
/// to be mixed.
void hold_arms(const FigureModel& model,
               const PartModel& part,
               const FeatureTrack& learnt,
               FeatureTrack& varied) {
    if (part.features == FigureFeatures::positions && part.part == Part::upper) {
        restore_arms_near(learnt, part, source_body(model), varied);
    }
}

// Factor of the detail of one part.
double detail_of(const PartModel& part) {
    if (part.features == FigureFeatures::positions) {
        return kPlaceDetail;
    }
    return part.part == Part::upper ? kArmDetail : kTorsoDetail;
}

// All that baking a passage reads; shared by the workers, which only read it.
struct Baking {
    std::span<const FigureModel> figures;
    const std::vector<FigureTracks>& tracks;
    const std::vector<FigurePath>& ways;
    const std::vector<Footing>& footings;
    double lost = 0.0;  // detail_lost() of the dance
    const Skeleton& skeleton;
    Generator generator = Generator::trajectories;

    /// Passage n of a figure; number 0 is danced as learnt, the others are varied.
    [[nodiscard]] FigurePassage passage(std::size_t figure, std::size_t n) const {
        if (generator == Generator::frames) {
            return FigurePassage(free_figure(
                figures[figure], drawn_tracks(figures[figure], figure, n), ways[figure], skeleton));
        }
        FigureTracks varied = tracks[figure];
        FigureTracks steps = tracks[figure];
        const std::uint64_t stream = kPassageStream + n * (kParts.size() + 1);
        for (const PartModel& part : figures[figure].parts) {
            const auto p = static_cast<std::size_t>(part.part);
            // Legs step as learnt and are only shifted aside; but the lower part of positions
            // carries the hips.
            if (n > 0 && (part.part != Part::lower || &part == &figures[figure].root_part())) {
                vary(part,
                     is_captured(figures[figure]),
                     CounterRandom(figure, stream + p),
                     varied[p]);
                hold_arms(figures[figure], part, tracks[figure][p], varied[p]);
            }
            const CounterRandom quick(figure, kDetailStream + n * kParts.size() + p);
            add_detail(part, quick, lost * detail_of(part), varied[p]);
            if (part.part == Part::lower) {
                add_detail(part, quick, lost * kStepDetail, steps[p]);
            }
        }
        const CounterRandom places_of_steps(figure, stream + kParts.size());
        const FreeFigure stepping = free_figure(figures[figure], steps, ways[figure], skeleton);
        std::vector<Pose> body = free_poses(figures[figure], varied, ways[figure], skeleton);
        steady_body(figures[figure], body);
        if (lost > 0.0) {  // in a written dance the author led the hands
            lead_hands_round(skeleton, stepping.samples_per_beat, body);
        }
        meet_hands(
            skeleton, free_poses(figures[figure], tracks[figure], ways[figure], skeleton), body);
        return planted(figure, stepping, body, n > 0 ? &places_of_steps : nullptr);
    }

    /// Plants the feet, then corrects the landings: each pass measures them and aims the contacts
    /// anew.
    [[nodiscard]] FigurePassage planted(std::size_t figure,
                                        const FreeFigure& steps,
                                        const std::vector<Pose>& body,
                                        const CounterRandom* random) const {
        const FigureModel& model = figures[figure];
        Footing footing = footings[figure];
        FigurePassage passage(model, steps, body, ways[figure], footing, random, skeleton);
        const double pace = footing.is_mean ? kMeanAimPace : 1.0;
        for (int i = 0; i < kLandingIterations; ++i) {
            aim_landings(model, passage, skeleton, pace, footing.landings);
            passage = FigurePassage(model, steps, body, ways[figure], footing, random, skeleton);
        }
        return passage;
    }
};

/// Value of a closed curve of bins at a beat, interpolated linearly between the bins' middles.
double value_of(std::span<const double> bins, double beat, int beats) noexcept {
    const auto size = static_cast<double>(bins.size());
    const double at = beat * size / beats - 0.5;
    const double wrapped = at - size * std::floor(at / size);
    const auto i = std::min(static_cast<std::size_t>(wrapped), bins.size() - 1);
    const double share = wrapped - static_cast<double>(i);
    return bins[i] + share * (bins[(i + 1) % bins.size()] - bins[i]);
}

/// Sets the fingers where the figure tells how far each hand is closed.
void shape_hands(const LibraryFigure& figure, double beat, Pose& pose) noexcept {
    for (const Side side : kSides) {
        const std::vector<double>& fist = figure.fist[static_cast<std::size_t>(side)];
        if (!fist.empty()) {
            set_hand_shape(side, value_of(fist, beat, figure.beats), pose);
        }
    }
}

}  // namespace

Expected<DanceContent> make_content(std::span<const FigureModel> figures,
                                    const Skeleton& skeleton,
                                    const FigureGrammar* grammar,
                                    Generator generator) {
    DanceContent content;
    content.generator = generator;
    content.skeleton = skeleton;
    relax_hands(content.rest);
    std::vector<FigureTracks> tracks;
    std::vector<std::string> names;
    double seconds_per_beat = 0.0;
    for (const FigureModel& model : figures) {
        if (auto valid = validate(model); !valid) {
            return fail(model.name + ": " + valid.error().message);
        }
        tracks.push_back(learnt_tracks(model, skeleton));
        names.push_back(model.name);
        seconds_per_beat +=
            model.learnt_tempo.seconds_per_beat() / static_cast<double>(figures.size());
    }
    content.metre = {Bpm::from_period(seconds_per_beat),
                     grammar != nullptr ? grammar->beats_per_bar : FigureGrammar().beats_per_bar};
    const auto is_of = [](const FigureGrammar::Rule& rule, const std::string& name) {
        return rule.figure == name;
    };
    if (grammar != nullptr &&
        !std::equal(
            grammar->rules.begin(), grammar->rules.end(), names.begin(), names.end(), is_of)) {
        return fail("the grammar has other figures than the dance, or in another order");
    }
    const std::vector<FigurePath> ways = closed_paths(figures, skeleton, grammar);
    std::vector<bool> turns_half;
    turns_half.reserve(ways.size());
    for (const FigurePath& way : ways) {
        turns_half.push_back(way.half_turns % 2 != 0);
    }
    content.chooser =
        FigureChooser(grammar != nullptr ? *grammar : FigureGrammar::uniform(names), turns_half);
    const std::vector<StartPlaces> places =
        start_places(figures,
                     tracks,
                     ways,
                     skeleton,
                     grammar != nullptr ? grammar->starts : FigureGrammar::Starts::common);

    // A dance learnt from people has lost detail of its motion, a written one has not. A slow
    // figure alone may look like either, so the figure that lost least decides for the whole dance.
    double lost = 1.0;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        lost = std::min(lost, detail_lost(figures[i], tracks[i]));
    }
    std::vector<Footing> footings;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        footings.push_back({places[i], single_landings(figures[i]), lost > 0.0});
    }
    const Baking baking{figures, tracks, ways, footings, lost, skeleton, generator};
    constexpr std::size_t kPassages = DanceContent::kPassages;
    std::vector<std::optional<FigurePassage>> baked(figures.size() * kPassages);
    {
        // Each worker takes every second passage; the block ends when all have joined.
        std::vector<std::jthread> workers;
        for (std::size_t first = 0; first < kWorkers; ++first) {
            workers.emplace_back([&baking, &baked, first] {
                for (std::size_t i = first; i < baked.size(); i += kWorkers) {
                    baked[i].emplace(baking.passage(i / kPassages, i % kPassages));
                }
            });
        }
    }
    for (std::size_t i = 0; i < figures.size(); ++i) {
        LibraryFigure figure;
        figure.name = figures[i].name;
        figure.beats = figures[i].beats;
        figure.fist = figures[i].fist;
        figure.learnt_tempo = figures[i].learnt_tempo;
        figure.size_by_tempo = figures[i].size_by_tempo;
        figure.move = ways[i].move;
        figure.turns_half = turns_half[i];
        if (generator == Generator::trajectories) {
            figure.landing_delay =
                motion::landing_delay(figures[i], *baked[i * kPassages], skeleton);
        }
        for (std::size_t n = 0; n < kPassages; ++n) {
            figure.passages.push_back(std::move(*baked[i * kPassages + n]));
            figure.passages.back().take_signs_of(figure.passages.front());
        }
        figure.arms_mix = arm_mixes(figure.passages, figure.beats);
        figure.middle =
            middle_of(figure.passages.front(), figure.beats, ways[i].half_turns == 0, skeleton);
        content.figures.push_back(std::move(figure));
    }
    if (grammar != nullptr && grammar->starts == FigureGrammar::Starts::own) {
        place_figures(skeleton, content.figures);
    }
    content.stage = stage_of(content.figures.front());
    content.couple = couple_of(figures, grammar);
    if (grammar != nullptr && grammar->couple && grammar->couple->apart) {
        content.couple =
            couple_of(*grammar->couple->apart,
                      figures.front().role,
                      stance_before(content.figures.front().passages.front(), skeleton));
    }
    if (grammar != nullptr) {
        take_rules(*grammar, content);
    }
    return content;
}

void take_rules(const FigureGrammar& grammar, DanceContent& content) {
    // Where nothing is said, his left hand holds her right one.
    content.solo = grammar.solo;
    content.form = grammar.couple.value_or(CoupleForm{CoupleHold::hands, {}, {}});
    for (std::size_t i = 0; i < std::min(content.figures.size(), grammar.rules.size()); ++i) {
        LibraryFigure& figure = content.figures[i];
        figure.holds = grammar.rules[i].holds;
        figure.can_slow = grammar.rules[i].can_slow;
        figure.hands = grammar.rules[i].hands;
        figure.still = grammar.rules[i].still;
        if (!grammar.couple) {
            figure.holds = {{Side::left, Side::right, 0.0, static_cast<double>(figure.beats)}};
        }
    }
    // Figures that share one stance are of people, who begin on one foot.
    const bool are_mirrored = grammar.habits.mirror > 0.0 &&
                              grammar.starts == FigureGrammar::Starts::own &&
                              content.generator == Generator::trajectories;
    if (!are_mirrored) {
        return;
    }
    const FloorMove first =
        stance_before(content.figures.front().passages.front(), content.skeleton);
    for (std::size_t i = 0; i < std::min(content.figures.size(), grammar.rules.size()); ++i) {
        LibraryFigure& figure = content.figures[i];
        figure.sides = sides_of(figure.passages.front(), first, content.skeleton);
        figure.sides.can_mirror = grammar.rules[i].can_mirror && figure.middle.comes_back;
    }
}

FigureChoice choose_ways(std::size_t figure,
                         std::uint64_t seed,
                         std::uint64_t number) noexcept RAKS_NONBLOCKING {
    constexpr auto kPassages = static_cast<std::uint64_t>(DanceContent::kPassages);
    const CounterRandom random(seed, kWaysStream);
    FigureChoice choice;
    choice.figure = figure;
    choice.body = random.below(4 * number, kPassages);
    choice.arms[0] = random.below(4 * number + 1, kPassages);
    // Never the same passage as the first.
    choice.arms[1] = (choice.arms[0] + 1 + random.below(4 * number + 2, kPassages - 1)) % kPassages;
    choice.arms_share = static_cast<float>(random.uniform(4 * number + 3));
    return choice;
}

namespace {

// Arms mixed from two passages, as rotations relative to the learnt arms. Straight between two
// passages, the shorter way round may change from one moment to the next.
void mix_arms(const LibraryFigure& figure,
              const FigureChoice& choice,
              double beat,
              Pose& pose) noexcept {
    Pose learnt = pose;
    Pose first = pose;
    Pose second = pose;
    const bool can_mix = figure.arms_mix[choice.arms[0]][choice.arms[1]];
    const float share = can_mix ? choice.arms_share : 0.0F;
    figure.passages.front().arms_at(beat, learnt);
    figure.passages[choice.arms[0]].arms_at(beat, first);
    figure.passages[choice.arms[1]].arms_at(beat, second);
    for (std::size_t i = FigurePassage::kBones.size() - FigurePassage::kArmBones;
         i < FigurePassage::kBones.size();
         ++i) {
        const Bone bone = FigurePassage::kBones[i];
        const glm::quat back = glm::conjugate(learnt.rotation(bone));
        const auto turn = [&](const Pose& varied) {
            return back * varied.rotation(bone);  // not by the shorter way: take_signs_of()
        };
        pose.rotation(bone) = learnt.rotation(bone) *
                              glm::normalize(turn(first) * (1.0F - share) + turn(second) * share);
    }
}

// The trunk over the hips, and the head, of another beat: they wait on beats while the legs go on.
void take_trunk(const FigurePassage& passage, double beat, Pose& pose) noexcept {
    Pose other = pose;
    passage.at(beat, other);
    for (const Bone bone : {Bone::spine, Bone::chest, Bone::upper_chest, Bone::neck, Bone::head}) {
        pose.rotation(bone) = other.rotation(bone);
    }
}

FigureSize size_of(const FigureChoice& choice, const Manner& manner) noexcept {
    FigureSize size = choice.size;
    size.body *= manner.body;
    size.arms *= manner.arms;
    size.steps = {size.steps[0] * manner.steps[0], size.steps[1] * manner.steps[1]};
    size.bend += manner.bend;
    return size;
}

}  // namespace

Pose pose_of(const DanceContent& content,
             const FigureChoice& choice,
             double beat,
             const Manner& manner) noexcept RAKS_NONBLOCKING {
    const LibraryFigure& figure = content.figures[choice.figure];
    if (choice.is_mirrored) {
        FigureChoice other = choice;
        other.is_mirrored = false;
        Manner own = manner;
        std::swap(own.steps[0], own.steps[1]);
        return mirrored(pose_of(content, other, beat, own));
    }
    if (beat < -FigurePassage::kMargin && figure.middle.comes_back) {
        beat += figure.beats;
    }
    Pose pose = content.rest;
    shape_hands(figure, beat, pose);
    figure.passages[choice.body].at(beat, pose);
    if (content.generator == Generator::frames) {
        // Arms of another draw, so that repeats are not equal one time in eight. Not mixed: a mean
        // of two draws would have less variance than one.
        figure.passages[choice.arms[0]].arms_at(beat, pose);
        return pose;
    }
    if (manner.sharpness > 0.0F) {
        take_trunk(figure.passages[choice.body], sharpened(beat, manner.sharpness), pose);
    }
    mix_arms(figure, choice, sharpened(beat, manner.sharpness), pose);
    if (const FigureSize size = size_of(choice, manner); !size.is_as_learnt()) {
        resize(figure.middle, size, content.skeleton, pose);
    }
    keep_still(content.skeleton, figure.still, figure.middle.pose, pose);
    return pose;
}

}  // namespace raks::motion
