#include "audio/music/styles/rhythm_styles.hpp"

#include "audio/music/styles/families.hpp"

namespace raks::audio {
namespace {

std::vector<RhythmStyle> all_styles() {
    std::vector<RhythmStyle> styles;
    for (auto* const family : {&caribbean_styles,
                               &african_styles,
                               &south_american_styles,
                               &belly_styles,
                               &pop_styles,
                               &electronic_styles,
                               &ballroom_styles}) {
        const std::vector<RhythmStyle> more = family();
        styles.insert(styles.end(), more.begin(), more.end());
    }
    return styles;
}

}  // namespace

std::span<const RhythmStyle> rhythm_styles() {
    static const std::vector<RhythmStyle> styles = all_styles();
    return styles;
}

}  // namespace raks::audio
