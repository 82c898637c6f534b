#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/clips/body_arguments.hpp"
#include "apps/clips/joint_arguments.hpp"
#include "apps/terminal/program.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/outputs/video_sink.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/avatar_clip.hpp"
#include "engine/show/avatar_model.hpp"
#include "engine/show/clip_course.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/formats/mmd/mmd_pose_of.hpp"

/// The commands of the program `raks`, one function each. Arguments are checked for their form
/// only; the command checks the rest and does the work. Threads: main.
namespace raks::apps {

/// A section of a file, in seconds.
struct Section {
    double start = 0.0;              ///< >= 0
    std::optional<double> duration;  ///< > 0; to the end when absent
};

/// How the window of play and live is opened.
struct WindowWish {
    bool is_fullscreen = false;  ///< it fills the screen
    bool is_borderless = false;  ///< without title and frame
    bool is_on_top = false;      ///< over all other windows
};

/// Where the pictures of play and live go besides the window.
struct VideoArguments {
    std::vector<engine::VideoWish> wishes;  ///< none: nowhere
    double offset_ms = 0.0;                 ///< pictures later than the sound by so much
    bool has_overlay = false;               ///< the overlay goes there, too
    Path record;                            ///< film of the show; empty: none from the start
};

/// Who may ask for actions besides the person at the window; nobody, unless it is said here.
struct RemoteArguments {
    bool has_server = false;            ///< HTTP, and a page for phones
    std::string address = "127.0.0.1";  ///< of it: ADDRESS, PORT or ADDRESS:PORT
    bool keeps_token = false;           ///< of it: the same one the next time
    std::string osc_in = {};            ///< OSC: PORT or ADDRESS:PORT; empty: none
    std::string midi_in = {};           ///< MIDI: a part of a port's name; empty: none
    bool follows_link = false;          ///< beats are those of Ableton Link's session
};

/// A clip that is performed in a dance's place.
struct MotionWish {
    std::string file;  ///< FILE, or FILE#NAME; empty: none
    /// None: by beats, or by the song where `offset` says, or the clip is one of a song.
    std::optional<engine::ClipSync> sync;
    std::optional<double> offset;     ///< seconds of the song at the clip's first pose
    bool loops = false;               ///< begins again at its end, whatever its ends are
    bool does_not_loop = false;       ///< is performed once
    std::optional<double> arm_angle;  ///< AvatarClipOptions::arm_angle
    Path camera;                      ///< a camera's VMD; empty: the settings' camera

