// What is chosen from the stage's lists, and what is dropped on it.
#include <future>
#include <string>
#include <utility>

#include "apps/raks/midi_choice.hpp"
#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/show/stage_drop.hpp"
#include "engine/show/themes.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using engine::Action;

constexpr std::string_view kDances = "dances";  // the list's name

template <typename Value>
bool is_ready(const std::future<Value>& future) {
    return future.valid() && future.wait_for(Nanos(0)) == std::future_status::ready;
}

Expected<std::unique_ptr<engine::ClipPerformance>> performance_of(
    const MotionWish& wish, const std::string& name, const engine::Settings& settings) {
    auto opened = open_clip(wish.file, settings, wish.arm_angle);
    if (!opened) {
        return fail(opened.error());
    }
    const engine::ClipTiming timing = wish.timing(*opened);
    auto performance = std::make_unique<engine::ClipPerformance>(
        engine::ClipPerformer(std::move(*opened), timing), name);
    if (!wish.camera.empty()) {
        auto camera = engine::CameraMotion::load(wish.camera);
        if (!camera) {
            return fail(std::move(camera.error()));
        }
        performance->set_camera(std::move(*camera));
    }
    return performance;
}

}  // namespace

SourceChoice::Means StageLoop::means_of_sources() {
    SourceChoice::Means means;
    means.input = [this] {
        return graph_->playback() == nullptr ? graph_->device().name : std::string();
    };
    means.output = [this] {
        return graph_->playback() != nullptr ? graph_->device().name : std::string();
    };
    means.level_dbfs = [this] { return graph_->analysis().level_dbfs(HostClock::now()); };
    means.queue = [this] { return source_.queue; };
    means.listen = [this](std::string name) {
        say_fault(ask({.kind = StageWish::Kind::input, .name = std::move(name)}));
    };
    means.play_on = [this](std::string name) {
        say_fault(ask({.kind = StageWish::Kind::output, .name = std::move(name)}));
    };
    means.play_file = [this](std::size_t place) {
        source_.queue->go_to(place);
        wish_ = StageEnd::chosen_file;
    };
    return means;
}

// Lists need a window; who asks by a name needs none.
void StageLoop::bind_choices(engine::ActionDispatcher& actions) {
    actions.on(Action::next_dance, [this](double) {
        stop_performing();
        choice_.select_next();
    });
    actions.on_text(Action::choose_dance, [this](const std::string& name) {
        stop_performing();
        return choice_.select(name);
    });
    actions.on_text(Action::choose_figure,
                    [this](const std::string& name) { return choice_.select_figure(name); });
    actions.on_text(Action::forbid_dance,
                    [this](const std::string& name) { return choice_.allow(name, false); });
    actions.on_text(Action::allow_dance,
                    [this](const std::string& name) { return choice_.allow(name, true); });
    actions.on_text(Action::choose_source, [this](const std::string& name) {
        return ask({.kind = StageWish::Kind::input, .name = name});
    });
    actions.on_text(Action::choose_output, [this](const std::string& name) {
        return ask({.kind = StageWish::Kind::output, .name = name});
    });
    if (!window_) {
        return;
    }
    bind_presets(actions);
    actions.on(Action::learn_midi, [this](double) { learn_midi(); });
    actions.on(Action::choose_source, [this](double) {
        window_->toggle_list(SourceChoice::kName, 0, [this] { return sources_.offer(); });
    });
    actions.on(Action::show_queue, [this](double) {
        window_->toggle_list(
            SourceChoice::kName, SourceChoice::kQueuePage, [this] { return sources_.offer(); });
    });
    actions.on(Action::choose_dance, [this](double) {
        stop_performing();
        window_->toggle_list(kDances, 0, [this] { return choice_.offer(); });
    });
}

void StageLoop::learn_midi() {
    engine::MidiInput* const midi = remote_->midi();
    if (midi == nullptr) {
        say("no MIDI controller is listened to: start with --midi-in NAME");
        return;
    }
    window_->toggle_list(kMidiList, 0, [this, midi] {
        return offer_midi(*midi, [this](Action action) { return actions_->handles(action); });
    });
}

// What a preset holds is what is seen, so that it needs a window.
void StageLoop::bind_presets(engine::ActionDispatcher& actions) {
    actions.on(Action::choose_preset, [this](double) {
        window_->toggle_list(PresetChoice::kName, 0, [this] { return presets_.offer(); });
    });
    actions.on(Action::save_preset, [this](double) {
        window_->toggle_list(
            PresetChoice::kName, PresetChoice::kSavePage, [this] { return presets_.offer(); });
    });
    actions.on_text(Action::choose_preset,
                    [this](const std::string& name) { return presets_.take(name); });
    actions.on_text(Action::save_preset,
                    [this](const std::string& name) { return presets_.save(name); });
}

