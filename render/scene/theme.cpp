#include "render/scene/theme.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "base/assert.hpp"
#include "base/toml_reader.hpp"
#include "render/scene/theme_text.hpp"

namespace raks::render {
namespace {

constexpr std::string_view kThemeFormat = "raks-theme";
constexpr std::int64_t kThemeVersion = 1;
constexpr NumberRange kLightRange{0.0, 10.0};
constexpr NumberRange kShareRange{0.0, 1.0};

using Keys = std::span<const std::string_view>;

/// Linear colour of an sRGB hexadecimal one. The exponent 2.2 is the inverse of the shaders' gamma,
/// so that a colour that is not lit comes out as written.
glm::vec3 srgb(std::uint32_t hex) noexcept {
    const auto channel = [hex](unsigned shift) {
        const auto byte = static_cast<float>((hex >> shift) & 0xFFU);
        return std::pow(byte / 255.0F, 2.2F);
    };
    return {channel(16), channel(8), channel(0)};
}

/// The number that "#a61b33" stands for.
std::optional<std::uint32_t> hex_of(std::string_view text) noexcept {
    if (text.size() != 7 || text.front() != '#') {
        return std::nullopt;
    }
    std::uint32_t number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + 1, end, number, 16);
    return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

/// Reads the tables of one theme over another theme's values.
class ThemeReader {
 public:
    ThemeReader(const toml::table& root, std::string file) : root_(root), complaints_(file) {}

    Expected<Theme> read(Theme theme) {
        constexpr std::array<std::string_view, 15> kKeys = {"format",
                                                            "version",
                                                            "listed",
                                                            "mannequin",
                                                            "sticks",
                                                            "backdrop",
                                                            "floor",
                                                            "rings",
                                                            "lights",
                                                            "exposure",
                                                            "tone_curve",
                                                            "show",
                                                            "tiles",
                                                            "beams",
                                                            "outfits"};
        complaints_.check_head(root_, kThemeFormat, kThemeVersion);
        complaints_.check_keys(root_, kKeys);
        truth(root_, "listed", theme.is_listed);
        truth(root_, "tone_curve", theme.has_tone_curve);
        number(root_, "exposure", {0.05, 10.0}, theme.exposure);
        read_bodies(theme);
        read_stage(theme);
        read_lights(theme);
        read_tiles(theme.tiles);
        read_beams(theme.beams);
        read_outfits(theme);
        if (!complaints_.is_sound()) {
            return fail(complaints_.fault());
        }
        return theme;
    }

 private:
    void read_bodies(Theme& theme) {
        constexpr std::array<std::string_view, 3> kMannequin = {"body", "bands", "edge"};
        constexpr std::array<std::string_view, 3> kSticks = {"middle", "left", "right"};
        if (const toml::table* const table = section(root_, "mannequin", kMannequin)) {
            colour(*table, "body", theme.body);
            colour(*table, "bands", theme.joint_bands);
            colour(*table, "edge", theme.band_edge);
        }
        if (const toml::table* const table = section(root_, "sticks", kSticks)) {
            colour(*table, "middle", theme.stick_middle);
            colour(*table, "left", theme.stick_left);
            colour(*table, "right", theme.stick_right);
        }
    }

    void read_stage(Theme& theme) {
        constexpr std::array<std::string_view, 3> kBackdrop = {"top", "glow", "horizon"};
        constexpr std::array<std::string_view, 3> kFloor = {"centre", "edge", "ambient"};
        constexpr std::array<std::string_view, 2> kRings = {"colour", "cover"};
        if (const toml::table* const table = section(root_, "backdrop", kBackdrop)) {
            colour(*table, "top", theme.background_top);
            colour(*table, "glow", theme.background_glow);
            colour(*table, "horizon", theme.background_horizon);
        }
        if (const toml::table* const table = section(root_, "floor", kFloor)) {
            colour(*table, "centre", theme.floor_centre);
            colour(*table, "edge", theme.floor_edge);
            number(*table, "ambient", kShareRange, theme.floor_ambient);
        }
        if (const toml::table* const table = section(root_, "rings", kRings)) {
            colour(*table, "colour", theme.ring);
            number(*table, "cover", kShareRange, theme.ring_cover);
        }
    }

    void read_lights(Theme& theme) {
        constexpr std::array<std::string_view, 5> kLights = {"key", "fill", "rim", "sky", "ground"};
        constexpr std::array<std::string_view, 3> kShow = {"range", "breakdown", "drop"};
        if (const toml::table* const table = section(root_, "lights", kLights)) {
            light(*table, "key", theme.key_light);
            light(*table, "fill", theme.fill_light);
            light(*table, "rim", theme.rim_light);
            light(*table, "sky", theme.sky_light);
            light(*table, "ground", theme.ground_light);
        }
        if (const toml::table* const table = section(root_, "show", kShow)) {
            number(*table, "range", kShareRange, theme.stage_range);
            tint(*table, "breakdown", theme.breakdown_tint);
            tint(*table, "drop", theme.drop_tint);
        }
    }

    void read_tiles(TileFloor& tiles) {
        constexpr std::array<std::string_view, 3> kTiles = {"size", "glow", "colours"};
        if (const toml::table* const table = section(root_, "tiles", kTiles)) {
            number(*table, "size", {0.2, 4.0}, tiles.size);
            number(*table, "glow", kShareRange, tiles.glow);
            colours(*table, tiles.colours);
        }
    }

