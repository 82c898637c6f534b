#include "tests/end_to_end/manual.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <sstream>
#include <utility>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/figures/small_figure.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RAKS_SOURCE_DIR;

/// The words of a line as a shell has them: "two words" are one, what follows # is none, and what
/// follows | is another program's.
std::vector<std::string> words_of(const std::string& line) {
    std::vector<std::string> words;
    std::optional<std::string> word;
    bool is_quoted = false;
    for (const char c : line) {
        if (c == '"') {
            is_quoted = !is_quoted;
            word = word.value_or("");
        } else if (!is_quoted && std::isspace(static_cast<unsigned char>(c)) != 0) {
            if (word) {
                words.push_back(*std::exchange(word, std::nullopt));
            }
        } else if (!is_quoted && (c == '#' || c == '|') && !word) {
            break;
        } else {
            word = word.value_or("") + c;
        }
    }
    if (word) {
        words.push_back(*word);
    }
    return words;
}

/// Reads a document line by line.
class Reader {
 public:
    explicit Reader(std::string document) : document_(std::move(document)) {}

    std::vector<ManualCommand> read() {
        const auto text = read_file(kRoot / document_);
        EXPECT_TRUE(text) << document_;
        std::istringstream lines(text.value_or(""));
        for (std::string line; std::getline(lines, line);) {
            ++line_;
            take(line);
        }
        end_paragraph();
        return std::move(commands_);
    }

 private:
    void take(const std::string& line) {
        if (line.starts_with("```")) {
            end_paragraph();
            fence_ = fence_ ? std::nullopt : std::optional(line.substr(3));
        } else if (fence_) {
            if (fence_->starts_with("sh")) {
                take_command(line, *fence_ == "sh");
            }
        } else if (line.starts_with("    ")) {
            take_command(line.substr(4), false);
        } else {
            take_text(line);
        }
    }

    void take_command(std::string line, bool is_run) {
        if (!unfinished_.empty()) {
            line = std::exchange(unfinished_, "") + line;
        } else {
            began_ = line_;
        }
        if (line.ends_with('\\')) {
            unfinished_ = line.substr(0, line.size() - 1);
            return;
        }
        add(line, began_, is_run);
    }

    /// Spans of code may go over the end of a line, so that a paragraph is looked at as a whole.
    void take_text(const std::string& line) {
        if (line.starts_with("## ")) {
            section_ = line.substr(3);
        }
        if (line.empty() || line.starts_with('|') || line.starts_with('#')) {
            end_paragraph();
        }
        if (paragraph_.empty()) {
            began_ = line_;
        }
        paragraph_ += line + "\n";
    }

    void end_paragraph() {
        static const std::regex kSpan("`(raks [^`]*)`");
        const std::string text = std::exchange(paragraph_, "");
        for (std::sregex_iterator at(text.begin(), text.end(), kSpan), end; at != end; ++at) {
            const auto lines = std::count(text.begin(), (*at)[0].first, '\n');
            add((*at)[1], began_ + static_cast<int>(lines), false);
        }
    }

    void add(const std::string& line, int number, bool is_run) {
        std::vector<std::string> words = words_of(line);
        if (words.size() < 2 || words.front() != "raks") {
            return;
        }
        words.erase(words.begin());
        commands_.push_back({document_, number, section_, std::move(words), is_run});
    }

    std::string document_;
    int line_ = 0;
    int began_ = 0;
    std::string section_;
    std::string paragraph_;
    std::string unfinished_;
    std::optional<std::string> fence_;  // what follows the opening ```
    std::vector<ManualCommand> commands_;
};

void write_music(const fs::path& file, audio::Style style, double bpm, double seconds) {
    audio::MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, bpm}};
    plan.seconds = seconds;
    const auto music = audio::generate(plan);
    ASSERT_TRUE(music) << music.error().message;
    fs::create_directories(file.parent_path());
    const auto written = audio::write_wav(file, music->samples, music->channels, music->rate);
    ASSERT_TRUE(written) << written.error().message;
}

/// Beats of steady music, every `seconds`.
std::string beats_text(double seconds, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        text += fmt::format("{:.3f}\t{}\n", seconds * i, i % 4 + 1);
    }
    return text;
}