engine::Preset StageLoop::preset_now() {
    const render::Scene& scene = window_->scene();
    engine::Preset preset;
    preset.theme = scene.theme->name;
    preset.camera = window_->camera_name();
    preset.backdrop = engine::backdrop_word(scene);
    preset.view = scene.view == render::View::stick ? "stick" : "skin";
    preset.avatars =
        window_->chosen_avatars().empty() ? settings_.avatars : window_->chosen_avatars();
    preset.dance = choice_.name().empty() ? "auto" : std::string(choice_.name());
    preset.formation = formations_->name();
    preset.forbidden = choice_.forbidden();
    preset.outputs.emplace();
    for (const engine::VideoWish& wish : options_.video.wishes) {
        preset.outputs->push_back(wish.target);
    }
    preset.told.emplace();
    for (const engine::OutputWish& wish : options_.outputs) {
        if (wish.kind->is_kept) {
            preset.told->push_back(wish.text());
        }
    }
    return preset;
}

// What cannot be had is said, and the rest is done.
void StageLoop::take_preset(const engine::Preset& preset) {
    render::Scene& scene = window_->scene();
    if (preset.theme) {
        const auto theme = engine::find_theme(*preset.theme);
        theme ? void(scene.theme = *theme) : say(theme.error().message);
    }
    if (preset.backdrop) {
        if (const auto backdrop = engine::parse_backdrop(*preset.backdrop)) {
            set_backdrop(scene, *backdrop);
        }
    }
    if (preset.view && *preset.view != "auto") {
        scene.view = *preset.view == "stick" ? render::View::stick : render::View::skin;
    }
    if (preset.camera) {
        window_->set_camera(*preset.camera, *this);
    }
    if (preset.avatars && *preset.avatars != *preset_now().avatars) {
        window_->wear(*preset.avatars);
    }
    if (preset.formation && *preset.formation != formations_->name()) {
        say_fault(formations_->ask_for(*preset.formation));
    }
    if (preset.forbidden) {
        choice_.forbid_only(*preset.forbidden);
    }
    if (preset.dance && *preset.dance != *preset_now().dance) {
        say_fault(choice_.select(*preset.dance));
    }
    if (preset.outputs) {
        change_outputs(*preset.outputs);
    }
    if (preset.told) {
        change_told(*preset.told);
    }
}

// Lines to files stay. What cannot be told is said, and the others are.
void StageLoop::change_told(const std::vector<std::string>& targets) {
    if (targets == *preset_now().told) {
        return;
    }
    std::vector<engine::OutputWish> wishes = options_.outputs;
    const bool writes_files = std::erase_if(wishes, [](const auto& wish) {
                                  return wish.kind->is_kept;
                              }) < options_.outputs.size();
    if (writes_files) {
        say("--lines: who is told stays as it is while lines are written");
        return;
    }
    for (const std::string& target : targets) {
        if (auto wish = engine::parse_output_wish(target)) {
            wishes.push_back(std::move(*wish));
        } else {
            say(wish.error().message);
        }
    }
    auto outputs = engine::Outputs::open(wishes);
    if (!outputs) {
        say(outputs.error().message);
        return;
    }
    options_.outputs = wishes;
    outputs_ = std::move(*outputs);
    if (graph_ != nullptr) {
        outputs_->follow(graph_->feed(), dances_);
    }
}

// The outputs that are open already stay where they are all that is asked for.
void StageLoop::change_outputs(const std::vector<std::string>& targets) {
    if (targets == *preset_now().outputs) {
        return;
    }
    VideoArguments wished = options_.video;
    wished.wishes.clear();
    for (const std::string& target : targets) {
        wished.wishes.push_back({.target = target});
    }
    video_.reset();
    options_.video = wished;
    if (targets.empty()) {
        return;
    }
    auto video = VideoShow::create(wished, settings_);
    if (!video) {
        options_.video.wishes.clear();
        say(video.error().message);
        return;
    }
    video_ = std::move(*video);
}

void StageLoop::say_fault(const Expected<void>& done) {
    if (!done) {
        say(done.error().message);
    }
}

