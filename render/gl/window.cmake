# The window on the screen: a library of its own, so that what draws off screen needs no GLFW.
raks_pkg(GLFW glfw3)
raks_library(render_window
    SOURCES frame_limiter.cpp window.cpp
    PUBLIC raks::base raks::render_gl
    PRIVATE PkgConfig::GLFW)
