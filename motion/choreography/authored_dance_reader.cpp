#include <array>

#include "base/dance_list.hpp"
#include "base/file.hpp"
#include "base/toml_reader.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/choreography/figure_check.hpp"
#include "motion/choreography/figure_reader.hpp"
#include "motion/choreography/follow_figure.hpp"

namespace raks::motion {
namespace {

using Names = std::vector<std::string_view>;

constexpr std::size_t kMostFigures = 200;  // in one file
// Bounds of the work of baking, far beyond any dance: frames and memory grow with both.
constexpr int kMostBeats = 800;        // of all figures of a file
constexpr double kMostSeconds = 60.0;  // of one figure at the slowest tempo

// A number of the style: its name in the file, its field and the range allowed.
struct StyleKey {
    std::string_view name;
    double DanceStyle::*field;
    NumberRange range;
};
constexpr std::array<StyleKey, 24> kStyleKeys = {{
    {"stance", &DanceStyle::stance, {0, 80}},
    {"toe_out", &DanceStyle::toe_out, {-30, 60}},
    {"knee", &DanceStyle::knee, {0, 100}},
    {"air", &DanceStyle::air, {0.05, 4}},
    {"weight_time", &DanceStyle::weight_time, {0.05, 4}},
    {"over", &DanceStyle::over, {0, 1}},
    {"sway", &DanceStyle::sway, {-15, 15}},
    {"step_yaw", &DanceStyle::step_yaw, {-90, 90}},
    {"iso", &DanceStyle::iso, {0, 1}},
    {"head_follow", &DanceStyle::head_follow, {0, 1}},
    {"lag_chest", &DanceStyle::lag_chest, {0, 1}},
    {"lag_head", &DanceStyle::lag_head, {0, 1}},
    {"lag_arm", &DanceStyle::lag_arm, {0, 1}},
    {"lag_elbow", &DanceStyle::lag_elbow, {0, 1}},
    {"lag_hand", &DanceStyle::lag_hand, {0, 1}},
    {"drag", &DanceStyle::drag, {0, 1}},
    {"breath", &DanceStyle::breath, {0, 5}},
    {"vary", &DanceStyle::vary, {0, 1}},
    {"vary_cm", &DanceStyle::vary_cm, {0, 10}},
    {"vary_deg", &DanceStyle::vary_deg, {0, 15}},
    {"jitter", &DanceStyle::jitter, {0, 0.2}},
    {"asym", &DanceStyle::asym, {-0.5, 0.5}},
    {"balance", &DanceStyle::balance, {0, 1}},
    {"tempo_scale", &DanceStyle::tempo_scale, {0, 2}},
}};

// Reads one file. Complaints are collected and the first one is reported, so that reading can go on
// with defaults.
class DanceReader {
 public:
    explicit DanceReader(const std::string& file) : complaints_(file) { dance_.file = file; }

    Expected<AuthoredDance> read(const toml::table& root) {
        read_head(root);
        read_defaults(root);
        read_figures(root);
        if (!complaints_.is_sound()) {
            return fail(complaints_.fault());
        }
        return std::move(dance_);
    }

 private:
    // Format and version come first: an error in them explains all others.
    void read_head(const toml::table& root) {
        complaints_.check_head(root, AuthoredDance::kFormat, AuthoredDance::kVersion);
        complaints_.check_keys(root,
                               Names{"format",
                                     "version",
                                     "dance",
                                     "tempo",
                                     "beats_per_bar",
                                     "licence",
                                     "style",
                                     "body",
                                     "expect",
                                     "couple",
                                     "figure"});
        dance_.dance = complaints_.text(root, "dance");
        dance_.licence = complaints_.text(root, "licence");
        if (dance_.dance.empty()) {
            complaints_.complain("needs dance = \"...\"");
        } else if (!is_dance_name(dance_.dance)) {
            // It becomes part of file names.
            complaints_.complain(*root.get("dance"), "dance: " + why_no_dance_name(dance_.dance));
        }
        double beats_per_bar = dance_.beats_per_bar;
        complaints_.read(root, "beats_per_bar", {1, 12}, beats_per_bar);
        dance_.beats_per_bar = whole(root, "beats_per_bar", beats_per_bar);
        read_tempo(root);
    }

