#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/play_set.hpp"
#include "apps/raks/song_player.hpp"
#include "apps/raks/stage_loop.hpp"
#include "audio/io/devices.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// A show in one window, or without one: files that play, or an input that is listened to. What
/// people ask for in the window makes it go from one to the other. Threads: main.
class ShowSession {
 public:
    /// `arguments`: of `play`; those that it shares with `live` count for both. `listens_for`:
    /// seconds of an input; until stopped when absent.
    explicit ShowSession(PlayArguments arguments, std::optional<double> listens_for = std::nullopt);

    /// The commands of these names.
    [[nodiscard]] ExitCode play();
    [[nodiscard]] ExitCode live();  ///< likewise
    [[nodiscard]] ExitCode open();  ///< likewise

 private:
    [[nodiscard]] Expected<void> choose_files(const std::vector<Path>& given);
    [[nodiscard]] Expected<void> choose_input();
    [[nodiscard]] Expected<void> choose_output();
    [[nodiscard]] Expected<audio::AudioSystem*> system();
    [[nodiscard]] StageLoop::Options stage_options() const;
    void recall_window();
    [[nodiscard]] Expected<void> set_stage();
    [[nodiscard]] Expected<bool> set_stage_in_window();
    [[nodiscard]] Expected<void> listen_or_play_own();
    [[nodiscard]] ExitCode run();
    [[nodiscard]] Expected<bool> play_files();
    [[nodiscard]] Expected<std::unique_ptr<engine::LiveGraph>> open_input() const;
    [[nodiscard]] Expected<bool> listen();
    void carry_out(StageWish wish);
    [[nodiscard]] Expected<void> change_music(const std::vector<Path>& files);
    [[nodiscard]] Expected<void> change_input(const std::string& name);
    [[nodiscard]] Expected<void> change_output(const std::string& name);
    void change_dances(StageWish wish);
    void say_skipped(const PlaySet& files);

    PlayArguments arguments_;
    std::optional<double> listens_for_;
    std::optional<audio::AudioSystem> system_;
    std::optional<audio::AudioDevice> output_;  // none: no sound
    bool has_output_ = false;                   // it was chosen, or none is wanted
    std::optional<audio::DeviceChoice> input_;
    bool is_input_named_ = false;
    std::unique_ptr<engine::LiveGraph> opened_;  // of input_, where it is open already
    std::unique_ptr<PlaySet> files_;             // null: an input is listened to
    std::optional<double> place_;                // in the file at which it goes on
    std::shared_ptr<StageSetup> setup_;
    std::vector<std::string> forbidden_;  // dances, at the start
    KeptWindow kept_;
    std::unique_ptr<StageLoop> loop_;
    std::string why_own_music_;
    bool has_failed_ = false;
    bool has_played_ = false;
    bool was_partly_ = false;
};

}  // namespace raks::apps
