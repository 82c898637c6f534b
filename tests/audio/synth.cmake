raks_test_program(audio_synth
    SOURCES synth/music_generator_test.cpp synth/tempo_curve_test.cpp
    LIBRARIES raks::audio_synth)
