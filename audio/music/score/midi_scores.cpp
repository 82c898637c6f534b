#include "audio/music/score/midi_scores.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "audio/music/score/midi_file.hpp"
#include "base/file.hpp"

namespace raks::audio {
namespace {

constexpr int kLowestBpm = 52;
constexpr int kHighestBpm = 217;
constexpr int kFewestBars = 4;
constexpr std::size_t kMostIndexBytes = std::size_t{16} << 20U;
constexpr double kMostQuarters = 20'000.0;  // of a file's stretches: more than an hour is damage

// A note of the file: start and length in quarters.
struct MidiNote {
    double quarter = 0.0;
    double length = 0.0;  // quarters
    int channel = 0;
    int key = 0;
    int program = 0;
    int velocity = 0;
};

// What is read of a file.
struct MidiSong {
    std::vector<MidiNote> notes;            // by quarter
    std::vector<MidiSignature> signatures;  // the first at 0
    double quarters = 0.0;
    double bpm = 120.0;  // quarters a minute, the file's first
};

/// The beat that is tapped in a time signature, and how many of them a bar has.
struct Metre {
    double beat_quarters = 1.0;
    int beats_per_bar = 4;
};

/// The metre of a signature; nothing for those that no dance here has.
std::optional<Metre> metre_of(const MidiSignature& signature) {
    const int n = signature.numerator;
    const double unit = 4.0 / signature.denominator;
    if (signature.denominator == 8 && (n == 6 || n == 9 || n == 12)) {
        return Metre{1.5, n / 3};
    }
    if (signature.denominator == 8 && n == 3) {
        return Metre{1.5, 1};
    }
    if (signature.denominator <= 4 && (n == 2 || n == 3 || n == 4 || n == 6)) {
        return Metre{unit, n};
    }
    return std::nullopt;
}

/// The General MIDI key for a pad of the groove set's electronic kit; other keys are the same.
int general_midi_drum(int key) {
    static const std::map<int, int> pads = {
        {22, 42}, {26, 46}, {58, 43}, {52, 57}, {40, 38}, {55, 49}, {59, 51}, {50, 48}, {47, 45}};
    const auto found = pads.find(key);
    return found == pads.end() ? key : found->second;
}

/// Collects the notes of one file, in quarters.
class NoteReader {
 public:
    explicit NoteReader(double pulses_per_quarter) : pulses_(pulses_per_quarter) {}

    void take(const MidiEvent& event) {
        constexpr std::uint8_t kMeta = 0xFF;
        constexpr std::uint8_t kTempo = 0x51;
        constexpr std::uint8_t kTimeSignature = 0x58;
        const double quarter = static_cast<double>(event.pulse) / pulses_;
        song_.quarters = std::max(song_.quarters, quarter);
        const auto byte = [&event](std::size_t i) {
            return static_cast<std::uint8_t>(event.meta[i]);
        };
        if (event.status != kMeta) {
            take_channel(event, quarter);
        } else if (event.first == kTimeSignature && event.meta.size() >= 2) {
            // The denominator is stored as a power of two; the bound keeps the shift defined.
            song_.signatures.push_back({quarter, byte(0), 1 << std::min<int>(byte(1), 5)});
        } else if (event.first == kTempo && event.meta.size() >= 3 && !has_tempo_) {
            const int micros = byte(0) << 16 | byte(1) << 8 | byte(2);
            song_.bpm = 6e7 / std::max(1, micros);
            has_tempo_ = true;
        }
    }
    MidiSong finish() {
        // Without a signature at the start the standard's default holds: 4/4.
        if (song_.signatures.empty() || song_.signatures.front().quarter > 0.0) {
            song_.signatures.insert(song_.signatures.begin(), MidiSignature{});
        }
        return std::move(song_);
    }

 private:
    void take_channel(const MidiEvent& event, double quarter) {
        const int kind = event.status & 0xF0;
        const int channel = event.status & 0x0F;
        int& program = programs_[static_cast<std::size_t>(channel)];
        if (kind == 0xC0) {
            program = event.first;
            return;
        }
        if (kind != 0x90 && kind != 0x80) {
            return;
        }
        // A note ends at its note-off or when its key is struck again; a note-on of velocity 0 is
        // an off.
        const auto sounding = open_.find({channel, event.first});
        if (sounding != open_.end()) {
            MidiNote& note = song_.notes[sounding->second];
            note.length = std::max(0.05, quarter - note.quarter);
            open_.erase(sounding);
        }
        if (kind == 0x90 && event.second > 0) {
            open_[{channel, event.first}] = song_.notes.size();
            // The length is provisional: it stays for notes that never end.
            song_.notes.push_back({quarter, 0.25, channel, event.first, program, event.second});
        }
    }

