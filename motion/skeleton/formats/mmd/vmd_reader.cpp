#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include "motion/skeleton/formats/mmd/mmd_morphs.hpp"
#include "motion/skeleton/formats/mmd/vmd.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr std::string_view kOldVmdHead = "Vocaloid Motion Data file";
constexpr std::size_t kVmdHeadBytes = 50;
constexpr std::size_t kOldVmdHeadBytes = 40;
constexpr std::size_t kBoneKeyBytes = 111;
constexpr std::size_t kMorphKeyBytes = 23;
constexpr std::size_t kCameraKeyBytes = 61;
constexpr std::size_t kLightKeyBytes = 28;
constexpr std::size_t kShadowKeyBytes = 9;
constexpr float kLargestMmdPlace = 1e6F;  // units
constexpr std::size_t kNamesCounted = 10'000;

// One record, or what is left of the bytes.
class VmdBytes {
 public:
    explicit VmdBytes(std::string_view bytes) : bytes_(bytes) {}

    [[nodiscard]] std::size_t left() const { return bytes_.size(); }
    std::string_view take(std::size_t count) {
        const std::string_view part = bytes_.substr(0, count);
        bytes_.remove_prefix(part.size());
        return part;
    }
    template <typename Number>
    Number number() {
        Number value{};
        const std::string_view part = take(sizeof(Number));
        std::memcpy(&value, part.data(), part.size());
        return value;
    }
    std::uint8_t byte() { return number<std::uint8_t>(); }
    glm::vec3 vector() {
        const float x = number<float>();
        const float y = number<float>();
        return {x, y, number<float>()};
    }

 private:
    std::string_view bytes_;
};
static_assert(std::endian::native == std::endian::little, "numbers are taken as they lie");

bool is_finite_place(const glm::vec3& v) {
    return std::abs(v.x) <= kLargestMmdPlace && std::abs(v.y) <= kLargestMmdPlace &&
           std::abs(v.z) <= kLargestMmdPlace;
}

// The words of one bone or morph, for a message.
std::string at_frame(std::string_view what, std::uint32_t frame) {
    return fmt::format("{} at frame {}", what, frame);
}

class VmdReader {
 public:
    explicit VmdReader(std::string_view bytes) : bytes_(bytes) {}

    Expected<VmdFile> read() {
        if (auto done = read_head(); !done) {
            return fail(std::move(done.error()));
        }
        for (const auto section : {&VmdReader::read_bones,
                                   &VmdReader::read_morphs,
                                   &VmdReader::read_camera,
                                   &VmdReader::skip_light,
                                   &VmdReader::skip_shadow,
                                   &VmdReader::read_switches}) {
            // Files of old versions end before later sections.
            if (bytes_.left() == 0) {
                break;
            }
            if (auto done = (this->*section)(); !done) {
                return fail(std::move(done.error()));
            }
        }
        sort();
        warn();
        return std::move(file_);
    }

 private:
    Expected<void> read_head() {
        const std::string_view head = bytes_.take(kVmdMark.size() + 10);
        const bool is_old = head.substr(0, kOldVmdHead.size()) == kOldVmdHead;
        const std::size_t rest = (is_old ? kOldVmdHeadBytes : kVmdHeadBytes) - 30;
        if (head.substr(0, kVmdMark.size()) != kVmdMark) {
            return fail("is not a motion of MikuMikuDance (VMD)");
        }
        if (bytes_.left() < rest) {
            return fail("ends within its head: it is cut off");
        }
        static_cast<void>(bytes_.take(rest));  // the model's name
        return {};
    }

    // The count of a section whose records have a size; checked before anything is allocated.
    Expected<std::size_t> read_count(std::string_view section, std::size_t size) {
        if (bytes_.left() < sizeof(std::uint32_t)) {
            return fail(fmt::format("ends within its {}: it is cut off", section));
        }
        const std::size_t count = bytes_.number<std::uint32_t>();
        if (count > bytes_.left() / size) {
            return fail(
                fmt::format("declares {} keys of its {}, but bytes for {} are there: it is "
                            "cut off or damaged",
                            count,
                            section,
                            bytes_.left() / size));
        }
        return count;
    }

