#include "motion/capture/calibration/rig_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/printable.hpp"
#include "motion/capture/calibration/floor.hpp"
#include "motion/capture/calibration/lens_fit.hpp"
#include "motion/capture/calibration/rig_adjustment.hpp"
#include "motion/capture/calibration/rig_start.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {

namespace {

// The sightings that are calibrated with, and those that are held out.
struct Shares {
    std::vector<Sighting> used;
    std::vector<Sighting> held_out;
};

Shares shares_of(const std::vector<Sighting>& sightings, const CalibrationSettings& settings) {
    std::map<std::size_t, std::size_t> cameras_at;
    for (const Sighting& sighting : sightings) {
        ++cameras_at[sighting.moment];
    }
    std::set<std::size_t> held_out;
    std::size_t shared = 0;
    const std::size_t every = std::max<std::size_t>(settings.held_out_every, 2);
    for (const auto& [moment, cameras] : cameras_at) {
        if (cameras >= 2 && moment != settings.floor_moment && ++shared % every == 0) {
            held_out.insert(moment);
        }
    }
    Shares shares;
    for (const Sighting& sighting : sightings) {
        (held_out.contains(sighting.moment) ? shares.held_out : shares.used).push_back(sighting);
    }
    return shares;
}

Expected<void> check_all_see(const std::vector<FilmedCamera>& cameras,
                             const std::vector<Sighting>& sightings) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        if (std::none_of(sightings.begin(), sightings.end(), [i](const Sighting& sighting) {
                return sighting.camera == i;
            })) {
            return fail(fmt::format(
                "camera \"{}\" never saw the board: is it this board, and is it sharp in the film?",
                printable(cameras[i].name)));
        }
    }
    return {};
}

// Fits every lens; its figures and doubts go into the calibration.
Expected<void> fit_lenses(const Board& board,
                          const std::vector<FilmedCamera>& cameras,
                          const std::vector<Sighting>& used,
                          const CalibrationSettings& settings,
                          RigCalibration& calibration) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const FilmedCamera& camera = cameras[i];
        std::vector<std::vector<BoardCorner>> views = camera.lens_views;
        for (const Sighting& sighting : used) {
            if (sighting.camera == i) {
                views.push_back(sighting.corners);
            }
        }
        const std::string name = fmt::format("camera \"{}\"", printable(camera.name));
        const auto fit = fit_lens(
            camera.width, camera.height, board, views, {.coefficients = settings.coefficients});
        if (!fit) {
            return fail(Error(fit.error()).in(name));
        }
        for (const std::string& doubt : fit->doubts) {
            calibration.doubts.push_back(fmt::format("{}: {}", name, doubt));
        }
        calibration.rig.cameras.push_back({camera.name, fit->lens, glm::dmat3(1.0), {}});
        calibration.cameras.push_back({.views = views.size(), .lens_rms = fit->rms});
    }
    return {};
}

// All together explain what they saw far worse than each alone: something moved, or the moments are
// not the same.
void doubt_contradictions(const Board& board, RigCalibration& calibration) {
    constexpr double kMuchWorse = 3.0;
    constexpr double kAtLeast = 1.0;  // pixels
    for (std::size_t i = 0; i < calibration.cameras.size(); ++i) {
        const CameraReport& report = calibration.cameras[i];
        if (report.rms > std::max(kAtLeast, kMuchWorse * report.lens_rms)) {
            calibration.doubts.push_back(
                fmt::format("camera \"{}\" is off by {:.2f} px with the others, by {:.2f} px "
                            "alone: are the films "
                            "in sync, and did it stand still?",
                            printable(calibration.rig.cameras[i].name),
                            report.rms,
                            report.lens_rms));
        }
    }
    constexpr double kBadEdges = 0.05;  // of their length
    const EdgeErrors& edges = calibration.held_out;
    if (edges.edges == 0) {
        calibration.doubts.emplace_back(
            "no board was left to measure by: film more of it where two cameras see it");
    } else if (edges.rms > kBadEdges * board.square) {
        calibration.doubts.push_back(fmt::format(
            "edges of boards that were held out are off by {:.1f} mm: film the board nearer, and "
            "larger in the pictures",
            edges.rms * 1e3));
    }
}

// Without a floor: the cameras' mean up as y, the lowest camera at y = 1.
void guess_floor(Rig& rig) {
    glm::dvec3 up{};
    for (const Camera& camera : rig.cameras) {
        up -= glm::transpose(camera.rotation)[1];
    }
    up = glm::length(up) > 1e-6 ? glm::normalize(up) : glm::dvec3(0.0, -1.0, 0.0);
    const glm::dvec3 forward = glm::transpose(rig.cameras.front().rotation)[2];
    glm::dvec3 x = glm::cross(forward, up);
    x = glm::length(x) > 1e-6 ? glm::normalize(x) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dmat3 rotation = glm::transpose(glm::dmat3(x, up, glm::cross(x, up)));
    rig.floor = FloorOrigin::unknown;
    double lowest = 1e9;
    for (Camera& camera : rig.cameras) {
        camera.rotation = camera.rotation * glm::transpose(rotation);
        lowest = std::min(lowest, camera.centre().y);
    }
    for (Camera& camera : rig.cameras) {
        camera.translation += camera.rotation * glm::dvec3(0.0, lowest - 1.0, 0.0);
    }
}

