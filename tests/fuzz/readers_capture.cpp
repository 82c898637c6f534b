// What is done with files of cameras: what was read is written, and reads back to the same bits.
#include <cmath>
#include <string>

#include "motion/capture/camera/easymocap_rig.hpp"
#include "motion/capture/camera/lens_file.hpp"
#include "motion/capture/camera/qualisys_rig.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

/// What is true of every rig that was read.
bool is_sound_rig(const Expected<capture::RigFile>& file) {
    if (!file) {
        must_be_one_line(file.error().message);
        return false;
    }
    for (const std::string& note : file->notes) {
        must_be_one_line(note);
    }
    const auto again = capture::parse_rig(capture::rig_text(file->rig), "y.toml");
    must(again && again->rig == file->rig);
    for (const std::string& doubt : capture::rig_doubts(file->rig)) {
        must_be_one_line(doubt);
    }
    for (const capture::Camera& camera : file->rig.cameras) {
        static_cast<void>(capture::direction_of(camera.lens, {0.0, 0.0}));
    }
    return true;
}

}  // namespace

bool read_lens_file(std::string_view text) {
    const auto lens = capture::parse_lens_yaml(text, "x.yml");
    if (!lens) {
        must_be_one_line(lens.error().message);
        return false;
    }
    const auto again = capture::parse_lens_yaml(capture::lens_yaml_text(*lens), "y.yml");
    must(again && *again == *lens);
    static_cast<void>(capture::folding_radius(*lens));
    return true;
}

bool read_rig_file(std::string_view text) {
    return is_sound_rig(capture::parse_rig(text, "x.toml"));
}

bool read_easymocap_files(std::string_view text) {
    constexpr std::string_view kBetween = "\n=====\n";
    const std::size_t at = text.find(kBetween);
    const std::string_view places =
        at == std::string_view::npos ? std::string_view() : text.substr(at + kBetween.size());
    return is_sound_rig(
        capture::parse_easymocap_rig({text.substr(0, at), "intri.yml"}, {places, "extri.yml"}));
}

bool read_qualisys_file(std::string_view text) {
    return is_sound_rig(capture::parse_qualisys_rig(text, "x.xml"));
}

}  // namespace raks::fuzz