    /// The same, decided for the clip that it names.
    [[nodiscard]] engine::ClipTiming timing(const engine::AvatarClip& clip) const {
        engine::ClipTiming timing;
        timing.sync = sync.value_or(offset || clip.is_of_one_song() ? engine::ClipSync::song
                                                                    : engine::ClipSync::beat);
        timing.loop = loops           ? engine::ClipLoop::always
                      : does_not_loop ? engine::ClipLoop::never
                                      : engine::ClipLoop::where_ends_meet;
        timing.offset = offset.value_or(0.0);
        return timing;
    }
};

/// Arguments of `raks play`.
struct PlayArguments {
    engine::Settings settings;  ///< of the files and the options
    std::vector<Path> files;    ///< files, folders, playlists, pipes; empty: the demo salsa
    Section section;            ///< of every file
    bool is_shuffled = false;   ///< in an order of the seed
    bool repeats = false;       ///< begins anew behind the last file
    bool quits = false;         ///< closes the window behind the last file
    bool is_headless = false;   ///< no window
    bool is_soundless = false;  ///< no loudspeaker; paced by the clock
    WindowWish window;          ///< how it is opened
    bool is_as_live = false;    ///< songs are analyzed as they come, as an input is
    std::vector<engine::OutputWish> outputs;  ///< who else is told of the music
    VideoArguments video;                     ///< who else has the pictures
    RemoteArguments remote;                   ///< who else asks for actions
    /// What players say of the music that is heard counts; none: with a monitor.
    std::optional<bool> now_playing;
    MotionWish motion;  ///< performed instead of a dance
};
/// Plays files and dances to them; kExitPartly when some could not be played. Errors: none can be
/// played, no loudspeaker.
[[nodiscard]] ExitCode play(const PlayArguments& arguments);

/// Opens the window at once and plays the files; without any it dances to what the computer plays,
/// and to music of its own where nothing can be listened to. Errors: no display; files of which
/// none can be played.
[[nodiscard]] ExitCode open(const PlayArguments& arguments);

/// Arguments of `raks live`.
struct LiveArguments {
    engine::Settings settings;                ///< of the files and the options
    std::optional<double> duration;           ///< seconds of the input; until stopped when absent
    bool is_headless = false;                 ///< no window
    bool has_no_avatar = false;               ///< nobody dances: see serve_beats()
    WindowWish window;                        ///< how it is opened
    std::vector<engine::OutputWish> outputs;  ///< who else is told of the music
    VideoArguments video;                     ///< who else has the pictures
    RemoteArguments remote;                   ///< who else asks for actions
    /// What players say of the music that is heard counts; none: with a monitor.
    std::optional<bool> now_playing;
    MotionWish motion;  ///< performed instead of a dance
};
/// Dances to an input. Errors: no input, it cannot be opened.
[[nodiscard]] ExitCode live(const LiveArguments& arguments);
/// Tells the outputs of an input's music, without window, dancers and dances. Errors: as live(); an
/// output that cannot be opened.
[[nodiscard]] ExitCode serve_beats(const LiveArguments& arguments);

/// Arguments of `raks devices`.
struct DevicesArguments {
    engine::Settings settings;     ///< of the files and the options
    bool as_json = false;          ///< one JSON document instead of text
    bool has_levels = false;       ///< and in it what each input hears
    bool asks_for_output = false;  ///< only the exit code: is there a loudspeaker?
};
/// Lists the audio devices and which of them are chosen.
[[nodiscard]] ExitCode devices(const DevicesArguments& arguments);

/// Arguments of `raks avatar list`.
struct AvatarListArguments {
    bool as_json = false;  ///< one JSON document instead of text
};
/// Lists the mannequin and the models in the user's folder of avatars.
[[nodiscard]] ExitCode avatar_list(const AvatarListArguments& arguments);

/// Arguments of `raks avatar show`.
struct AvatarShowArguments {
    std::string model;              ///< file, or a name of `raks avatar list`
    engine::AvatarOptions options;  ///< of its file
    std::string expression;         ///< "happy=1,blink=0.6"; empty: none
    Path thumbnail;                 ///< .png; empty: none
    bool as_json = false;           ///< one JSON document instead of text
};
/// Tells what is in a model. Errors: no such model; those of reading it.
[[nodiscard]] ExitCode avatar_show(const AvatarShowArguments& arguments);

/// Arguments of `raks avatar pose`.
struct AvatarPoseArguments {
    std::string model;                ///< file, or a name of `raks avatar list`
    engine::AvatarOptions options;    ///< of its file
    std::string pose;                 ///< "FILE.json" or "FILE.json#NAME"; empty: `motion` is given
    std::string motion;               ///< clip: FILE, or FILE#NAME; empty: `pose` is given
    JointArguments joints;            ///< which joint of the clip is which bone
    std::optional<double> arm_angle;  ///< AvatarClipOptions::arm_angle
    std::string time = "0";           ///< seconds into the clip, or "all"
    Path output;                      ///< .png, .obj or .tsv
};
/// Writes a model's posed mesh or its joints. Errors: no model or not a figure, no posture, no clip
/// or not a figure's, a time that it does not have, the output's ending.
[[nodiscard]] ExitCode avatar_pose(const AvatarPoseArguments& arguments);

/// Arguments of `raks avatar export`.
struct AvatarExportArguments {
    std::string model = "mannequin";   ///< file, or a name of `raks avatar list`
    engine::AvatarOptions options;     ///< of its file
    std::string title;                 ///< empty: the file's own, else its name
    std::vector<std::string> authors;  ///< empty: the file's own
    std::string licence;               ///< in words, or its address; empty: the file's own
    Path output;                       ///< .vrm, .glb, .3ds or .obj
};
/// Writes a model as VRM 1.0, as binary glTF, as 3DS of rigid parts with its pictures and labels
/// beside it, or its mesh at rest as OBJ with its materials beside it. Errors: no model; as VRM: no
/// figure, neither author nor licence in it or given; the output's ending.
[[nodiscard]] ExitCode avatar_export(const AvatarExportArguments& arguments);

/// Arguments of `raks xbody`.
struct XbodyArguments {
    std::string model;                 ///< file, or a name of `raks avatar list`
    engine::AvatarOptions options;     ///< of its file
    std::string motion;                ///< clip: FILE, or FILE#NAME; empty: none
    JointArguments joints;             ///< which joint of the clip is which bone
    std::optional<double> arm_angle;   ///< AvatarClipOptions::arm_angle
    std::optional<std::size_t> frame;  ///< of the clip; none: the first, of a film all
    double rate = 1.0;                 ///< of a film; -2 to 4, not 0
    std::string view = "front";        ///< or side, back, top
    std::string size;                  ///< of window or picture; empty: 1280x720 or 960x720
    bool has_names = false;            ///< beside the bones
    Path output;                       ///< as XbodyFilmPlan has it; empty: a window
};
/// Shows a model with its bones over it, in a window in which they are labelled, or films it.
/// Errors: no such model or clip; those of reading them, of OpenGL and of the picture; no display.
[[nodiscard]] ExitCode xbody(const XbodyArguments& arguments);

/// Arguments of `raks calibrate`.
struct CalibrateArguments {
    engine::Settings settings;  ///< of the files and the options
    bool by_loop = false;       ///< an input hears the clicks
    bool by_taps = false;       ///< a person taps to the clicks
    bool forgets = false;       ///< nothing is measured: what is kept of the loudspeaker goes
};
/// Measures how much later a loudspeaker is heard than it reports, and keeps it. Errors: those of
/// the devices; what was measured is not sure enough; the file cannot be read or written.
[[nodiscard]] ExitCode calibrate(const CalibrateArguments& arguments);

/// Arguments of `raks render`.
struct RenderArguments {
    engine::Settings settings;  ///< of the files and the options
    Path input;                 ///< empty: the demo salsa
    Path output;                ///< .mp4, .mkv, .webm, .avi, or a folder for .png
    MotionWish motion;          ///< performed instead of the dance
    Section section;            ///< of the input
    bool is_as_live = false;    ///< it is analyzed as it comes, as an input is
    bool has_alpha = false;     ///< the film keeps what is transparent; nothing is behind the dance
};
/// Writes a film of the dance. Errors: those of input, OpenGL and the film.
[[nodiscard]] ExitCode render(const RenderArguments& arguments);

/// How a file's beats are tracked: the methods of audio::BeatMethod, and the paper's method with
/// the whole file before it.
enum class FileBeatMethod : std::uint8_t { pointer, whole, paper, paper_whole };

/// Arguments of `raks analyze`.
struct AnalyzeArguments {
    engine::Settings settings;                      ///< of the files and the options
    std::vector<Path> inputs;                       ///< files, folders, playlists, pipes
    bool as_json = false;                           ///< one JSON document instead of text
    FileBeatMethod beat = FileBeatMethod::pointer;  ///< how beats are tracked
    Path plot;                                      ///< .svg; empty: none
    Path reference;  ///< beats to compare with in the plot; empty: none
};
/// Reports beats, tempo and dance of files; kExitPartly when some could not be read. Errors: none
/// can be read; those of the plot.
[[nodiscard]] ExitCode analyze(const AnalyzeArguments& arguments);

/// Arguments of `raks eval beats`.
struct EvalBeatsArguments {
    Path corpus;  ///< folder: index.tsv, NAME.beats, NAME.ogg
    std::vector<FileBeatMethod> methods = {FileBeatMethod::pointer};  ///< each is scored
    std::vector<Path> peers;  ///< folders of other trackers' beats, or folders of such
    Path network;             ///< for the pointer; empty: what comes with Raks; "none": none
    /// Folder of CLASS.json: networks that were trained without excerpts of that class.
    Path left_out;
    std::string category;        ///< only excerpts of this class; empty: all
    Path output;                 ///< folder for our trackers' beats; empty: not written
    bool as_json = false;        ///< one JSON document instead of text
    bool asks_for_each = false;  ///< a row for each excerpt
};
/// Scores our trackers, and others', against annotated excerpts.
[[nodiscard]] ExitCode eval_beats(const EvalBeatsArguments& arguments);

/// Arguments of `raks eval dance`.
struct EvalDanceArguments {
    engine::Settings settings;                         ///< of the files and the options
    motion::DanceRole role = motion::DanceRole::lead;  ///< which part is measured
    std::vector<std::string> trials;                   ///< by name; empty: all
    std::vector<Path> against;  ///< music; its loudness is compared with the dance, nothing else is
    Path clips;                 ///< folder of people's clips, TAKE.bvh; empty: none
    Path labels;                ///< TSV; needed with clips
    Path counts;                ///< TSV; empty: counts lie evenly in a label, no BAS
    Path faults;                ///< TSV of capture faults; empty: none
    double fps = 0.0;           ///< of the clips; 0: the files'
    double scale = 1.0;         ///< metres per unit of the clips
    JointArguments joints;      ///< which joint of the clips is which bone
    bool as_json = false;       ///< one JSON document instead of text
};
/// Measures the dancer, from generated music to poses, beside people's clips.
[[nodiscard]] ExitCode eval_dance(const EvalDanceArguments& arguments);

/// Arguments of `raks eval avatar`.
struct EvalAvatarArguments {
    engine::Settings settings;        ///< of the files and the options; `dance`: auto for all
    std::vector<std::string> models;  ///< files, or names of `raks avatar list`; at least one
    bool as_json = false;             ///< one JSON document instead of text
};
/// Measures how avatars wear dances that are solved for them. A model that cannot dance is told and
/// left out (kExitPartly).
[[nodiscard]] ExitCode eval_avatar(const EvalAvatarArguments& arguments);

/// Arguments of `raks dance`.
struct DanceArguments {
    engine::Settings settings;  ///< of the files and the options
    Path input;                 ///< the music file
    Path output;                ///< x.bvh, x.vrma, x.vmd or x.glb; of several dancers x_1.bvh, ...
    motion::MmdLegs legs = motion::MmdLegs::ik;  ///< of x.vmd
    double fps = 60.0;                           ///< [1, 240]
    bool is_as_live = false;  ///< the music is analyzed as it comes, as an input is
};
/// Writes the dance to a file as motion. Errors: those of the files and of the dance.
[[nodiscard]] ExitCode dance(const DanceArguments& arguments);

/// Arguments of `raks eval genre`.
struct EvalGenreArguments {
    Path folder;               ///< of music
    Path groups;               ///< table of its clips; empty: one folder a genre
    Path model;                ///< .json; empty: the one that comes with Raks
    std::string labels;        ///< only clips whose label is one of these letters; empty: all
    bool with_damage = false;  ///< also quieter, low-passed, with noise, in a room
    Path plots;                ///< folder for a picture of each file; empty: none
    engine::TaggerUse tagger = engine::TaggerUse::on;  ///< whether the shown decision asks it
    bool as_json = false;                              ///< one JSON document instead of text
    int threads = 2;                                   ///< [1, 64]
};
/// Measures how well a model tells dances apart on a folder of music, by each kind of evidence.
[[nodiscard]] ExitCode eval_genre(const EvalGenreArguments& arguments);

/// Arguments of `raks eval music`.
struct EvalMusicArguments {
    Path folder;                 ///< annotated songs: NAME.events, NAME.ogg; empty: generated ones
    long long seed = 1;          ///< of the first song of each style
    int songs = 3;               ///< of each style, [1, 1000]
    double seconds = 100.0;      ///< length of a song, 20 to 3600
    double tolerance = 1.0;      ///< seconds, of annotated events: found within, 0.05 to 5
    bool asks_for_each = false;  ///< also what was missed and wrongly told in each song
    bool as_json = false;        ///< one JSON document instead of text
};
/// Measures how well it is told what music does, live and of a song that is known, on generated
/// songs or on a folder of annotated ones.
[[nodiscard]] ExitCode eval_music(const EvalMusicArguments& arguments);

/// Arguments of `raks dances`.
struct DancesArguments {
    bool as_json = false;  ///< one JSON document instead of text
};
/// Lists all dances with their figures, where each lies, and why one that is broken is left out.
[[nodiscard]] ExitCode dances(const DancesArguments& arguments);

/// Arguments of `raks sheet`.
struct SheetArguments {
    engine::Settings settings;  ///< of the files and the options
    Path output;                ///< .png: a sheet; else a film
    std::string motion;         ///< clip in a dance's place: FILE, or FILE#NAME; empty: none
    std::optional<double> arm_angle{};  ///< as of `raks render`
    std::string figure;                 ///< of the dance; empty: its first
    double bpm = 180.0;                 ///< [50, 230]
};
/// Draws a figure from the front and the side: every 1/8 beat of 8 beats on a sheet, or a film of
/// 16 beats.
[[nodiscard]] ExitCode sheet(const SheetArguments& arguments);

/// Arguments of `raks stick`.
struct StickArguments {
    engine::Settings settings;         ///< of the files and the options
    Path input;                        ///< a motion file, or a written dance (.toml)
    Path skeleton;                     ///< .asf of an .amc; empty: looked for beside it
    Path output;                       ///< .png: front and side views; empty: a window
    std::string edges;                 ///< of points: a set, "auto", or a file; empty: none
    Path other;                        ///< a second motion, compared with the first; empty: none
    bool is_side_by_side = false;      ///< the two apart, not overlaid
    std::string align = "none";        ///< what is done to the second: none, rigid, hips or both
    double shift = 0.0;                ///< seconds by which the second begins later
    double rate = 1.0;                 ///< at which a window or film plays; -2 to 4, not 0
    bool has_names = false;            ///< names of points are shown
    bool has_trails = false;           ///< and where they have been
    std::string figure;                ///< of a written dance; empty: all
    double bpm = 0.0;                  ///< to dance it at; 0: as it is written
    double fps = 0.0;                  ///< frames a second of the clip; 0: the file's
    BodyArguments body;                ///< how the clip's body lies in its file
    bool as_json = false;              ///< says what was found instead of drawing
    std::optional<std::size_t> frame;  ///< to stand at, or to draw alone
    JointArguments joints;             ///< which joint is which bone
    Path joints_output;                ///< a joint map to write instead of a picture; empty: none
    Path counts;                       ///< TSV of beats of takes; `input` may be a folder; or none
    Path strips;                       ///< folder for strips of these beats; empty: none
    bool edits = false;                ///< sets these beats right in a window
    Path music;                        ///< that the take was danced to; empty: none
    std::optional<double> offset;      ///< seconds of it at the first frame; none: found
};
/// Plays a motion clip's own skeleton as a stick figure; without a display draws a sheet.
[[nodiscard]] ExitCode stick(const StickArguments& arguments);
/// The same of a written dance, on the mannequin.
[[nodiscard]] ExitCode stick_dance(const StickArguments& arguments);

/// Arguments of `raks synth`.
struct SynthArguments {
    std::string style;  ///< of the generator, or a dance; empty: the first dance's
    Path output;        ///< .wav
    Path beats;         ///< its beats as text; empty: not written
    Path events;        ///< its sections' events as text; empty: not written
    /// "steady", "song": drawn from the seed, or sections and their beats (audio::parse_form)
    std::string form = "steady";
    double bpm = 0.0;       ///< [50, 230]; 0: the usual tempo of the style
    double seconds = 60;    ///< (0, 3600]
    std::int64_t seed = 1;  ///< same seed, same music
};
/// Writes music of our own generator.
[[nodiscard]] ExitCode synth(const SynthArguments& arguments);

/// Arguments of `raks bench`.
struct BenchArguments {
    std::string what;       ///< latency, analysis, motion, render, avatar, train or capture
    std::string model;      ///< the avatar's: file, or a name of `raks avatar list`
    bool as_json = false;   ///< one JSON document instead of text
    double seconds = 20.0;  ///< length of the music
    bool is_held = false;   ///< latency: beats are tapped and the tempo held
};
/// Measures this machine and prints the results.
[[nodiscard]] ExitCode bench(const BenchArguments& arguments);

/// Arguments of `raks completion`.
struct CompletionArguments {
    std::string shell;  ///< bash, zsh or fish
};

/// Arguments of `raks config`.
struct ConfigArguments {
    std::string action = "show";  ///< show, path or init
    bool with_origins = false;    ///< beside each value that is shown stands who has set it
    std::string preset;           ///< over the settings that are shown; empty: none
};
/// Prints the settings or where their file lies, or writes the file.
[[nodiscard]] ExitCode config(const ConfigArguments& arguments);

}  // namespace raks::apps
