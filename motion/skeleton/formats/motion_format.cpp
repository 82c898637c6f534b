#include "motion/skeleton/formats/motion_format.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kWordsLookedAt = 4096;  // bytes of text in which a keyword is looked for

bool begins(std::string_view text, std::string_view start) {
    return text.substr(0, start.size()) == start;
}

// Without a byte order mark and blank lines.
std::string_view text_of(std::string_view start) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (begins(start, kByteOrderMark)) {
        start.remove_prefix(kByteOrderMark.size());
    }
    const std::size_t first = start.find_first_not_of(" \t\r\n\v\f");
    return first == std::string_view::npos ? std::string_view() : start.substr(first);
}

// Lines of an Acclaim file: comments, then keywords that begin with a colon.
std::optional<MotionFormat> acclaim_format(std::string_view text) {
    for (const Line& line : split_lines(text.substr(0, kWordsLookedAt))) {
        if (line.text.front() == '#') {
            continue;
        }
        if (line.text.front() != ':') {
            return std::nullopt;
        }
        const std::string word = lower(line.text);
        for (const std::string_view mark : {":fully-specified", ":degrees", ":radians"}) {
            if (begins(word, mark)) {
                return MotionFormat::amc;
            }
        }
        for (const std::string_view mark : {":version", ":name", ":units", ":root", ":bonedata"}) {
            if (begins(word, mark)) {
                return MotionFormat::asf;
            }
        }
        return std::nullopt;
    }
    return std::nullopt;
}

// A glTF as text has an "asset", which may come late.
MotionFormat json_format(std::string_view text) {
    text = text.substr(0, kMotionFormatBytes);
    for (const std::string_view key : {"\"asset\"", "\"nodes\"", "\"accessors\"", "\"buffers\""}) {
        if (text.find(key) != std::string_view::npos) {
            return MotionFormat::model;
        }
    }
    return MotionFormat::smpl_json;
}

std::optional<MotionFormat> format_of_content(std::string_view start) {
    // A C3D begins with the number of its parameter block and this key.
    constexpr char kC3dKey = 0x50;
    if (begins(start, "PK\x03\x04") || begins(start, "PK\x05\x06")) {
        return MotionFormat::smpl_npz;
    }
    if (begins(start, "glTF") || begins(start, "Kaydara FBX Binary") || begins(start, "; FBX ")) {
        return MotionFormat::model;
    }
    if (begins(start, "Vocaloid Motion Data")) {
        return MotionFormat::vmd;
    }
    const std::string_view text = text_of(start);
    if (begins(text, "Vocaloid Pose Data file")) {
        return MotionFormat::vpd;
    }
    const std::string word = lower(text.substr(0, 16));
    if (begins(word, "hierarchy")) {
        return MotionFormat::bvh;
    }
    if (begins(word, "pathfiletype")) {
        return MotionFormat::trc;
    }
    if (begins(text, "{")) {
        return json_format(text);
    }
    if (const auto acclaim = acclaim_format(text)) {
        return acclaim;
    }
    if (start.size() >= 512 && start[0] > 0 && start[1] == kC3dKey) {
        return MotionFormat::c3d;
    }
    return std::nullopt;
}

constexpr std::array<std::pair<std::string_view, MotionFormat>, 18> kEndings = {
    {{".bvh", MotionFormat::bvh},
     {".amc", MotionFormat::amc},
     {".asf", MotionFormat::asf},
     {".c3d", MotionFormat::c3d},
     {".trc", MotionFormat::trc},
     {".csv", MotionFormat::csv},
     {".tsv", MotionFormat::csv},
     {".vmd", MotionFormat::vmd},
     {".vpd", MotionFormat::vpd},
     {".npz", MotionFormat::smpl_npz},
     {".json", MotionFormat::smpl_json},
     {".gltf", MotionFormat::model},
     {".glb", MotionFormat::model},
     {".vrm", MotionFormat::model},
     {".vrma", MotionFormat::model},
     {".3ds", MotionFormat::model},
     {".fbx", MotionFormat::model},
     {".dae", MotionFormat::model}}};

std::optional<MotionFormat> format_of_ending(const std::filesystem::path& name) {
    const std::string ending = lower(name.extension().string());
    const auto* const found = std::find_if(
        kEndings.begin(), kEndings.end(), [&](const auto& each) { return each.first == ending; });
    return found == kEndings.end() ? std::nullopt : std::optional(found->second);
}

// Of Python's protocols 2 to 5 by their first bytes; 0 and 1 as they begin a dictionary, a list or
// an array.
bool is_pickle(std::string_view start) {
    constexpr std::array<std::string_view, 6> kOld = {
        "(dp", "(lp", "}q", "]q", "ccopy_reg\n", "cnumpy"};
    return (start.size() >= 2 && start[0] == '\x80' && start[1] >= 2 && start[1] <= 5) ||
           std::any_of(kOld.begin(), kOld.end(), [&](std::string_view mark) {
               return begins(start, mark);
           });
}

}  // namespace

std::optional<MotionFormat> motion_format(std::string_view start,
                                          const std::filesystem::path& name) {
    const auto shown = format_of_content(start);
    return shown ? shown : format_of_ending(name);
}

std::vector<std::string_view> motion_endings() {
    std::vector<std::string_view> endings;
    endings.reserve(kEndings.size());
    for (const auto& [ending, format] : kEndings) {
        endings.push_back(ending);
    }
    return endings;
}

bool is_clip_name(const std::filesystem::path& name) {
    switch (format_of_ending(name).value_or(MotionFormat::csv)) {
        case MotionFormat::bvh:
        case MotionFormat::amc:
        case MotionFormat::vmd:
        case MotionFormat::smpl_npz:
        case MotionFormat::model:
            return true;
        default:
            return false;
    }
}

std::string refusal_of(std::string_view start) {
    if (is_pickle(start)) {
        return "is a pickle, and pickles are programs, which are not run; where it comes from, "
               "save it with numpy.savez(\"x.npz\", poses=..., trans=...)";
    }
    if (begins(start, "\x93NUMPY")) {
        return "is one array alone, without a name; save it with numpy.savez(\"x.npz\", poses=..., "
               "trans=...)";
    }
    if (begins(start, "PXR-USDC") || begins(start, "#usda")) {
        return "is USD, which is not read; export it as glTF";
    }
    if (begins(start, "version https://git-lfs.")) {
        return "is a Git LFS pointer, not the file itself; fetch that (git lfs pull)";
    }
    if (begins(start, "PMX ") || begins(start, "Pmd")) {
        return "is a model of MikuMikuDance (PMX, PMD), which is not read; convert it to VRM, in "
               "Blender with MMD Tools and the VRM add-on";
    }
    const std::string word = lower(text_of(start).substr(0, 16));
    if (begins(word, "<!doctype html") || begins(word, "<html")) {
        return "is a web page, not a motion file; download the file itself";
    }
    return {};
}

}  // namespace raks::motion