    // Three tempi in BPM, rising.
    void read_tempo(const toml::table& root) {
        const toml::node* const node = root.get("tempo");
        if (node == nullptr) {
            complaints_.complain("needs tempo = [slowest, written, fastest]");
            return;
        }
        const auto tempo = complaints_.numbers<3>(
            *node, "tempo", {30, 300}, "three numbers, [slowest, written, fastest]");
        if (!(tempo[0] <= tempo[1] && tempo[1] <= tempo[2])) {
            complaints_.complain(*node, "tempo must rise: [slowest, written, fastest]");
            return;
        }
        dance_.slowest = Bpm(tempo[0]);
        dance_.written = Bpm(tempo[1]);
        dance_.fastest = Bpm(tempo[2]);
    }

    // The number as an integer; after a complaint 1, a valid value.
    int whole(const toml::table& table, std::string_view key, double value) {
        if (value != std::floor(value)) {
            complaints_.complain(*table.get(key),
                                 fmt::format("{} is {}, must be a whole number", key, value));
            return 1;
        }
        return static_cast<int>(value);
    }

    // What the file sets for all figures.
    void read_defaults(const toml::table& root) {
        if (const toml::table* const style = table_at(root, "style")) {
            read_style(*style, style_);
        }
        if (const toml::table* const body = table_at(root, "body")) {
            read_body(*body, complaints_, body_);
        }
        if (const toml::table* const expectation = table_at(root, "expect")) {
            read_expectation(*expectation, expectation_);
        }
        if (const toml::table* const couple = table_at(root, "couple")) {
            read_couple(*couple);
        }
    }

    void read_couple(const toml::table& table) {
        complaints_.check_keys(table, Names{"follow", "hold", "apart"});
        CoupleStyle couple;
        // The index of the text among the names; the first where there is none.
        const auto index_in = [&](std::string_view key, const auto& names) {
            const std::string text = complaints_.text(table, key);
            const auto found = std::find(names.begin(), names.end(), text);
            if (!text.empty() && found == names.end()) {
                complaints_.complain(*table.get(key), unknown_name(key, text, names));
            }
            return found == names.end() ? std::ptrdiff_t{0} : found - names.begin();
        };
        couple.follow = static_cast<CoupleStyle::Follow>(index_in("follow", kFollowNames));
        couple.hold = static_cast<CoupleHold>(index_in("hold", kCoupleHoldNames));
        if (const toml::node* const node = table.get("apart")) {
            const auto apart =
                complaints_.numbers<2>(*node, "apart", {-200, 200}, "[left, forward] in cm");
            couple.apart = {apart[0], apart[1]};
        }
        dance_.couple = couple;
    }

    // The table under a key; null where there is none, or, with a complaint, something else.
    const toml::table* table_at(const toml::table& table, std::string_view key) {
        const toml::node* const node = table.get(key);
        if (node != nullptr && !node->is_table()) {
            complaints_.complain(*node, fmt::format("{} must be a table", key));
        }
        return node != nullptr ? node->as_table() : nullptr;
    }

    // Overwrites the numbers that the table gives; the others keep the value of the level above.
    void read_style(const toml::table& table, DanceStyle& style) {
        Names known;
        for (const StyleKey& key : kStyleKeys) {
            known.push_back(key.name);
        }
        complaints_.check_keys(table, known);
        for (const StyleKey& key : kStyleKeys) {
            complaints_.read(table, key.name, key.range, style.*key.field);
        }
    }

