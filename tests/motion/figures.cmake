raks_test_program(figures
    SOURCES figures/common_turn_test.cpp figures/figure_file_test.cpp figures/figure_grammar_test.cpp
            figures/figure_trainer_test.cpp
            figures/label_tables_test.cpp figures/motion_features_test.cpp figures/music_counts_test.cpp figures/position_figure_test.cpp
            figures/classifier_evaluation_test.cpp figures/figure_report_test.cpp
            figures/state_selection_test.cpp figures/shipped_figures_test.cpp figures/training_plan_test.cpp
    LIBRARIES raks::motion_figures fmt::fmt)
