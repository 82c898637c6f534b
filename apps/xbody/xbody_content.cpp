#include "apps/xbody/xbody_content.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>
#include <variant>

#include "apps/xbody/surface_pick.hpp"
#include "apps/xbody/thumbnail.hpp"
#include "apps/xbody/xbody_texts.hpp"
#include "base/printable.hpp"
#include "engine/setup/user_folders.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/shader_warm_up.hpp"

#include <fmt/format.h>
#include <imgui.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

engine::ClipTransport transport_of(const ShownModel& model, std::size_t frame) {
    return model.clip && frame == 0
               ? engine::ClipTransport(model.frame_count(), model.rate())
               : engine::ClipTransport(model.frame_count(), model.rate(), frame);
}

std::vector<render::BoneLabel> labels_of(const ShownModel& model) {
    return model.labels ? model.labels->bones : std::vector<render::BoneLabel>();
}

/// Lets a driver finish shaders before a model is there, and opens the loudspeaker.
FileArrival::Preparation preparation_of(const XbodyStage& stage) {
    return [quality = stage.quality()](DroppedFiles& files) {
        if (files.model) {
            render::warm_up_shaders(*files.model->avatar, quality);
        }
        if (files.sound.empty()) {
            return;
        }
        if (auto player = engine::ClipSound::open(files.sound)) {
            files.player = std::move(*player);
        } else {
            files.sound.clear();
            files.faults.push_back("No sound: " + player.error().message);
        }
    };
}

}  // namespace

XbodyContent::XbodyContent(XbodyStage stage, render::PaneHost host, const XbodyStart& start)
    : stage_(std::move(stage)),
      film_host_(std::move(host)),
      session_(xbody_session(stage_.model().as_read,
                             labels_of(stage_.model()),
                             transport_of(stage_.model(), start.frame),
                             {})),
      arrival_(preparation_of(stage_)),
      first_view_(start.view) {
    session_.has_names = start.has_names;
    begin_session();
}

// Of what is the same as long as the model is.
void XbodyContent::begin_session() {
    stands_by_ = session_.labels.now();
    view_.meshes = mesh_lines(stage_.model().as_read);
    load_thumbnail();
    follow_session();
}

// What changes with the labels.
void XbodyContent::follow_session() {
    const render::HumanoidMap& humanoid = stage_.model().figure.model.character.humanoid;
    view_.file = file_lines(stage_.model());
    view_.expressions = expression_names(stage_.model());
    view_.can_pose = render::missing_bones(humanoid).empty();
    view_.can_gaze = stage_.model().as_read.character.has_look_at;
    view_.film = film_lines(stage_.model(), engine::pictures_folder());
}

void XbodyContent::load_thumbnail() {
    thumbnail_.reset();
    view_.thumbnail = nullptr;
    if (const auto found = thumbnail_of(stage_.model().as_read)) {
        thumbnail_.emplace(found->width, found->height, found->rgb);
        view_.thumbnail = &*thumbnail_;
        view_.thumbnail_aspect =
            static_cast<float>(found->width) / static_cast<float>(found->height);
    }
}

void XbodyContent::draw(const render::PaneFrame& frame) {
    take_arrived();
    take_dance();
    box_ = xbody_layout(frame.area).view;
    unit_ = frame.pen.unit();
    if (!first_view_.empty()) {
        fulfil(FitView{std::exchange(first_view_, std::string())});
    }
    add_to_film();
    draw_model(frame, box_);
    view_.kinds = node_kinds(stage_.model().as_read, session_.humanoid);
    view_.seen = seen_marks(stage_.model(),
                            stage_.shown(),
                            session_.humanoid,
                            session_.tree.is_hidden,
                            session_.camera,
                            box_,
                            session_.marks());
    for (const XbodyWish& wish : xbody_pane(frame, session_, view_)) {
        std::visit([this](const auto& one) { fulfil(one); }, wish);
    }
}