// A pipe cannot be opened twice, so that it ends with what comes in its place.
Expected<void> StageLoop::ask(StageWish wish) {
    engine::Playback* const playback = graph_->playback();
    const bool goes_on =
        wish.kind == StageWish::Kind::output || wish.kind == StageWish::Kind::dances;
    if (goes_on && playback != nullptr && !playback->player().can_seek()) {
        return fail("not while sound comes through a pipe");
    }
    asked_ = std::move(wish);
    wish_ = StageEnd::wish;
    return {};
}

bool StageLoop::take_dropped(const std::vector<std::string>& paths) {
    engine::StageDrop files = engine::sort_drop(paths);
    for (const std::string& line : files.lines) {
        say(line);
    }
    dropped_model_ =
        files.models.size() == 1 ? std::optional<Path>(files.models.front()) : std::nullopt;
    if (!files.models.empty()) {
        window_->wear(std::move(files.models));
    }
    if (!files.dances.empty()) {
        learn_dropped(files.dances.front());
    }
    if (!files.clips.empty()) {
        load_clip(files.clips.front());
    }
    if (!files.music.empty()) {
        play_dropped(files.music);
    }
    return true;
}

// A file of a model's form may hold motion alone, as those of stores of motion do.
bool StageLoop::take_refused(const Error& why) {
    const bool is_motion = dropped_model_ && why.message.ends_with(engine::kMotionAlone);
    if (is_motion) {
        load_clip(*dropped_model_);
    }
    dropped_model_.reset();
    return is_motion;
}

// While the queue is looked at, music is added to it.
void StageLoop::play_dropped(const std::vector<Path>& files) {
    const engine::ListPanel& list = window_->list();
    const bool is_queue_open =
        list.name() == SourceChoice::kName && list.page() == SourceChoice::kQueuePage;
    if (!is_queue_open || source_.queue == nullptr) {
        say_fault(ask({.kind = StageWish::Kind::music, .files = files}));
        return;
    }
    const auto added = source_.queue->add(files);
    say(!added        ? added.error().message
        : *added == 1 ? "added: " + printable(files.front().filename().string())
                      : fmt::format("added: {} files", *added));
}

void StageLoop::learn_dropped(const Path& place) {
    if (learning_.valid()) {
        say("another dance is being loaded: wait for it");
        return;
    }
    say("loading " + printable(place.filename().string()));
    learning_ = std::async(std::launch::async, load_dance, settings_, place);
}

void StageLoop::load_clip(const Path& file) {
    if (clip_loading_.valid()) {
        say("another clip is being loaded: wait for it");
        return;
    }
    const std::string name = printable(file.filename().string());
    say("loading " + name);
    clip_loading_ = std::async(
        std::launch::async,
        [file, name, settings = settings_]() -> Expected<std::unique_ptr<engine::ClipPerformance>> {
            MotionWish wish;
            wish.file = file.string();
            return performance_of(wish, name, settings);
        });
}

// What is asked for on the command line is there from the start.
Expected<void> StageLoop::perform_wished() {
    const MotionWish& wish = options_.motion;
    if (wish.file.empty()) {
        return {};
    }
    const std::string name = printable(engine::AvatarClip::file_of(wish.file).filename().string());
    auto performance = performance_of(wish, name, settings_);
    if (!performance) {
        return fail(performance.error());
    }
    performance_ = std::move(*performance);
    apps::say(fmt::format("performing {}: {}", name, performance_->description()));
    return {};
}

// With every picture: a seek leads to another place of the song.
void StageLoop::follow_song() {
    engine::Playback* const playback = graph_->playback();
    if (performance_ && playback != nullptr) {
        performance_->follow_song(playback->position_seconds() -
                                  to_seconds(graph_->analysis().taken_until() - StreamTime{}));
    }
}

// With every picture: what was dropped may be there.
void StageLoop::take_loaded() {
    if (is_ready(clip_loading_)) {
        if (auto clip = clip_loading_.get()) {
            performance_ = std::move(*clip);
            say(fmt::format("performing {}: {} (D: dance again)",
                            performance_->name(),
                            performance_->description()));
        } else {
            say(clip.error().message);
        }
    }
    if (is_ready(learning_)) {
        if (auto dance = learning_.get()) {
            stop_performing();
            say_fault(ask({.kind = StageWish::Kind::dances,
                           .name = std::move(dance->name),
                           .setup = std::move(dance->setup)}));
        } else {
            say(dance.error().message);
        }
    }
}

void StageLoop::stop_performing() { performance_.reset(); }

}  // namespace raks::apps
