#include "apps/raks/midi_choice.hpp"

#include <utility>
#include <vector>

namespace raks::apps {
namespace {

using engine::MidiWish;

class MidiOffer final : public engine::ListOffer {
 public:
    MidiOffer(engine::MidiInput& input, std::vector<MidiWish> wishes)
        : input_(input), wishes_(std::move(wishes)) {}
    // Nothing is waited for that is not seen.
    ~MidiOffer() override { input_.learn(std::nullopt); }
    MidiOffer(const MidiOffer&) = delete;
    MidiOffer& operator=(const MidiOffer&) = delete;

    [[nodiscard]] std::vector<engine::ListPage> pages() override {
        engine::ListPage page{.title = "MIDI",
                              .hint = "Enter: teach it   Space: forget it   Esc: close"};
        const std::string& device = input_.device();
        page.rows.push_back({.text = device.empty()
                                         ? "nothing called " + input_.name() + " is connected yet"
                                         : device,
                             .is_title = true});
        for (const MidiWish& wish : wishes_) {
            const bool is_waited_for = input_.learning() == wish;
            const std::string controls = input_.controls_of(wish);
            page.rows.push_back(
                {.text = in_words(wish),
                 .detail = !is_waited_for   ? controls
                           : wish.is_turned ? "turn the knob now"
                                            : "press the button now",
                 .is_checked = controls.empty() ? std::optional<bool>() : std::optional(true),
                 .is_current = is_waited_for});
        }
        return {std::move(page)};
    }

    [[nodiscard]] bool take(std::size_t, std::size_t row, std::string_view) override {
        if (row >= 1 && row <= wishes_.size() && !input_.device().empty()) {
            input_.learn(wishes_[row - 1]);
        }
        return false;
    }

    void check(std::size_t, std::size_t row) override {
        if (row >= 1 && row <= wishes_.size()) {
            input_.forget(wishes_[row - 1]);
        }
    }

 private:
    engine::MidiInput& input_;
    std::vector<MidiWish> wishes_;
};

}  // namespace

std::unique_ptr<engine::ListOffer> offer_midi(engine::MidiInput& input,
                                              const std::function<bool(engine::Action)>& is_there) {
    return std::make_unique<MidiOffer>(input, engine::midi_wishes(is_there));
}

}  // namespace raks::apps
