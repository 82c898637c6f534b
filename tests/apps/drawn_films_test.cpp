// Films that are drawn of a known dance: markers are found in them where they are.
#include "apps/raks_capture/drawn_films.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks_capture/film_detections.hpp"
#include "apps/raks_capture/filmed_picture.hpp"
#include "base/file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

constexpr double kPicturesASecond = 30.0;
constexpr std::size_t kPictures = 6;

/// A dancer who lifts the arms to the side and turns.
std::vector<motion::Pose> lifted_arms() {
    std::vector<motion::Pose> poses;
    for (std::size_t i = 0; i < kPictures; ++i) {
        const float lift = 1.0F - 0.08F * static_cast<float>(i);
        motion::Pose pose;
        pose.hips_position = {0.0F, motion::mannequin_skeleton().hips_height(), 0.0F};
        pose.rotation(motion::Bone::hips) =
            glm::angleAxis(0.05F * static_cast<float>(i), glm::vec3(0.0F, 1.0F, 0.0F));
        pose.rotation(motion::Bone::left_upper_arm) = glm::quat(glm::vec3(0.0F, 0.0F, -lift));
        pose.rotation(motion::Bone::right_upper_arm) = glm::quat(glm::vec3(0.0F, 0.0F, lift));
        poses.push_back(pose);
    }
    return poses;
}

class DrawnFilms : public ::testing::Test {
 protected:
    DrawnFilms() : poses_(lifted_arms()), rig_(capture::studio_rig(3, 640, 480)) {
        rig_.cameras[0].lens.distortion = {-0.12, 0.05, 0.001, -0.0005, 0.0};
        motion_ = {.skeleton = motion::mannequin_skeleton(),
                   .poses = poses_,
                   .frames_per_second = kPicturesASecond};
        clean_ = capture::film_points(
            motion_,
            rig_,
            markers_,
            {.frames_per_second = kPicturesASecond, .noise = 0.0, .merge = 0.0});
    }

    [[nodiscard]] Expected<std::vector<fs::path>> draw(const DrawnFilmOptions& options) const {
        return draw_films(motion_, rig_, markers_, clean_.clocks, folder_.path(), options);
    }
    [[nodiscard]] std::vector<CameraFilm> films_of(const std::vector<fs::path>& paths) const {
        std::vector<CameraFilm> films;
        for (std::size_t i = 0; i < paths.size(); ++i) {
            films.push_back({rig_.cameras[i].name, paths[i]});
        }
        return films;
    }

    raks::test::TemporaryFolder folder_;
    std::vector<motion::Pose> poses_;
    capture::Rig rig_;
    capture::MarkerSet markers_ = capture::default_markers();
    capture::StudioMotion motion_;
    capture::StudioTake clean_;
};

