#include "audio/music/generator/song_form.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/random.hpp"
#include "base/suggest.hpp"

namespace raks::audio {
namespace {

constexpr int kMostBeats = 10'000;  // of a section
constexpr int kPhrase = 8;          // bars

// In the order of SectionKind.
constexpr std::array<std::string_view, 12> kSectionNames{"intro",
                                                         "verse",
                                                         "full",
                                                         "breakdown",
                                                         "filtered",
                                                         "build-up",
                                                         "drop",
                                                         "stop",
                                                         "hit-stop",
                                                         "ending",
                                                         "fade-out",
                                                         "riff"};

// "full:32" as a section.
Expected<FormSection> parse_section(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view name = text.substr(0, colon);
    const auto* const found = std::find(kSectionNames.begin(), kSectionNames.end(), name);
    if (found == kSectionNames.end()) {
        return fail(unknown_name("section", name, kSectionNames));
    }
    const std::string_view number = text.substr(std::min(colon + 1, text.size()));
    int beats = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), beats);
    if (error != std::errc() || end != number.data() + number.size() || beats < 1 ||
        beats > kMostBeats) {
        return fail("section " + std::string(text) + ": needs beats, 1 to 10000, as in full:32");
    }
    return FormSection{static_cast<SectionKind>(found - kSectionNames.begin()), beats};
}

// Draws a song group by group; a group is not begun where it does not fit any more.
class FormWriter {
 public:
    explicit FormWriter(const FormDraw& draw)
        : draw_(draw), random_(draw.seed, 41), left_(draw.bars) {}

    std::vector<FormSection> write() {
        const bool fades = left_ >= 40 && pick(5) == 0;
        const int ending = fades ? kPhrase : 2;
        left_ -= std::min(ending, left_);
        if (left_ >= 20) {
            add(SectionKind::intro, pick(2) == 0 || left_ < 32 ? 4 : kPhrase);
        }
        if (left_ >= kPhrase) {
            add(SectionKind::verse, kPhrase);
        }
        for (int group = 0; left_ >= 4; ++group) {
            // The breakdown comes first: even a short song has one.
            if (left_ >= drop_group_bars() && (group == 0 || pick(2) == 0)) {
                add_drop_group(group == 0);
            } else {
                add_plain_group(std::min(left_ - left_ % 4, kPhrase));
            }
        }
        add(fades ? SectionKind::fade_out : SectionKind::ending, ending);
        return sections_;
    }

 private:
    [[nodiscard]] std::uint64_t pick(std::uint64_t count) { return random_.below(drawn_++, count); }

    void add(SectionKind kind, int bars) {
        sections_.push_back({kind, bars * draw_.beats_per_bar});
        left_ -= bars;
    }
    // A phrase whose last beats are a stop.
    void add_stopped(SectionKind kind, int bars) {
        // Half a bar to two bars, but no longer than some 3 s.
        const int half = std::max(draw_.beats_per_bar / 2, 1);
        const int longest = draw_.bar_seconds > 1.6 ? draw_.beats_per_bar : 2 * draw_.beats_per_bar;
        const std::array<int, 3> beats{half, draw_.beats_per_bar, longest};
        const int stop = beats[pick(beats.size())];
        const SectionKind how = pick(3) == 0 ? SectionKind::hit_stop : SectionKind::stop;
        sections_.push_back({kind, bars * draw_.beats_per_bar - stop});
        sections_.push_back({how, stop});
        left_ -= bars;
    }

    // Four bars are enough where they are long.
    [[nodiscard]] int calm_bars() const { return draw_.bar_seconds > 1.8 ? 4 : kPhrase; }
    // The shortest breakdown and drop.
    [[nodiscard]] int drop_group_bars() const { return 4 + 4; }