bool XbodyContent::is_moving() {
    const HostTime now = HostClock::now();
    const double passed = to_seconds(now - std::exchange(advanced_, now));
    session_.transport.advance(passed + sound_step());
    const bool plays = !session_.transport.is_paused() && stage_.model().frame_count() > 1;
    return plays || film_ || arrival_.is_due();
}

// Seconds by which the clip goes where the sound is heard: a loudspeaker is later than the picture,
// and its clock is another.
double XbodyContent::sound_step() {
    if (!sound_) {
        return 0.0;
    }
    const engine::ClipTransport& clip = session_.transport;
    const bool sounds = !clip.is_paused() && clip.rate() == 1.0 && stage_.model().frame_count() > 1;
    const double step = sound_->follow(clip.seconds(), sounds);
    if (sound_->is_lost()) {
        session_.message = "The loudspeaker is gone: it is moved on without sound";
        sound_.reset();
    }
    return step;
}

bool XbodyContent::may_close() {
    if (session_.labels.is_saved() || is_warned_) {
        return true;
    }
    is_warned_ = true;
    session_.message = "Not saved: S saves, Q once more closes without";
    return false;
}

std::string XbodyContent::title() const { return xbody_title(stage_.model()); }

void XbodyContent::draw_model(const render::PaneFrame& frame, const render::Box& box) {
    if (session_.labels.now() != stands_by_) {
        stands_by_ = session_.labels.now();
        const std::size_t at = session_.transport.frame();
        const std::size_t count = stage_.model().frame_count();
        if (auto stood = stage_.stand_by_labels(stands_by_); !stood) {
            session_.message = stood.error().message;
        }
        if (stage_.model().frame_count() != count) {
            session_.transport = transport_of(stage_.model(), at);
        }
        arrival_.ask_again(wearer_of(stage_.model()));
        follow_session();
    }
    if (auto drawn = stage_.set_look(session_.look()); !drawn) {
        session_.message = drawn.error().message;
    }
    stage_.show(session_.transport.frame(), session_.tuning);
    stage_.draw(session_.camera, session_.is_wireframe, frame.target_of(box));
}

// A few pictures a frame, so that the window can be used meanwhile.
void XbodyContent::add_to_film() {
    view_.film_share.reset();
    if (!film_) {
        return;
    }
    constexpr Nanos kMost = std::chrono::milliseconds(40);
    // Films have panes of their own, which are drawn while the window's are being made.
    ImGuiContext* const panes = ImGui::GetCurrentContext();
    const HostTime began = HostClock::now();
    Expected<void> added;
    while (added && film_->share() < 1.0 && HostClock::now() - began < kMost) {
        added = film_->add_next(stage_, film_host_);
    }
    ImGui::SetCurrentContext(panes);
    if (!added) {
        session_.message = added.error().message;
        film_.reset();
    } else if (film_->share() >= 1.0) {
        fulfil(StopFilm{});
    } else {
        view_.film_share = film_->share();
    }
}

void XbodyContent::take_arrived() {
    std::optional<DroppedFiles> files = arrival_.take();
    if (!files) {
        return;
    }
    if (files->model && !may_close()) {
        session_.message = "Labels are not saved: S saves, drop it once more to go on without";
        return;
    }
    const std::string message = message_of(*files);
    session_.message.clear();
    if (awaits_dance_ && !files->motion.empty()) {
        awaits_dance_ = false;
        dance_.reset();
    }
    if (files->model || files->clip) {
        sound_ = std::move(files->player);
    }
    if (files->model) {
        take_model(std::move(*files->model));
    } else if (files->clip) {
        take_motion(std::move(files->motion), std::move(*files->clip));
    }
    if (files->music) {
        take_music(*files->music);
    }
    if (session_.message.empty()) {
        session_.message = message;
    }
}