bool has(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

void add_missing(std::vector<std::string>& words, const std::string& option, const char* value) {
    if (!has(words, option)) {
        words.insert(words.end(), {option, value});
    }
}

/// A quarter of each side of the picture that is asked for, of the same shape.
void draw_small(std::vector<std::string>& words) {
    add_missing(words, "--size", "320x180");
    std::string& size = *(std::find(words.begin(), words.end(), "--size") + 1);
    const std::size_t by = size.find('x');
    const auto smaller = [](const std::string& side) { return std::stoi(side) / 8 * 2; };
    size = fmt::format("{}x{}", smaller(size.substr(0, by)), smaller(size.substr(by + 1)));
}

}  // namespace

std::string ManualCommand::said() const {
    return fmt::format("{}:{}: raks {}", document, line, fmt::join(words, " "));
}

std::vector<std::string> manual_documents() {
    std::vector<std::string> found = {"README.md"};
    for (const char* folder : {"docs", "models"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            if (entry.path().extension() == ".md") {
                found.push_back(entry.path().lexically_relative(kRoot).generic_string());
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<ManualCommand> commands_of(const std::string& document) {
    return Reader(document).read();
}

std::vector<std::string> without_window(std::vector<std::string> words) {
    const std::string command = words.front();
    if (command == "play") {
        words.insert(words.end(), {"--headless", "--no-sound"});
        add_missing(words, "--duration", "1");
    }
    if (command == "render") {
        add_missing(words, "--duration", "0.4");
        add_missing(words, "--quality", "fast");
        draw_small(words);
    }
    if (command == "stick") {
        add_missing(words, "-o", "window.png");
    }
    return words;
}

void write_manual_files(const fs::path& folder) {
    using audio::Style;
    write_music(folder / "song.wav", Style::montuno, 180.0, 8.0);
    fs::rename(folder / "song.wav", folder / "song.mp3");  // told by what it holds
    ASSERT_TRUE(write_file(folder / "song.beats", beats_text(1.0 / 3.0, 24)));
    write_music(folder / "album/1.wav", Style::clicks, 120.0, 1.0);
    ASSERT_TRUE(write_file(folder / "list.m3u", "#EXTM3U\nsong.mp3\nalbum/1.wav\n"));
    write_music(folder / "excerpts/drums.wav", Style::drums, 120.0, 12.0);
    ASSERT_TRUE(write_file(folder / "excerpts/drums.beats", beats_text(0.5, 24)));
    ASSERT_TRUE(write_file(folder / "excerpts/index.tsv", "name\tclass\ndrums\tdrums\n"));
    write_music(folder / "music/salsa/1.wav", Style::montuno, 190.0, 6.0);
    write_music(folder / "music/rock/1.wav", Style::backbeat, 130.0, 6.0);
    write_dance(folder / "my.toml", "tango");
    write_clips(folder);
    fs::copy_file(kRoot / "tests/data/avatars/Godette_vrm_v4.vrm", folder / "me.vrm");
}

void write_dance(const fs::path& file, const std::string& name) {
    auto text = read_file(kRoot / "config/choreographies/waltz.toml");
    ASSERT_TRUE(text) << text.error().message;
    const std::string old = "dance = \"waltz\"";
    text->replace(text->find(old), old.size(), "dance = \"" + name + "\"");
    ASSERT_TRUE(write_file(file, *text));
}

void write_dance_of_one_figure(const fs::path& file, const std::string& name) {
    write_dance(file, name);
    auto text = read_file(file);
    ASSERT_TRUE(text) << text.error().message;
    const std::size_t second = text->find("[[figure]]", text->find("[[figure]]") + 1);
    ASSERT_TRUE(write_file(file, text->substr(0, second)));
}

void write_clips(const fs::path& folder) {
    fs::create_directories(folder / "CLIPS");
    const motion::TrainingClip clip = motion::test::known_dance(3);
    ASSERT_TRUE(
        motion::write_bvh(folder / "CLIPS/1.bvh", motion::mannequin_skeleton(), clip.poses, 60.0));
    std::string labels = "take\trole\tstart\tend\tfigure\tbeats\tconfidence\tsplit\n";
    std::string counts = "take\tcount\tframe\n";
    for (int r = 0; r < 3; ++r) {
        labels += fmt::format("1\tlead\t{}\t{}\tbasic\t8\t1\ttrain\n", 160 * r, 160 * r + 160);
        for (int c = 1; c <= 8; ++c) {
            counts += fmt::format("1\t{}\t{}\n", c, 160 * r + 20 * (c - 1));
        }
    }
    ASSERT_TRUE(write_file(folder / "labels.tsv", labels));
    ASSERT_TRUE(write_file(folder / "counts.tsv", counts));
}

}  // namespace raks::test