    double pulses_;
    MidiSong song_;
    std::array<int, 16> programs_{};
    std::map<std::pair<int, int>, std::size_t> open_;  // by channel and key
    bool has_tempo_ = false;
};

/// Reads one MIDI file into notes, signatures and tempo.
Expected<MidiSong> read_song(std::string_view bytes) {
    const auto midi = parse_midi(bytes);
    if (!midi) {
        return fail(midi.error());
    }
    NoteReader reader(midi->pulses_per_quarter);
    for (const MidiEvent& event : midi->events) {
        reader.take(event);
    }
    return reader.finish();
}

/// The notes of [from, to) in quarters as a score of this metre.
Score score_of(const MidiSong& song, double from, double to, const Metre& metre, bool is_kit) {
    Score score;
    score.bpm = song.bpm / metre.beat_quarters;
    score.has_drums = false;
    // People hit a little before the beat: a note just before the stretch belongs to its first
    // beat.
    const double begin = from - 0.06;
    const double end = to - 0.06;
    const auto first = std::lower_bound(
        song.notes.begin(), song.notes.end(), begin, [](const MidiNote& note, double quarter) {
            return note.quarter < quarter;
        });
    for (auto at = first; at != song.notes.end() && at->quarter < end; ++at) {
        const MidiNote& note = *at;
        ScoreNote written;
        written.beat = std::max(0.0, (note.quarter - from) / metre.beat_quarters);
        written.length = note.length / metre.beat_quarters;
        written.channel = is_kit ? kDrumChannel : note.channel;
        written.key = is_kit ? general_midi_drum(note.key) : note.key;
        written.program = is_kit ? 0 : note.program;
        written.velocity = note.velocity;
        score.has_drums = score.has_drums || written.channel == kDrumChannel;
        score.notes.push_back(written);
    }
    // The small addition keeps a rounding error from losing the last beat.
    const int beats = static_cast<int>((to - from) / metre.beat_quarters + 0.01);
    for (int beat = 0; beat < beats; ++beat) {
        score.bar_position.push_back(beat % metre.beats_per_bar + 1);
    }
    return score;
}

/// Cells of a tab-separated line.
std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> cells;
    std::size_t from = 0;
    for (std::size_t tab = text.find('\t'); tab != std::string::npos; tab = text.find('\t', from)) {
        cells.push_back(text.substr(from, tab - from));
        from = tab + 1;
    }
    cells.push_back(text.substr(from));  // the last one may be empty
    return cells;
}

/// The whole of `text` as a number in [lowest, highest]; nothing for anything else.
template <class Number>
std::optional<Number> number_in(std::string_view text, Number lowest, Number highest) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    return is_number && number >= lowest && number <= highest ? std::optional(number)
                                                              : std::nullopt;
}

/// "4/4"; nothing where it is none.
std::optional<MidiSignature> signature_of(std::string_view text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto numerator = number_in(text.substr(0, slash), 1, 99);
    const auto denominator = number_in(text.substr(std::min(slash + 1, text.size())), 1, 64);
    if (!numerator || !denominator) {
        return std::nullopt;
    }
    return MidiSignature{0.0, *numerator, *denominator};
}

/// One line of the index. Tempo and signature count for the set "groove" alone: the other sets'
/// files say their own. Errors: a tempo or a signature that is none.
Expected<MidiPackRow> row_of(const std::vector<std::string>& cells,
                             std::map<std::string, std::size_t>& columns) {
    MidiPackRow row;
    row.file = cells[columns["file"]];
    row.set = cells[columns["set"]];
    row.is_fill = cells[columns["kind"]] == "fill";
    row.style = columns.contains("style") ? cells[columns["style"]] : std::string();
    if (row.set != "groove") {
        return row;
    }
    const std::string& tempo = cells[columns["bpm_quarter"]];
    const auto bpm = number_in(tempo, 1.0, 1000.0);
    if (!bpm) {
        return fail("bpm_quarter is '" + tempo + "', must be 1 to 1000");
    }
    row.bpm = *bpm;
    const std::string& signature = cells[columns["time_signature"]];
    row.signature = signature_of(signature);
    if (!row.signature && !signature.empty()) {
        return fail("time_signature is '" + signature + "', must be such as 4/4");
    }
    return row;
}

/// For the set "groove": tempo and signature of the index replace the file's, which holds only drum
/// hits.
void apply_index(const MidiPackRow& row, MidiSong& song) {
    song.bpm = row.bpm;
    if (row.signature) {
        song.signatures = {*row.signature};
    }
}

