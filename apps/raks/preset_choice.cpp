#include "apps/raks/preset_choice.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace raks::apps {

// Names are read once, when the list opens, and again when one is kept.
class PresetChoice::Offer final : public engine::ListOffer {
 public:
    explicit Offer(PresetChoice& choice) : choice_(choice), names_(engine::preset_names()) {}

    [[nodiscard]] std::vector<engine::ListPage> pages() override;
    [[nodiscard]] bool take(std::size_t page, std::size_t row, std::string_view typed) override;

 private:
    PresetChoice& choice_;
    std::vector<std::string> names_;
};

Expected<void> PresetChoice::take(std::string_view name) {
    auto loaded = engine::load_preset(name);
    if (!loaded) {
        return fail(loaded.error());
    }
    for (const std::string& note : loaded->notes) {
        say_(note);
    }
    use_(loaded->preset);
    taken_ = name;
    say_("preset " + taken_);
    return {};
}

Expected<void> PresetChoice::save(std::string_view name) {
    const auto file = engine::save_preset(name, now_());
    if (!file) {
        return fail(file.error());
    }
    taken_ = name;
    say_("kept as preset " + taken_ + ": " + file->string());
    return {};
}

std::unique_ptr<engine::ListOffer> PresetChoice::offer() { return std::make_unique<Offer>(*this); }

// On the second page the first row keeps what is seen under what was typed; the others under the
// name of a preset that is there, which is replaced.
std::vector<engine::ListPage> PresetChoice::Offer::pages() {
    engine::ListPage choose{.title = "Presets",
                            .hint = "Enter: take it   Tab: keep what is seen   Esc: close"};
    engine::ListPage keep{.title = "Keep as",
                          .finds_typed = false,
                          .prompt = "type a name",
                          .hint = "Enter: keep   Esc: close"};
    keep.rows.push_back({.text = "keep what is seen under this name"});
    for (const std::string& name : names_) {
        choose.rows.push_back({.text = name, .is_current = name == choice_.taken_});
        keep.rows.push_back({.text = name, .detail = "replace it"});
    }
    if (names_.empty()) {
        choose.rows.push_back(
            {.text = "none is kept yet (Tab: keep what is seen)", .is_title = true});
    }
    return {std::move(choose), std::move(keep)};
}

bool PresetChoice::Offer::take(std::size_t page, std::size_t row, std::string_view typed) {
    if (page != kSavePage) {
        const auto done = row < names_.size() ? choice_.take(names_[row]) : Expected<void>();
        if (!done) {
            choice_.say_(done.error().message);
        }
        return true;
    }
    const std::string name = row == 0 ? std::string(typed) : names_[row - 1];
    // Who types the name of one that is there may not know that it is.
    if (row == 0 && std::find(names_.begin(), names_.end(), name) != names_.end()) {
        choice_.say_("there is a preset " + name + " already: choose it below to replace it");
        return false;
    }
    if (const auto done = choice_.save(name); !done) {
        choice_.say_(done.error().message);
        return false;
    }
    return true;
}

}  // namespace raks::apps
