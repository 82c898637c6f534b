#include "audio/music/generator/form_score.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

// Drums of a style that carry a form: the accent of a drop or a hit, and the roll of a build-up.
struct FormDrums {
    std::vector<Sound> accent;
    Sound low = Sound::kick;    ///< on the beats of a build-up's last part
    Sound roll = Sound::snare;  ///< doubles in a build-up
};
FormDrums drums_of(Style style) {
    switch (style) {
        case Style::clicks:
            return {{Sound::click_high}, Sound::click_low, Sound::click_low};
        case Style::montuno:
            return {{Sound::crash, Sound::timbale_low, Sound::conga_open},
                    Sound::conga_low,
                    Sound::timbale_high};
        case Style::maqsum:
            return {{Sound::darbuka_dum, Sound::darbuka_tek, Sound::riq},
                    Sound::darbuka_dum,
                    Sound::darbuka_tek};
        case Style::four_on_the_floor:
            return {{Sound::club_kick, Sound::crash, Sound::clap}, Sound::club_kick, Sound::snare};
        case Style::drums:
        case Style::backbeat:
        case Style::boom_bap:
        case Style::oom_pah_pah:
            break;
    }
    return {{Sound::kick, Sound::crash}, Sound::kick, Sound::snare};
}

bool is_bass(Sound sound) { return sound == Sound::bass || sound == Sound::synth_bass; }

// Drums that keep time softly where there is nothing but drums.
bool keeps_time(Sound sound) {
    return sound == Sound::closed_hat || sound == Sound::click_high || sound == Sound::click_low ||
           sound == Sound::clave || sound == Sound::maracas || sound == Sound::riq ||
           sound == Sound::darbuka_ka;
}

bool is_at(double beat, double place) { return std::abs(beat - place) < 0.02; }

// Rewrites a score section by section.
class Arranger {
 public:
    Arranger(Notes score, Style style)
        : score_(std::move(score)), style_(style), drums_(drums_of(style)) {
        std::stable_sort(score_.begin(), score_.end(), [](const Note& a, const Note& b) {
            return a.beat < b.beat;
        });
    }

    void play(const SectionSpan& section) {
        switch (section.kind) {
            case SectionKind::intro:
                return each_in(section, [&](Note note) {
                    note.velocity *= 0.75;
                    if (!is_pitched(note.sound) || is_bass(note.sound)) {
                        notes_.push_back(note);
                    }
                });
            case SectionKind::breakdown:
                return play_breakdown(section);
            case SectionKind::riff:
                return play_riff(section);
            case SectionKind::build_up:
                return play_build_up(section);
            case SectionKind::drop:
                end_notes_at(section.from);
                play_whole(section);
                return add_accent(section.from);
            case SectionKind::stop:
                return end_notes_at(section.from);
            case SectionKind::hit_stop:
                end_notes_at(section.from);
                return add_chord(section.from, 0.8);
            case SectionKind::ending:
                end_notes_at(section.from);
                return add_chord(section.from, section.to - section.from);
            case SectionKind::verse:
            case SectionKind::full:
            case SectionKind::filtered:
            case SectionKind::fade_out:
                return play_whole(section);
        }
    }

    Notes take() { return std::move(notes_); }

 private:
    // The notes of the score in [from, to).
    [[nodiscard]] std::span<const Note> notes_in(double from, double to) const {
        const auto place = [&](double beat) {
            return std::lower_bound(
                score_.begin(), score_.end(), beat, [](const Note& note, double value) {
                    return note.beat < value;
                });
        };
        return {place(from), place(to)};
    }
    template <typename Take>
    void each_in(const SectionSpan& section, const Take& take) const {
        for (const Note& note : notes_in(section.from, section.to)) {
            take(note);
        }
    }

    void play_whole(const SectionSpan& section) {
        each_in(section, [&](const Note& note) { notes_.push_back(note); });
    }

