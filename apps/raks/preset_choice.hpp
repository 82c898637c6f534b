#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/setup/presets.hpp"
#include "engine/show/list_panel.hpp"

namespace raks::apps {

/// The list of presets: one page to take one, one to keep what is seen now. Threads: main.
class PresetChoice {
 public:
    /// `now`: what is seen; `use`: makes it so.
    PresetChoice(std::function<engine::Preset()> now,
                 std::function<void(const engine::Preset&)> use,
                 engine::SayLine say)
        : now_(std::move(now)), use_(std::move(use)), say_(std::move(say)) {}

    static constexpr std::string_view kName = "presets";  ///< of the list
    static constexpr std::size_t kSavePage = 1;           ///< its page that keeps

    /// Takes the preset of this name. Errors: those of engine::load_preset.
    [[nodiscard]] Expected<void> take(std::string_view name);
    /// Keeps what is seen under this name, in the place of a preset that has it. Errors: those of
    /// engine::save_preset.
    [[nodiscard]] Expected<void> save(std::string_view name);

    /// The list. This must outlive it.
    [[nodiscard]] std::unique_ptr<engine::ListOffer> offer();

 private:
    class Offer;

    std::function<engine::Preset()> now_;
    std::function<void(const engine::Preset&)> use_;
    engine::SayLine say_;
    std::string taken_;  // name of the one that was taken or kept last
};

}  // namespace raks::apps
