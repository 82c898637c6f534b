#include <algorithm>
#include <cmath>
#include <utility>

#include "audio/music/generator/dsp.hpp"
#include "audio/music/generator/notes.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

// A resonance of the drum: body, skin or rim.
struct Partial {
    double hertz;
    double gain;
    double t60;  ///< seconds
};

// A burst of band-limited noise: stick, skin, beads or snares.
struct Burst {
    double gain;
    double t60;     ///< seconds
    double centre;  ///< hertz
    double q;
    double rise = 0.0005;  ///< seconds
    double delay = 0.0;    ///< seconds after the attack
};

// How a drum is built. Its pitch starts at (1 + drop) times the final one and falls with the time
// constant `drop_time`.
struct Recipe {
    std::vector<Partial> partials;
    std::vector<Burst> bursts;
    double drop = 0.0;
    double drop_time = 0.01;  ///< seconds
};

// Guiro: one short burst for each notch that the stick passes.
std::vector<Burst> scrape(int teeth, double seconds, double gain) {
    std::vector<Burst> bursts;
    for (int i = 0; i < teeth; ++i) {
        const double place = static_cast<double>(i) / teeth;
        // The stick gets faster along the gourd, and louder towards the end of a long stroke.
        const double level = gain * (0.5 + 0.5 * place);
        bursts.push_back(
            {level, 0.018, 3400.0 + 900.0 * place, 1.6, 0.0006, seconds * std::pow(place, 0.9)});
    }
    return bursts;
}

// Frequencies of skins: the modes of a round membrane (1, 1.59, 2.14, 2.30, 2.65), pulled towards
// harmonic ratios by the air in the shell.
Recipe kit_recipe(Sound sound) {
    switch (sound) {
        case Sound::kick:
            return {{{58, 1.0, 0.28}, {116, 0.25, 0.12}}, {{0.25, 0.02, 2500, 0.7}}, 1.6, 0.018};
        case Sound::club_kick:
            return {{{50, 1.0, 0.36}, {100, 0.2, 0.10}}, {{0.3, 0.012, 3500, 0.6}}, 3.2, 0.022};
        case Sound::snare:
            return {{{185, 0.55, 0.16}, {330, 0.35, 0.10}},
                    {{1.1, 0.19, 4200, 0.5}, {0.6, 0.03, 1800, 0.7}},
                    0.25,
                    0.01};
        case Sound::clap:
            return {{},
                    {{0.8, 0.014, 1300, 1.1},
                     {0.8, 0.014, 1400, 1.1, 0.0005, 0.010},
                     {0.8, 0.014, 1250, 1.1, 0.0005, 0.020},
                     {1.2, 0.16, 1350, 0.9, 0.0005, 0.028}}};
        case Sound::closed_hat:
            return {{}, {{1.0, 0.055, 9500, 0.7}, {0.3, 0.03, 6000, 1.5}}};
        case Sound::open_hat:
            return {{}, {{1.0, 0.32, 8800, 0.6}, {0.3, 0.2, 5600, 2.0}}};
        case Sound::crash:
            return {{{1180, 0.04, 0.8}, {2130, 0.04, 0.9}, {3410, 0.04, 0.7}},
                    {{0.8, 1.5, 7200, 0.4}, {0.4, 0.6, 4300, 0.8}}};
        case Sound::click_high:
            return {{{2000, 1.0, 0.02}}, {}};
        default:  // click_low
            return {{{1000, 1.0, 0.02}}, {}};
    }
}

// Percussion of salsa.
Recipe latin_recipe(Sound sound) {
    switch (sound) {
        case Sound::clave:
            return {{{2480, 1.0, 0.075}, {6150, 0.22, 0.025}}, {{0.15, 0.004, 5000, 0.7}}};
        case Sound::cowbell:
            return {{{547, 0.5, 0.26},
                     {818, 0.7, 0.30},
                     {1610, 0.35, 0.18},
                     {2280, 0.28, 0.14},
                     {3390, 0.16, 0.09}},
                    {{0.25, 0.01, 4200, 0.8}}};
        case Sound::cowbell_mouth:
            return {{{562, 0.25, 0.10}, {1120, 0.5, 0.12}, {1745, 0.6, 0.10}, {2910, 0.3, 0.06}},
                    {{0.2, 0.008, 4800, 0.8}}};
        case Sound::conga_open:
            return {{{218, 1.0, 0.36}, {345, 0.32, 0.16}, {468, 0.22, 0.11}, {585, 0.12, 0.08}},
                    {{0.35, 0.012, 1500, 0.7}},
                    0.06,
                    0.012};
        case Sound::conga_low:
            return {{{163, 1.0, 0.42}, {259, 0.32, 0.18}, {350, 0.2, 0.12}},
                    {{0.3, 0.014, 1100, 0.7}},
                    0.06,
                    0.014};
        case Sound::conga_slap:
            return {{{232, 0.35, 0.06}, {980, 0.45, 0.05}, {1490, 0.4, 0.045}, {2260, 0.3, 0.03}},
                    {{1.0, 0.03, 2600, 0.8}},
                    0.1,
                    0.005};
        case Sound::conga_heel:
            return {{{190, 0.7, 0.07}, {300, 0.25, 0.05}}, {{0.35, 0.016, 700, 0.8}}, 0.05, 0.01};
        case Sound::guiro_long:
            return {{}, scrape(26, 0.235, 0.85)};
        case Sound::guiro_short:
            return {{}, scrape(8, 0.055, 0.9)};
        case Sound::maracas:
            return {{}, {{1.0, 0.05, 7600, 0.9, 0.004}, {0.5, 0.03, 11000, 0.7, 0.002}}};
        case Sound::timbale_high:
            return {{{392, 0.8, 0.30}, {627, 0.4, 0.2}, {902, 0.3, 0.16}, {1840, 0.16, 0.09}},
                    {{0.5, 0.02, 3400, 0.7}},
                    0.04,
                    0.01};
        case Sound::timbale_low:
            return {{{294, 0.8, 0.36}, {470, 0.4, 0.24}, {676, 0.3, 0.18}, {1400, 0.14, 0.10}},
                    {{0.5, 0.02, 3000, 0.7}},
                    0.04,
                    0.01};
        default:  // cascara: the stick on the shell of the timbales
            return {{{1240, 0.5, 0.05}, {2105, 0.6, 0.06}, {3620, 0.45, 0.05}, {5190, 0.3, 0.03}},
                    {{0.4, 0.008, 5200, 0.8}}};
    }
}