void XbodyContent::take_model(ShownModel model) {
    film_.reset();
    if (auto taken = stage_.take_model(std::move(model)); !taken) {
        session_.message = taken.error().message;
    }
    const XbodySession before = std::exchange(session_,
                                              xbody_session(stage_.model().as_read,
                                                            labels_of(stage_.model()),
                                                            transport_of(stage_.model(), 0),
                                                            {}));
    session_.message = before.message;
    session_.page = before.page;
    session_.has_bones = before.has_bones;
    session_.has_names = before.has_names;
    session_.has_springs = before.has_springs;
    is_warned_ = false;
    begin_session();
    fulfil(FitView{"front"});
}

void XbodyContent::take_motion(std::string motion, engine::AvatarClip clip) {
    film_.reset();
    stage_.wear(std::move(motion), std::move(clip));
    session_.transport = transport_of(stage_.model(), 0);
    follow_session();
}

void XbodyContent::take_music(const DroppedFile& music) {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    auto dance = MadeDance::begin(program, music.path);
    if (!dance) {
        session_.message = dance.error().message;
        return;
    }
    dance_ = std::move(*dance);
    awaits_dance_ = true;
    music_ = music;
}

// What was made stays as long as it is the motion: other labels read it anew.
void XbodyContent::take_dance() {
    if (!awaits_dance_ || arrival_.is_awaited()) {
        return;
    }
    const auto made = dance_->take();
    awaits_dance_ = made && !*made;
    if (!made) {
        session_.message = made.error().message;
    } else if (*made) {
        arrival_.ask({{**made, "a dance to " + music_.name, music_.path}},
                     wearer_of(stage_.model()));
    }
}

void XbodyContent::fulfil(const XbodyAction& action) {
    if (!std::holds_alternative<MoveCamera>(action)) {
        is_warned_ = false;
    }
    apply(action, session_);
}

void XbodyContent::fulfil(const FitView& wish) {
    session_.camera =
        camera_before(stage_.model(), stage_.shown(), wish.view, box_.width / box_.height);
}

void XbodyContent::fulfil(const FrameChosen& /*wish*/) {
    std::vector<glm::vec3> points =
        branch_places(stage_.model(), stage_.shown(), session_.node.value_or(-1));
    if (points.empty()) {
        points = branch_places(stage_.model(), stage_.shown(), -1);
    }
    if (!points.empty()) {
        session_.camera = camera_before(session_.camera, points, box_.width / box_.height);
    }
}

void XbodyContent::fulfil(const PickSurface& wish) {
    const auto node = node_at(
        wish.at, stage_.model(), stage_.shown(), session_.tree.is_hidden, session_.camera, box_);
    if (node) {
        apply(ChooseNode{*node}, session_);
    }
}

void XbodyContent::fulfil(const SaveXbody& /*wish*/) {
    const fs::path& file = stage_.model().labels_file;
    const auto saved = engine::save_labels(file, session_.labels);
    session_.message = saved ? "Saved: " + printable(file.string()) : saved.error().message;
}

void XbodyContent::fulfil(const WriteFilm& wish) {
    auto film = WindowFilm::begin(
        free_film_name(engine::pictures_folder(), stage_.model().file(), wish.ending),
        stage_,
        session_,
        {static_cast<int>(box_.width * unit_), static_cast<int>(box_.height * unit_)},
        unit_);
    if (!film) {
        session_.message = film.error().message;
        return;
    }
    film_ = std::move(*film);
    session_.message = "Writing " + printable(film_->file().string());
}

void XbodyContent::fulfil(const StopFilm& /*wish*/) {
    if (film_) {
        const auto written = film_->finish();
        session_.message =
            written ? "Written: " + printable(film_->file().string()) : written.error().message;
        film_.reset();
    }
}

void XbodyContent::fulfil(const TakeFiles& wish) {
    std::vector<DroppedFile> files;
    std::transform(wish.paths.begin(), wish.paths.end(), std::back_inserter(files), dropped_file);
    session_.message = loading_message(files);
    arrival_.ask(std::move(files), wearer_of(stage_.model()));
}

void XbodyContent::fulfil(const CloseXbody& /*wish*/) { is_finished_ = may_close(); }

}  // namespace raks::apps
