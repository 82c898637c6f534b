#include "apps/raks_capture/colour_lessons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "engine/films/film_reader.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

constexpr double kLeastSeparation = 6.0;  // standard deviations between two colours
constexpr double kSameHue = 0.9;          // cosine between the chroma of two labels of a colour
// Of the richest label's distance from grey, that others of its colour differ at most.
constexpr double kSameColour = 0.3;

// The labels of one camera, by the picture in which they are.
using Lessons = std::map<std::size_t, std::vector<const capture::MarkerLabel*>>;

capture::PictureView view_of(const engine::FilmPicture& picture) {
    return {picture.width, picture.height, picture.rgb};
}

// The labelled pictures of a film, in the order of `lessons`.
Expected<std::vector<engine::FilmPicture>> labelled_pictures(const CameraFilm& film,
                                                             const Lessons& lessons,
                                                             const DetectionOptions& options) {
    const auto reader = open_film(film, options);
    if (!reader) {
        return fail(reader.error());
    }
    std::vector<engine::FilmPicture> pictures;
    const std::size_t last = lessons.rbegin()->first;
    for (std::size_t number = 0; number <= last; ++number) {
        auto picture = (*reader)->next();
        if (!picture) {
            return fail(picture.error());
        }
        if (!*picture) {
            return fail(fmt::format("{}: the label of {} is in picture {}, but the film has {}",
                                    film.path.string(),
                                    lessons.rbegin()->second.front()->marker,
                                    last,
                                    number));
        }
        if (lessons.contains(number)) {
            pictures.push_back(std::move(**picture));
        }
    }
    return pictures;
}

// A label of a colour, and what is learnt from it alone.
struct Lesson {
    const capture::MarkerLabel* label;
    capture::ColourPoint point;
    glm::dvec2 chroma{};
};

bool has_hue_of(const Lesson& a, const Lesson& b) {
    return glm::dot(a.chroma, b.chroma) > kSameHue * glm::length(a.chroma) * glm::length(b.chroma);
}

// The label of the hue that most labels have, and of these the most coloured: those of markers that
// are half hidden are paler, as skin and cloth mix into them.
const Lesson& clearest(const std::vector<Lesson>& lessons) {
    const auto rank = [&lessons](const Lesson& lesson) {
        const auto count =
            std::count_if(lessons.begin(), lessons.end(), [&lesson](const Lesson& other) {
                return has_hue_of(lesson, other);
            });
        return std::pair(count, glm::length(lesson.chroma));
    };
    return *std::max_element(lessons.begin(), lessons.end(), [&rank](const auto& a, const auto& b) {
        return rank(a) < rank(b);
    });
}

// The labels that show what the clearest does. The same hue, but paler, shows a marker that is half
// hidden or in the shade: the label is true, and only no lesson. The rest lie beside their markers.
std::vector<capture::ColourPoint> agreed_points(const std::vector<Lesson>& lessons,
                                                std::vector<std::string>& doubts) {
    const Lesson& best = clearest(lessons);
    std::vector<capture::ColourPoint> points;
    for (const Lesson& lesson : lessons) {
        if (glm::distance(lesson.chroma, best.chroma) <= kSameColour * glm::length(best.chroma)) {
            points.push_back(lesson.point);
        } else if (!has_hue_of(lesson, best)) {
            doubts.push_back("camera " + lesson.label->camera + ": the label of " +
                             lesson.label->marker +
                             " shows another colour than others of its colour; it is left out");
        }
    }
    return points;
}

using LabelPoint = std::pair<const capture::MarkerLabel*, capture::ColourPoint>;

// The labels of one colour that show any colour, and why the others do not.
std::vector<Lesson> lessons_of(std::span<const capture::PictureView> views,
                               const std::vector<LabelPoint>& labels,
                               std::vector<std::string>& faults) {
    std::vector<Lesson> lessons;
    for (const auto& [label, point] : labels) {
        const auto alone =
            capture::learn_colour(views, std::span(&point, 1), capture::ChromaForm::normalised);
        if (alone) {
            lessons.push_back({label, point, alone->mean});
        } else {
            faults.push_back("camera " + label->camera + ": " + label->marker + ": " +
                             alone.error().message);
        }
    }
    return lessons;
}

