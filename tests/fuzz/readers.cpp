#include "tests/fuzz/readers.hpp"

#include <algorithm>

#include "tests/fuzz/mutation.hpp"

namespace raks::fuzz {

std::span<const Reader> readers() {
    static const std::vector<Reader> all = {
        {"settings", read_settings, {"config/default.toml"}, 2000},
        {"devices", read_devices, {}, 2000},
        {"preset", read_preset, {}, 2000},
        {"theme", read_theme, {"config/themes/club.toml", "config/themes/dance_floor.toml"}, 2000},
        {"window_memory", read_window_memory, {}, 2000},
        {"kdeglobals", read_kdeglobals, {}, 2000},
        {"dances", read_dances, {"models/trained/dances.toml"}, 2000},
        {"dance_corrections", read_dance_corrections, {}, 2000},
        {"genre_words", read_genre_words, {"config/genres.toml"}, 300},
        {"grammar", read_grammar, {"models/trained/salsa.toml", "models/trained/belly.toml"}, 2000},
        {"styles", read_styles, {"config/styles/palettes.toml"}, 300},
        {"choreography",
         read_choreography,
         {"config/choreographies/waltz.toml", "config/choreographies/rock.toml"},
         200},
        {"figure_angles", read_figure, {"models/trained/salsa_basic_lead.json"}, 40},
        {"figure_positions", read_figure, {"models/trained/salsa_basic_lead_positions.json"}, 40},
        {"genre", read_genre, {"models/trained/genres.json"}, 20},
        {"beats", read_beats, {"models/trained/beats.json"}, 60},
        {"beatnet", read_beatnet, {}, 300, Content::bytes},
        {"tagger", read_tagger, {}, 100, Content::bytes},
        {"labels", read_labels, {}, 2000},
        {"counts", read_counts, {}, 2000},
        {"faults", read_faults, {}, 2000},
        {"take_beats", read_take_beats, {}, 2000},
        {"cells", read_cells, {}, 100, Content::bytes},
        {"index", read_index, {}, 2000},
        {"beat_list", read_beat_list, {}, 2000},
        {"event_list", read_event_list, {}, 2000},
        {"playlist", read_playlist, {}, 2000},
        {"bvh", read_clip, {"tests/data/bvh/odd/plain.bvh", "tests/data/bvh/odd/names.bvh"}, 60},
        {"acclaim", read_acclaim, {}, 300},
        {"smpl_npz", read_smpl_npz, {}, 300, Content::bytes},
        {"smpl_json", read_smpl_json, {}, 300},
        {"c3d", read_c3d, {}, 300, Content::bytes},
        {"trc", read_trc, {}, 300},
        {"points_csv", read_points_csv, {}, 300},
        {"vmd", read_vmd_file, {}, 100, Content::bytes},
        {"vpd", read_vpd_file, {}, 300},
        {"edges", read_edges, {}, 2000},
        {"midi", read_midi, {}, 2000, Content::bytes},
        {"sound", read_sound, {}, 60, Content::bytes},
        {"film", read_film, {}, 60, Content::bytes},
        {"genre_samples", read_genre_samples, {}, 300, Content::bytes},
        {"soundfont", read_soundfont, {}, 300, Content::bytes},
        {"soundfont_talk", read_soundfont_talk, {}, 2000, Content::bytes},
        {"decode_talk", read_decode_talk, {}, 2000, Content::bytes},
        {"midi_map", read_midi_map, {}, 2000},
        {"midi_bytes", read_midi_bytes, {}, 2000, Content::bytes},
        {"osc_packet", read_osc_packet, {}, 2000, Content::bytes},
        {"remote_text", read_remote_text, {}, 2000},
#ifdef RAKS_NOW_PLAYING_IS_BUILT
        {"player_message", read_player_message, {}, 2000, Content::bytes},
#endif
        {"import_talk", read_import_talk, {}, 2000, Content::bytes},
        {"unpack_talk", read_unpack_talk, {}, 2000, Content::bytes},
        {"kept_dance", read_kept_dance, {}, 300, Content::bytes},
        {"posture", read_posture, {}, 2000},
        {"bone_labels", read_bone_label_file, {}, 2000},
        {"joint_map", read_joint_map_file, {}, 2000},
        {"lens_yaml", read_lens_file, {}, 1000},
        {"rig", read_rig_file, {}, 1000},
        {"easymocap_rig", read_easymocap_files, {}, 1000},
        {"qualisys_rig", read_qualisys_file, {}, 1000},
#ifdef RAKS_CAPTURE_IS_BUILT
        {"capture_plan", read_capture_plan, {}, 2000},
        {"capture_song", read_capture_song, {}, 2000},
        {"calibration_choices", read_calibration_choices, {}, 2000},
#endif
        {"marker_set", read_marker_set_file, {}, 1000},
        {"body_model", read_body_model_file, {}, 2000},
        {"clocks", read_clocks_file, {}, 2000},
        {"marker_labels", read_marker_labels, {}, 2000},
        {"detections", read_detections, {}, 1000},
        {"keypoints", read_keypoint_file, {}, 500},
        {"openpose", read_openpose_file, {}, 1000},
        {"keypoint_table", read_keypoint_table, {}, 1000},
        {"point_names", read_point_name_file, {}, 2000},
        {"pose_network", read_pose_network, {}, 2000, Content::bytes},
        {"angles", read_angles_file, {}, 1000},
        {"tracks", read_tracks_file, {}, 1000},
        {"flags", read_flags_file, {}, 2000},
        {"moves", read_moves_file, {}, 2000},
        {"edits", read_edits_file, {}, 2000},
#ifdef RAKS_IMPORT_IS_BUILT
        {"foreign_text",
         read_foreign_text,
         {"tests/data/avatars/bent_bar.fbx",
          "tests/data/avatars/bent_bar_text.fbx",
          "tests/data/avatars/bent_bar.dae",
          "tests/data/avatars/bent_bar.obj"},
         3000,
         Content::bytes},
#endif
        {"model",
         read_model_file,
         {"tests/data/avatars/SimpleSkin.gltf", "tests/data/avatars/RiggedFigure.glb"},
         500},
        {"model_3ds",
         read_tds_file,
         {"tests/data/avatars/derived_kenney_character.3ds"},
         2000,
         Content::bytes},
        {"packed_picture",
         read_packed_picture,
         {"tests/data/avatars/Textures/colormap.png"},
         500,
         Content::bytes},
        {"plain_picture", read_plain_picture_file, {}, 2000, Content::bytes},
    };
    return all;
}

std::string damaged(const Reader& reader, std::string_view file, std::uint64_t seed) {
    return reader.content == Content::text ? mutated(file, seed) : mutated_bytes(file, seed);
}

const Reader* reader_named(std::string_view name) {
    const auto all = readers();
    const auto found = std::find_if(
        all.begin(), all.end(), [name](const Reader& reader) { return reader.name == name; });
    return found != all.end() ? &*found : nullptr;
}

}  // namespace raks::fuzz
