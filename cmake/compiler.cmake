# Language, warnings and the compile definitions that every folder gets.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# No -march here: one binary runs everywhere, the mpm kernels choose their instruction set at run time.
add_compile_options(-Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes)
if(BREECH_WERROR)
    add_compile_options(-Werror)
endif()

# Headers are included from the root: #include "base/status.h"
include_directories(${CMAKE_SOURCE_DIR})

# Where the program looks for cases and materials: $BREECH_MATERIALS, its own installation, then the source tree.
file(RELATIVE_PATH installed_cases ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/breech/cases)
add_compile_definitions(
    BREECH_VERSION="${PROJECT_VERSION}"
    BREECH_SOURCE_CASES="${CMAKE_SOURCE_DIR}/cases"
    BREECH_INSTALLED_CASES="${installed_cases}")

if(BREECH_FUZZ)
    if(NOT CMAKE_C_COMPILER_ID STREQUAL "Clang")
        message(FATAL_ERROR "BREECH_FUZZ needs clang (libFuzzer): cmake --preset fuzz")
    endif()
    add_compile_options(-fsanitize=fuzzer-no-link)
endif()