    // The same for expectations: each key replaces the one of the file.
    void read_expectation(const toml::table& table, FigureExpectation& expectation) {
        complaints_.check_keys(table, Names{"hip_travel", "toe_contacts", "hand_delay", "jerk"});
        const auto range = [&](std::string_view key, std::optional<ValueRange>& target) {
            const toml::node* const node = table.get(key);
            if (node == nullptr) {
                return;
            }
            const auto ends = complaints_.numbers<2>(*node, key, kAnyControl, "[least, greatest]");
            if (ends[0] > ends[1]) {
                complaints_.complain(*node, fmt::format("{} must rise: [least, greatest]", key));
            }
            target = ValueRange{ends[0], ends[1]};
        };
        range("hip_travel", expectation.hip_travel);
        range("toe_contacts", expectation.toe_contacts);
        range("hand_delay", expectation.hand_delay);
        if (const toml::node* const node = table.get("jerk")) {
            const auto bound =
                complaints_.numbers<2>(*node, "jerk", {1, 1e5}, "[rms, p99.9], m/s^3");
            expectation.jerk = JerkBound{bound[0], bound[1]};
        }
    }

    // Stops at the first unsound figure: complaints after it would mostly be consequences.
    void read_figures(const toml::table& root) {
        const toml::node* const node = root.get("figure");
        const toml::array* const figures = node != nullptr ? node->as_array() : nullptr;
        if (figures == nullptr || figures->empty() || figures->size() > kMostFigures) {
            complaints_.complain(
                fmt::format("needs 1 to {} figures, each under [[figure]]", kMostFigures));
            return;
        }
        for (const toml::node& one : *figures) {
            complaints_.enter("");
            const toml::table* const table = one.as_table();
            if (table == nullptr) {
                complaints_.complain(one, "a figure must be a [[figure]] table");
                return;
            }
            read_figure(*table);
            if (!complaints_.is_sound()) {
                return;
            }
        }
    }

    // One figure. Style before steps, since steps take their default air time from it; the check
    // comes last, on the resolved figure.
    void read_figure(const toml::table& table) {
        AuthoredFigure figure;
        figure.name = complaints_.text(table, "name");
        const toml::node* const name = table.get("name");
        figure.line = name != nullptr ? name->source().begin.line : table.source().begin.line;
        if (figure.name.empty() || figure.name.size() > 60 || !is_plain(figure.name)) {
            complaints_.complain(figure.line,
                                 "a figure needs a name of a-z, 0-9 and _, at most 60 letters");
            return;
        }
        if (const AuthoredFigure* const other = dance_.figure(figure.name)) {
            complaints_.complain(
                figure.line,
                fmt::format(
                    "figure \"{}\" is there twice, first in line {}", figure.name, other->line));
            return;
        }
        complaints_.enter(fmt::format("figure \"{}\"", figure.name));
        complaints_.check_keys(table,
                               Names{"name",
                                     "beats",
                                     "mirror",
                                     "travel",
                                     "turn",
                                     "style",
                                     "steps",
                                     "follow_steps",
                                     "body",
                                     "expect"});
        read_frame(table, figure);
        figure.style = style_;
        figure.expectation = expectation_;
        if (const toml::table* const style = table_at(table, "style")) {
            read_style(*style, figure.style);
        }
        if (const toml::table* const expectation = table_at(table, "expect")) {
            read_expectation(*expectation, figure.expectation);
        }
        figure.steps = read_steps(table, "steps", complaints_, figure);
        figure.follow_steps = read_steps(table, "follow_steps", complaints_, figure);
        WrittenBody own;
        if (const toml::table* const body = table_at(table, "body")) {
            read_body(*body, complaints_, own);
        }
        resolve_body(own, figure);
        if (complaints_.is_sound()) {
            if (const auto fault = first_fault(figure)) {
                complaints_.complain(fault->line, fault->message);
            } else if (dance_.couple) {
                check_follow(figure);
            }
        }
        check_work(figure);
        dance_.figures.push_back(std::move(figure));
    }

