#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/films/film_reader.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/pictures/chroma.hpp"

namespace raks::apps {

/// The film of one camera.
struct CameraFilm {
    std::string camera;          ///< its name in the rig
    std::filesystem::path path;  ///< a film, or a folder of numbered pictures
    int width = 0;               ///< of its pictures, as calibrated; 0: any
    int height = 0;              ///< likewise
};

/// How markers are looked for.
struct DetectionOptions {
    capture::ChromaForm form = capture::ChromaForm::normalised;
    double folder_pictures_per_second = 30.0;   ///< of folders of pictures; > 0
    int threads = 0;                            ///< films read at once; 0: as many as cores
    std::span<const capture::SeenFilm> kept{};  ///< films of these cameras are not read again
    /// Told from time to time, by one thread at a time: camera (its index), pictures done, pictures
    /// in all as the film claims (0: unknown).
    std::function<void(std::size_t camera, std::size_t done, std::size_t all)> tell_progress =
        [](std::size_t, std::size_t, std::size_t) {};
    /// Handed each film once it is whole, by one thread at a time. An error ends the work.
    std::function<Expected<void>(std::size_t camera, const capture::SeenFilm&)> take_film =
        [](std::size_t, const capture::SeenFilm&) { return Expected<void>(); };
    /// Asked before each picture, by any thread; true ends the work with an error.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// Opens a film as they say. Errors: those of the reader; pictures of another size than calibrated.
[[nodiscard]] Expected<std::unique_ptr<engine::FilmReader>> open_film(
    const CameraFilm& film, const DetectionOptions& options);

/// Pictures of a film in all, as it claims; 0: unknown.
[[nodiscard]] std::size_t claimed_pictures(const engine::FilmInfo& info);

/// What was found in the films, and what is doubtful about it.
struct FilmDetections {
    capture::Observations seen;       ///< as detections.csv has it; colours as of the marker set
    std::vector<std::string> doubts;  ///< one line each: films cut off, colours without a label or
                                      ///< too much alike, colours that were hardly ever seen
};

/// Finds the markers in every picture of every film (`raks capture track`): the colours are learnt,
/// for each camera by itself, from the labels of its film; then the whole of each picture is
/// searched. Means follow slow changes of the light. Several films at once, each by one thread, so
/// that the same films give the same bits; each is decoded in a process beside this one.
/// Labels that lie beside their marker are left out, with a doubt, where another shows its colour.
/// Errors, one line: no film; a film that cannot be read, or of another size than calibrated; a
/// label of an unknown camera or marker, or behind the film's end; a colour of which no label shows
/// it; a camera without any label; two films that were exchanged (exchanged_films), before a label
/// is blamed.
[[nodiscard]] Expected<FilmDetections> detect_in_films(std::span<const CameraFilm> films,
                                                       const capture::MarkerSet& markers,
                                                       std::span<const capture::MarkerLabel> labels,
                                                       const DetectionOptions& options = {});

}  // namespace raks::apps
