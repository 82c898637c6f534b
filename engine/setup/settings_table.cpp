#include "engine/setup/settings_table.hpp"

#include <algorithm>
#include <optional>

#include "base/assert.hpp"
#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

const std::array kRows = std::to_array<SettingRow>({
    {.section = "audio",
     .name = "device",
     .field = &Settings::device,
     .help = "input of `raks live`; empty: chosen",
     .option = {"--device", kLive, "input: name, part of it, or number"},
     .manual = "input: name, part of it, or number; empty: chosen"},
    {.section = "audio",
     .name = "output",
     .field = &Settings::output,
     .help = "loudspeaker of `raks play`; empty: the default",
     .option = {"--output", kPlay, "loudspeaker: name, part of it, or number"},
     .manual = "loudspeaker: name, part of it, or number; empty: the default"},
    {.section = "audio",
     .name = "audio_system",
     .field = &Settings::audio_system,
     .words = Words("auto", "portaudio", "jack", "pulse"),
     .option = {"--audio-system", kPlay | kLive},
     .manual =
         "`auto`: JACK and PulseAudio or PipeWire where they run, else the sound cards; `jack`, "
         "`pulse`; `portaudio`: the cards (ALSA, OSS) and what PortAudio knows else"},
    {.section = "audio",
     .name = "buffer_ms",
     .field = &Settings::buffer_ms,
     .range = {0, 2000},
     .help = "of the device's buffer; 0: 40 for a loudspeaker, longer after a gap",
     .option = {"--buffer",
                kPlay | kLive,
                "milliseconds of the device's buffer; longer: fewer gaps in the sound"},
     .manual = "what the device buffers, in ms; 0: 40 for a loudspeaker, doubled, up to 320, "
               "after each gap in the sound. JACK has its own"},
    {.section = "audio",
     .name = "latency_offset_ms",
     .field = &Settings::latency_offset_ms,
     .range = {-500, 500},
     .help = "milliseconds added to the latency that the device reports",
     .option = {"--latency-offset", kShows},
     .manual = "milliseconds added to the latency that the device reports, and to what `raks "
               "calibrate` has kept for it"},
    {.section = "audio",
     .name = "volume",
     .field = &Settings::volume,
     .range = {0, 2},
     .help = "1 is the file's own level",
     .option = {"--volume", kPlay}},
    {.section = "dance",
     .name = "dance",
     .field = &Settings::dance,
     .help = "auto, or the dance to keep to",
     .option = {"--dance",
                kShows | kDance,
                "the dance to keep to: name, folder or written dance (X.toml); or auto"},
     .manual = "the dance to keep to: name, folder or written dance (X.toml); or `auto`: as "
               "recognised"},
    {.section = "dance",
     .name = "fallback_dance",
     .field = &Settings::fallback_dance,
     .help =
         "danced when nothing is recognised: a dance, auto, keep (the dance that is on) or stand",
     .manual =
         "danced when nothing is recognised: a dance, `auto` (the one that the list of dances "
         "has for it), `first` (the list's first), `keep` (the one that is on), `stand`; to "
         "a tempo that is neither the dance's nor half or twice of it, the dance of the nearest "
         "tempo"},
    {.section = "dance",
     .name = "figures",
     .field = &Settings::figures,
     .words = Words("angles", "positions"),
     .help = "learnt as angles or positions of the joints",
     .option = {"--figures", kShows | kDance | kSheet},
     .manual = "learnt as `angles` or `positions` of the joints"},
    {.section = "dance",
     .name = "material",
     .field = &Settings::material,
     .words = Words("people", "written", "both"),
     .help = "of a dance that has both: people's takes, written figures, or both in turn",
     .option = {"--material", kShows | kDance | kSheet},
     .manual = "of a dance that has both: `people`: whole takes of people; `written`: its figures; "
               "`both`: dancers have the one and the other in turn, the first by the seed"},
    {.section = "dance",
     .name = "formation",
     .field = &Settings::formation,
     .words = Words("solo", "couple", "unison", "canon", "free", "grid", "ring", "v"),
     .option = {"--formation", kShows | kDance}},
    {.section = "dance",
     .name = "dancers",
     .field = &Settings::dancers,
     .range = {0, kMostAvatars},
     .help = "1 to 32; 0: as many as the formation has, and one for each avatar",
     .option = {"--dancers", kShows | kDance},
     .manual = "0: as many as the formation has, and one for each avatar. `solo` and `couple` have "
               "their own number; several dancers without a formation stand in a grid"},
    {.section = "dance",
     .name = "generator",
     .field = &Settings::generator,
     .words = Words("trajectories", "frames"),
     .help = "trajectories, or frames: the paper's, for comparison",
     .option = {"--generator", kShows | kDance | kSheet},
     .manual = "`trajectories`, or `frames`: the paper's, for comparison"},
    {.section = "dance",
     .name = "dynamics",
     .field = &Settings::dynamics,
     .words = Words("on", "off"),
     .help = "on, or off: the dance follows nothing but the beat",
     .option = {"--dynamics", kShows | kDance},
     .manual = "`on`, or `off`: the dance follows nothing but the beat: no sizes, stops, holds and "
               "rests"},
    {.section = "dance",
     .name = "tagger",
     .field = &Settings::tagger,
     .words = Words("on", "off"),
     .help = "on, or off: the network that knows many kinds of music does not listen along",
     .option = {"--tagger", kShows | kDance},
     .manual = "`on`, or `off`: the network that knows many kinds of music does not listen along"},
    {.section = "dance",
     .name = "ignore_tags",
     .field = &Settings::ignore_tags,
     .help = "the dance follows what is heard alone, and not what the file says of itself",
     .option = {"--ignore-tags", kShows | kDance},
     .manual = "the dance follows what is heard alone, and not what the file says of itself "
               "([files.md](files.md)); also an option of `raks analyze`"},
    {.section = "dance",
     .name = "seed",
     .field = &Settings::seed,
     .range = {0, 9e15},  // below 2^53, so that a seed survives the comparison in double
     .help = "same seed, same dance",
     .option = {"--seed", kShows | kDance | kSheet}},
    {.section = "dance",
     .name = "pose_lead_ms",
     .field = &Settings::pose_lead_ms,
     .range = {-200, 200},
     .help = "pictures show the pose this much ahead"},
    {.section = "picture",
     .name = "avatar",
     .field = &Settings::avatars,
     .help = "mannequin, a file (.vrm, .glb, .gltf, .3ds, .fbx, .dae, .obj), or a name in the "
             "folder of avatars; or a list of them, worn in turn",
     .option = {"--avatar",
                kShows | kDance | kSheet,
                "mannequin, a file (.vrm, .glb, .gltf, .3ds, .fbx, .dae, .obj), or one of raks "
                "avatar list; several times: worn in turn"},
     .manual = "who dances: `mannequin`, a file (.vrm, .glb, .gltf, .3ds, .fbx, .dae, .obj), or a "
               "name in the folder of avatars, as `raks avatar list` shows them; or a list of up "
               "to 32, `[\"anna.vrm\", \"mannequin\"]`, that dancers wear in turn"},
    {.section = "picture",
     .name = "avatar_height",
     .field = &Settings::avatar_height,
     .range = {0, 10},
     .help = "metres that the avatar is tall; 0: its own",
     .option = {"--height", kShows | kDance | kSheet},
     .manual = "metres that the avatar is tall; 0: as its file has it, and 1.7 where that is not "
               "0.5 to 2.5 m"},
    {.section = "picture",
     .name = "avatar_labels",
     .field = &Settings::avatar_labels,
     .help = "file that says which nodes are the avatar's bones; empty: they are found",
     .option = {"--labels", kShows | kDance | kSheet},
     .manual =
         "[file](files.md) that says which nodes are the avatar's bones; empty: they are found"},
    {.section = "picture",
     .name = "avatar_pictures_mb",
     .field = &Settings::avatar_pictures_mb,
     .range = {1, 4096},
     .help =
         "MB of memory that the pictures on an avatar may take; beyond it the largest are halved",
     .manual = "MB of memory that the pictures on an avatar may take, with the smaller copies that "
               "are drawn from afar; beyond it the largest are drawn half as wide and high, and so "
               "on, which is said"},
    {.section = "picture",
     .name = "theme",
     .field = &Settings::theme,
     .help =
         "stage, club, dance_floor, workshop_dark, studio_light, plain, or a theme's file X.toml",
     .option = {"--theme", kShows | kSheet},
     .manual =
         "`stage`, `club`, `dance_floor`, `workshop_dark`, `studio_light`, `plain` (one white "
         "light), one of your own, or a [file](files.md#raks-theme-version-1-toml) `X.toml`; "
         "where it is unknown or cannot be read, `stage`"},
    {.section = "picture",
     .name = "backdrop",
     .field = &Settings::backdrop,
     .help = "stage, transparent, or a colour to be keyed out, such as #00ff00",
     .option = {"--backdrop", kShows | kSheet},
     .manual =
         "`stage`: the theme's; `transparent`: nothing, so that what lies behind the window or "
         "under the film shows; or a colour such as `#00ff00`, for programs that key it out: "
         "each pixel is that colour exactly or holds none of it, without shadow and rings"},
    {.section = "picture",
     .name = "shadow",
     .field = &Settings::shadow,
     .help = "dancers throw a shadow on the floor",
     .option = {"--shadow", kShows | kSheet}},
    {.section = "picture",
     .name = "rings",
     .field = &Settings::rings,
     .help = "rings of light on the floor show the beat",
     .option = {"--rings", kShows}},
    {.section = "picture",
     .name = "dress",
     .field = &Settings::dress,
     .words = Words("auto", "dancer", "street", "oriental", "ballroom", "mannequin"),
     .help = "what the mannequin wears: auto (by the dance), dancer, street, oriental, ballroom or "
             "mannequin",
     .option = {"--dress", kShows | kSheet},
     .manual = "what the mannequin wears, in the theme's colours: `auto`, what the dance asks for "
               "(`dress` in [dances.toml](files.md)); `dancer`: a unitard, with a skirt; `street`: "
               "hoodie, wide trousers, sneakers; `oriental`: bare midriff, full trousers, a scarf; "
               "`ballroom`: gown and tailcoat; `mannequin`: nothing but bands at its joints"},
    {.section = "picture",
     .name = "camera",
     .field = &Settings::camera,
     .words = Words("director", "wide", "portrait", "front", "side", "back", "top"),
     .help = "director, or still: wide, portrait, front or side",
     .option = {"--camera", kShows},
     .manual = "`director`: shots that change with the music; or still: `wide`, `portrait`, "
               "`front`, `side`, `back`, `top`"},
    {.section = "picture",
     .name = "calm",
     .field = &Settings::calm,
     .help = "calmer pictures: fewer cuts, and light that changes slowly and little",
     .option = {"--calm", kShows}},
    {.section = "picture",
     .name = "size",
     .field = &Settings::size,
     .help = "picture size, such as 1280x720",
     .option = {"--size", kShows},
     .manual = "WIDTHxHEIGHT, 16 to 7680 each"},
    {.section = "picture",
     .name = "fps",
     .field = &Settings::fps,
     .range = {1, 240, true},
     .help = "pictures a second; 0: as many as the monitor shows",
     .option = {"--fps", kShows | kSheet},
     .manual = "pictures a second; 0: as many as the monitor shows, of a film 30"},
    {.section = "picture",
     .name = "quality",
     .field = &Settings::quality,
     .words = Words("auto", "fast", "high"),
     .option = {"--quality", kShows | kSheet},
     .manual = "`auto` (in a window by the driver, a film `high`), `fast`, `high`"},
    {.section = "picture",
     .name = "view",
     .field = &Settings::view,
     .words = Words("auto", "skin", "stick"),
     .help = "skin, stick, or auto: stick when danced by positions",
     .option = {"--view", kShows | kSheet},
     .manual = "`skin`, `stick`, or `auto`: stick when danced by positions"},
    {.section = "picture",
     .name = "face_blink",
     .field = &Settings::face_blink,
     .help = "an avatar's eyes blink by themselves",
     .option = {"--blink", kShows}},
    {.section = "picture",
     .name = "face_mouth",
     .field = &Settings::face_mouth,
     .help = "its mouth opens with the music",
     .option = {"--mouth", kShows}},
    {.section = "picture",
     .name = "face_gaze",
     .field = &Settings::face_gaze,
     .help = "its eyes look at the camera, in a couple at each other",
     .option = {"--gaze", kShows},
     .manual = "its eyes look at the camera, those of a couple at each other, and go first where "
               "the head turns away"},
    {.section = "picture",
     .name = "face_mood",
     .field = &Settings::face_mood,
     .words = Words("off", "calm", "normal", "stage"),
     .help = "how much faces feel: off, calm, normal or stage (seen from afar)",
     .option = {"--mood", kShows | kDance},
     .manual = "how much faces feel: `off`, `calm`, `normal`, or `stage`, which is seen from afar"},
    {.section = "picture",
     .name = "overlay",
     .field = &Settings::overlay,
     .help = "beat, tempo and levels over the picture",
     .option = {"--overlay", kShows},
     .manual = "beat, tempo and levels over the picture of a window; a film has them with "
               "`--overlay` alone"},
});