// Percussion of belly dance.
Recipe oriental_recipe(Sound sound) {
    switch (sound) {
        case Sound::darbuka_dum:
            return {{{96, 1.0, 0.30}, {154, 0.35, 0.16}, {213, 0.18, 0.1}},
                    {{0.3, 0.012, 900, 0.7}},
                    0.22,
                    0.016};
        case Sound::darbuka_tek:
            return {{{428, 0.5, 0.12}, {874, 0.6, 0.10}, {1390, 0.4, 0.08}, {2150, 0.3, 0.06}},
                    {{0.7, 0.014, 4200, 0.8}}};
        case Sound::darbuka_ka:
            return {{{445, 0.4, 0.07}, {915, 0.5, 0.06}, {1480, 0.4, 0.05}},
                    {{0.7, 0.012, 3600, 0.8}}};
        default:  // riq: jingles
            return {{{5230, 0.16, 0.10}, {6810, 0.16, 0.12}, {8470, 0.12, 0.09}},
                    {{0.8, 0.06, 8600, 1.0, 0.001}}};
    }
}

// The sounds of each group follow each other in Sound.
Recipe recipe_of(Sound sound) {
    if (sound <= Sound::crash) {
        return kit_recipe(sound);
    }
    return sound <= Sound::cascara ? latin_recipe(sound) : oriental_recipe(sound);
}

// Until everything has fallen by somewhat more than 60 dB.
double length_of(const Recipe& recipe) {
    double seconds = 0.02;
    for (const Partial& partial : recipe.partials) {
        seconds = std::max(seconds, 1.2 * partial.t60);
    }
    for (const Burst& burst : recipe.bursts) {
        seconds = std::max(seconds, burst.delay + burst.rise + 1.2 * burst.t60);
    }
    return seconds;
}

// A decaying sine with falling pitch; variants differ by 0.4 % in tuning.
void add_partial(const Partial& partial,
                 const Recipe& recipe,
                 const SoundRequest& request,
                 std::vector<double>& out) {
    // A click starts at its peak: its first sample is its onset. Everything else starts at 0.
    const bool is_click = request.sound <= Sound::click_low;
    const double decay = decay_per_sample(partial.t60, request.rate);
    double phase = is_click ? 0.25 * kTwoPi : 0.0;
    double level = partial.gain;
    double drop = recipe.drop;
    const double drop_decay = std::exp(-1.0 / (recipe.drop_time * request.rate));
    const double tune = 1.0 + 0.004 * (request.variant - 1);
    for (double& sample : out) {
        sample += level * std::sin(phase);
        phase += kTwoPi * partial.hertz * tune * (1.0 + drop) / request.rate;
        level *= decay;
        drop *= drop_decay;
    }
}

// Filtered noise; each burst and variant has noise of its own, the same in every run.
void add_burst(const Burst& burst,
               const SoundRequest& request,
               const CounterRandom& random,
               std::vector<double>& out) {
    StateVariableFilter filter(burst.centre, burst.q, request.rate);
    const double decay = decay_per_sample(burst.t60, request.rate);
    const auto first = static_cast<std::size_t>(burst.delay * request.rate);
    double level = burst.gain;
    for (std::size_t i = first; i < out.size(); ++i) {
        const double rise = static_cast<double>(i - first + 1) / (burst.rise * request.rate);
        filter.feed(2.0 * random.uniform(i) - 1.0);
        out[i] += level * std::min(rise, 1.0) * filter.band();
        level *= decay;
    }
}

}  // namespace

std::vector<float> synthesize_drum(const SoundRequest& request) {
    const Recipe recipe = recipe_of(request.sound);
    const double seconds = length_of(recipe);
    std::vector<double> sum(static_cast<std::size_t>(seconds * request.rate), 0.0);
    for (const Partial& partial : recipe.partials) {
        add_partial(partial, recipe, request, sum);
    }
    const auto sound = static_cast<std::uint64_t>(request.sound);
    for (std::size_t i = 0; i < recipe.bursts.size(); ++i) {
        const auto variant = static_cast<std::uint64_t>(request.variant);
        add_burst(recipe.bursts[i], request, CounterRandom(sound, 64 * variant + i), sum);
    }
    std::vector<float> out(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
        // 5 ms of fade at the end.
        const double t = static_cast<double>(sum.size() - i) / request.rate;
        out[i] = static_cast<float>(sum[i] * std::min(t / 0.005, 1.0));
    }
    return out;
}

// Sounds are mixed by their peak, so all have the same.
std::vector<float> synthesize(const SoundRequest& request) {
    std::vector<float> out =
        is_pitched(request.sound) ? synthesize_tone(request) : synthesize_drum(request);
    float peak = 1e-9F;
    for (const float sample : out) {
        peak = std::max(peak, std::abs(sample));
    }
    for (float& sample : out) {
        sample /= peak;
    }
    return out;
}

}  // namespace raks::audio
