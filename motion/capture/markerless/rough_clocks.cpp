#include "motion/capture/markerless/rough_clocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motion/capture/markerless/dancer_limbs.hpp"

namespace raks::capture {
namespace {

constexpr double kRoughRate = 30.0;        // samples a second
constexpr double kLeastShared = 4.0;       // seconds that two films must share
constexpr double kRoughConfidence = 0.05;  // below it, nothing fits
constexpr double kSlowConfidence = 0.1;    // from which another speed is believed
constexpr double kSlowLikeness = 0.35;     // likewise, of a dance that repeats itself

/// Upward speeds of the joints of a film at kRoughRate, in usual speeds of each joint; 0: not
/// known.
struct UpwardSpeeds {
    std::array<std::vector<double>, kMainPoints.size()> joints;
    double first = 0.0;  // camera time of the first; seconds
    std::size_t count = 0;
};

// In shares of what is usual for the joint; bounded, so that what a network invents counts little.
void normalise(std::vector<double>& speeds) {
    constexpr double kMostSpeed = 3.0;
    double squares = 1e-12;
    for (const double speed : speeds) {
        squares += speed * speed;
    }
    const double usual =
        std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, speeds.size())));
    for (double& speed : speeds) {
        speed = std::clamp(speed / usual, -kMostSpeed, kMostSpeed);
    }
}

UpwardSpeeds upward_speeds(const KeypointFilm& film) {
    constexpr double kSurely = 0.5;        // visibility
    constexpr double kLongestSpan = 0.48;  // seconds over which a speed is taken
    UpwardSpeeds speeds;
    speeds.first = film.pictures.front().time;
    const double seconds = film.pictures.back().time - speeds.first;
    speeds.count = static_cast<std::size_t>(seconds * kRoughRate);
    for (auto& joint : speeds.joints) {
        joint.assign(speeds.count, 0.0);
    }
    std::size_t picture = 0;
    for (std::size_t i = 0; i < speeds.count; ++i) {
        const double time = speeds.first + (static_cast<double>(i) + 0.5) / kRoughRate;
        while (picture + 2 < film.pictures.size() && film.pictures[picture + 1].time <= time) {
            ++picture;
        }
        // Over three pictures: the errors of a network tremble.
        const std::size_t from = picture > 0 ? picture - 1 : 0;
        const std::size_t to = std::min(picture + 2, film.pictures.size() - 1);
        const double step = film.pictures[to].time - film.pictures[from].time;
        for (std::size_t joint = 0; joint < kMainPoints.size(); ++joint) {
            const Keypoint& before = film.pictures[from][kMainPoints[joint]];
            const Keypoint& after = film.pictures[to][kMainPoints[joint]];
            if (before.visibility >= kSurely && after.visibility >= kSurely && step > 0.0 &&
                step < kLongestSpan) {
                speeds.joints[joint][i] = (before.pixel.y - after.pixel.y) / step;
            }
        }
    }
    for (auto& joint : speeds.joints) {
        normalise(joint);
    }
    return speeds;
}

double length_of(const KeypointFilm& film) {
    return film.pictures.back().time - film.pictures.front().time;
}

// The same with left and right exchanged: kMainPoints has them in pairs.
UpwardSpeeds exchanged(UpwardSpeeds speeds) {
    static_assert(kMainPoints[0] == BodyPoint::left_shoulder &&
                  kMainPoints[1] == BodyPoint::right_shoulder);
    for (std::size_t joint = 0; joint + 1 < kMainPoints.size(); joint += 2) {
        std::swap(speeds.joints[joint], speeds.joints[joint + 1]);
    }
    return speeds;
}