    static Expected<void> check_frame(std::string_view what, std::uint32_t frame) {
        return frame <= kMostMmdFrames
                   ? Expected<void>()
                   : fail(fmt::format("has a key of {}, which is after more than an hour: it is "
                                      "damaged",
                                      at_frame(what, frame)));
    }
    static tl::unexpected<Error> not_finite(std::string_view what, std::uint32_t frame) {
        return fail(
            fmt::format("{}: a number is not finite, or impossibly large", at_frame(what, frame)));
    }

    Expected<void> read_bones() {
        const auto count = read_count("bones", kBoneKeyBytes);
        if (!count) {
            return fail(count.error());
        }
        for (std::size_t i = 0; i < *count; ++i) {
            VmdBytes record(bytes_.take(kBoneKeyBytes));
            const std::string_view name = record.take(kMmdNameBytes);
            const auto bone = mmd_bone_named(name);
            if (!bone) {
                ++foreign_keys_;
                if (foreign_bones_.size() < kNamesCounted) {
                    foreign_bones_.insert(name.substr(0, name.find('\0')));
                }
                continue;
            }
            if (auto read = read_bone(*bone, record); !read) {
                return read;
            }
        }
        return {};
    }

    Expected<void> read_bone(MmdBone bone, VmdBytes& record) {
        MmdBoneKey key;
        key.frame = record.number<std::uint32_t>();
        const glm::vec3 place = record.vector();
        const glm::vec3 axis = record.vector();
        const float w = record.number<float>();
        const float size = std::sqrt(glm::dot(axis, axis) + w * w);
        if (auto checked = check_frame(mmd_name(bone), key.frame); !checked) {
            return checked;
        }
        if (!is_finite_place(place) || !std::isfinite(size)) {
            return not_finite(mmd_name(bone), key.frame);
        }
        key.place = static_cast<float>(kMmdMetres) * glm::vec3(place.x, place.y, -place.z);
        // All zero occurs, and means no turn.
        if (size > 0.0F) {
            key.turn = glm::quat(w / size, -axis.x / size, -axis.y / size, axis.z / size);
        }
        // Only the first number of each group counts, and of the first row two are overwritten by
        // the switch of the physics.
        const std::string_view curves = record.take(64);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const auto at = [&](std::size_t i) {
                return static_cast<std::uint8_t>(curves[16 * channel + i]);
            };
            key.curves[channel] = {at(0), at(4), at(8), at(12)};
        }
        has_stray_place_ = has_stray_place_ || (!has_mmd_place(bone) && key.place != glm::vec3(0));
        file_.motion.bones[index_of(bone)].push_back(key);
        return {};
    }

    Expected<void> read_morphs() {
        const auto count = read_count("morphs", kMorphKeyBytes);
        if (!count) {
            return fail(count.error());
        }
        for (std::size_t i = 0; i < *count; ++i) {
            VmdBytes record(bytes_.take(kMorphKeyBytes));
            const std::string_view name = record.take(kMmdNameBytes);
            const auto morph = mmd_morph_named(name);
            if (!morph) {
                if (foreign_morphs_.size() < kNamesCounted) {
                    foreign_morphs_.insert(name.substr(0, name.find('\0')));
                }
                continue;
            }
            MmdMorphKey key;
            key.frame = record.number<std::uint32_t>();
            key.weight = record.number<float>();
            const std::string what = fmt::format("morph {}", *morph + 1);
            if (auto checked = check_frame(what, key.frame); !checked) {
                return checked;
            }
            if (!(std::abs(key.weight) <= kLargestMmdPlace)) {
                return not_finite(what, key.frame);
            }
            file_.motion.morphs[*morph].push_back(key);
        }
        return {};
    }

    Expected<void> read_camera() {
        const auto count = read_count("camera", kCameraKeyBytes);
        if (!count) {
            return fail(count.error());
        }
        for (std::size_t i = 0; i < *count; ++i) {
            VmdBytes record(bytes_.take(kCameraKeyBytes));
            MmdCameraKey key;
            key.frame = record.number<std::uint32_t>();
            const float distance = record.number<float>();
            const glm::vec3 target = record.vector();
            key.turn = record.vector();
            const std::string_view curves = record.take(24);
            const auto angle = record.number<std::uint32_t>();
            key.has_perspective = record.byte() == 0;
            if (auto checked = check_frame("its camera", key.frame); !checked) {
                return checked;
            }
            if (!is_finite_place(target) || !is_finite_place(key.turn) ||
                !(std::abs(distance) <= kLargestMmdPlace) || angle > 360) {
                return not_finite("its camera", key.frame);
            }
            // The file's distance is that from the eye on to the target: below 0 as a rule.
            key.distance = -static_cast<float>(kMmdMetres) * distance;
            key.target = static_cast<float>(kMmdMetres) * glm::vec3(target.x, target.y, -target.z);
            key.view_angle = static_cast<float>(angle);
            for (std::size_t channel = 0; channel < key.curves.size(); ++channel) {
                const auto at = [&](std::size_t j) {
                    return static_cast<std::uint8_t>(curves[4 * channel + j]);
                };
                key.curves[channel] = {at(0), at(2), at(1), at(3)};
            }
            file_.camera.push_back(key);
        }
        return {};
    }

    Expected<void> skip(std::string_view section, std::size_t size) {
        const auto count = read_count(section, size);
        if (!count) {
            return fail(count.error());
        }
        static_cast<void>(bytes_.take(*count * size));
        return {};
    }
    Expected<void> skip_light() { return skip("light", kLightKeyBytes); }
    Expected<void> skip_shadow() { return skip("shadow", kShadowKeyBytes); }

    Expected<void> read_switches() {
        constexpr std::size_t kHead = 9;  // frame, visible, count
        constexpr std::size_t kSwitch = kMmdSwitchBytes + 1;
        const auto count = read_count("switches", kHead);
        if (!count) {
            return fail(count.error());
        }
        for (std::size_t i = 0; i < *count; ++i) {
            if (bytes_.left() < kHead) {
                return fail("ends within its switches: it is cut off");
            }
            const auto frame = bytes_.number<std::uint32_t>();
            static_cast<void>(bytes_.byte());  // whether the model is shown
            const std::size_t switches = bytes_.number<std::uint32_t>();
            if (switches > bytes_.left() / kSwitch) {
                return fail("ends within its switches: it is cut off or damaged");
            }
            for (std::size_t j = 0; j < switches; ++j) {
                const std::string_view name = bytes_.take(kMmdSwitchBytes);
                add_switch(mmd_bone_named(name, kMmdSwitchBytes), {frame, bytes_.byte() != 0});
            }
        }
        return {};
    }

    void add_switch(std::optional<MmdBone> bone, const MmdSwitchKey& key) {
        if (!bone || !side_of(*bone)) {
            return;
        }
        const auto side = static_cast<std::size_t>(*side_of(*bone));
        if (left_of(*bone) == MmdBone::left_leg_ik) {
            file_.motion.leg_ik[side].push_back(key);
        } else if (left_of(*bone) == MmdBone::left_toe_ik) {
            file_.motion.toe_ik[side].push_back(key);
        }
    }

    void sort() {
        const auto sort_all = [](auto& lists) {
            for (auto& keys : lists) {
                sort_keys(keys);
            }
        };
        sort_all(file_.motion.bones);
        sort_all(file_.motion.morphs);
        sort_all(file_.motion.leg_ik);
        sort_all(file_.motion.toe_ik);
        sort_keys(file_.camera);
    }

    void warn() {
        std::vector<std::string>& warnings = file_.motion.warnings;
        const auto number_of = [](const auto& names) {
            return fmt::format(
                "{}{}", names.size() < kNamesCounted ? "" : "more than ", names.size());
        };
        if (foreign_keys_ > 0) {
            warnings.push_back(fmt::format(
                "{} keys of {} bones that are none of a body (hair, clothes, physics, helpers) are "
                "left out",
                foreign_keys_,
                number_of(foreign_bones_)));
        }
        if (!foreign_morphs_.empty()) {
            warnings.push_back(fmt::format("{} morphs that no expression stands for are left out",
                                           number_of(foreign_morphs_)));
        }
        if (has_stray_place_) {
            warnings.emplace_back(
                "places of bones that do not move in a standard body are left "
                "out; their turns count");
        }
        if (bytes_.left() > 0) {
            warnings.push_back(fmt::format("{} bytes behind its end are left out", bytes_.left()));
        }
    }

    VmdBytes bytes_;
    VmdFile file_;
    std::size_t foreign_keys_ = 0;
    std::unordered_set<std::string_view> foreign_bones_;
    std::unordered_set<std::string_view> foreign_morphs_;
    bool has_stray_place_ = false;
};

}  // namespace

Expected<VmdFile> read_vmd(std::string_view bytes) { return VmdReader(bytes).read(); }

}  // namespace raks::motion
