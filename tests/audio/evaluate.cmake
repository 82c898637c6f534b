raks_test_program(audio_evaluate
    SOURCES evaluate/beat_corpus_test.cpp evaluate/beat_metrics_test.cpp
            evaluate/beat_scores_test.cpp
    LIBRARIES raks::audio_evaluate nlohmann_json::nlohmann_json)