void find_floor(const Board& board,
                const std::vector<Sighting>& sightings,
                const CalibrationSettings& settings,
                RigCalibration& calibration) {
    if (!settings.floor_moment) {
        guess_floor(calibration.rig);
        calibration.doubts.emplace_back(
            "no floor: lay the board on it for a moment and say when; until then up is the "
            "cameras' mean up, and the floor is guessed from the feet");
        return;
    }
    std::vector<Sighting> seen;
    std::copy_if(
        sightings.begin(), sightings.end(), std::back_inserter(seen), [&](const auto& one) {
            return one.moment == *settings.floor_moment;
        });
    const auto found = put_on_floor(calibration.rig, board, seen);
    calibration.has_floor = found.has_value();
    if (found) {
        return;
    }
    guess_floor(calibration.rig);
    calibration.doubts.push_back(
        fmt::format("no floor: {}; until then up is the cameras' mean up, and the floor is guessed "
                    "from the feet",
                    found.error().message));
    if (seen.empty()) {
        calibration.doubts.push_back(lying_board_size(calibration.rig, board));
    }
}

// How far from the middle of its picture each camera saw a corner of the board; pixels.
std::vector<double> used_radii(const Rig& rig, const std::vector<Sighting>& sightings) {
    std::vector<double> radii(rig.cameras.size());
    for (const Sighting& sighting : sightings) {
        const Lens& lens = rig.cameras[sighting.camera].lens;
        for (const BoardCorner& corner : sighting.corners) {
            radii[sighting.camera] = std::max(
                radii[sighting.camera], glm::distance(corner.pixel, glm::dvec2(lens.cx, lens.cy)));
        }
    }
    return radii;
}

std::vector<std::string> names_of(const std::vector<FilmedCamera>& cameras) {
    std::vector<std::string> names;
    names.reserve(cameras.size());
    for (const FilmedCamera& camera : cameras) {
        names.push_back(camera.name);
    }
    return names;
}

}  // namespace

Expected<RigCalibration> calibrate_rig(const Board& board,
                                       const std::vector<FilmedCamera>& cameras,
                                       const std::vector<Sighting>& sightings,
                                       const CalibrationSettings& settings) {
    if (const auto checked = check_board(board); !checked) {
        return fail(checked.error());
    }
    if (cameras.size() < 2) {
        return fail(cameras.empty()
                        ? "no camera; two or more are needed"
                        : "one camera is too few: where something is, two or more tell");
    }
    const Shares shares = shares_of(sightings, settings);
    RigCalibration calibration{.rig = {},
                               .cameras = {},
                               .shared = SharedViews(shares.used, cameras.size()),
                               .held_out = {},
                               .used = {},
                               .doubts = {}};
    if (const auto checked = check_all_see(cameras, shares.used); !checked) {
        return fail(checked.error());
    }
    const std::vector<std::string> names = names_of(cameras);
    const auto joins = joins_of(calibration.shared, names);
    if (!joins) {
        return fail(joins.error());
    }
    if (const auto fitted = fit_lenses(board, cameras, shares.used, settings, calibration);
        !fitted) {
        return fail(fitted.error());
    }
    Rig& rig = calibration.rig;
    place_cameras(rig, board, shares.used, *joins);
    BoardPlaces places = place_boards(rig, board, shares.used);
    const LensFreedom freedom = settings.coefficients == 8 ? LensFreedom::eight : LensFreedom::five;
    const auto adjustment = adjust_rig(rig, places, board, shares.used, freedom);
    if (!adjustment) {
        return fail(adjustment.error());
    }
    calibration.rms = adjustment->rms;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        calibration.cameras[i].rms = adjustment->camera_rms[i];
    }
    calibration.held_out = edge_errors(rig, board, shares.held_out);
    calibration.used = edge_errors(rig, board, shares.used);
    for (std::string& line : weak_joins(*joins, names)) {
        calibration.doubts.push_back(std::move(line));
    }
    doubt_contradictions(board, calibration);
    find_floor(board, sightings, settings, calibration);
    if (const auto checked = check_rig(rig); !checked) {
        return fail(checked.error());
    }
    for (auto& doubts : {rig_doubts(rig), folding_doubts(rig, used_radii(rig, sightings))}) {
        calibration.doubts.insert(calibration.doubts.end(), doubts.begin(), doubts.end());
    }
    return calibration;
}

}  // namespace raks::capture