// The film as it would be at `times` its speed; pictures that then come quicker than is worth
// while are left out.
KeypointFilm sped_up(const KeypointFilm& film, double times) {
    constexpr double kShortestStep = 0.9 / 60.0;  // seconds
    KeypointFilm quick = film;
    quick.pictures.clear();
    const double first = film.pictures.front().time;
    for (KeypointPicture picture : film.pictures) {
        picture.time = first + (picture.time - first) / times;
        if (quick.pictures.empty() || picture.time - quick.pictures.back().time >= kShortestStep) {
            quick.pictures.push_back(picture);
        }
    }
    return quick;
}

/// How alike two films are when one is shifted.
struct Likeness {
    std::ptrdiff_t lag = 0;
    // Correlation; [-1, 1]. What they do not share counts against a lag: else a figure that is
    // repeated is found again where the films hardly meet.
    double whole = 0.0;
    double shared = 0.0;  // correlation of what they share alone
    double seconds = 0.0;
};

double energy_of(const UpwardSpeeds& speeds) {
    double squares = 1e-9;
    for (const auto& joint : speeds.joints) {
        for (const double speed : joint) {
            squares += speed * speed;
        }
    }
    return squares;
}

// When `other` is `lag` samples later. `energy`: of both, the root of the product.
Likeness likeness_at(const UpwardSpeeds& one,
                     const UpwardSpeeds& other,
                     std::ptrdiff_t lag,
                     double energy) {
    double product = 0.0;
    double of_one = 1e-9;
    double of_other = 1e-9;
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, lag);
    const std::ptrdiff_t to = std::min(static_cast<std::ptrdiff_t>(one.count),
                                       static_cast<std::ptrdiff_t>(other.count) + lag);
    for (std::size_t joint = 0; joint < kMainPoints.size(); ++joint) {
        for (std::ptrdiff_t i = from; i < to; ++i) {
            const double a = one.joints[joint][static_cast<std::size_t>(i)];
            const double b = other.joints[joint][static_cast<std::size_t>(i - lag)];
            product += a * b;
            of_one += a * a;
            of_other += b * b;
        }
    }
    return {lag,
            product / energy,
            product / std::sqrt(of_one * of_other),
            static_cast<double>(std::max<std::ptrdiff_t>(0, to - from)) / kRoughRate};
}

/// All shifts of two films.
class Shifts {
 public:
    Shifts(const UpwardSpeeds& one, const UpwardSpeeds& other, double within)
        : first_(one.first - other.first) {
        constexpr double kDay = 86400.0;
        const auto least = static_cast<std::ptrdiff_t>(kLeastShared * kRoughRate);
        const auto most = static_cast<std::ptrdiff_t>(std::min(within, kDay) * kRoughRate);
        const std::ptrdiff_t from =
            std::max(-most, least - static_cast<std::ptrdiff_t>(other.count));
        const std::ptrdiff_t to = std::min(most, static_cast<std::ptrdiff_t>(one.count) - least);
        const double energy = std::sqrt(energy_of(one) * energy_of(other));
        for (std::ptrdiff_t lag = from; lag <= to; ++lag) {
            all_.push_back(likeness_at(one, other, lag, energy));
        }
    }

    [[nodiscard]] bool is_empty() const noexcept { return all_.size() < 3; }

    // Shifts that are better than their neighbours, the best first. Precondition: not empty.
    [[nodiscard]] std::vector<std::size_t> peaks() const {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const bool is_above_last = i == 0 || all_[i].whole > all_[i - 1].whole;
            if (is_above_last && (i + 1 == all_.size() || all_[i].whole >= all_[i + 1].whole)) {
                found.push_back(i);
            }
        }
        std::stable_sort(found.begin(), found.end(), [this](std::size_t a, std::size_t b) {
            return all_[a].whole > all_[b].whole;
        });
        return found;
    }

    [[nodiscard]] const Likeness& at(std::size_t index) const { return all_[index]; }

    // Offset of the other camera's clock, between the samples.
    [[nodiscard]] double offset_of(std::size_t index) const {
        double between = 0.0;
        if (index > 0 && index + 1 < all_.size()) {
            const double before = all_[index - 1].whole;
            const double after = all_[index + 1].whole;
            const double bend = before - 2.0 * all_[index].whole + after;
            between = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
        }
        return first_ + (static_cast<double>(all_[index].lag) + between) / kRoughRate;
    }

 private:
    double first_ = 0.0;
    std::vector<Likeness> all_;
};

