#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/reports/bound.hpp"
#include "base/json.hpp"
#include "engine/trials/dynamics_trial.hpp"

namespace raks::apps {

/// One dance's dynamics, to music that comes and to music that is known.
struct DynamicsReport {
    engine::DynamicsResult known;  ///< as to a file
    engine::DynamicsResult live;   ///< as to an input
};

/// One quantity of the dynamics: a row of their table.
struct DynamicsQuantity {
    std::string_view id;         ///< in JSON: "silence_ratio"
    std::string_view title;      ///< of the row
    int digits = 2;              ///< decimals in the text table
    std::optional<Bound> bound;  ///< to reach; none: it is only reported
    /// Reads it; nothing where the dance does not have it.
    std::optional<double> (*value)(const engine::DynamicsResult& result);
    /// Set where it says something of only one of the two dances.
    std::optional<engine::Knowledge> only = std::nullopt;
};
/// All of them, in the order of the table. Threads: any.
[[nodiscard]] std::span<const DynamicsQuantity> dynamics_quantities() noexcept;

/// How many values have a bound, and how many of them do not reach it; a missing one does not.
struct Verdict {
    std::size_t bounded = 0;
    std::size_t outside = 0;
};
/// Of both dances.
[[nodiscard]] Verdict verdict_of(const DynamicsReport& report);

/// A table in Markdown: quantity, bound, both values ("!": out of bounds), reached or not.
[[nodiscard]] std::string to_text(const DynamicsReport& report);
/// `bounds`, and by `known` and `live`: `values` and `outside`.
[[nodiscard]] Json to_json(const DynamicsReport& report);

/// How the dances to one file follow it.
struct FollowedFile {
    std::string name;              ///< of the file
    engine::MusicFollowing known;  ///< as a file
    engine::MusicFollowing live;   ///< as an input
};
/// A table in Markdown with the mean of all; `files`: at least one.
[[nodiscard]] std::string to_text(std::span<const FollowedFile> files);
/// One JSON document: format "raks-eval-dance-against", version 1.
[[nodiscard]] std::string to_json(std::span<const FollowedFile> files);

}  // namespace raks::apps
