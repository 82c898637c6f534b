#include "apps/raks_train/genre_adding.hpp"

#include <algorithm>
#include <utility>

#include "apps/raks_train/genre_features.hpp"
#include "audio/genre/genre_file.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// How a sample names the features that it was computed with.
std::string text_of(const audio::FeaturePlan& feature_plan, const audio::GenreFeatures& features) {
    return fmt::format("{:016x}", feature_key(feature_plan, features));
}

}  // namespace

Expected<GenreBase> load_base(const std::filesystem::path& model) {
    auto loaded = audio::load_genre(model);
    if (!loaded) {
        return fail(loaded.error());
    }
    // The sample lies beside the model under a name made from the model's.
    const std::filesystem::path beside = audio::samples_path(model);
    std::error_code ignored;
    if (!std::filesystem::exists(beside, ignored)) {
        return fail(fmt::format(
            "{}: is not there: what {} was learnt from was not kept; train it again with all its "
            "music",
            beside.string(),
            model.filename().string()));
    }
    // The sample stands in for the music of the old genres in the training.
    auto samples = audio::load_samples(beside);
    if (!samples) {
        return fail(samples.error());
    }
    // A sample of other genres would label its pieces wrongly.
    if (samples->genres != (*loaded)->genres) {
        return fail(fmt::format("{}: is of another model than {}; train it again",
                                beside.string(),
                                model.filename().string()));
    }
    return GenreBase{std::move(*loaded), std::move(*samples)};
}

Expected<void> check_features(const GenreBase& base,
                              const std::filesystem::path& model,
                              const audio::FeaturePlan& feature_plan) {
    // Features of two kinds in one training would separate the genres by their kind.
    if (base.samples.feature_key != text_of(feature_plan, base.model->features)) {
        return fail(audio::samples_path(model).string() +
                    ": was heard with other features or another beat network than this program "
                    "has; train the model again");
    }
    return {};
}

void keep_known(const GenreBase& base,
                const std::set<std::string>& renewed,
                audio::GenreModel& model) {
    // Genres are matched by name: the new model may number them otherwise.
    for (std::size_t i = 0; i < model.genres.size(); ++i) {
        const auto& known = base.model->genres;
        const auto found = std::find(known.begin(), known.end(), model.genres[i]);
        if (found != known.end() && !renewed.contains(model.genres[i])) {
            model.mfcc[i] = base.model->mfcc[static_cast<std::size_t>(found - known.begin())];
        }
    }
}

Expected<void> keep_samples(const GenreOptions& options,
                            const audio::FeaturePlan& feature_plan,
                            std::span<const std::string> genres,
                            std::span<const audio::PieceFeatures* const> pieces) {
    if (options.sample_kilobytes == 0 || options.output.empty()) {
        return {};
    }
    // The option is in kilobytes of 1,000 bytes.
    const auto bytes = static_cast<std::size_t>(options.sample_kilobytes) * 1'000;
    const audio::GenreSamples samples{text_of(feature_plan, options.plan.features),
                                      {genres.begin(), genres.end()},
                                      options.plan.written_networks,
                                      audio::sample_pieces(pieces, genres, bytes, options.seed)};
    return audio::save_samples(samples, audio::samples_path(options.output));
}

}  // namespace raks::apps
