# OpenCV's modules that calibrate cameras, as RaksOpenCV::RaksOpenCV, and the one that runs networks, as
# RaksOpenCV::Networks. Its own CMake files come only with Debian's libopencv-dev, and that with a hundred
# packages (Java, VTK, GDAL) that none needs.
find_path(RaksOpenCV_INCLUDE_DIR opencv2/aruco.hpp PATH_SUFFIXES opencv4)
set(RaksOpenCV_LIBRARIES "")
set(RaksOpenCV_NEEDED RaksOpenCV_INCLUDE_DIR)
foreach(module aruco video calib3d imgproc core)
    find_library(RaksOpenCV_${module} opencv_${module})
    list(APPEND RaksOpenCV_LIBRARIES "${RaksOpenCV_${module}}")
    list(APPEND RaksOpenCV_NEEDED RaksOpenCV_${module})
endforeach()

find_library(RaksOpenCV_dnn opencv_dnn)
list(APPEND RaksOpenCV_NEEDED RaksOpenCV_dnn)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(RaksOpenCV REQUIRED_VARS ${RaksOpenCV_NEEDED}
    REASON_FAILURE_MESSAGE "run scripts/setup.sh learn, or configure with -DRAKS_CAPTURE=OFF")
mark_as_advanced(${RaksOpenCV_NEEDED})

if(NOT TARGET RaksOpenCV::RaksOpenCV)
    add_library(RaksOpenCV::RaksOpenCV INTERFACE IMPORTED GLOBAL)
    target_include_directories(RaksOpenCV::RaksOpenCV SYSTEM INTERFACE "${RaksOpenCV_INCLUDE_DIR}")
    target_link_libraries(RaksOpenCV::RaksOpenCV INTERFACE ${RaksOpenCV_LIBRARIES})
    add_library(RaksOpenCV::Networks INTERFACE IMPORTED GLOBAL)
    target_link_libraries(RaksOpenCV::Networks INTERFACE "${RaksOpenCV_dnn}" RaksOpenCV::RaksOpenCV)
endif()