/// One stretch for each time signature of the song that has a metre and is long enough.
void add_stretches(const MidiPackRow& row, const MidiSong& song, std::vector<MidiStretch>& into) {
    double left = kMostQuarters;
    for (std::size_t i = 0; i < song.signatures.size(); ++i) {
        const double from = song.signatures[i].quarter;
        const double to =
            i + 1 < song.signatures.size() ? song.signatures[i + 1].quarter : song.quarters;
        const auto metre = metre_of(song.signatures[i]);
        if (!metre) {
            continue;
        }
        // Counted over all: a few bytes of a damaged file may claim thousands of hours.
        if (to - from > left) {
            continue;
        }
        left -= to - from;
        const double bars = (to - from) / metre->beat_quarters / metre->beats_per_bar;
        if (bars < kFewestBars && !row.is_fill) {
            continue;
        }
        MidiStretch stretch{
            score_of(song, from, to, *metre, row.set == "groove"), row.set, row.style, row.is_fill};
        stretch.score.is_expressive = row.set == "lieder";
        const double bpm = stretch.score.bpm;
        if (row.set == "lieder") {
            // Songs are sung slower and faster than written; other music keeps closer to its tempo.
            stretch.score.lowest_bpm = std::max(50.0, 0.7 * bpm);
            stretch.score.highest_bpm = std::min(217.0, 1.4 * bpm);
        } else {
            stretch.score.lowest_bpm = std::max<double>(kLowestBpm, 0.85 * bpm);
            stretch.score.highest_bpm = std::min<double>(kHighestBpm, 1.18 * bpm);
        }
        // By the tempo as written, not by the range around it.
        const bool is_tempo_fit = bpm >= kLowestBpm && bpm <= kHighestBpm;
        if (!stretch.score.notes.empty() && is_tempo_fit) {
            into.push_back(std::move(stretch));
        }
    }
}

}  // namespace

Expected<std::vector<MidiPackRow>> parse_midi_index(const std::string& text,
                                                    const std::string& name) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> heads = split(line);
    std::map<std::string, std::size_t> columns;
    for (std::size_t i = 0; i < heads.size(); ++i) {
        columns.emplace(heads[i], i);  // of a name that stands there twice the first counts
    }
    for (const char* const column : {"file", "set", "kind", "bpm_quarter", "time_signature"}) {
        if (!columns.contains(column)) {
            return fail(name + ": no column '" + column + "'");
        }
    }
    std::vector<MidiPackRow> rows;
    for (std::size_t number = 2; std::getline(lines, line); ++number) {
        const std::vector<std::string> cells = split(line);
        Expected<MidiPackRow> row = fail("has too few columns");
        if (cells.size() >= heads.size()) {
            row = row_of(cells, columns);
        }
        if (!row) {
            return fail(std::move(row.error()).in(name + ": line " + std::to_string(number)));
        }
        rows.push_back(std::move(*row));
    }
    if (rows.empty()) {
        return fail(name + ": names no file");
    }
    return rows;
}

Expected<std::vector<MidiStretch>> midi_stretches(std::string_view bytes, const MidiPackRow& row) {
    auto song = read_song(bytes);
    if (!song) {
        return fail(std::move(song.error()));
    }
    if (row.set == "groove") {
        apply_index(row, *song);
    }
    std::vector<MidiStretch> stretches;
    add_stretches(row, *song, stretches);
    return stretches;
}

Score cut_beats(const Score& score, int first_beat, int beats) {
    Score cut = score;
    cut.notes.clear();
    for (ScoreNote note : score.notes) {
        note.beat -= first_beat;
        if (note.beat >= -0.06 && note.beat < beats - 0.06) {
            note.beat = std::max(0.0, note.beat);
            cut.notes.push_back(note);
        }
    }
    const auto first = score.bar_position.begin() + first_beat;
    cut.bar_position.assign(first, first + beats);
    return cut;
}

Expected<std::vector<MidiStretch>> read_midi_pack(const std::filesystem::path& folder) {
    const std::filesystem::path index = folder / "index.tsv";
    const auto text = read_text_file(index, kMostIndexBytes);
    if (!text) {
        return fail(text.error());
    }
    const auto rows = parse_midi_index(*text, index.string());
    if (!rows) {
        return fail(rows.error());
    }
    std::vector<MidiStretch> stretches;
    for (const MidiPackRow& row : *rows) {
        const std::filesystem::path file = folder / row.file;
        const auto bytes = read_file(file);
        if (!bytes) {
            return fail(bytes.error());
        }
        auto own = midi_stretches(*bytes, row);
        if (!own) {
            return fail(std::move(own.error()).in(file.string()));
        }
        std::move(own->begin(), own->end(), std::back_inserter(stretches));
    }
    return stretches;
}

}  // namespace raks::audio
