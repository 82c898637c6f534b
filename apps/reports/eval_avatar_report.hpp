#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/reports/eval_dance_report.hpp"
#include "engine/trials/avatar_measures.hpp"
#include "engine/trials/dance_trial.hpp"

namespace raks::apps {

/// An avatar in one dance.
struct AvatarDance {
    std::string dance;            ///< its name
    engine::TrialResult trial;    ///< of the bones, as large as the mannequin
    engine::AvatarMeasures mesh;  ///< of what is drawn
    double pelvis_height = 0.0;   ///< of the avatar (render::Avatar::pelvis_drop); metres
};

/// One avatar.
struct AvatarRow {
    std::string model;                ///< as it was named
    std::string name;                 ///< of its file, without ending
    double height = 0.0;              ///< of the mesh; metres
    double hips_height = 0.0;         ///< metres
    std::vector<AvatarDance> dances;  ///< one a dance
};

/// Everything that `raks eval avatar` reports.
struct AvatarReport {
    std::int64_t seed = 1;           ///< of the dancers
    std::vector<AvatarRow> avatars;  ///< in the order of the command
};

/// One quantity: a column of the report.
struct AvatarQuantity {
    std::string_view id;     ///< in JSON: "slip_p90_cm"
    std::string_view title;  ///< of the column
    int digits;              ///< decimals in the text table
    /// Reads it; nothing where the avatar does not have it.
    std::optional<double> (*value)(const AvatarDance& dance);
    /// Its bound; nothing: it is only reported. Lengths of feet go by the height of the pelvis.
    std::optional<Bound> (*bound)(const AvatarDance& dance);
};
/// All quantities. Threads: any.
[[nodiscard]] std::span<const AvatarQuantity> avatar_quantities() noexcept;

/// Ids of the quantities that lie outside their bound.
[[nodiscard]] std::vector<std::string> outside_of(const AvatarDance& dance);

/// A table in Markdown, a row for each avatar and dance; values out of bounds are marked by "!".
[[nodiscard]] std::string to_text(const AvatarReport& report);

/// One JSON document: format "raks-eval-avatar", version 1.
[[nodiscard]] std::string to_json(const AvatarReport& report);

}  // namespace raks::apps