// Distances of the true detections from the nearest that were found of their colour.
std::vector<double> distances(const capture::SeenFilm& truth, const capture::SeenFilm& found) {
    std::vector<double> result;
    for (std::size_t i = 0; i < truth.pictures.size(); ++i) {
        for (const capture::Detection& known : truth.pictures[i].detections) {
            double nearest = 1e9;
            for (const capture::Detection& seen : found.pictures[i].detections) {
                if (seen.colour == known.colour) {
                    nearest = std::min(nearest, glm::distance(seen.pixel, known.pixel));
                }
            }
            result.push_back(nearest);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

TEST_F(DrawnFilms, show_the_markers_where_they_are) {
    const auto paths = draw({.frames_per_second = kPicturesASecond});
    ASSERT_TRUE(paths) << paths.error().message;
    // For whoever wants to look at them.
    if (const char* const keep = std::getenv("RAKS_KEEP_FILMS"); keep != nullptr) {
        fs::copy(folder_.path(),
                 keep,
                 fs::copy_options::overwrite_existing | fs::copy_options::recursive);
    }
    const auto found = detect_in_films(films_of(*paths), markers_, clean_.labels);
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_EQ(found->seen.films.size(), rig_.cameras.size());
    EXPECT_EQ(found->seen.colours, clean_.seen.colours);
    std::size_t false_ones = 0;
    for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
        const capture::SeenFilm& seen = found->seen.films[i];
        EXPECT_EQ(seen.camera, rig_.cameras[i].name);
        ASSERT_EQ(seen.pictures.size(), kPictures);
        for (std::size_t k = 0; k < kPictures; ++k) {
            EXPECT_NEAR(seen.pictures[k].time, static_cast<double>(k) / kPicturesASecond, 1e-6);
        }
        const auto far = distances(clean_.seen.films[i], seen);
        std::printf("camera %zu: %zu markers seen, median %.2f, p90 %.2f px\n",
                    i,
                    far.size(),
                    far[far.size() / 2],
                    far[far.size() * 9 / 10]);
        // Markers that are half sunk into hair or skin show a part of themselves alone.
        EXPECT_LT(far[far.size() / 2], 0.75) << i;
        EXPECT_LT(far[far.size() * 8 / 10], 2.0) << i;
        for (const double distance : distances(seen, clean_.seen.films[i])) {
            false_ones += distance > 8.0 ? 1U : 0U;
        }
    }
    std::printf("spots that are no visible marker: %zu\n", false_ones);
    EXPECT_LT(false_ones, 4 * kPictures * rig_.cameras.size());
}

TEST_F(DrawnFilms, as_drafts_have_sound_and_are_the_same_again) {
    const std::vector<float> music(24'000, 0.25F);
    const DrawnFilmOptions options{
        .frames_per_second = kPicturesASecond, .is_draft = true, .ending = ".avi", .music = music};
    const auto paths = draw(options);
    ASSERT_TRUE(paths) << paths.error().message;
    const std::string first = read_file(paths->front()).value();
    fs::remove(paths->front());
    ASSERT_TRUE(draw(options));
    EXPECT_EQ(first, read_file(paths->front()).value());
    EXPECT_NE(first.find("auds"), std::string::npos);
}

TEST_F(DrawnFilms, are_refused_in_one_line) {
    markers_.markers.front().colour = "lilac";
    const auto unknown = draw({.is_draft = true});
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("lilac"), std::string::npos);
    markers_.markers.front().colour = "green";
    const auto stopped = draw({.is_draft = true, .is_stop_requested = [] { return true; }});
    ASSERT_FALSE(stopped);
    EXPECT_NE(stopped.error().message.find("was stopped"), std::string::npos);
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(DrawnFilms, whose_labels_are_wrong_are_refused_in_one_line) {
    const auto paths = draw({.frames_per_second = kPicturesASecond, .is_draft = true});
    ASSERT_TRUE(paths) << paths.error().message;
    const std::vector<CameraFilm> films = films_of(*paths);
    const auto error_with = [&](const capture::MarkerLabel& label) {
        std::vector<capture::MarkerLabel> labels = clean_.labels;
        labels.push_back(label);
        const auto found = detect_in_films(films, markers_, labels);
        return found ? "" : found.error().message;
    };
    // Before a label is blamed, the films are tried in another order.
    std::vector<CameraFilm> exchanged = films;
    std::swap(exchanged[0].path, exchanged[2].path);
    const auto mixed = detect_in_films(exchanged, markers_, clean_.labels);
    ASSERT_FALSE(mixed);
    EXPECT_NE(mixed.error().message.find("the film of camera \"cam1\" fits the place of \"cam3\""),
              std::string::npos)
        << mixed.error().message;
    const std::string camera = rig_.cameras[0].name;
    const std::string marker = markers_.markers[0].name;
    EXPECT_NE(error_with({"nobody", 0, marker, {5.0, 5.0}}).find("camera \"nobody\""),
              std::string::npos);
    EXPECT_NE(error_with({camera, 0, "nose", {5.0, 5.0}}).find("marker \"nose\""),
              std::string::npos);
    EXPECT_NE(error_with({camera, 99, marker, {5.0, 5.0}}).find("but the film has 6"),
              std::string::npos);
    // One label beside its marker does no harm where others show the colour.
    std::vector<capture::MarkerLabel> labels = clean_.labels;
    labels.push_back({camera, 0, marker, {900.0, 5.0}});
    labels.push_back({camera, 0, marker, {3.0, 5.0}});
    const auto found = detect_in_films(films, markers_, labels);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(std::any_of(found->doubts.begin(), found->doubts.end(), [](const auto& doubt) {
        return doubt.find("outside of the picture") != std::string::npos;
    }));
    // What was kept of a film is taken as it is; the others are handed over once they are whole.
    const std::vector<capture::SeenFilm> kept = {{rig_.cameras[1].name, {{0.5, {}}}}};
    std::vector<std::string> read;
    const auto rest = detect_in_films(
        films,
        markers_,
        clean_.labels,
        {.kept = kept, .take_film = [&](std::size_t, const capture::SeenFilm& film) {
             read.push_back(film.camera);
             return Expected<void>();
         }});
    ASSERT_TRUE(rest) << rest.error().message;
    std::sort(read.begin(), read.end());
    EXPECT_EQ(read, (std::vector<std::string>{rig_.cameras[0].name, rig_.cameras[2].name}));
    EXPECT_EQ(rest->seen.films[1], kept[0]);
    // A marker that lies behind another one shows that one's colour: its label is no lesson, and
    // true.
    const auto nearer =
        std::find_if(clean_.labels.begin(), clean_.labels.end(), [&](const auto& label) {
            return label.camera == camera && label.picture == 0 &&
                   markers_.markers[*markers_.index_of(label.marker)].colour !=
                       markers_.markers[0].colour;
        });
    ASSERT_NE(nearer, clean_.labels.end());
    std::vector<capture::MarkerLabel> hidden = clean_.labels;
    hidden.push_back({camera, 0, marker, nearer->pixel + glm::dvec2(1.0, 0.0)});
    const auto behind = detect_in_films(films, markers_, hidden);
    ASSERT_TRUE(behind) << behind.error().message;
    for (const std::string& doubt : behind->doubts) {
        EXPECT_EQ(doubt.find("shows another colour"), std::string::npos) << doubt;
    }
    const auto only = detect_in_films(
        std::span(films).first(1), markers_, std::vector(labels.end() - 2, labels.end()));
    ASSERT_FALSE(only);
    EXPECT_NE(only.error().message.find("outside of the picture"), std::string::npos);
    const auto without = detect_in_films(films, markers_, {});
    ASSERT_FALSE(without);
    EXPECT_NE(without.error().message.find("has no label; click its markers"), std::string::npos);
    const auto stopped =
        detect_in_films(films, markers_, clean_.labels, {.is_stop_requested = [] { return true; }});
    EXPECT_FALSE(stopped);
}

// A lens that bends shows straight things bent, by as much as its formula says.
TEST(FilmedPicture, bends_as_the_lens_does) {
    capture::Camera camera;
    camera.lens = {.width = 160, .height = 120, .fx = 120.0, .fy = 120.0, .cx = 79.5, .cy = 59.5};
    camera.lens.distortion = {-0.2, 0.03, 0.0, 0.0};
    for (const int scale : {1, 2}) {
        FilmedPicture filmed(camera, scale);
        const render::PinholeView& view = filmed.drawing();
        const glm::dvec2 direction(0.45, -0.30);
        const glm::dvec2 drawn(view.fx * direction.x + view.cx, view.fy * direction.y + view.cy);
        std::vector<std::uint8_t> rgba;
        for (int y = 0; y < static_cast<int>(view.height); ++y) {
            for (int x = 0; x < static_cast<int>(view.width); ++x) {
                const bool is_in = std::hypot(x - drawn.x, y - drawn.y) < 4.0 * scale;
                rgba.insert(rgba.end(), {std::uint8_t(is_in ? 255 : 0), 0, 0, 255});
            }
        }
        filmed.add(rgba);
        Dice dice(1, 0);
        const auto& picture = filmed.develop({.noise = 0.0}, dice);
        ASSERT_EQ(picture.size(), std::size_t{160} * 120 * 4);
        glm::dvec2 sum{};
        double weight = 0.0;
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                const double red = picture[static_cast<std::size_t>(4 * (y * 160 + x))];
                sum += red * glm::dvec2(x, y);
                weight += red;
            }
        }
        const glm::dvec2 expected = capture::distorted_pixel(camera.lens, direction);
        EXPECT_LT(glm::distance(sum / weight, expected), 0.15) << scale;
    }
}

}  // namespace
}  // namespace raks::apps
