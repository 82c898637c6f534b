#include "apps/grid/take_music.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/dances/known_dances.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"
#include "engine/offline/song_planner.hpp"

namespace raks::apps {

Expected<TakeMusic> read_take_music(const std::filesystem::path& file) {
    const auto models = load_models_of_known_dances();
    if (!models) {
        return fail(models.error());
    }
    const auto plan = engine::plan_song(file, *models);
    if (!plan) {
        return fail(plan.error());
    }
    if (!*plan) {
        return fail(file.string() + ": is longer than an hour; give the part that was danced to");
    }
    TakeMusic take;
    take.music.name = file.filename().string();
    double most = 1e-6;
    for (const MusicState& state : (*plan)->states) {
        take.onsets.push_back(static_cast<double>(state.onset_strength));
        most = std::max(most, take.onsets.back());
    }
    for (double& onset : take.onsets) {
        onset /= most;
    }
    take.music.duration = static_cast<double>(take.onsets.size()) / kOnsetRate;
    for (const audio::SongBeat& beat : (*plan)->beats) {
        const double seconds = to_seconds(beat.time);
        if (take.music.beats.empty() || seconds > take.music.beats.back().seconds) {
            take.music.beats.push_back({seconds, beat.place.position + 1});
        }
    }
    if (take.music.beats.empty()) {
        return fail(file.string() + ": no beats were heard in it");
    }
    return take;
}

std::string offset_line(const std::string& song, const motion::MusicOffset& found) {
    constexpr double kSure = 4.0;  // deviations
    return fmt::format(
        "{}: by landings the clip begins {:.2f} s into it{}; a beat or a bar more is as good: "
        "look, "
        "and give --offset S",
        song,
        found.seconds,
        found.strength >= kSure ? "" : ", hardly surer than by chance");
}

}  // namespace raks::apps
