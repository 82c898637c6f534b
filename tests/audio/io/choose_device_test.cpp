#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audio/io/devices.hpp"

namespace raks::audio {
namespace {

using ::testing::HasSubstr;

AudioDevice device(const char* name, const char* api, int in, int out) {
    return {.portaudio_index = 0,
            .name = name,
            .id = name,
            .host_api = api,
            .input_channels = in,
            .output_channels = out};
}

AudioDevice monitor(const char* name, const char* id) {
    AudioDevice result = device(name, "PulseAudio", 2, 0);
    result.id = id;
    result.is_monitor = true;
    return result;
}

std::vector<AudioDevice> desktop() {
    std::vector<AudioDevice> devices{device("system", "JACK", 2, 2),
                                     device("some player", "JACK", 2, 0),
                                     monitor("Monitor of Speakers", "speakers.monitor"),
                                     monitor("Monitor of Living Room Screen", "hdmi.monitor"),
                                     device("USB Mic, Deluxe: Audio (hw:1,0)", "ALSA", 1, 0),
                                     device("HDMI 0", "ALSA", 0, 8),
                                     device("default", "ALSA", 32, 32)};
    devices[6].is_default_input = true;
    devices[6].is_default_output = true;
    return devices;
}

TEST(ChooseDevice, live_listens_to_what_the_computer_plays_when_it_can) {
    const auto choice = choose_input(desktop());
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->device.id, "speakers.monitor");
    EXPECT_EQ(choice->reason,
              "'Monitor of Speakers' (PulseAudio): it is what this computer plays "
              "(JACK is running too: --audio-system jack)");
}

/// A desktop's sound server with one loudspeaker, beside JACK or alone.
std::vector<AudioDevice> pulse_with(const char* sink, bool has_jack) {
    std::vector<AudioDevice> devices;
    if (has_jack) {
        devices.push_back(device("system", "JACK", 2, 2));
        devices.back().system = AudioSystemKind::jack;
        devices.back().is_default_input = true;
        devices.back().is_default_output = true;
    }
    devices.push_back(monitor("Monitor", (std::string(sink) + ".monitor").c_str()));
    devices.push_back(device("Loudspeaker", "PulseAudio", 0, 2));
    devices.back().id = sink;
    devices.back().system = AudioSystemKind::pulse;
    devices.back().is_default_output = true;
    return devices;
}

TEST(ChooseDevice, play_goes_where_live_listens_and_both_say_that_there_is_another_system) {
    const auto both = pulse_with("speakers", true);
    EXPECT_EQ(choose_input(both)->device.id, "speakers.monitor");
    EXPECT_EQ(choose_output(both)->device.id, "speakers");
    EXPECT_EQ(choose_output(both)->reason,
              "'Loudspeaker' (PulseAudio): the default output "
              "(JACK is running too: --audio-system jack)");
    const auto alone = pulse_with("speakers", false);
    EXPECT_EQ(choose_input(alone)->reason,
              "'Monitor' (PulseAudio): it is what this computer plays");
    EXPECT_EQ(choose_output(alone)->reason, "'Loudspeaker' (PulseAudio): the default output");
}

TEST(ChooseDevice, a_loudspeaker_that_the_server_made_up_comes_after_jack) {
    const auto both = pulse_with("auto_null", true);
    EXPECT_EQ(choose_input(both)->device.name, "system");
    EXPECT_EQ(choose_output(both)->device.name, "system");
    const auto alone = pulse_with("auto_null", false);
    EXPECT_EQ(choose_input(alone)->device.id, "auto_null.monitor");
    EXPECT_EQ(choose_output(alone)->device.id, "auto_null");
}

TEST(ChooseDevice, without_monitors_it_is_jack_then_the_default_then_the_first) {
    auto devices = desktop();
    std::erase_if(devices, [](const AudioDevice& each) { return each.is_monitor; });
    EXPECT_EQ(choose_input(devices)->device.name, "system");
    EXPECT_EQ(choose_output(devices)->device.name, "system");
    devices.erase(devices.begin(), devices.begin() + 2);
    EXPECT_EQ(choose_input(devices)->device.name, "default");
    EXPECT_EQ(choose_output(devices)->device.name, "default");
    devices.pop_back();
    EXPECT_EQ(choose_input(devices)->device.name, "USB Mic, Deluxe: Audio (hw:1,0)");
    EXPECT_EQ(choose_output(devices)->device.name, "HDMI 0");
}

TEST(ChooseDevice, a_monitor_of_pipewire_through_jack_counts) {
    auto devices = desktop();
    std::erase_if(devices, [](const AudioDevice& each) { return each.is_monitor; });
    devices.push_back(device("Built-in Audio Monitor", "JACK", 2, 0));
    devices.back().is_monitor = true;
    EXPECT_EQ(choose_input(devices)->device.name, "Built-in Audio Monitor");
}

TEST(ChooseDevice, users_name_a_number_a_name_or_a_part_of_one) {
    struct Row {
        const char* wanted;
        const char* name;
    };
    for (const Row& row :
         {Row{"4", "USB Mic, Deluxe: Audio (hw:1,0)"},
          Row{"USB Mic, Deluxe: Audio (hw:1,0)", "USB Mic, Deluxe: Audio (hw:1,0)"},
          Row{"usb mic", "USB Mic, Deluxe: Audio (hw:1,0)"},
          Row{"some player", "some player"},
          Row{"DEFAULT", "default"},
          Row{"hdmi", "Monitor of Living Room Screen"},
          Row{"monitor of living room screen", "Monitor of Living Room Screen"},
          Row{"hdmi.monitor", "Monitor of Living Room Screen"},
          Row{"Living Room", "Monitor of Living Room Screen"}}) {
        const auto choice = choose_input(desktop(), row.wanted);
        ASSERT_TRUE(choice) << choice.error().message;
        EXPECT_EQ(choice->device.name, row.name) << row.wanted;
    }
    EXPECT_EQ(choose_output(desktop(), "hdmi")->device.name, "HDMI 0");
}

TEST(ChooseDevice, what_does_not_exist_is_an_error_that_lists_what_does) {
    EXPECT_EQ(choose_output(desktop(), "kitchen").error().message,
              "no output 'kitchen'; there are 0 'system' (JACK), 5 'HDMI 0' (ALSA), "
              "6 'default' (ALSA)");
    EXPECT_THAT(choose_input(desktop(), "monitor").error().message,
                HasSubstr("'monitor' fits several inputs: 'Monitor of Speakers' (PulseAudio), "
                          "'Monitor of Living Room Screen' (PulseAudio); "
                          "name one in full or by number"));
    EXPECT_THAT(choose_input(desktop(), "5").error().message,
                HasSubstr("device 5 'HDMI 0' (ALSA) is no input; there are 0 "));
    EXPECT_THAT(choose_input(desktop(), "99").error().message, HasSubstr("no input '99'"));
    EXPECT_THAT(choose_input({}).error().message, HasSubstr("no audio input was found"));
    EXPECT_EQ(choose_input({}, "x").error().message, "no input 'x'; there is none");
}

TEST(ChooseDevice, two_of_the_same_name_are_told_apart_by_their_ids) {
    auto devices = desktop();
    devices.push_back(monitor("Monitor of Speakers", "usb.monitor"));
    EXPECT_THAT(choose_input(devices, "monitor of speakers").error().message,
                HasSubstr("fits several inputs: 'Monitor of Speakers' (PulseAudio) "
                          "speakers.monitor, 'Monitor of Speakers' (PulseAudio) usb.monitor; "));
    EXPECT_EQ(choose_input(devices, "usb.monitor")->device.id, "usb.monitor");
}

TEST(AudioSystem, every_kind_has_a_word) {
    for (const auto kind : {AudioSystemKind::automatic,
                            AudioSystemKind::portaudio,
                            AudioSystemKind::jack,
                            AudioSystemKind::pulse}) {
        EXPECT_EQ(audio_system_of(name_of(kind)), kind);
    }
}

}  // namespace
}  // namespace raks::audio
