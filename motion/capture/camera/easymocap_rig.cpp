#include "motion/capture/camera/easymocap_rig.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "motion/capture/camera/lens_file.hpp"
#include "motion/capture/camera/rotation.hpp"

namespace raks::capture {

namespace {

constexpr std::size_t kMostYamlCameras = 1000;
constexpr const char* kLensFile = "intri.yml";
constexpr const char* kPlaceFile = "extri.yml";

Expected<void> read_size(const YamlEntries& lenses, const std::string& name, Lens& lens) {
    if (!lenses.has("W_" + name) && !lenses.has("H_" + name)) {
        lens.width = static_cast<int>(2.0 * lens.cx + 1.0);
        lens.height = static_cast<int>(2.0 * lens.cy + 1.0);
        return {};
    }
    const auto width = lenses.picture_size("W_" + name);
    const auto height = lenses.picture_size("H_" + name);
    if (!width || !height) {
        return fail(width ? height.error() : width.error());
    }
    lens.width = *width;
    lens.height = *height;
    return {};
}

Expected<void> read_lens_of(const YamlEntries& lenses, const std::string& name, Lens& lens) {
    auto done = read_lens_matrix(lenses, "K_" + name, lens);
    if (done) {
        done = read_lens_distortion(lenses, "dist_" + name, lens);
    }
    if (done && !(lens.cx < 32'767.0 && lens.cy < 32'767.0 && lens.cx > 0.0 && lens.cy > 0.0)) {
        done = fail(lenses.complaint("K_" + name, "has its principal point outside of a picture"));
    }
    return done ? read_size(lenses, name, lens) : done;
}

// So many numbers of a key.
Expected<std::vector<double>> numbers_of(const YamlEntries& places,
                                         const std::string& key,
                                         std::size_t count) {
    auto numbers = places.matrix(key);
    if (numbers && numbers->size() != count) {
        return fail(places.complaint(key, fmt::format("must be {} numbers", count)));
    }
    return numbers;
}

Expected<void> read_place_of(const YamlEntries& places, const std::string& name, Camera& camera) {
    const bool is_matrix = places.has("Rot_" + name);
    const auto turn =
        is_matrix ? numbers_of(places, "Rot_" + name, 9) : numbers_of(places, "R_" + name, 3);
    const auto shift = numbers_of(places, "T_" + name, 3);
    if (!turn || !shift) {
        return fail(turn ? shift.error() : turn.error());
    }
    const std::vector<double>& r = *turn;
    camera.rotation = is_matrix ? glm::dmat3(r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8])
                                : rotation_of({r[0], r[1], r[2]});
    camera.translation = {(*shift)[0], (*shift)[1], (*shift)[2]};
    return {};
}

}  // namespace

Expected<RigFile> parse_easymocap_rig(const NamedText& lenses,
                                      const NamedText& places,
                                      const RigReading& reading) {
    const auto lens_entries = YamlEntries::parse(lenses.text, lenses.name);
    const auto place_entries = YamlEntries::parse(places.text, places.name);
    if (!lens_entries || !place_entries) {
        return fail(lens_entries ? place_entries.error() : lens_entries.error());
    }
    const auto names = lens_entries->words("names");
    if (!names) {
        return fail(names.error());
    }
    if (names->size() > kMostYamlCameras) {
        return fail(fmt::format(
            "{}: has {} cameras, more than {}", lenses.name, names->size(), kMostYamlCameras));
    }
    RigFile file;
    for (const std::string& name : *names) {
        Camera& camera = file.rig.cameras.emplace_back();
        camera.name = name;
        auto done = read_lens_of(*lens_entries, name, camera.lens);
        if (done) {
            done = read_place_of(*place_entries, name, camera);
        }
        if (!done) {
            return fail(std::move(done.error()));
        }
    }
    return settled_rig(std::move(file), {.metres_per_unit = 1.0, .up = {}}, reading, places.name);
}

Expected<RigFile> read_easymocap_rig(const std::filesystem::path& path,
                                     std::string_view text,
                                     const RigReading& reading) {
    const bool is_places = path.filename() == kPlaceFile;
    const std::filesystem::path other = path.parent_path() / (is_places ? kLensFile : kPlaceFile);
    if (other == path || !is_there(other)) {
        return fail(
            fmt::format("{}: EasyMocap's cameras are {} and {}, side by side: {} is not "
                        "there",
                        path.string(),
                        kLensFile,
                        kPlaceFile,
                        printable(other.string())));
    }
    const Expected<std::string> second = read_text_file(other, kLongestYaml);
    if (!second) {
        return fail(second.error());
    }
    const NamedText own{text, path.string()};
    const NamedText beside{*second, other.string()};
    return is_places ? parse_easymocap_rig(beside, own, reading)
                     : parse_easymocap_rig(own, beside, reading);
}

}  // namespace raks::capture