// Learns one colour of one camera. Errors: no label shows it.
Expected<capture::ColourModel> learn_from(std::span<const capture::PictureView> views,
                                          const std::vector<LabelPoint>& labels,
                                          capture::ChromaForm form,
                                          std::vector<std::string>& doubts) {
    std::vector<std::string> faults;
    const std::vector<Lesson> lessons = lessons_of(views, labels, faults);
    if (lessons.empty()) {
        return fail(faults.front());
    }
    for (std::string& fault : faults) {
        doubts.push_back(std::move(fault) + "; this label is left out");
    }
    return capture::learn_colour(views, agreed_points(lessons, doubts), form);
}

void tell_likeness(const std::string& camera,
                   const LearntColours& learnt,
                   const std::vector<std::string>& names,
                   std::vector<std::string>& doubts) {
    for (std::size_t a = 0; a < learnt.models.size(); ++a) {
        for (std::size_t b = a + 1; b < learnt.models.size(); ++b) {
            const double apart = capture::separation(learnt.models[a], learnt.models[b]);
            if (apart < kLeastSeparation) {
                doubts.push_back(fmt::format(
                    "camera {}: {} and {} look alike ({:.1f} standard deviations apart, should be "
                    "{:.0f}); use another colour, or more light",
                    camera,
                    names[learnt.colours[a]],
                    names[learnt.colours[b]],
                    apart,
                    kLeastSeparation));
            }
        }
    }
}

/// The labelled pictures of a film, and where in them each colour is to be learnt.
struct Taught {
    std::vector<engine::FilmPicture> pictures;
    std::vector<std::vector<LabelPoint>> points;  // by colour of the marker set

    [[nodiscard]] std::vector<capture::PictureView> views() const {
        std::vector<capture::PictureView> views;
        for (const engine::FilmPicture& picture : pictures) {
            views.push_back(view_of(picture));
        }
        return views;
    }
};

// What the labels of `camera` say of a film.
Expected<Taught> taught_in(const CameraFilm& film,
                           const std::string& camera,
                           const capture::MarkerSet& markers,
                           std::span<const capture::MarkerLabel> labels,
                           const DetectionOptions& options) {
    Lessons lessons;
    for (const capture::MarkerLabel& label : labels) {
        if (label.camera == camera) {
            lessons[label.picture].push_back(&label);
        }
    }
    if (lessons.empty()) {
        return fail("camera " + camera + ": has no label; click its markers (raks capture label)");
    }
    auto pictures = labelled_pictures(film, lessons, options);
    if (!pictures) {
        return fail(pictures.error());
    }
    const std::vector<std::size_t> classes = markers.classes();
    Taught taught{std::move(*pictures), {}};
    taught.points.resize(markers.colours().size());
    std::size_t view = 0;
    for (const auto& [number, in_picture] : lessons) {
        for (const capture::MarkerLabel* const label : in_picture) {
            // That the marker is known was checked before.
            taught.points[classes[*markers.index_of(label->marker)]].push_back(
                {label, {view, label->pixel}});
        }
        ++view;
    }
    return taught;
}

// The labels of a colour that no label of another colour is near: two markers that lie over one
// another in a picture show the colour of the nearer one. All of them where none is so clear.
std::vector<LabelPoint> clear_points(const Taught& taught, std::size_t colour) {
    constexpr double kNear = 10.0;  // pixels
    const auto is_clear = [&](const LabelPoint& point) {
        for (std::size_t other = 0; other < taught.points.size(); ++other) {
            for (const LabelPoint& near : taught.points[other]) {
                if (other != colour && near.second.picture == point.second.picture &&
                    glm::distance(near.second.pixel, point.second.pixel) < kNear) {
                    return false;
                }
            }
        }
        return true;
    };
    std::vector<LabelPoint> clear;
    std::copy_if(taught.points[colour].begin(),
                 taught.points[colour].end(),
                 std::back_inserter(clear),
                 is_clear);
    return clear.empty() ? taught.points[colour] : clear;
}

