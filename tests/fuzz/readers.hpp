// The readers of files that are fuzzed: for each what is done with any bytes that may lie in a
// file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raks::fuzz {

/// What files of a kind consist of, which decides how they are damaged: see mutation.hpp.
enum class Content : std::uint8_t { text, bytes };

/// One reader: it reads the text, and what it accepts is used as the program would use it.
struct Reader {
    std::string_view name;                ///< of its target and of its folder in tests/fuzz/corpus
    bool (*read)(std::string_view text);  ///< returns for every text; whether it was good
    /// Good files to begin with: paths within the source tree.
    std::vector<std::string_view> seeds;
    std::size_t trials = 100;  ///< mutations that the test tries: fewer of what is slow
    Content content = Content::text;
};

/// A file of this reader, damaged: mutated() or mutated_bytes().
[[nodiscard]] std::string damaged(const Reader& reader, std::string_view file, std::uint64_t seed);

/// All readers. Threads: any.
[[nodiscard]] std::span<const Reader> readers();
/// The reader of a name; null: there is none.
[[nodiscard]] const Reader* reader_named(std::string_view name);

/// What each reader does; definitions in readers_*.cpp. True: the text was good.
bool read_settings(std::string_view text);
bool read_devices(std::string_view text);  ///< what `raks calibrate` keeps
bool read_theme(std::string_view text);
bool read_preset(std::string_view text);         ///< and puts it over settings; and writes it again
bool read_window_memory(std::string_view text);  ///< likewise
bool read_kdeglobals(std::string_view text);     ///< of the desktop
bool read_dances(std::string_view text);         ///< and writes them again
/// The dances that a person keeps; and writes them again.
bool read_dance_corrections(std::string_view text);
bool read_genre_words(std::string_view text);   ///< and what it says of its own words
bool read_grammar(std::string_view text);       ///< and chooses figures by it
bool read_styles(std::string_view text);        ///< of music
bool read_choreography(std::string_view text);  ///< and bakes every figure
bool read_figure(std::string_view text);        ///< of angles or positions; dances it for 2 s
bool read_genre(std::string_view text);         ///< and analyses one second with it
bool read_tagger(std::string_view changes);     ///< of the shipped weights; tags a patch
bool read_beatnet(std::string_view changes);    ///< of the shipped weights; hears ten frames
bool read_beats(std::string_view text);         ///< networks; and analyses one second with them
bool read_labels(std::string_view text);        ///< of figures in takes
bool read_counts(std::string_view text);        ///< of figures in takes
bool read_faults(std::string_view text);        ///< of takes
bool read_take_beats(std::string_view text);    ///< of takes
bool read_cells(std::string_view changes);      ///< of a dance of cells; solves and dances it
bool read_index(std::string_view text);         ///< of a beat corpus
bool read_beat_list(std::string_view text);     ///< annotated beats
bool read_event_list(std::string_view text);    ///< annotated events of songs
bool read_playlist(std::string_view text);      ///< in all forms
bool read_clip(std::string_view text);          ///< BVH; draws it, retargets it and learns from it
bool read_acclaim(std::string_view text);       ///< .asf, a line "%%", .amc
bool read_smpl_npz(std::string_view bytes);     ///< SMPL parameters
bool read_smpl_json(std::string_view text);     ///< the same
bool read_c3d(std::string_view bytes);          ///< points, and draws them
bool read_trc(std::string_view text);           ///< the same
bool read_points_csv(std::string_view text);    ///< the same
bool read_vmd_file(std::string_view bytes);     ///< a body's motion and a camera's
bool read_vpd_file(std::string_view text);      ///< a pose of MikuMikuDance
bool read_edges(std::string_view text);         ///< of points; and looks for them
bool read_midi(std::string_view bytes);         ///< a file of a pack, and performs it; or its index
bool read_sound(std::string_view bytes);        ///< of any format, and seeks in it
bool read_film(std::string_view bytes);         ///< of any format, its first pictures
bool read_genre_samples(std::string_view bytes);       ///< and other files that training keeps
bool read_soundfont(std::string_view bytes);           ///< SF2 or SF3, and plays it
bool read_soundfont_talk(std::string_view bytes);      ///< what raks-soundfont may answer
bool read_decode_talk(std::string_view bytes);         ///< what raks-decode may, of sound
bool read_midi_map(std::string_view text);             ///< what a MIDI controller is taught
bool read_midi_bytes(std::string_view bytes);          ///< of a MIDI controller, and what they ask
bool read_osc_packet(std::string_view bytes);          ///< that asks for actions
bool read_remote_text(std::string_view text);          ///< of a page that asks for actions
bool read_player_message(std::string_view bytes);      ///< what a player may say on the bus
bool read_import_talk(std::string_view bytes);         ///< what raks-import may
bool read_unpack_talk(std::string_view bytes);         ///< what raks-unpack may
bool read_kept_dance(std::string_view changes);        ///< a solved dance, and what is changed
bool read_posture(std::string_view text);              ///< of `raks avatar pose`
bool read_bone_label_file(std::string_view text);      ///< labels of avatars
bool read_joint_map_file(std::string_view text);       ///< of clips; and puts it to one
bool read_lens_file(std::string_view text);            ///< OpenCV's; and writes it again
bool read_rig_file(std::string_view text);             ///< of any program; and writes it again
bool read_easymocap_files(std::string_view text);      ///< both, with a line "=====" between
bool read_qualisys_file(std::string_view text);        ///< its XML; and writes it as our own
bool read_capture_plan(std::string_view text);         ///< capture.toml; and writes it again
bool read_capture_song(std::string_view text);         ///< music.toml
bool read_calibration_choices(std::string_view text);  ///< and writes them again
bool read_marker_set_file(std::string_view text);      ///< likewise, as those that follow
bool read_body_model_file(std::string_view text);      ///< joints; and writes them again
bool read_clocks_file(std::string_view text);          ///< of cameras
bool read_marker_labels(std::string_view text);        ///< of pictures
bool read_detections(std::string_view text);           ///< spots in pictures
bool read_keypoint_file(std::string_view text);    ///< joints in pictures; and writes them again
bool read_openpose_file(std::string_view text);    ///< the same of two pictures of OpenPose
bool read_keypoint_table(std::string_view text);   ///< and of another program's table
bool read_point_name_file(std::string_view text);  ///< what a table's names mean
bool read_pose_network(std::string_view bytes);    ///< as ONNX
bool read_angles_file(std::string_view text);      ///< of a body
bool read_tracks_file(std::string_view text);      ///< of markers; and as TRC
bool read_flags_file(std::string_view text);       ///< of two markers over ten frames
bool read_moves_file(std::string_view text);       ///< `moved.tsv`; and writes it again
bool read_edits_file(std::string_view text);       ///< of tracks
bool read_model_file(std::string_view text);       ///< glTF and VRM; and unpacks its pictures
bool read_tds_file(std::string_view bytes);        ///< 3DS; the same
bool read_packed_picture(std::string_view bytes);  ///< PNG, JPEG or WebP
bool read_plain_picture_file(std::string_view bytes);  ///< BMP or TGA
bool read_foreign_text(std::string_view bytes);        ///< FBX, Collada, OBJ, before assimp reads

}  // namespace raks::fuzz
