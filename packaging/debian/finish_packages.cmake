# CPack reads this when all files of the packages lie in their folders, and before it packs them: what
# Debian asks for and CPack does not know of. Compressed manual pages and changelog, the copyright, and
# the libraries that a package needs. What is loaded when it is asked for, as PipeWire's, is recommended:
# without it the program goes on.

cmake_policy(VERSION 3.25)

# Packages that it asks for without being linked with them: OpenGL and a font.
execute_process(
    COMMAND ${CPACK_RAKS_DEBIAN}/../../scripts/setup.sh --list run
    OUTPUT_VARIABLE needed_RAKS OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ", " needed_RAKS "${needed_RAKS}")
# Of the same build, as both read the same files and talk with each other.
set(needed_TRAIN "raks (= ${CPACK_PACKAGE_VERSION})")
set(needed_CAPTURE "raks (= ${CPACK_PACKAGE_VERSION})")
set(modules raks-pipewire.so)

# libraries_of(NEEDED RECOMMENDED): the packages of the libraries that the files of the lists `always` and
# `asked_for` are linked with, as lists with commas; what is needed is not recommended, too.
function(libraries_of needed recommended)
    set(work ${CPACK_TEMPORARY_DIRECTORY}/shlibdeps)
    file(WRITE ${work}/debian/control "Source: raks\n\nPackage: raks\nArchitecture: any\n")
    list(TRANSFORM always PREPEND "-e")
    list(TRANSFORM asked_for PREPEND "-e")
    execute_process(
        COMMAND dpkg-shlibdeps -O -dDepends ${always} -dRecommends ${asked_for}
        WORKING_DIRECTORY ${work} OUTPUT_VARIABLE found ERROR_VARIABLE said RESULT_VARIABLE fault)
    if(fault)
        message(FATAL_ERROR "dpkg-shlibdeps: ${said}")
    endif()
    string(REGEX MATCH "shlibs:Depends=([^\n]*)" ignored "${found}")
    set(${needed} "${CMAKE_MATCH_1}" PARENT_SCOPE)
    set(${recommended} "" PARENT_SCOPE)
    if(found MATCHES "shlibs:Recommends=([^\n]*)")
        set(${recommended} "${CMAKE_MATCH_1}" PARENT_SCOPE)
    endif()
endfunction()

# The programs and modules below a folder: those that are loaded when they are asked for apart.
function(sort_programs folder)
    file(GLOB_RECURSE files ${folder}/bin/* ${folder}/libexec/* ${folder}/lib/*)
    set(always "")
    set(asked_for "")
    foreach(file IN LISTS files)
        get_filename_component(name ${file} NAME)
        if(name IN_LIST modules)
            list(APPEND asked_for ${file})
        else()
            list(APPEND always ${file})
        endif()
    endforeach()
    set(always ${always} PARENT_SCOPE)
    set(asked_for ${asked_for} PARENT_SCOPE)
endfunction()

# Without name and time of the file in it, so that the bytes are the same each time.
function(compress)
    if(ARGN)
        execute_process(COMMAND gzip -9nf ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
    endif()
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER ${component} upper)
    set(folder ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
    set(documents ${folder}/share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
    file(MAKE_DIRECTORY ${documents})
    configure_file(${CPACK_RAKS_DEBIAN}/copyright ${documents}/copyright COPYONLY)
    configure_file(${CPACK_RAKS_DEBIAN}/changelog ${documents}/changelog COPYONLY)
    file(GLOB pages ${folder}/share/man/man1/*.1)
    compress(${documents}/changelog ${pages})

    sort_programs(${folder})
    libraries_of(needed CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS)
    string(JOIN ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS ${needed_${upper}} ${needed})
endforeach()

# All times in the packages are that of the commit, so that the same source gives the same bytes.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
    execute_process(
        COMMAND git -C ${CPACK_RAKS_DEBIAN} log -1 --format=%ct
        OUTPUT_VARIABLE time OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(time)
        set(ENV{SOURCE_DATE_EPOCH} ${time})
    endif()
endif()
