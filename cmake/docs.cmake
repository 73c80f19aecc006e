# SPDX-License-Identifier: BSD-3-Clause
# The pages as a site: cmake --build build/release --target docs writes build/release/docs/html/index.html (Debian:
# pandoc; with doxygen also the pages of the public headers, target `api`, in html/api).
set(BREECH_SITE ${CMAKE_BINARY_DIR}/docs/html)
file(MAKE_DIRECTORY ${BREECH_SITE})

# A comment before a name, or behind a member, is its text.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
    set(DOXYGEN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/docs)
    set(DOXYGEN_HTML_OUTPUT html/api)
    set(DOXYGEN_PROJECT_BRIEF "functions in C")
    set(DOXYGEN_USE_MDFILE_AS_MAINPAGE ${CMAKE_BINARY_DIR}/docs/api.md)
    file(WRITE ${CMAKE_BINARY_DIR}/docs/api.md "\
# Functions in C

Every function, struct and member of the public headers, under *Files* and *Data Structures* above.  Begin with
`circuit/shot.h` for a shot, `mpm/mpm.h` for a scene.

How to build and link a program, and examples: <a href=\"../docs/reference/library.html\">The libraries</a>.
Back to <a href=\"../index.html\">Breech</a>.
")
    set(DOXYGEN_OPTIMIZE_OUTPUT_FOR_C YES)
    set(DOXYGEN_EXTRACT_ALL YES)
    set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
    set(DOXYGEN_WARNINGS NO)
    set(DOXYGEN_WARN_IF_DOC_ERROR NO)
    set(DOXYGEN_QUIET YES)
    set(DOXYGEN_HAVE_DOT NO)
    set(DOXYGEN_MACRO_EXPANSION YES)
    set(DOXYGEN_INCLUDE_PATH ${CMAKE_SOURCE_DIR})
    set(DOXYGEN_STRIP_FROM_PATH ${CMAKE_SOURCE_DIR})
    set(DOXYGEN_EXAMPLE_PATH ${CMAKE_SOURCE_DIR}/examples)
    set(DOXYGEN_INPUT_FILTER "sed -E 's:^/\\* (SPDX):/* \\1:; t; s:([;,]|\\) ?) +/\\* :\\1 /**< :; t; s:^( *)/\\* :\\1/** :'")
    set(documented ${BREECH_PUBLIC_HEADERS})
    list(FILTER documented INCLUDE REGEX "^(base/.*|circuit/.*|mpm/(mpm|scene|material|read/probe|refine/refine|shape/solid|law/flow_curve))\\.h$")
    doxygen_add_docs(api ${documented} ${CMAKE_BINARY_DIR}/docs/api.md)
endif()

find_program(BREECH_PANDOC pandoc)
find_program(BREECH_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(BREECH_PANDOC AND BREECH_PYTHON)
    add_custom_target(docs COMMAND ${BREECH_PYTHON} ${CMAKE_SOURCE_DIR}/docs/site/site.py ${BREECH_SITE} --pandoc ${BREECH_PANDOC} VERBATIM)
    if(TARGET api)
        add_dependencies(docs api)
    endif()
else()
    add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E echo "The site needs pandoc and python3 (Debian: apt-get install pandoc python3 doxygen fonts-dejavu-extra)."
                      COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
