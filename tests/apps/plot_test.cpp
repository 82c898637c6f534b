#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "apps/reports/plot_sheet.hpp"
#include "apps/reports/plot_svg.hpp"
#include "apps/reports/web_page.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::apps {
namespace {

class ReferenceBeats : public ::testing::Test {
 protected:
    Expected<std::vector<BeatEvent>> read(const std::string& text) const {
        EXPECT_TRUE(write_file(path_, text));
        return read_reference_beats(path_);
    }
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "reference.beats";
};

TEST(PlotSheet, base64_agrees_with_rfc_4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

TEST(PlotSheet, text_is_escaped_and_what_is_not_utf8_is_replaced) {
    EXPECT_EQ(xml_text("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
    EXPECT_EQ(xml_text("t\xC3\xBCrk \xE2\x99\xAB"), "t\xC3\xBCrk \xE2\x99\xAB");
    EXPECT_EQ(xml_text("a\x01\nb"), "a  b");
    EXPECT_EQ(xml_text("a\xFFz"), "a\xEF\xBF\xBDz");
    EXPECT_EQ(xml_text("\xE2\x99"), "\xEF\xBF\xBD\xEF\xBF\xBD");
}

TEST_F(ReferenceBeats, times_and_positions_are_read) {
    const auto beats = read("# made by hand\n0.5\t1\n\n1.0 2\r\n1.5\n");
    ASSERT_TRUE(beats) << beats.error().message;
    ASSERT_EQ(beats->size(), 3U);
    EXPECT_EQ((*beats)[0].time, stream_time_from_seconds(0.5));
    EXPECT_EQ((*beats)[0].bar_position, 1);
    EXPECT_EQ((*beats)[1].bar_position, 2);
    EXPECT_EQ((*beats)[2].bar_position, 0);
}

TEST_F(ReferenceBeats, a_bad_line_is_named) {
    struct Case {
        const char* text;
        const char* part;
    };
    for (const Case& c : {Case{"0.5\nabc\n", "line 2: 'abc'"},
                          Case{"1.0\n0.5\n", "line 2: a beat that is not after"},
                          Case{"1.0 x\n", "line 1: '1.0 x' is not a time and a position"},
                          Case{"nan\n", "line 1"},
                          Case{"1e300\n", "line 1"},
                          Case{"-1\n", "line 1"},
                          Case{"1.0 1 1\n", "line 1"}}) {
        const auto beats = read(c.text);
        ASSERT_FALSE(beats) << c.text;
        EXPECT_NE(beats.error().message.find(c.part), std::string::npos) << beats.error().message;
        EXPECT_EQ(beats.error().message.find('\n'), std::string::npos);
    }
}

TEST_F(ReferenceBeats, cut_and_flipped_files_are_read_or_refused) {
    const std::string text = "0.50\t1\n1.02\t2\n1.51\t3\n2.00\t4\n";
    for (std::size_t size = 0; size < text.size(); ++size) {
        if (const auto beats = read(text.substr(0, size))) {
            EXPECT_LE(beats->size(), 4U);
        }
    }
    const CounterRandom random(7);
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        std::string bent = text;
        bent[random.below(2 * trial, static_cast<std::uint32_t>(text.size()))] =
            static_cast<char>(random.below(2 * trial + 1, 256));
        if (const auto beats = read(bent)) {
            EXPECT_LE(beats->size(), 5U);
        } else {
            EXPECT_NE(beats.error().message.find("line"), std::string::npos);
        }
    }
}

TEST(PlotData, memory_is_bounded_and_nothing_is_lost_by_merging) {
    PlotData data;
    ASSERT_TRUE(data.prepare(SampleRate(32'000)));
    // 100 s: 10,000 hops, merged to 4 a column. One loud sample at 61.005 s.
    std::vector<float> second(32'000, 0.0F);
    for (int i = 0; i < 100; ++i) {
        second[160] = i == 61 ? 0.75F : 0.0F;
        data.add(second);
    }
    for (HopIndex hop = 0; hop < 10'000; ++hop) {
        MusicState state;
        state.hop = hop;
        state.grid.tempo = Bpm(100.0);
        state.grid.confidence = 0.5F;
        data.add(state);
    }
    data.finish(std::chrono::seconds(100));
    EXPECT_DOUBLE_EQ(data.seconds_per_column(), 0.04);
    ASSERT_EQ(data.columns().size(), 2500U);
    for (std::size_t i = 0; i < data.columns().size(); ++i) {
        const PlotColumn& column = data.columns()[i];
        EXPECT_EQ(column.states, 4);
        EXPECT_EQ(column.tempi, 4);
        EXPECT_EQ(column.high, i == 1525 ? 0.75F : 0.0F) << i;
        EXPECT_DOUBLE_EQ(column.bpm / column.tempi, 100.0);
    }
}

TEST(PlotData, beats_of_another_method_change_nothing_but_tempo_and_confidence) {
    PlotData data;
    ASSERT_TRUE(data.prepare(SampleRate(32'000)));
    for (HopIndex hop = 0; hop < 10'000; ++hop) {
        MusicState state;
        state.hop = hop;
        data.add(state);
    }
    const std::vector<PlotColumn> before(data.columns().begin(), data.columns().end());
    data.replace_beats(
        {{stream_time_from_seconds(0.0), 1, 0.9F}, {stream_time_from_seconds(0.5), 2, 0.9F}});
    for (std::size_t i = 0; i < before.size(); ++i) {
        const PlotColumn& column = data.columns()[i];
        EXPECT_EQ(column.music, before[i].music);
        EXPECT_EQ(column.states, before[i].states);
        EXPECT_EQ(column.tempi, 1);
        EXPECT_EQ(column.bpm, 120.0);
    }
}

TEST(PlotData, a_sine_lights_its_band_at_its_level) {
    PlotData data;
    ASSERT_TRUE(data.prepare(SampleRate(32'000)));
    std::vector<float> sine(32'000);
    for (std::size_t i = 0; i < sine.size(); ++i) {
        // Bin 32 of 1024: 1 kHz. -20 dBFS.
        sine[i] = static_cast<float>(0.1 * std::sin(2.0 * M_PI * static_cast<double>(i) / 32.0));
    }
    data.add(sine);
    data.finish(std::chrono::seconds(1));
    const auto& level = data.columns()[50].level;
    const auto loudest = std::max_element(level.begin(), level.end());
    EXPECT_NEAR(*loudest, -20.0F, 0.1F);
    const auto band = static_cast<double>(loudest - level.begin());
    const auto mel = [](double hertz) { return std::log10(1.0 + hertz / 700.0); };
    const double wanted = 96.0 * (mel(1000.0) - mel(30.0)) / (mel(16000.0) - mel(30.0));
    EXPECT_NEAR(band + 0.5, wanted, 1.5);
}

/// The SVG group of a panel.
std::string panel_of(const std::string& svg, const std::string& id) {
    const std::size_t begin = svg.find("<g id=\"" + id + "\">");
    EXPECT_NE(begin, std::string::npos) << id;
    return svg.substr(begin, svg.find("</g>", begin) - begin);
}

TEST(PlotSvg, shows_where_beats_have_three_parts_and_where_another_tempo_is_likely) {
    PlotData data;
    ASSERT_TRUE(data.prepare(SampleRate(32'000)));
    data.add(std::vector<float>(10 * 32'000));
    // From 0 to 2 s no beat, then two parts, from 5 s on three; to 4 s it may be 66 BPM.
    for (HopIndex hop = 0; hop < 1'000; ++hop) {
        MusicState state;
        state.hop = hop;
        state.time = time_of_hop(hop);
        state.grid.tempo = Bpm(99.0);
        state.grid.confidence = hop < 200 ? 0.0F : 0.6F;
        state.beat_parts = hop < 500 ? 2 : 3;
        state.rival = {66.0, hop < 400 ? 0.35F : 0.05F};
        data.add(state);
    }
    data.finish(std::chrono::seconds(10));
    const std::string svg = draw_plot(data, {.title = "a", .method = "b", .reference = {}}).value();
    // The axis has 128.4 units a second, from 92 on.
    const std::string parts = panel_of(svg, "beat_parts");
    const std::string two = parts.substr(parts.find("d=\"M348.8"));
    EXPECT_NE(parts.find("d=\"M348.8"), std::string::npos) << parts;
    EXPECT_NE(two.find("H734.0"), std::string::npos) << parts;
    EXPECT_NE(parts.find("d=\"M734.0"), std::string::npos) << parts;
    const std::string tempo = panel_of(svg, "tempo");
    EXPECT_EQ(tempo.find("M347.5"), std::string::npos) << "no beat, no other tempo";
    EXPECT_NE(tempo.find("M350.1"), std::string::npos);
    EXPECT_NE(tempo.find("M604.3"), std::string::npos);
    EXPECT_EQ(tempo.find("M606.9"), std::string::npos);
}

TEST(PlotSvg, an_empty_file_still_gives_every_panel) {
    PlotData data;
    ASSERT_TRUE(data.prepare(SampleRate(48'000)));
    data.finish(Nanos(0));
    const auto svg = draw_plot(data, {.title = "a<b", .method = "none", .reference = {}});
    ASSERT_TRUE(svg) << svg.error().message;
    for (const char* id : {"waveform",
                           "spectrogram",
                           "onsets",
                           "beats",
                           "tempo",
                           "bar",
                           "beat_parts",
                           "confidence",
                           "energy",
                           "form",
                           "accents",
                           "time"}) {
        EXPECT_NE(svg->find("<g id=\"" + std::string(id) + "\">"), std::string::npos) << id;
    }
    EXPECT_EQ(svg->find("nan"), std::string::npos);
    EXPECT_NE(svg->find("a&lt;b"), std::string::npos);
}

}  // namespace
}  // namespace raks::apps
