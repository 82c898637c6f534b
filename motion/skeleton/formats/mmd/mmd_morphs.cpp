#include "motion/skeleton/formats/mmd/mmd_morphs.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <unordered_map>

#include "motion/skeleton/formats/mmd/mmd_text.hpp"

namespace raks::motion {
namespace {

struct MorphRow {
    std::string_view name;        // UTF-8
    std::string_view expression;  // VRM 1.0
    bool is_written = false;      // the one that stands for the expression in files of ours
};

// Winks: models differ in which of a left or right eye they mean; this is MikuMikuDance's own.
constexpr std::array<MorphRow, kMmdMorphs> kMorphRows = {{
    {"まばたき", "blink", true},
    {"ウィンク", "blinkLeft", true},
    {"ウィンク２", "blinkLeft"},
    {"ウインク", "blinkLeft"},
    {"ウィンク右", "blinkRight", true},
    {"ｳｨﾝｸ２右", "blinkRight"},
    {"笑い", "happy"},
    {"にこり", "happy"},
    {"にやり", "happy"},
    {"にっこり", "happy", true},
    {"口角上げ", "happy"},
    {"あ", "aa", true},
    {"い", "ih", true},
    {"う", "ou", true},
    {"え", "ee", true},
    {"お", "oh", true},
    {"怒り", "angry", true},
    {"困る", "sad", true},
    {"悲しむ", "sad"},
    {"悲しい", "sad"},
    {"びっくり", "surprised", true},
    {"なごみ", "relaxed", true},
    {"じと目", "relaxed"},
    {"真面目", "angry"},
    {"ん", ""},
    {"上", ""},
    {"下", ""},
}};

std::unordered_map<std::string, std::size_t> morphs_by_bytes() {
    std::unordered_map<std::string, std::size_t> morphs;
    for (std::size_t i = 0; i < kMorphRows.size(); ++i) {
        const std::string name(kMorphRows[i].name);
        for (const std::string& spelling : {name, narrow(name)}) {
            for (const MmdCode code : kMmdCodes) {
                if (const auto bytes = mmd_bytes(spelling, code)) {
                    morphs.emplace(bytes->substr(0, kMmdNameBytes), i);
                }
            }
        }
    }
    return morphs;
}

}  // namespace

std::optional<std::size_t> mmd_morph_named(std::string_view bytes) {
    static const std::unordered_map<std::string, std::size_t> kMorphs = morphs_by_bytes();
    const auto found =
        kMorphs.find(std::string(bytes.substr(0, bytes.find('\0')).substr(0, kMmdNameBytes)));
    return found == kMorphs.end() ? std::nullopt : std::optional(found->second);
}

std::string_view mmd_morph_of(std::string_view expression) {
    const auto* const found =
        std::find_if(kMorphRows.begin(), kMorphRows.end(), [&](const MorphRow& row) {
            return row.is_written && row.expression == expression;
        });
    return found == kMorphRows.end() ? std::string_view() : found->name;
}

std::vector<ExpressionTrack> mmd_expressions(const MmdMotion& motion, std::size_t frames) {
    std::vector<ExpressionTrack> tracks;
    std::array<ExpressionTrack*, kMmdMorphs> of_morph{};
    tracks.reserve(kMmdMorphs);
    for (std::size_t i = 0; i < kMorphRows.size(); ++i) {
        const bool moves = std::any_of(motion.morphs[i].begin(),
                                       motion.morphs[i].end(),
                                       [](const MmdMorphKey& key) { return key.weight > 0.0F; });
        if (!moves || kMorphRows[i].expression.empty()) {
            continue;
        }
        const auto same = std::find_if(tracks.begin(), tracks.end(), [&](const auto& track) {
            return track.name == kMorphRows[i].expression;
        });
        if (same == tracks.end()) {
            tracks.push_back({.name = std::string(kMorphRows[i].expression),
                              .weights = std::vector<float>(frames, 0.0F)});
            of_morph[i] = &tracks.back();
        } else {
            of_morph[i] = &*same;
        }
    }
    if (tracks.empty()) {
        return tracks;
    }
    MmdSampler sampler(motion);
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const auto weights = sampler.morphs_at(static_cast<std::uint32_t>(frame));
        for (std::size_t i = 0; i < weights.size(); ++i) {
            if (of_morph[i] != nullptr) {
                float& weight = of_morph[i]->weights[frame];
                weight = std::max(weight, std::clamp(weights[i], 0.0F, 1.0F));
            }
        }
    }
    return tracks;
}

}  // namespace raks::motion
