raks_test_program(audio
    SOURCES beat/bar_belief_test.cpp beat/bar_input_test.cpp beat/beat_change_test.cpp beat/beat_pointer_test.cpp beat/beat_regression_test.cpp beat/beat_tracker_test.cpp beat/paper_beat_test.cpp beat/song_listener_test.cpp beat/stage_behaviour_test.cpp beat/tap_tempo_test.cpp
            features/cepstral_mean_test.cpp features/mfcc_hops_test.cpp features/mfcc_test.cpp features/noise_floor_test.cpp features/onset_test.cpp resample/resampler_test.cpp
            genre/bar_patterns_test.cpp genre/genre_listener_test.cpp genre/genre_recognizer_test.cpp genre/shipped_genres_test.cpp
            listen.cpp music_analyzer_test.cpp odd_sound_test.cpp
    LIBRARIES raks::audio_analyzer raks::audio_beat raks::audio_evaluate raks::audio_features raks::audio_genre raks::audio_resample raks::audio_synth
    TIMEOUT 300)
# The models that the analyzer reads, without the analyzer: quick to build under a sanitizer.
raks_test_program(audio_models
    SOURCES beat/network_file_test.cpp genre/genre_file_test.cpp
    LIBRARIES raks::audio_beat_network raks::audio_genre)
raks_test_program(audio_training_files
    SOURCES beat/corpus_file_test.cpp
    LIBRARIES raks::audio_beat_training)
raks_test_program(audio_training
    SOURCES beat/bar_training_test.cpp beat/mel_hearing_test.cpp beat/network_training_test.cpp beat/training_music_test.cpp
            genre/genre_samples_test.cpp genre/genre_shard_test.cpp genre/genre_training_test.cpp
            genre/fusion_fit_test.cpp genre/quarter_tones_test.cpp genre/sound_damage_test.cpp
            genre/synthesizers_test.cpp
            genre/written_music_test.cpp
    LIBRARIES raks::audio_beat_training raks::audio_codec raks::audio_genre_training)
