// Film pictures: single pictures of several films, read beside the window that shows them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/raks_capture/film_detections.hpp"
#include "engine/films/film_reader.hpp"

namespace raks::apps {

/// A picture of a film, as it was asked for.
struct ShownPicture {
    std::shared_ptr<const engine::FilmPicture> picture;  ///< null: none yet, or a problem
    std::size_t number = 0;                              ///< of that picture, or problem
    std::string problem;               ///< one line why what was asked for is not there
    std::optional<std::size_t> count;  ///< pictures of the film, once its end was met
};

/// Reads pictures of films on a thread of its own, the last one asked for of each film. Films are
/// read from front to back, so that going on is quick, a few pictures back too, and far back means
/// reading from the start. Threads: one caller. Real-time: no.
class FilmPictures {
 public:
    /// A film without a path has no pictures.
    explicit FilmPictures(std::vector<CameraFilm> films);
    FilmPictures(const FilmPictures&) = delete;             ///< its thread refers to it
    FilmPictures& operator=(const FilmPictures&) = delete;  ///< likewise
    ~FilmPictures();                                        ///< stops reading

    /// Asks for a picture of a film. What was asked for of it before is forgotten.
    void want(std::size_t film, std::size_t number);
    /// What there is of a film now.
    [[nodiscard]] ShownPicture shown(std::size_t film) const;
    /// Whether something has changed since this was asked last.
    [[nodiscard]] bool take_news();

 private:
    struct Film {
        CameraFilm source;
        std::optional<std::size_t> wanted;  // what is still to be read
        ShownPicture shown;
        // The reader's thread alone:
        std::unique_ptr<engine::FilmReader> reader;
        std::size_t next = 0;  // number of the picture that the reader gives next
        std::deque<std::pair<std::size_t, std::shared_ptr<const engine::FilmPicture>>> recent;
    };
    void read();
    void serve(Film& film, std::size_t number);
    [[nodiscard]] bool is_still_wanted(const Film& film, std::size_t number) const;
    void finish(Film& film, std::size_t number, ShownPicture shown);
    void keep(Film& film, std::shared_ptr<const engine::FilmPicture> picture) const;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Film> films_;
    bool is_ending_ = false;
    bool has_news_ = false;
    std::jthread thread_;  // last: begins once all else is there
};

}  // namespace raks::apps
