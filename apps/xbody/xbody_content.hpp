// Xbody content: what the Xbody window shows and does.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/xbody/dropped_files.hpp"
#include "apps/xbody/file_arrival.hpp"
#include "apps/xbody/made_dance.hpp"
#include "apps/xbody/window_film.hpp"
#include "apps/xbody/xbody_pane.hpp"
#include "apps/xbody/xbody_session.hpp"
#include "apps/xbody/xbody_stage.hpp"
#include "apps/xbody/xbody_window.hpp"
#include "base/time.hpp"
#include "engine/live/clip_sound.hpp"
#include "render/panes/pane_host.hpp"
#include "render/panes/pane_window.hpp"

namespace raks::apps {

/// A model in a window, from its stage to its labels. Threads: main.
class XbodyContent : public render::PaneContent {
 public:
    /// `host`: draws the marks of films.
    XbodyContent(XbodyStage stage, render::PaneHost host, const XbodyStart& start);
    XbodyContent(const XbodyContent&) = delete;             ///< the session refers to the stage
    XbodyContent& operator=(const XbodyContent&) = delete;  ///< likewise

    void draw(const render::PaneFrame& frame) override;
    bool is_moving() override;
    bool may_close() override;
    [[nodiscard]] bool is_finished() const override { return is_finished_; }
    [[nodiscard]] std::string title() const override;

 private:
    void begin_session();
    void follow_session();
    void load_thumbnail();
    void draw_model(const render::PaneFrame& frame, const render::Box& box);
    void add_to_film();
    void take_arrived();
    void take_model(ShownModel model);
    void take_motion(std::string motion, engine::AvatarClip clip);
    double sound_step();
    void take_music(const DroppedFile& music);
    void take_dance();

    void fulfil(const XbodyAction& action);
    void fulfil(const FitView& wish);
    void fulfil(const PickSurface& wish);
    void fulfil(const FrameChosen& wish);
    void fulfil(const SaveXbody& wish);
    void fulfil(const WriteFilm& wish);
    void fulfil(const StopFilm& wish);
    void fulfil(const TakeFiles& wish);
    void fulfil(const CloseXbody& wish);

    XbodyStage stage_;
    render::PaneHost film_host_;
    XbodySession session_;
    std::vector<render::BoneLabel> stands_by_;  // labels by which the model stands
    XbodyView view_;
    std::optional<render::PanePicture> thumbnail_;
    std::optional<WindowFilm> film_;
    std::optional<MadeDance> dance_;            // to music that was dropped
    DroppedFile music_;                         // that it is made to
    bool awaits_dance_ = false;                 // it is not done
    FileArrival arrival_;                       // of what was dropped
    std::unique_ptr<engine::ClipSound> sound_;  // of the motion; null: it has none
    std::string first_view_;                    // until the window's form is known
    render::Box box_;                           // of the model; units
    float unit_ = 1.0F;                         // pixels
    HostTime advanced_ = HostClock::now();
    bool is_warned_ = false;  // that labels are not saved
    bool is_finished_ = false;
};

}  // namespace raks::apps