// What a number is, as it is compared with its range; nothing for other values.
std::optional<double> number_of(const SettingRow& row, const Settings& settings) {
    if (const auto* const real = std::get_if<double Settings::*>(&row.field)) {
        return settings.**real;
    }
    if (const auto* const whole = std::get_if<std::int64_t Settings::*>(&row.field)) {
        return static_cast<double>(settings.**whole);
    }
    return std::nullopt;
}

}  // namespace

std::span<const SettingRow> setting_rows() noexcept { return kRows; }

const SettingRow& row_of(SettingField field) {
    const auto row = std::find_if(
        kRows.begin(), kRows.end(), [&](const SettingRow& each) { return each.field == field; });
    RAKS_ASSERT(row != kRows.end());
    return *row;
}

const SettingOrigin& origin_of(const Settings& settings, SettingField field) {
    return settings.origins.of(full_name(row_of(field)));
}

void take_setting(SettingField field, const Settings& from, Settings& to) {
    const SettingOrigin& origin = origin_of(from, field);
    if (origin_of(to, field).rank <= origin.rank) {
        std::visit([&](auto member) { to.*member = from.*member; }, field);
        to.origins.set(full_name(row_of(field)), origin);
    }
}

std::string full_name(const SettingRow& row) { return fmt::format("{}.{}", row.section, row.name); }

std::string help_of(const SettingRow& row) {
    const auto words = row.words.all();
    if (!row.help.empty() || words.empty()) {
        return std::string(row.help);
    }
    return fmt::format("{} or {}", fmt::join(words.first(words.size() - 1), ", "), words.back());
}

std::string fault_of(const SettingRow& row, const Settings& settings) {
    if (const auto number = number_of(row, settings)) {
        // Written so that NaN is a fault.
        const bool is_in = *number >= row.range.low && *number <= row.range.high;
        return is_in || (row.range.has_zero && *number == 0.0)
                   ? std::string()
                   : fmt::format("{} is {}, must be {}{} to {}",
                                 full_name(row),
                                 *number,
                                 row.range.has_zero ? "0, or " : "",
                                 row.range.low,
                                 row.range.high);
    }
    const auto words = row.words.all();
    if (const auto* const text = std::get_if<std::string Settings::*>(&row.field);
        text != nullptr && !words.empty() &&
        std::find(words.begin(), words.end(), settings.**text) == words.end()) {
        return unknown_name(full_name(row), settings.**text, words);
    }
    return {};
}

}  // namespace raks::engine