/// A shift that may be the right one.
struct Candidate {
    double offset = 0.0;
    double likeness = 0.0;  // Likeness::whole
};

/// What the shifts of a film say.
struct RoughGuess {
    std::vector<Candidate> candidates;  // the best first, then those that fit nearly as well
    double confidence = 0.0;

    [[nodiscard]] double likeness() const noexcept {
        return candidates.empty() ? 0.0 : candidates.front().likeness;
    }
};

bool fits_nearly_as_well(const Likeness& other, const Likeness& best) {
    constexpr double kNearlyWhole = 0.75;
    constexpr double kNearlyShared = 0.85;
    constexpr double kEnough = 8.0;  // seconds shared
    return other.whole >= kNearlyWhole * best.whole ||
           (other.seconds >= kEnough && other.shared >= kNearlyShared * best.shared);
}

RoughGuess guess_of(const Shifts& shifts) {
    constexpr double kApart = 0.1;        // seconds: a shift that far off is another one
    constexpr double kRepeatApart = 0.3;  // likewise, of one that may be a repeat of the dance
    constexpr double kNextBest = 0.7;     // how much it counts against the best
    constexpr std::size_t kMostNamed = 4;
    RoughGuess guess;
    if (shifts.is_empty()) {
        return guess;
    }
    const auto peaks = shifts.peaks();
    const Likeness& best = shifts.at(peaks.front());
    double second = 0.0;
    for (const std::size_t peak : peaks) {
        const Likeness& other = shifts.at(peak);
        const double apart = static_cast<double>(std::abs(other.lag - best.lag)) / kRoughRate;
        second = apart > kApart ? std::max(second, other.whole) : second;
        const bool is_rival = apart > kRepeatApart && fits_nearly_as_well(other, best);
        if ((is_rival || peak == peaks.front()) && guess.candidates.size() < kMostNamed) {
            guess.candidates.push_back({shifts.offset_of(peak), other.whole});
        }
    }
    guess.confidence = std::clamp(best.whole - kNextBest * second, 0.0, 1.0);
    return guess;
}

// A dance that repeats itself has no shift that stands out; but then several are truly alike.
bool is_believed(const RoughGuess& guess) {
    constexpr double kTrulyAlike = 0.3;
    return guess.confidence >= kRoughConfidence ||
           (guess.candidates.size() > 1 && guess.likeness() >= kTrulyAlike);
}

// Without the minus sign of what rounds to 0.
double hundredths(double seconds) { return std::round(100.0 * seconds) / 100.0 + 0.0; }