    // Breakdown, mostly a build-up, sometimes a stop, drop.
    void add_drop_group(bool must_stop) {
        const SectionKind calm = pick(2) == 0 ? SectionKind::filtered : SectionKind::breakdown;
        const int calm_for = left_ >= calm_bars() + 4 ? calm_bars() : 4;
        const bool builds = left_ >= calm_for + 8 && pick(4) != 0;
        const bool stops = must_stop || pick(3) == 0;
        if (builds) {
            add(calm, calm_for);
        }
        const SectionKind last = builds ? SectionKind::build_up : calm;
        const int last_for = builds ? 4 : calm_for;
        stops ? add_stopped(last, last_for) : add(last, last_for);
        add(SectionKind::drop, left_ >= kPhrase ? kPhrase : 4);
    }

    // A phrase of the band, every third with a stop at its end.
    void add_plain_group(int bars) {
        const SectionKind kind = pick(2) == 0 ? SectionKind::verse : SectionKind::full;
        // No stop right before the ending: it would be taken for it.
        left_ >= bars + 4 && pick(3) == 0 ? add_stopped(kind, bars) : add(kind, bars);
    }

    FormDraw draw_;
    CounterRandom random_;
    std::uint64_t drawn_ = 0;
    int left_;  // bars
    std::vector<FormSection> sections_;
};

}  // namespace

std::span<const std::string_view> section_names() noexcept { return kSectionNames; }

MusicPart part_of(SectionKind kind) noexcept {
    switch (kind) {
        case SectionKind::breakdown:
        case SectionKind::filtered:
        case SectionKind::riff:
            return MusicPart::breakdown;
        case SectionKind::build_up:
            return MusicPart::build_up;
        case SectionKind::stop:
        case SectionKind::hit_stop:
            return MusicPart::stopped;
        default:
            return MusicPart::playing;
    }
}

Expected<std::vector<FormSection>> parse_form(std::string_view text) {
    std::vector<FormSection> sections;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        auto section = parse_section(text.substr(at, comma - at));
        if (!section) {
            return fail(std::move(section.error()));
        }
        sections.push_back(*section);
        at = comma + 1;
    }
    return sections;
}

std::vector<FormSection> draw_form(const FormDraw& draw) { return FormWriter(draw).write(); }

namespace {

// What begins with a section. `before`: the part before it; `was_calm`: a breakdown or build-up
// since the whole band last played; `is_first`: nothing has happened yet.
MusicEvent::Kind event_of(SectionKind section, MusicPart before, bool was_calm, bool is_first) {
    using Kind = MusicEvent::Kind;
    const MusicPart part = part_of(section);
    if (section == SectionKind::ending) {
        return Kind::end;
    }
    if (part == MusicPart::playing) {
        return was_calm || section == SectionKind::drop ? Kind::drop
               : before == MusicPart::stopped           ? Kind::entry
                                                        : Kind::none;
    }
    if (part == before) {
        return Kind::none;
    }
    if (part == MusicPart::stopped) {
        return Kind::stop;
    }
    // Music that begins calm has begun; there is nothing that it breaks down from.
    return is_first ? Kind::entry : part == MusicPart::breakdown ? Kind::breakdown : Kind::build_up;
}

}  // namespace

std::vector<MusicEvent> events_of(std::span<const PlayedSection> sections) {
    using Kind = MusicEvent::Kind;
    std::vector<MusicEvent> events;
    bool was_calm = false;  // a breakdown or build-up since the whole band last played
    MusicPart before = MusicPart::stopped;
    for (const PlayedSection& section : sections) {
        const MusicPart part = part_of(section.kind);
        const Kind kind = event_of(section.kind, before, was_calm, events.empty());
        if (section.kind != SectionKind::ending && part != MusicPart::stopped) {
            was_calm = part != MusicPart::playing;
        }
        if (kind != Kind::none) {
            events.push_back({kind, section.from});
        }
        before = part;
    }
    // Cut or faded out.
    if (!events.empty() && events.back().kind != Kind::end && !sections.empty()) {
        events.push_back({Kind::end, sections.back().to});
    }
    return events;
}

}  // namespace raks::audio
