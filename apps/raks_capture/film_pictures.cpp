#include "apps/raks_capture/film_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace raks::apps {
namespace {

constexpr std::size_t kKeptBytes = std::size_t{256} << 20U;  // of all films together

}  // namespace

FilmPictures::FilmPictures(std::vector<CameraFilm> films) {
    for (CameraFilm& film : films) {
        films_.emplace_back().source = std::move(film);
    }
    thread_ = std::jthread([this] { read(); });
}

FilmPictures::~FilmPictures() {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    changed_.notify_all();
}

void FilmPictures::want(std::size_t film, std::size_t number) {
    const std::lock_guard lock(mutex_);
    Film& wanted = films_[film];
    const bool is_answered = wanted.shown.number == number &&
                             (wanted.shown.picture != nullptr || !wanted.shown.problem.empty());
    if (wanted.source.path.empty() || (is_answered && !wanted.wanted) || wanted.wanted == number) {
        return;
    }
    wanted.wanted = number;
    changed_.notify_all();
}

ShownPicture FilmPictures::shown(std::size_t film) const {
    const std::lock_guard lock(mutex_);
    return films_[film].shown;
}

bool FilmPictures::take_news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(has_news_, false);
}

void FilmPictures::read() {
    std::size_t turn = 0;  // each film gets its own, also where one is asked for all the time
    for (;;) {
        Film* film = nullptr;
        std::size_t number = 0;
        {
            std::unique_lock lock(mutex_);
            const auto is_wanted = [](const Film& one) { return one.wanted.has_value(); };
            changed_.wait(lock, [&] {
                return is_ending_ || std::any_of(films_.begin(), films_.end(), is_wanted);
            });
            if (is_ending_) {
                return;
            }
            do {
                film = &films_[turn++ % films_.size()];
            } while (!film->wanted);
            number = *film->wanted;
        }
        serve(*film, number);
    }
}

bool FilmPictures::is_still_wanted(const Film& film, std::size_t number) const {
    const std::lock_guard lock(mutex_);
    return !is_ending_ && film.wanted == number;
}

void FilmPictures::finish(Film& film, std::size_t number, ShownPicture shown) {
    const std::lock_guard lock(mutex_);
    if (film.wanted == number) {
        film.wanted.reset();
    }
    shown.count = shown.count ? shown.count : film.shown.count;
    film.shown = std::move(shown);
    has_news_ = true;
}

void FilmPictures::keep(Film& film, std::shared_ptr<const engine::FilmPicture> picture) const {
    const std::size_t bytes = std::max<std::size_t>(picture->rgb.size(), 1);
    film.recent.emplace_back(film.next, std::move(picture));
    const std::size_t most = std::max<std::size_t>(kKeptBytes / films_.size() / bytes, 1);
    while (film.recent.size() > most) {
        film.recent.pop_front();
    }
}

// Reads until the picture is there, or another one is asked for.
void FilmPictures::serve(Film& film, std::size_t number) {
    const auto kept = std::find_if(film.recent.begin(), film.recent.end(), [&](const auto& one) {
        return one.first == number;
    });
    if (kept != film.recent.end()) {
        finish(film, number, {kept->second, number, {}, {}});
        return;
    }
    if (film.reader == nullptr || film.next > number) {
        DetectionOptions options;
        options.is_stop_requested = [this] {
            const std::lock_guard lock(mutex_);
            return is_ending_;
        };
        auto opened = open_film(film.source, options);
        if (!opened) {
            finish(film, number, {nullptr, number, opened.error().message, {}});
            return;
        }
        film.reader = std::move(*opened);
        film.next = 0;
        film.recent.clear();
    }
    while (is_still_wanted(film, number)) {
        auto picture = film.reader->next();
        if (!picture || !*picture) {
            film.reader.reset();
            ShownPicture ended{nullptr, number, {}, {}};
            if (!picture) {
                ended.problem = picture.error().message;
            } else {
                ended.count = film.next;
                ended.problem = fmt::format("the film has {} pictures", film.next);
            }
            finish(film, number, std::move(ended));
            return;
        }
        auto shared = std::make_shared<const engine::FilmPicture>(std::move(**picture));
        keep(film, shared);
        const std::size_t read = film.next++;
        if (read == number) {
            finish(film, number, {std::move(shared), number, {}, {}});
            return;
        }
    }
}

}  // namespace raks::apps
