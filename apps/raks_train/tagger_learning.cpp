#include "apps/raks_train/tagger_learning.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/terminal/say.hpp"
#include "audio/evaluate/genre_folder.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/io/audio_file.hpp"
#include "base/parallel.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "training/genre/tagger_trainer.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Keeps what a tagger says of each patch.
class KeepWords final : public audio::MusicAnalyzer::Sink {
 public:
    explicit KeepWords(audio::TagSource& tags) : tags_(tags) {}
    void on_state(const MusicState& state) noexcept override {
        genre = state.genre;
        const audio::TaggerWord& word = tags_.word();
        if (word.patches > 0 && (word.patches != patches_ || word.until != until_)) {
            patches.push_back(word.embedding);
        }
        patches_ = word.patches;
        until_ = word.until;
    }
    std::vector<std::array<float, audio::kTagFeatures>> patches;
    DanceId genre = DanceId::none;  // that is recognised at the end

 private:
    audio::TagSource& tags_;
    std::uint32_t patches_ = 0;
    StreamTime until_{};
};

struct Heard {
    audio::TaggedPiece piece;
    bool is_right = false;  // the dance is recognised at the end
};

Expected<Heard> heard_with(const audio::MusicFile& file, const engine::AnalyzerModels& models) {
    const auto music = audio::read_all_mono(file.path);
    if (!music) {
        return fail(music.error());
    }
    const auto tags = engine::make_tagger(models);
    auto analyzer = engine::make_analyzer(music->rate, models, audio::BeatMethod::pointer, tags);
    if (!analyzer) {
        return fail(analyzer.error());
    }
    KeepWords words(*tags);
    analyzer->process(music->samples, words);
    return Heard{{file.genre, file.group, std::move(words.patches)},
                 words.genre == models.dances->id_of(file.genre)};
}

// All files, each heard by itself; the order does not depend on the threads.
std::vector<Expected<Heard>> hear_all(const std::vector<audio::MusicFile>& files,
                                      const engine::AnalyzerModels& models,
                                      int threads) {
    std::vector<Expected<Heard>> heard(files.size(), Heard{});
    run_parallel(
        files.size(), threads, [&](std::size_t i) { heard[i] = heard_with(files[i], models); });
    return heard;
}

void say_how_many_are_right(const std::vector<audio::TaggedPiece>& pieces,
                            const std::vector<std::vector<float>>& held_out,
                            const std::vector<std::string>& genres) {
    std::vector<int> right(genres.size() + 1);
    std::vector<int> all(genres.size() + 1);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::size_t truth = audio::class_of(pieces[i].genre, genres);
        const auto best = std::max_element(held_out[i].begin(), held_out[i].end());
        ++all[truth];
        right[truth] += static_cast<std::size_t>(best - held_out[i].begin()) == truth ? 1 : 0;
    }
    for (std::size_t c = 0; c < all.size(); ++c) {
        say(fmt::format("{}: the tagger alone, held out by group: {} of {} right",
                        c < genres.size() ? genres[c] : "none of them",
                        right[c],
                        all[c]));
    }
}

}  // namespace

Expected<void> learn_tagger(const GenreOptions& options, const std::string& command) {
    auto model = audio::load_genre(options.tagger_for);
    if (!model) {
        return fail(model.error());
    }
    const auto models = engine::load_analyzer_models(options.dances, {});
    if (!models || !models->tagger) {
        return fail(models ? Error{models->tagger_note} : models.error());
    }
    const auto& recordings = options.recordings;
    auto files = recordings.index.empty()
                     ? audio::list_music(recordings.folder, *options.dances)
                     : audio::list_music(recordings.folder, recordings.index, *options.dances);
    if (!files) {
        return fail(files.error());
    }
    auto heard = hear_all(*files, *models, options.threads);
    std::vector<audio::TaggedPiece> pieces;
    std::vector<bool> is_free;
    std::set<std::string> credits;
    for (std::size_t i = 0; i < heard.size(); ++i) {
        if (!heard[i]) {
            say(heard[i].error().message + "; left out");
            continue;
        }
        pieces.push_back(std::move(heard[i]->piece));
        is_free.push_back((*files)[i].may_train || !recordings.trains_on_free_alone);
        const std::string& credit = (*files)[i].credit;
        if (is_free.back() && (*model)->attribution.find(credit) == std::string::npos) {
            credits.insert(credit);
        }
    }
    const std::vector<std::string>& genres = (*model)->genres;
    const auto held_out = audio::held_out_tagger(pieces, genres);
    if (!held_out) {
        return fail(held_out.error());
    }
    say_how_many_are_right(pieces, *held_out, genres);
    std::vector<const audio::TaggedPiece*> learnt;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (is_free[i]) {
            learnt.push_back(&pieces[i]);
        }
    }
    auto tagger = audio::fit_tagger(learnt, genres);
    if (!tagger) {
        return fail(tagger.error());
    }
    say(fmt::format("the tagger is fitted to {} recordings", learnt.size()));
    audio::GenreModel with_tagger = **model;
    with_tagger.tagger = std::move(*tagger);
    with_tagger.made_with += "; " + command;
    for (const std::string& credit : credits) {
        with_tagger.attribution += "; " + credit;
    }
    return audio::save_genre(with_tagger, options.output);
}

namespace {

std::size_t count_right(const std::vector<Expected<Heard>>& heard) {
    return static_cast<std::size_t>(std::count_if(
        heard.begin(), heard.end(), [](const auto& song) { return song && song->is_right; }));
}

}  // namespace

Expected<std::size_t> adapt_to_kept(const GenreOptions& options, const std::string& command) {
    auto models = engine::load_analyzer_models(options.dances, {});
    if (!models || !models->tagger) {
        return fail(models ? Error{models->tagger_note} : models.error());
    }
    if (!options.tagger_for.empty()) {
        auto model = audio::load_genre(options.tagger_for);
        if (!model) {
            return fail(model.error());
        }
        models->genres = std::move(*model);
    }
    const audio::GenreModel& base = *models->genres;
    if (!base.tagger) {
        return fail("the model has no part for the music tagger: learn it with --tagger-for");
    }
    const auto& files = options.recordings.kept;
    const auto before = hear_all(files, *models, options.threads);
    std::vector<const audio::TaggedPiece*> pieces;
    std::set<std::string> artists;
    for (const Expected<Heard>& song : before) {
        if (!song) {
            say(song.error().message + "; left out");
        } else if (audio::class_of(song->piece.genre, base.genres) < base.genres.size()) {
            pieces.push_back(&song->piece);
            artists.insert(song->piece.group);
        } else {
            say("left out: the model does not know " + song->piece.genre);
        }
    }
    auto tagger = audio::adapt_tagger(*base.tagger, pieces, base.genres);
    if (!tagger) {
        return fail(tagger.error());
    }
    auto adapted = std::make_shared<audio::GenreModel>(base);
    adapted->tagger = std::move(*tagger);
    adapted->made_with += "; " + command;
    models->genres = adapted;
    say(
        fmt::format("what the music tagger says of the dances is adapted to {} kept songs "
                    "(artists: {}), nothing else is learnt: {} of them recognised before, {} now",
                    pieces.size(),
                    artists.size(),
                    count_right(before),
                    count_right(hear_all(files, *models, options.threads))));
    auto saved = audio::save_genre(*adapted, options.output);
    return saved ? Expected<std::size_t>(files.size() - pieces.size()) : fail(saved.error());
}

}  // namespace raks::apps
