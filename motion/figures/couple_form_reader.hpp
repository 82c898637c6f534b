// Reading of couple forms.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/toml_tree.hpp"
#include "motion/figures/couple_form.hpp"

namespace raks::motion {

/// What a reader could not use, a line each: "FILE: line N: what; what the dance does instead".
class HoldComplaints {
 public:
    /// `name`: of the file; `lines`: where they are appended. Both must outlive this.
    HoldComplaints(std::string_view name, std::vector<std::string>& lines)
        : name_(name), lines_(lines) {}
    /// Adds a line about a node.
    void add(const toml::node& node, std::string_view what);

 private:
    std::string_view name_;
    std::vector<std::string>& lines_;
};

/// Reads [couple]: hold, apart, and of a closed hold hips, clasp, look and contacts. What is
/// unknown or out of range is complained of and left as it was; of an unknown hold that is none.
[[nodiscard]] CoupleForm read_couple_form(const toml::node& node, HoldComplaints& complaints);

/// Reads `holds` of a figure. A hold that is none is complained of and left out.
[[nodiscard]] std::vector<HeldHands> read_held_hands(const toml::node& node,
                                                     HoldComplaints& complaints);

}  // namespace raks::motion
