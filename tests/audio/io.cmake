raks_test_program(audio_io
    SOURCES io/audio_file_test.cpp io/callback_gate_test.cpp io/choose_device_test.cpp io/downmix_test.cpp
            io/file_player_test.cpp io/mangled_files_test.cpp
    LIBRARIES raks::audio_io raks::audio_synth)

# Real servers and real time: one at a time, and nothing beside them.
raks_test_program(audio_devices SERIAL
    SOURCES io/device_stream_test.cpp
    LIBRARIES raks::audio_io)