    // No drums. The bass holds its first note of a bar softly, a strummed guitar rings for half a
    // bar: what else drives on would not sound like a breakdown. Where the band has nothing but
    // drums, or drums and bass, what keeps time goes on softly.
    void play_breakdown(const SectionSpan& section) {
        const int bar = beats_per_bar(style_);
        each_in(section, [&](Note note) {
            const double in_bar = std::fmod(note.beat, bar);
            const double start = note.beat - in_bar;
            if (!has_chords_in(start, start + bar)) {
                note.velocity *= is_pitched(note.sound) ? 0.7 : 0.5;
                if (is_pitched(note.sound) || keeps_time(note.sound)) {
                    notes_.push_back(note);
                }
            } else if (is_bass(note.sound)) {
                note.beats = bar - 0.1 - in_bar;
                note.velocity *= 0.5;
                if (!has_bass_in(start, note.beat)) {
                    notes_.push_back(note);
                }
            } else if (note.sound == Sound::guitar) {
                note.beats = 1.9;
                if (is_at(std::fmod(note.beat, 2.0), 0.0)) {
                    notes_.push_back(note);
                }
            } else if (is_pitched(note.sound)) {
                notes_.push_back(note);
            }
        });
    }

    // What has a pitch, but no bass.
    void play_riff(const SectionSpan& section) {
        each_in(section, [&](const Note& note) {
            if (is_pitched(note.sound) && !is_bass(note.sound)) {
                notes_.push_back(note);
            }
        });
    }

    // Whether anything with a pitch but the bass sounds in these beats: a pad may have begun
    // before.
    [[nodiscard]] bool has_chords_in(double from, double to) const {
        const auto notes = notes_in(from - 8.0, to);
        return std::any_of(notes.begin(), notes.end(), [&](const Note& note) {
            return is_pitched(note.sound) && !is_bass(note.sound) && note.beat + note.beats > from;
        });
    }

    // Whether the score has a bass note in [from, to).
    [[nodiscard]] bool has_bass_in(double from, double to) const {
        const auto notes = notes_in(from, to);
        return std::any_of(
            notes.begin(), notes.end(), [](const Note& note) { return is_bass(note.sound); });
    }

    // Strokes on the beat, on halves, on quarters, on eighths, each for a quarter of the section;
    // below them the low drum from the middle on.
    void play_build_up(const SectionSpan& section) {
        each_in(section, [&](const Note& note) {
            if (is_pitched(note.sound) && !is_bass(note.sound)) {
                notes_.push_back(note);
            }
        });
        const double length = section.to - section.from;
        for (double at = section.from; at < section.to - 1e-6;) {
            const double share = (at - section.from) / length;
            notes_.push_back({.beat = at, .sound = drums_.roll, .velocity = 0.4 + 0.6 * share});
            at += share < 0.25 ? 1.0 : (share < 0.5 ? 0.5 : (share < 0.875 ? 0.25 : 0.125));
        }
        for (int at = (section.from + section.to + 1) / 2; at < section.to; ++at) {
            notes_.push_back({.beat = static_cast<double>(at), .sound = drums_.low});
        }
    }

    // Tones that ring from before are damped: what comes must not stand in them.
    void end_notes_at(double beat) {
        for (Note& note : notes_) {
            if (is_pitched(note.sound) && note.beat < beat) {
                note.beats = std::min(note.beats, beat - note.beat);
            }
        }
    }

    void add_accent(double beat) {
        for (const Sound sound : drums_.accent) {
            notes_.push_back({.beat = beat, .sound = sound});
        }
    }

    // The tones that the band has at this beat, or had last, together with the accent.
    void add_chord(double beat, double length) {
        double last = -1.0;
        for (const Note& note : score_) {
            if (is_pitched(note.sound) && !is_bass(note.sound) && note.beat < beat + 0.02) {
                last = note.beat;
            }
        }
        for (Note note : score_) {
            const bool is_bass_here = is_bass(note.sound) && is_at(note.beat, beat);
            if (is_pitched(note.sound) && (is_at(note.beat, last) || is_bass_here)) {
                note.beat = beat;
                note.beats = length;
                note.velocity = 1.0;
                notes_.push_back(note);
            }
        }
        add_accent(beat);
    }

    Notes score_;  // by beat
    Style style_;
    FormDrums drums_;
    Notes notes_;
};

}  // namespace

std::vector<SectionSpan> spans_of(std::span<const FormSection> form) {
    std::vector<SectionSpan> spans;
    int at = 0;
    for (const FormSection& section : form) {
        spans.push_back({section.kind, at, at + section.beats});
        at += section.beats;
    }
    return spans;
}

Notes arrange(Notes score, std::span<const SectionSpan> form, Style style) {
    Arranger arranger(std::move(score), style);
    for (const SectionSpan& section : form) {
        arranger.play(section);
    }
    return arranger.take();
}

}  // namespace raks::audio