    void check_follow(const AuthoredFigure& figure) {
        if (const auto fault = first_fault(follow_of(figure, *dance_.couple))) {
            complaints_.complain(fault->line, "of the follow: " + fault->message);
        }
    }

    // Before anything is computed: a slip of the finger must not cost minutes and gigabytes.
    void check_work(const AuthoredFigure& figure) {
        const double seconds = figure.beats / dance_.slowest.beats_per_second();
        if (seconds > kMostSeconds) {
            complaints_.complain(
                figure.line,
                fmt::format("beats is {}, {:.0f} s at {} BPM, the slowest tempo; a figure has at "
                            "most {} s",
                            figure.beats,
                            seconds,
                            dance_.slowest.bpm(),
                            kMostSeconds));
        }
        beats_ += figure.beats;
        if (beats_ > kMostBeats) {
            complaints_.complain(
                figure.line,
                fmt::format("beats is {}: all figures together have more than {} beats; split the "
                            "file",
                            figure.beats,
                            kMostBeats));
        }
    }

    // Plain names only, as they become parts of file names.
    static bool is_plain(const std::string& name) {
        return std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        });
    }

    // Length, mirroring and the motion of the figure's frame.
    void read_frame(const toml::table& table, AuthoredFigure& figure) {
        double beats = figure.beats;
        if (!table.contains("beats")) {
            complaints_.complain(figure.line, "needs beats = ...");
        }
        complaints_.read(table, "beats", {1, 64}, beats);
        figure.beats = whole(table, "beats", beats);
        if (const toml::node* const node = table.get("mirror")) {
            if (!node->is_boolean()) {
                complaints_.complain(*node, "mirror must be true or false");
            }
            figure.is_mirrored = node->value_or(false);
        }
        if (const toml::node* const node = table.get("travel")) {
            const auto place =
                complaints_.numbers<2>(*node, "travel", {-300, 300}, "[left, forward] in cm");
            figure.travel = {place[0], place[1]};
        }
        complaints_.read(table, "turn", {-720, 720}, figure.turn);
    }

    /// Takes each control's tracks from where they are most specific: the figure before the file,
    /// and in each one side before both. A control that is not written rests.
    void resolve_body(const WrittenBody& own, AuthoredFigure& figure) {
        for (std::size_t i = 0; i < kControlCount; ++i) {
            const ControlInfo& info = info_of(static_cast<Control>(i));
            const WrittenBody::Entry* entry = own.find(info.name);
            entry = entry != nullptr ? entry : own.find(info.both_name);
            entry = entry != nullptr ? entry : body_.find(info.name);
            entry = entry != nullptr ? entry : body_.find(info.both_name);
            if (entry != nullptr) {
                figure.body[i] = entry->tracks;
                continue;
            }
            Track still;
            still.rest = info.group == ControlGroup::knee ? figure.style.knee : info.rest;
            figure.body[i] = {still};
        }
    }

    TomlComplaints complaints_;
    AuthoredDance dance_;
    DanceStyle style_;
    WrittenBody body_;
    FigureExpectation expectation_;
    int beats_ = 0;  // of all figures so far
};

Expected<AuthoredDance> parse(std::string_view text, const std::string& name) {
    const auto root = parse_toml(text, name);
    return root ? DanceReader(name).read(*root) : fail(root.error());
}

}  // namespace

Expected<AuthoredDance> parse_authored_dance(std::string_view text, const std::string& name) {
    auto dance = parse(text, name);
    if (!dance) {  // names in quotes may hold control characters
        std::string& message = dance.error().message;
        std::replace_if(
            message.begin(), message.end(), [](char c) { return c >= 0 && c < ' '; }, '?');
    }
    return dance;
}

Expected<AuthoredDance> load_authored_dance(const std::filesystem::path& path) {
    auto text = read_text_file(path, kLongestToml);
    if (!text) {
        return fail(std::move(text.error()));
    }
    return parse_authored_dance(*text, path.string());
}

}  // namespace raks::motion
