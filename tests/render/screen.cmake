find_package(X11 REQUIRED)
raks_test_program(render_window
    SOURCES window/frame_limiter_test.cpp window/window_test.cpp
    LIBRARIES raks::render_window raks::render_overlay PkgConfig::EPOXY X11::X11)
raks_test_program(render_overlay
    SOURCES overlay/key_bindings_test.cpp overlay/overlay_test.cpp overlay/text_format_test.cpp
    LIBRARIES raks::render_overlay)
set(film_tests video/png_test.cpp)
if(RAKS_FFMPEG_VIDEO)
    list(APPEND film_tests video/film_sync_test.cpp video/video_writer_test.cpp)
endif()
raks_test_program(render_video
    SOURCES ${film_tests}
    LIBRARIES raks::render_video PkgConfig::PNG)