// How many labels of a camera lie in a film on a colour that others of their colour show, too.
std::size_t fitting_labels(const CameraFilm& film,
                           const std::string& camera,
                           const capture::MarkerSet& markers,
                           std::span<const capture::MarkerLabel> labels,
                           const DetectionOptions& options) {
    CameraFilm any_size = film;
    any_size.width = 0;
    const auto taught = taught_in(any_size, camera, markers, labels, options);
    if (!taught) {
        return 0;
    }
    const std::vector<capture::PictureView> views = taught->views();
    std::size_t fitting = 0;
    for (const std::vector<LabelPoint>& points : taught->points) {
        std::vector<std::string> faults;
        const std::vector<Lesson> lessons = lessons_of(views, points, faults);
        if (!lessons.empty()) {
            const Lesson& best = clearest(lessons);
            fitting += static_cast<std::size_t>(
                std::count_if(lessons.begin(), lessons.end(), [&best](const Lesson& lesson) {
                    return has_hue_of(lesson, best);
                }));
        }
    }
    return fitting;
}

}  // namespace

std::string exchanged_films(std::span<const CameraFilm> films,
                            const capture::MarkerSet& markers,
                            std::span<const capture::MarkerLabel> labels,
                            const DetectionOptions& options) {
    std::vector<std::vector<std::size_t>> fitting(films.size());  // by camera, by film
    for (std::size_t camera = 0; camera < films.size(); ++camera) {
        for (const CameraFilm& film : films) {
            fitting[camera].push_back(
                fitting_labels(film, films[camera].camera, markers, labels, options));
        }
    }
    // Two films that both fit far better in each other's place.
    constexpr std::size_t kFewest = 5;
    for (std::size_t one = 0; one < films.size(); ++one) {
        for (std::size_t other = one + 1; other < films.size(); ++other) {
            const std::size_t as_named = fitting[one][one] + fitting[other][other];
            const std::size_t exchanged = fitting[one][other] + fitting[other][one];
            if (exchanged >= as_named + as_named / 2 + kFewest) {
                return fmt::format(
                    "the film of camera \"{}\" fits the place of \"{}\", and that one its place: "
                    "{} labels lie on a marker then, not {}; exchange them in capture.toml",
                    films[one].camera,
                    films[other].camera,
                    exchanged,
                    as_named);
            }
        }
    }
    return {};
}

Expected<LearntColours> learn_colours(const CameraFilm& film,
                                      const capture::MarkerSet& markers,
                                      std::span<const capture::MarkerLabel> labels,
                                      const DetectionOptions& options,
                                      std::vector<std::string>& doubts) {
    const auto taught = taught_in(film, film.camera, markers, labels, options);
    if (!taught) {
        return fail(taught.error());
    }
    const std::vector<capture::PictureView> views = taught->views();
    const std::vector<std::string> names = markers.colours();
    const std::vector<std::size_t> classes = markers.classes();
    LearntColours learnt;
    for (std::size_t colour = 0; colour < names.size(); ++colour) {
        if (taught->points[colour].empty()) {
            doubts.push_back("camera " + film.camera + ": no marker in " + names[colour] +
                             " has a label; they are not looked for");
            continue;
        }
        auto model = learn_from(views, clear_points(*taught, colour), options.form, doubts);
        if (!model) {
            return fail(model.error());
        }
        learnt.models.push_back(*model);
        learnt.colours.push_back(colour);
        learnt.markers.push_back(
            static_cast<std::size_t>(std::count(classes.begin(), classes.end(), colour)));
    }
    tell_likeness(film.camera, learnt, names, doubts);
    return learnt;
}

}  // namespace raks::apps