std::string words_of(const std::vector<Candidate>& candidates) {
    std::vector<std::string> words;
    words.reserve(candidates.size());
    for (const Candidate& candidate : candidates) {
        words.push_back(
            fmt::format("{:+.2f} s ({:.2f})", hundredths(candidate.offset), candidate.likeness));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

/// By how much later a film was begun than the first, as far as their dates tell.
struct BeginByDates {
    // Phones write when a recording began, or when it ended: one of each.
    std::vector<double> later;

    // The candidate that is meant, however the dates are read; nothing: they do not tell.
    // Precondition: two candidates or more.
    [[nodiscard]] std::optional<std::size_t> meant(const std::vector<Candidate>& candidates) const {
        constexpr double kMostOff = 3.0;  // seconds: dates are whole seconds, and written late
        constexpr double kClearly = 1.2;  // seconds by which the next one must be farther off
        std::optional<std::size_t> all;
        for (const double recorded : later) {
            std::vector<std::pair<double, std::size_t>> off;
            for (std::size_t i = 0; i < candidates.size(); ++i) {
                off.emplace_back(std::abs(candidates[i].offset - recorded), i);
            }
            std::sort(off.begin(), off.end());
            const bool is_clear =
                off[0].first <= kMostOff && off[1].first - off[0].first >= kClearly;
            if (!is_clear || (all && *all != off[0].second)) {
                return std::nullopt;
            }
            all = off[0].second;
        }
        return all;
    }
};

// Which of several offsets: by what the films say of when they were recorded, else the best.
double choose(const std::vector<Candidate>& candidates,
              const std::string& camera,
              const BeginByDates& dates,
              RoughClocks& found) {
    if (candidates.size() < 2) {
        return candidates.front().offset;
    }
    if (const auto meant = dates.meant(candidates)) {
        found.notes.push_back(fmt::format(
            "{}: the dance repeats itself, and its clock fits at several offsets nearly "
            "alike: {}; by the films' dates it is {:+.2f} s",
            camera,
            words_of(candidates),
            hundredths(candidates[*meant].offset)));
        return candidates[*meant].offset;
    }
    found.doubts.push_back(fmt::format(
        "{}: the dance repeats itself, and its clock fits at several offsets nearly alike: {}; the "
        "first is taken. Compare the films, and set it by hand where it is another "
        "(raks capture sync --offsets)",
        camera,
        words_of(candidates)));
    return candidates.front().offset;
}

// By the likeness as it is, and with left and right exchanged.
bool is_mirrored(double as_it_is, double exchanged_likeness) {
    constexpr double kMirrorGain = 1.5;      // by how much it fits better
    constexpr double kMirrorLikeness = 0.2;  // from which that is believed
    return exchanged_likeness >= kMirrorLikeness && exchanged_likeness > kMirrorGain * as_it_is;
}

// One line on films that mirror the first; empty: none does. Where all do, it is the first itself,
// or, of two, either.
std::string mirror_line(const std::vector<KeypointFilm>& films,
                        const std::vector<bool>& is_against_first) {
    std::vector<std::string> names;
    for (std::size_t i = 1; i < films.size(); ++i) {
        if (is_against_first[i]) {
            names.push_back(films[i].camera);
        }
    }
    if (names.empty()) {
        return {};
    }
    constexpr const char* kWayOut =
        "as selfie cameras do: film with the camera at the back, or mirror that film once more "
        "(ffmpeg -i FILM -vf hflip NEW)";
    if (names.size() + 1 < films.size()) {
        return fmt::format(
            "{}: mirrors what {} shows, {}", fmt::join(names, ", "), films.front().camera, kWayOut);
    }
    return films.size() == 2
               ? fmt::format("{} or {} mirrors what the other one shows, {}",
                             films[0].camera,
                             films[1].camera,
                             kWayOut)
               : fmt::format("{}: mirrors what the others show, {}", films.front().camera, kWayOut);
}

/// One run of rough_clocks().
class RoughSearch {
 public:
    RoughSearch(const std::vector<KeypointFilm>& films, const RoughClockHints& hints)
        : films_(films), hints_(hints), is_mirrored_(films.size(), false) {}

    Expected<RoughClocks> run() {
        first_ = upward_speeds(films_.front());
        found_.clocks.push_back({films_.front().camera, 0.0, 0.0, 1.0});
        for (std::size_t i = 1; i < films_.size(); ++i) {
            if (auto found = find(i); !found) {
                return fail(std::move(found.error()));
            }
        }
        if (std::string line = mirror_line(films_, is_mirrored_); !line.empty()) {
            return fail(std::move(line));
        }
        return std::move(found_);
    }

 private:
    Expected<void> find(std::size_t film) {
        const UpwardSpeeds speeds = upward_speeds(films_[film]);
        const RoughGuess guess = guess_of(Shifts(first_, speeds, hints_.within));
        const RoughGuess other = guess_of(Shifts(first_, exchanged(speeds), hints_.within));
        is_mirrored_[film] = is_mirrored(guess.likeness(), other.likeness());
        if (is_mirrored_[film]) {
            return {};
        }
        if (!is_believed(guess)) {
            return fail(fmt::format(
                "{}: nothing in it moves as in {}{}; else set its clock by hand (raks capture sync "
                "--offsets)",
                films_[film].camera,
                films_.front().camera,
                slow_motion_of(film, speeds)));
        }
        const double offset = choose(guess.candidates, films_[film].camera, dates(film), found_);
        found_.clocks.push_back({films_[film].camera, offset, 0.0, guess.confidence});
        return {};
    }

    [[nodiscard]] BeginByDates dates(std::size_t film) const {
        const auto& recorded = hints_.recorded;
        if (film >= recorded.size() || !recorded[film] || !recorded.front()) {
            return {};
        }
        const double later = *recorded[film] - *recorded.front();
        return {{later, later - length_of(films_[film]) + length_of(films_.front())}};
    }

    // Films that phones took quickly are played slowly: 120 or 240 pictures a second at 30 or 60.
    [[nodiscard]] std::string slow_motion_of(std::size_t film, const UpwardSpeeds& speeds) const {
        for (const double times : {2.0, 4.0, 8.0}) {
            for (const bool is_first : {false, true}) {
                const KeypointFilm& slow = films_[is_first ? 0 : film];
                const UpwardSpeeds quick = upward_speeds(sped_up(slow, times));
                const RoughGuess guess = guess_of(
                    Shifts(is_first ? quick : first_, is_first ? speeds : quick, hints_.within));
                if (guess.confidence > kSlowConfidence || guess.likeness() > kSlowLikeness) {
                    return fmt::format(
                        ", unless {} is in slow motion, {:.0f} times as slow: film both at the "
                        "usual speed, or give it that back (ffmpeg -itsscale {} -i FILM -c copy "
                        "-an NEW)",
                        slow.camera,
                        times,
                        1.0 / times);
                }
            }
        }
        return ": are they films of one dance?";
    }

    const std::vector<KeypointFilm>& films_;
    const RoughClockHints& hints_;
    std::vector<bool> is_mirrored_;  // against the first film
    UpwardSpeeds first_;
    RoughClocks found_;
};

}  // namespace

Expected<RoughClocks> rough_clocks(const std::vector<KeypointFilm>& films,
                                   const RoughClockHints& hints) {
    constexpr double kShortest = 5.0;  // seconds
    for (const KeypointFilm& film : films) {
        if (film.pictures.size() < 2 || length_of(film) < kShortest) {
            return fail(
                fmt::format("{}: its film is too short to tell its clock from what moves in "
                            "it: {:.0f} s are needed",
                            film.camera,
                            kShortest));
        }
    }
    return RoughSearch(films, hints).run();
}

std::string why_mirrored(const std::vector<KeypointFilm>& films, const std::vector<Clock>& clocks) {
    std::vector<bool> is_against_first(films.size(), false);
    std::optional<UpwardSpeeds> first;
    for (std::size_t i = 0; i < films.size(); ++i) {
        if (films[i].pictures.size() < 2) {
            return {};
        }
        const UpwardSpeeds speeds = upward_speeds(films[i]);
        if (!first) {
            first = speeds;
            continue;
        }
        const double begins = clocks[i].capture_time(speeds.first);
        const double later = clocks[0].camera_time(begins) - first->first;
        const auto lag = static_cast<std::ptrdiff_t>(std::lround(later * kRoughRate));
        const Likeness as_it_is = likeness_at(*first, speeds, lag, 1.0);
        is_against_first[i] =
            as_it_is.seconds >= kLeastShared &&
            is_mirrored(as_it_is.shared, likeness_at(*first, exchanged(speeds), lag, 1.0).shared);
    }
    return mirror_line(films, is_against_first);
}

}  // namespace raks::capture
