#include "motion/skeleton/formats/motion_file.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/file.hpp"
#include "motion/skeleton/formats/acclaim.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/formats/json_arrays.hpp"
#include "motion/skeleton/formats/mmd/mmd_clip.hpp"
#include "motion/skeleton/formats/mmd/vpd.hpp"
#include "motion/skeleton/formats/motion_format.hpp"
#include "motion/skeleton/formats/npz.hpp"
#include "motion/skeleton/formats/points.hpp"
#include "motion/skeleton/formats/smpl.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

// A clip of either kind as what the door hands out.
template <typename Clip>
Expected<MotionFile> as_file(Expected<Clip> clip) {
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    return MotionFile(std::move(*clip));
}

Expected<MotionFile> read_model(const ClipAddress& address, const MotionReadOptions& options) {
    if (!options.read_model) {
        return fail(address.file.string() + ": is a model, whose clips are not read here");
    }
    return as_file(options.read_model(address, options.frames_per_second));
}

Expected<MotionFile> read_smpl(Expected<NpzContent> arrays,
                               const std::string& name,
                               const MotionReadOptions& options) {
    if (!arrays) {
        return fail(std::move(arrays.error()).in(name));
    }
    auto clip = smpl_clip(*arrays, options.frames_per_second);
    if (!clip) {
        return fail(std::move(clip.error()).in(name));
    }
    return MotionFile(std::move(*clip));
}

// The motion, and its skeleton from the file beside it or the one that is named.
Expected<MotionFile> read_amc(std::string_view text,
                              const fs::path& path,
                              const MotionReadOptions& options) {
    const auto asf =
        options.skeleton.empty() ? find_asf(path, text) : Expected<fs::path>(options.skeleton);
    if (!asf) {
        return fail(asf.error());
    }
    const auto asf_text = read_file(*asf);
    if (!asf_text) {
        return fail(asf_text.error());
    }
    const auto skeleton = parse_asf(*asf_text, asf->string());
    if (!skeleton) {
        return fail(skeleton.error());
    }
    return as_file(parse_amc(text, path.string(), *skeleton, options.frames_per_second));
}

Expected<MotionFile> read_mmd(std::string_view bytes,
                              const std::string& name,
                              MotionFormat format,
                              const MotionReadOptions& options) {
    const double arm_angle = options.arm_angle.value_or(kMmdArmAngle);
    auto clip = format == MotionFormat::vmd ? parse_vmd(bytes, name, arm_angle)
                                            : parse_vpd(bytes, name, arm_angle);
    if (clip) {
        clip->frames_per_second = options.frames_per_second.value_or(clip->frames_per_second);
    }
    return as_file(std::move(clip));
}

}  // namespace

ClipAddress clip_address(const fs::path& argument) {
    const std::string text = argument.string();
    const std::size_t at = text.rfind('#');
    if (at == std::string::npos || is_there(argument)) {
        return {argument, ""};
    }
    return {text.substr(0, at), text.substr(at + 1)};
}

Expected<MotionFile> parse_motion(std::string_view bytes,
                                  const ClipAddress& address,
                                  const MotionReadOptions& options) {
    const std::string name = address.file.string();
    if (bytes.empty()) {
        return fail(name + ": is empty");
    }
    if (std::string refusal = refusal_of(bytes); !refusal.empty()) {
        return fail(name + ": " + std::move(refusal));
    }
    const auto format = motion_format(bytes, address.file);
    if (!format) {
        return fail(fmt::format(
            "{}: is not a motion file of a known kind; known: {}", name, kKnownMotionFormats));
    }
    if (*format != MotionFormat::model && !address.clip.empty()) {
        return fail(name + ": holds one clip, which has no name");
    }
    switch (*format) {
        case MotionFormat::bvh:
            return as_file(
                parse_bvh(bytes, name, {.frames_per_second = options.frames_per_second}));
        case MotionFormat::amc:
            return read_amc(bytes, address.file, options);
        case MotionFormat::asf:
            return fail(name + ": is a skeleton without motion; give its .amc");
        case MotionFormat::vmd:
        case MotionFormat::vpd:
            return read_mmd(bytes, name, *format, options);
        case MotionFormat::smpl_npz:
            return read_smpl(read_npz(bytes, kSmplArrays), name, options);
        case MotionFormat::smpl_json:
            return read_smpl(read_json_arrays(bytes, kSmplArrays), name, options);
        case MotionFormat::model:
            return read_model(address, options);
        case MotionFormat::c3d:
            return as_file(parse_c3d(bytes, name, options.frames_per_second));
        case MotionFormat::trc:
            return as_file(parse_trc(bytes, name, options.frames_per_second));
        case MotionFormat::csv:
            return as_file(parse_points_csv(bytes, name, options.frames_per_second));
    }
    return fail(name + ": is not of a known kind");
}

Expected<MotionFile> read_motion(const fs::path& path, const MotionReadOptions& options) {
    const ClipAddress address = clip_address(path);
    const auto bytes = read_file(address.file);
    if (!bytes) {
        return fail(bytes.error());
    }
    return parse_motion(*bytes, address, options);
}

Expected<MotionClip> read_skeleton_motion(const fs::path& path, const MotionReadOptions& options) {
    auto file = read_motion(path, options);
    if (!file) {
        return fail(std::move(file.error()));
    }
    if (auto* const clip = std::get_if<MotionClip>(&*file)) {
        return std::move(*clip);
    }
    return fail(
        fmt::format("{}: holds {} points, but joints are needed here "
                    "(raks stick shows them)",
                    path.string(),
                    std::get<PointClip>(*file).names.size()));
}

}  // namespace raks::motion