    void read_beams(LightBeams& beams) {
        constexpr std::array<std::string_view, 4> kBeams = {"count", "strength", "haze", "colours"};
        if (const toml::table* const table = section(root_, "beams", kBeams)) {
            if (const toml::node* const node = table->get("count")) {
                beams.count = complaints_.whole(*node, "count", {0.0, kMostBeams});
            }
            number(*table, "strength", kShareRange, beams.strength);
            number(*table, "haze", kShareRange, beams.haze);
            colours(*table, beams.colours);
        }
    }

    void read_outfits(Theme& theme) {
        const toml::node* const node = root_.get("outfits");
        if (node == nullptr) {
            return;
        }
        const toml::array* const array = node->as_array();
        if (array == nullptr || array->size() != theme.outfits.size()) {
            complaints_.complain(*node, "outfits must be 6 tables [[outfits]]");
            return;
        }
        for (std::size_t i = 0; i < theme.outfits.size(); ++i) {
            if (const toml::table* const table = (*array)[i].as_table()) {
                read_outfit(*table, theme.outfits[i]);
            } else {
                complaints_.complain((*array)[i], "outfits must be 6 tables [[outfits]]");
            }
        }
    }

    void read_outfit(const toml::table& table, Outfit& outfit) {
        constexpr std::array<std::pair<std::string_view, glm::vec3 Outfit::*>, 7> kColours = {
            {{"skin", &Outfit::skin},
             {"suit", &Outfit::suit},
             {"stripe", &Outfit::stripe},
             {"hair", &Outfit::hair},
             {"shoes", &Outfit::shoes},
             {"trim", &Outfit::trim},
             {"iris", &Outfit::iris}}};
        std::array<std::string_view, kColours.size()> keys{};
        for (std::size_t i = 0; i < kColours.size(); ++i) {
            keys[i] = kColours[i].first;
            colour(table, keys[i], outfit.*kColours[i].second);
        }
        complaints_.check_keys(table, keys);
    }

    /// A table; null where there is none, and after a complaint.
    const toml::table* section(const toml::table& parent, std::string_view key, Keys known) {
        const toml::node* const node = parent.get(key);
        if (node == nullptr) {
            return nullptr;
        }
        const toml::table* const table = node->as_table();
        if (table == nullptr) {
            complaints_.complain(*node, fmt::format("{0} must be a table [{0}]", key));
        } else {
            complaints_.check_keys(*table, known);
        }
        return table;
    }

    void truth(const toml::table& table, std::string_view key, bool& value) {
        if (const toml::node* const node = table.get(key)) {
            if (!node->is_boolean()) {
                complaints_.complain(*node, fmt::format("{} must be true or false", key));
            }
            value = node->value_or(value);
        }
    }

    void number(const toml::table& table, std::string_view key, NumberRange range, float& value) {
        if (const toml::node* const node = table.get(key)) {
            value = static_cast<float>(complaints_.number(*node, key, range));
        }
    }

    void light(const toml::table& table, std::string_view key, glm::vec3& value) {
        triple(table, key, kLightRange, value);
    }

    /// A factor by colour. It keeps the limits of LightShow's levels.
    void tint(const toml::table& table, std::string_view key, glm::vec3& value) {
        triple(table, key, {0.25, 2.0}, value);
    }

    void triple(const toml::table& table,
                std::string_view key,
                NumberRange range,
                glm::vec3& value) {
        if (const toml::node* const node = table.get(key)) {
            const auto of = complaints_.numbers<3>(*node, key, range, "[red, green, blue]");
            value = {
                static_cast<float>(of[0]), static_cast<float>(of[1]), static_cast<float>(of[2])};
        }
    }

    void colour(const toml::table& table, std::string_view key, glm::vec3& value) {
        if (const toml::node* const node = table.get(key)) {
            colour(*node, key, value);
        }
    }

    void colour(const toml::node& node, std::string_view key, glm::vec3& value) {
        const auto text = node.value_exact<std::string>();
        const auto hex = text ? hex_of(*text) : std::nullopt;
        if (hex) {
            value = srgb(*hex);
        } else {
            complaints_.complain(node, fmt::format("{} must be a colour such as \"#a61b33\"", key));
        }
    }

    template <std::size_t Count>
    void colours(const toml::table& table, std::array<glm::vec3, Count>& values) {
        const toml::node* const node = table.get("colours");
        if (node == nullptr) {
            return;
        }
        const toml::array* const array = node->as_array();
        if (array == nullptr || array->size() != Count) {
            complaints_.complain(*node, fmt::format("colours must be a list of {} colours", Count));
            return;
        }
        for (std::size_t i = 0; i < Count; ++i) {
            colour((*array)[i], "colours", values[i]);
        }
    }

    const toml::table& root_;
    TomlComplaints complaints_;
};

Theme shipped_stage() {
    Expected<Theme> stage = parse_theme(kStageTheme, "stage", "config/themes/stage.toml", Theme());
    RAKS_ASSERT(stage.has_value());
    return stage ? std::move(*stage) : Theme();
}

}  // namespace

const Theme& default_theme() noexcept {
    static const Theme stage = shipped_stage();
    return stage;
}

Expected<Theme> parse_theme(std::string_view text,
                            const std::string& name,
                            const std::string& file,
                            const Theme& base) {
    const auto root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    Theme theme = base;
    theme.name = name;
    return ThemeReader(*root, file).read(std::move(theme));
}

}  // namespace raks::render
